/* Maps texel by texel, and rotations by quaternion products, so that no matrix of the renderer is trusted. */
#include "maps.h"

#include <stdlib.h>

environment_map maps_even(int width, float level)
{
    environment_map m = { width, width / 2, NULL };
    m.rgb = malloc((size_t)width * (size_t)m.height * 3 * sizeof *m.rgb);
    if (m.rgb == NULL)
        abort();
    for (int y = 0; y < m.height; ++y)
        for (int x = 0; x < width; ++x)
            maps_set(&m, x, y, level);
    return m;
}

void maps_set(environment_map *m, int x, int y, float level)
{
    float *const texel = &m->rgb[3 * ((size_t)y * (size_t)m->width + (size_t)x)];
    texel[0] = texel[1] = texel[2] = level;
}

double maps_texel_sr(const environment_map *m, int y)
{
    const double top = cos(PREVIEW_PI * y / m->height), bottom = cos(PREVIEW_PI * (y + 1) / m->height);
    return (top - bottom) * 2.0 * PREVIEW_PI / m->width;
}

double maps_add_disc(environment_map *m, vec3 towards, double radius, float level)
{
    double covered = 0.0;
    for (int y = 0; y < m->height; ++y)
        for (int x = 0; x < m->width; ++x) {
            double d[3];
            environment_map_direction((x + 0.5) / m->width, (y + 0.5) / m->height, d);
            if (v3_dot(v3(d[0], d[1], d[2]), v3_normalize(towards)) < cos(radius))
                continue;
            maps_set(m, x, y, level);
            covered += maps_texel_sr(m, y);
        }
    return covered;
}

double maps_light(const environment_map *m)
{
    double sum = 0.0;
    for (int y = 0; y < m->height; ++y)
        for (int x = 0; x < m->width; ++x)
            sum += maps_texel_sr(m, y) * (double)m->rgb[3 * ((size_t)y * (size_t)m->width + (size_t)x) + 1];
    return sum;
}

preview_environment maps_environment(const environment_map *m)
{
    return (preview_environment){ m, { 0.0F, 0.0F, 0.0F, 1.0F }, 1.0F };
}

/* v + 2 w (q x v) + 2 q x (q x v), for a unit quaternion (q, w). */
static vec3 turn(const float rotation[4], double sign, vec3 v)
{
    const double length =
        sqrt(v3_dot(v3_from(rotation), v3_from(rotation)) + (double)rotation[3] * (double)rotation[3]);
    const vec3 q = v3_scale(v3_from(rotation), sign / length);
    const vec3 once = v3_cross(q, v);
    return v3_mad(v3_mad(v, once, 2.0 * (double)rotation[3] / length), v3_cross(q, once), 2.0);
}

vec3 maps_direction(const preview_environment *e, double u, double v)
{
    double d[3];
    environment_map_direction(u, v, d);
    return turn(e->rotation, 1.0, v3(d[0], d[1], d[2]));
}

void maps_place(const preview_environment *e, vec3 direction, double place[2])
{
    const vec3 d = turn(e->rotation, -1.0, direction);
    const double there[3] = { d.x, d.y, d.z };
    environment_map_place(there, &place[0], &place[1]);
}
