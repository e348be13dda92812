/* Two lanes: what every machine has. */
#define WIDE_LANES 2
#include "preview/camera_kernel.h"
#include "preview/hit_kernel.h"
#include "preview/light_kernel.h"

const kernels kernels_2 = {
    .lanes = WIDE_LANES, .draw = draw_pairs, .camera = leave_camera, .hit = resolve_hits, .light = look_at_light
};
