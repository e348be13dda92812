/* A caller's lights and what surrounds its scene, checked and copied. */
#include "preview/caller_light.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- lights ---- */

static bool check_light(const glint_preview_light *from, const char *place, report *r)
{
    if (!caller_check_size(place, from->size, sizeof *from, r))
        return false;
    if (from->kind < GLINT_PREVIEW_LIGHT_SUN || from->kind > GLINT_PREVIEW_LIGHT_DISK)
        return report_error(r, "%s: kind is %d; expected %d to %d", place, from->kind, GLINT_PREVIEW_LIGHT_SUN,
                            GLINT_PREVIEW_LIGHT_DISK);
    const float numbers[12] = { from->color[0],  from->color[1],       from->color[2],
                                from->intensity, from->range_m,        from->inner_cone_rad,
                                from->radius_m,  from->outer_cone_rad, from->angular_diameter_rad,
                                from->width_m,   from->height_m,       0.0F };
    for (int i = 0; i < 12; ++i) {
        if (!(numbers[i] >= 0.0F) || !isfinite(numbers[i]))
            return report_error(r, "%s: found %g, expected finite numbers that are not negative", place,
                                (double)numbers[i]);
    }
    if (from->kind == GLINT_PREVIEW_LIGHT_SPOT && !(from->inner_cone_rad < from->outer_cone_rad))
        return report_error(r, "%s: inner_cone_rad is %g; expected less than the outer_cone_rad of %g", place,
                            (double)from->inner_cone_rad, (double)from->outer_cone_rad);
    return caller_check_finite(place, "to_world", from->to_world, 16, r);
}

static scene_light light_of(const glint_preview_light *from)
{
    static const scene_light_kind kinds[] = { SCENE_LIGHT_DIRECTIONAL, SCENE_LIGHT_POINT, SCENE_LIGHT_SPOT,
                                              SCENE_LIGHT_RECT, SCENE_LIGHT_DISK };
    scene_light to = { .kind = kinds[from->kind],
                       .color = { from->color[0], from->color[1], from->color[2] },
                       .intensity = from->intensity,
                       .range = from->range_m,
                       .inner_cone_rad = from->inner_cone_rad,
                       .outer_cone_rad = from->outer_cone_rad,
                       .angular_diameter_rad = from->angular_diameter_rad,
                       .radius_m = from->radius_m,
                       .width_m = from->width_m,
                       .height_m = from->height_m };
    memcpy(to.to_world, from->to_world, sizeof to.to_world);
    return to;
}

bool caller_lights_copy(const glint_preview_scene_options *o, scene *s, report *r)
{
    if (!caller_check_array("lights", o->lights, o->light_count, r))
        return false;
    s->lights = calloc(o->light_count > 0 ? o->light_count : 1U, sizeof *s->lights);
    if (s->lights == NULL)
        return report_error(r, "no memory for %zu lights", o->light_count);
    for (size_t i = 0; i < o->light_count; ++i) {
        char place[32];
        snprintf(place, sizeof place, "lights/%zu", i);
        if (!check_light(&o->lights[i], place, r))
            return false;
        s->lights[s->light_count++] = light_of(&o->lights[i]);
    }
    return true;
}

/* ---- world ---- */

/* Texels that hold no light there can be are black, as in a file. */
static bool copy_map(const glint_preview_world *from, caller_world *to, report *r)
{
    if (from->map_width < 2 || from->map_width != 2 * from->map_height)
        return report_error(r, "world: its map is %d x %d pixels, expected twice as wide as high", from->map_width,
                            from->map_height);
    const size_t count = 3 * (size_t)from->map_width * (size_t)from->map_height;
    to->map = (environment_map){ from->map_width, from->map_height, malloc(count * sizeof(float)) };
    if (to->map.rgb == NULL)
        return report_error(r, "world: a map of %d x %d pixels does not fit into memory", from->map_width,
                            from->map_height);
    size_t mended = 0;
    for (size_t i = 0; i < count; ++i) {
        const bool good = isfinite(from->map[i]) && from->map[i] >= 0.0F;
        to->map.rgb[i] = good ? from->map[i] : 0.0F;
        mended += good ? 0U : 1U;
    }
    if (mended > 0)
        report_warning(r, "world: %zu numbers of its map are no radiance (negative or not finite) and are taken as 0",
                       mended);
    to->environment = (preview_environment){ .map = &to->map, .scale = from->map_scale };
    memcpy(to->environment.rotation, from->map_rotation, sizeof to->environment.rotation);
    return true;
}

bool caller_world_copy(const glint_preview_world *from, caller_world *to, report *r)
{
    if (!caller_check_size("world", from->size, sizeof *from, r) ||
        !caller_check_finite("world", "color", from->color, 3, r) ||
        !caller_check_finite("world", "map_rotation", from->map_rotation, 4, r) ||
        !caller_check_finite("world", "map_scale", &from->map_scale, 1, r))
        return false;
    for (int c = 0; c < 3; ++c)
        to->sky.zenith[c] = to->sky.horizon[c] = to->sky.ground[c] = fmaxf(from->color[c], 0.0F);
    return from->map == NULL || copy_map(from, to, r);
}
