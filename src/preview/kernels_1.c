/* One point at a time. */
#define WIDE_LANES 1
#include "preview/camera_kernel.h"
#include "preview/hit_kernel.h"
#include "preview/light_kernel.h"

const kernels kernels_1 = {
    .lanes = WIDE_LANES, .draw = draw_pairs, .camera = leave_camera, .hit = resolve_hits, .light = look_at_light
};
