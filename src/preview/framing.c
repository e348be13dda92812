/* The camera of a file that has none: a three-quarter view from slightly above that just holds the whole scene. */
#include "preview/preview.h"
#include "preview/vector.h"

/* Taste: the view of product photography. */
#define AZIMUTH_RAD 0.6
#define ELEVATION_RAD 0.4
#define YFOV_RAD 0.5
#define MARGIN 1.05

scene_camera preview_framed_camera(const scene *s, int width, int height)
{
    vec3 low = v3_from(s->bounds_min);
    vec3 high = v3_from(s->bounds_max);
    if (!(low.x <= high.x && low.y <= high.y && low.z <= high.z)) /* nothing to see: any view will do */
        low = high = v3(0.0, 0.0, 0.0);
    const vec3 centre = v3_scale(v3_add(low, high), 0.5);
    const vec3 half = v3_scale(v3_sub(high, low), 0.5);
    const double radius = v3_length(half) > 0.0 ? v3_length(half) : 1.0;

    const vec3 backward =
        v3(sin(AZIMUTH_RAD) * cos(ELEVATION_RAD), sin(ELEVATION_RAD), cos(AZIMUTH_RAD) * cos(ELEVATION_RAD));
    const vec3 right = v3_normalize(v3_cross(v3(0.0, 1.0, 0.0), backward));
    const vec3 up = v3_cross(backward, right);

    /* A corner at (x, y, z) of the camera's axes is in the picture from distance z + |x| / tan on. */
    const double slope_y = tan(0.5 * YFOV_RAD);
    const double slope_x = slope_y * (double)width / (double)height;
    double distance = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 p = v3(corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z);
        const double reach = fmax(fabs(v3_dot(p, right)) / slope_x, fabs(v3_dot(p, up)) / slope_y);
        distance = fmax(distance, v3_dot(p, backward) + MARGIN * reach);
    }
    distance = fmax(distance, 0.01 * radius);
    if (!(v3_length(half) > 0.0))
        distance = 4.0 * radius;

    scene_camera camera = { .projection = SCENE_PERSPECTIVE, .yfov_rad = (float)YFOV_RAD };
    m4_from_axes(right, up, backward, v3_mad(centre, backward, distance), camera.to_world);
    return camera;
}
