/* From a public light to the directions in which the point sees it. */
#include "model/area.h"

#include "math/float_bits.h"
#include "math/real.h"

static int is_usable(const float v[3])
{
    return is_below(v[0], 1e15F) && is_below(v[1], 1e15F) && is_below(v[2], 1e15F);
}

static void see_sphere(const glint_area_light *from, area_light *light)
{
    const vec3d center = vec3d_from(from->center);
    const double distance = vec3d_length(center), radius = (double)clamp_to(from->radius, 0.0F, 1e15F);
    /* It shines outwards: there is nothing to see from within. */
    if (!(distance > radius) || !(distance > 0.0))
        return;
    const double sine = radius / distance;
    area_make_round(light, vec3d_scale(center, 1.0 / distance), sine, sqrt((1.0 - sine) * (1.0 + sine)));
}

static void see_sun(const glint_area_light *from, area_light *light)
{
    /* A cap of solid angle 2 pi (1 - cos). */
    const vec3d axis = vec3d_normalize(vec3d_from(from->center));
    const double versine = (double)clamp_to(from->solid_angle_sr, 0.0F, 6.28318531F) / (2.0 * REAL_PI);
    const double sine = sqrt(real_max(0.0, versine * (2.0 - versine)));
    if (vec3d_dot(axis, axis) > 0.5)
        area_make_round(light, axis, sine, real_max(0.0, 1.0 - versine));
}

static void see_polygon(const glint_area_light *from, area_light *light)
{
    vec3d corner[GLINT_MAX_CORNERS];
    if (from->corner_count < 3U || from->corner_count > GLINT_MAX_CORNERS)
        return;
    for (uint32_t i = 0; i < from->corner_count; i++) {
        if (!is_usable(from->corners[i]))
            return;
        corner[i] = vec3d_from(from->corners[i]);
    }
    area_make_polygon(light, corner, (int)from->corner_count, from->two_sided != 0U);
}

int area_see(const model_query *q, area_light *light)
{
    const glint_area_light *from = q->area_light;
    light->kind = AREA_NOTHING;
    if (from->kind == GLINT_AREA_POLYGON) {
        see_polygon(from, light);
        return light->kind != AREA_NOTHING;
    }
    if (!is_usable(from->center))
        return 0;
    const vec3d center = vec3d_from(from->center);
    switch (from->kind) {
    case GLINT_AREA_SPHERE:
        see_sphere(from, light);
        break;
    case GLINT_AREA_SUN:
        see_sun(from, light);
        break;
    case GLINT_AREA_RECTANGLE:
    case GLINT_AREA_DISK:
        if (is_usable(from->half_x) && is_usable(from->half_y))
            (from->kind == GLINT_AREA_DISK ? area_make_ellipse : area_make_rectangle)(
                light, center, vec3d_from(from->half_x), vec3d_from(from->half_y), from->two_sided != 0U);
        break;
    case GLINT_AREA_POLYGON:
        break;
    }
    return light->kind != AREA_NOTHING;
}

static void turn(const float from[3], vec3 x, vec3 y, vec3 z, float to[3])
{
    /* What is not usable stays so, without arithmetic that would raise an exception. */
    to[0] = to[1] = to[2] = 3e38F;
    if (!is_usable(from))
        return;
    const vec3 v = vec3_from(from);
    to[0] = vec3_dot(v, x);
    to[1] = vec3_dot(v, y);
    to[2] = vec3_dot(v, z);
}

glint_area_light area_turn(const glint_area_light *from, vec3 x, vec3 y, vec3 z)
{
    glint_area_light to = *from;
    turn(from->center, x, y, z, to.center);
    turn(from->half_x, x, y, z, to.half_x);
    turn(from->half_y, x, y, z, to.half_y);
    for (int i = 0; i < GLINT_MAX_CORNERS; i++)
        turn(from->corners[i], x, y, z, to.corners[i]);
    return to;
}
