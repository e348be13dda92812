/* The lookdev rig: a hard key that makes flakes flash, a broad cool fill, a rim from behind, and a soft gradient
 * around. */
#include "preview/rig.h"

#include <stdlib.h>
#include <string.h>

/* Angles of a light as seen from the object: azimuth to the right of the camera, elevation above the ground; radians.
 */
typedef struct rig_light {
    const char *name;
    double azimuth, elevation;
    float color[3], intensity; /* W/m^2; a white wall under pi shows radiance 1 */
    float angular_diameter;
} rig_light;

/* Taste, all of it: three-point lighting. The key is small, nearly as small as the sun, so that flakes flash. */
static const rig_light RIG[RIG_LIGHT_COUNT] = {
    { "key", -0.75, 0.80, { 1.0F, 0.97F, 0.92F }, 2.2F, 0.015F },
    { "fill", 1.10, 0.35, { 0.86F, 0.92F, 1.0F }, 0.4F, 0.12F },
    { "rim", 2.60, 0.55, { 1.0F, 1.0F, 1.0F }, 1.4F, 0.02F },
};

rig_axes rig_axes_of(const scene_camera *camera)
{
    double m[16];
    for (int i = 0; i < 16; ++i)
        m[i] = (double)camera->to_world[i];
    /* The camera's heading: straight down, its up axis points there. */
    vec3 towards_camera = m4_column(m, 2);
    if (fabs(towards_camera.y) > 0.99 * v3_length(towards_camera))
        towards_camera = v3_scale(m4_column(m, 1), towards_camera.y > 0.0 ? -1.0 : 1.0);
    towards_camera = v3_normalize(v3(towards_camera.x, 0.0, towards_camera.z));
    const vec3 up = v3(0.0, 1.0, 0.0);
    return (rig_axes){ towards_camera, v3_cross(up, towards_camera), up };
}

vec3 rig_direction(const rig_axes *axes, double azimuth, double elevation)
{
    const vec3 heading = v3_mad(v3_scale(axes->towards_camera, cos(azimuth)), axes->right, sin(azimuth));
    return v3_mad(v3_scale(heading, cos(elevation)), axes->up, sin(elevation));
}

void rig_lights(const scene_camera *camera, scene_light lights[RIG_LIGHT_COUNT])
{
    const rig_axes axes = rig_axes_of(camera);
    for (int i = 0; i < RIG_LIGHT_COUNT; ++i) {
        const rig_light *const from = &RIG[i];
        const vec3 z = rig_direction(&axes, from->azimuth, from->elevation);
        const vec3 x = v3_normalize(v3_cross(axes.up, z));
        lights[i] = (scene_light){ .kind = SCENE_LIGHT_DIRECTIONAL,
                                   .color = { from->color[0], from->color[1], from->color[2] },
                                   .intensity = from->intensity,
                                   .angular_diameter_rad = from->angular_diameter };
        m4_from_axes(x, v3_cross(z, x), z, v3(0.0, 0.0, 0.0), lights[i].to_world);
    }
}

bool preview_add_lookdev_rig(scene *s, report *r)
{
    const scene_camera camera = s->camera_count > 0 ? s->cameras[0] : preview_framed_camera(s, 16, 9);
    scene_light added[RIG_LIGHT_COUNT];
    rig_lights(&camera, added);

    scene_light *const lights = realloc(s->lights, ((size_t)s->light_count + RIG_LIGHT_COUNT) * sizeof *lights);
    if (lights == NULL)
        return report_error(r, "no memory for the lookdev rig");
    s->lights = lights;
    for (int i = 0; i < RIG_LIGHT_COUNT; ++i) {
        added[i].name = strdup(RIG[i].name);
        if (added[i].name == NULL)
            return report_error(r, "no memory for the lookdev rig");
        s->lights[s->light_count++] = added[i];
    }
    return true;
}

preview_sky rig_sky(void)
{
    return (preview_sky){ .zenith = { 0.42F, 0.46F, 0.53F },
                          .horizon = { 0.20F, 0.205F, 0.215F },
                          .ground = { 0.06F, 0.057F, 0.054F } };
}

void sky_radiance(const preview_sky *sky, vec3 direction, float rgb[3])
{
    const float *const far = direction.y >= 0.0 ? sky->zenith : sky->ground;
    const float t = (float)fmin(fabs(direction.y), 1.0);
    const float soft = t * (2.0F - t); /* most of the change is near the horizon */
    for (int c = 0; c < 3; ++c)
        rgb[c] = sky->horizon[c] + (far[c] - sky->horizon[c]) * soft;
}
