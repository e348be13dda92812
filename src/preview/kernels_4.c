/* Four lanes, AVX2. */
#define WIDE_LANES 4
#include "preview/camera_kernel.h"
#include "preview/hit_kernel.h"
#include "preview/light_kernel.h"

static void resolve_all(hit_batch *b, int count)
{
    for (int at = 0; at < count; at += WIDE_LANES)
        resolve(b, at);
}

const kernels kernels_4 = { .lanes = WIDE_LANES, .camera = leave_camera, .hit = resolve_all, .light = look_at_light };
