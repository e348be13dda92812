/* Copies a caller's arrays into a scene; whatever cannot be is named by its place. */
#include "preview/caller_scene.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/scene_bounds.h"
#include "io/scene_build.h"

bool caller_check_size(const char *name, size_t found, size_t expected, report *r)
{
    if (found == expected)
        return true;
    return report_error(r, "%s: its size is %zu; expected %zu: start from its _INIT macro", name, found, expected);
}

bool caller_check_finite(const char *place, const char *member, const float *values, int count, report *r)
{
    for (int i = 0; i < count; ++i) {
        if (!isfinite(values[i]))
            return report_error(r, "%s: %s: found %g at place %d, expected a finite number", place, member,
                                (double)values[i], i);
    }
    return true;
}

static bool check_array(const char *name, const void *array, size_t count, report *r)
{
    if (count > INT_MAX)
        return report_error(r, "%s: found %zu, expected at most %d", name, count, INT_MAX);
    return array != NULL || count == 0 || report_error(r, "%s: found NULL, expected %zu elements", name, count);
}

static char *text_copy(const char *text, report *r)
{
    const size_t size = strlen(text) + 1;
    char *const copy = malloc(size);
    if (copy != NULL)
        memcpy(copy, text, size);
    else
        report_error(r, "no memory for a name");
    return copy;
}

/* ---- images ---- */

static bool copy_bytes(const glint_preview_image *from, scene_image *to, report *r)
{
    to->bytes = malloc(from->byte_count > 0 ? from->byte_count : 1U);
    if (to->bytes == NULL)
        return report_error(r, "%s: its %zu bytes do not fit into memory", to->name, from->byte_count);
    to->byte_count = from->byte_count;
    memcpy(to->bytes, from->bytes, from->byte_count);
    return true;
}

static bool copy_pixels(const glint_preview_image *from, scene_image *to, report *r)
{
    if (from->width < 1 || from->height < 1)
        return report_error(r, "%s: is %d x %d pixels, expected at least 1 x 1", to->name, from->width, from->height);
    const size_t count = 4 * (size_t)from->width * (size_t)from->height;
    to->texels = malloc(count * sizeof *to->texels);
    if (to->texels == NULL)
        return report_error(r, "%s: %d x %d pixels do not fit into memory", to->name, from->width, from->height);
    to->width = from->width;
    to->height = from->height;
    /* The nearest of 65535 steps; what is no number is black. */
    for (size_t i = 0; i < count; ++i)
        to->texels[i] = (uint16_t)lrintf(65535.0F * fminf(fmaxf(from->pixels[i], 0.0F), 1.0F));
    return true;
}

static bool copy_image(const glint_preview_image *from, int number, scene_image *to, report *r)
{
    char place[32];
    snprintf(place, sizeof place, "images/%d", number);
    if (!caller_check_size(place, from->size, sizeof *from, r))
        return false;
    to->name = text_copy(from->name != NULL ? from->name : place, r);
    if (to->name == NULL)
        return false;
    if ((from->path != NULL) + (from->bytes != NULL) + (from->pixels != NULL) != 1)
        return report_error(r, "%s: found %s of path, bytes and pixels, expected one", to->name,
                            from->path == NULL && from->bytes == NULL && from->pixels == NULL ? "none" : "several");
    if (from->bytes != NULL)
        return copy_bytes(from, to, r);
    if (from->pixels != NULL)
        return copy_pixels(from, to, r);
    to->path = text_copy(from->path, r);
    return to->path != NULL;
}

static bool copy_images(const glint_preview_scene_options *o, scene *s, report *r)
{
    if (!check_array("images", o->images, o->image_count, r))
        return false;
    s->images = calloc(o->image_count > 0 ? o->image_count : 1U, sizeof *s->images);
    if (s->images == NULL)
        return report_error(r, "no memory for %zu images", o->image_count);
    while (s->image_count < (int)o->image_count) {
        const int i = s->image_count++;
        if (!copy_image(&o->images[i], i, &s->images[i], r))
            return false;
    }
    return true;
}

/* ---- meshes and instances ---- */

/* Where the meshes of the scene lie that a mesh of the caller has become: from first[i] to before first[i + 1]. */
static bool copy_meshes(const glint_preview_scene_options *o, scene *s, int *first, report *r)
{
    for (size_t i = 0; i < o->mesh_count; ++i) {
        const glint_preview_mesh *const from = &o->meshes[i];
        char place[32];
        snprintf(place, sizeof place, "meshes/%zu", i);
        if (!caller_check_size(place, from->size, sizeof *from, r))
            return false;
        const scene_arrays arrays = { .name = from->name != NULL ? from->name : place,
                                      .vertex_count = from->vertex_count,
                                      .triangle_count = from->triangle_count,
                                      .position = from->positions,
                                      .normal = from->normals,
                                      .tangent = from->tangents,
                                      .texcoord = { from->texcoords[0], from->texcoords[1] },
                                      .color = from->colors,
                                      .index = from->indices,
                                      .material = from->materials };
        first[i] = s->mesh_count;
        if (!scene_build_mesh(s, &arrays, r))
            return false;
    }
    first[o->mesh_count] = s->mesh_count;
    return true;
}

static bool check_instance(const glint_preview_scene_options *o, size_t number, report *r)
{
    char place[32];
    snprintf(place, sizeof place, "instances/%zu", number);
    const int32_t mesh = o->instance_mesh[number];
    if (mesh < 0 || (size_t)mesh >= o->mesh_count)
        return report_error(r, "%s: found mesh %d, expected an index into the %zu meshes", place, mesh, o->mesh_count);
    return caller_check_finite(place, "to_world", &o->instance_to_world[16 * number], 16, r);
}

static void place_instance(const glint_preview_scene_options *o, size_t number, const int *first, scene *s)
{
    const int32_t mesh = o->instance_mesh[number];
    for (int m = first[mesh]; m < first[mesh + 1]; ++m) {
        scene_instance *const to = &s->instances[s->instance_count++];
        *to = (scene_instance){ .mesh = m, .node = o->instance_object != NULL ? o->instance_object[number] : 0 };
        memcpy(to->to_world, &o->instance_to_world[16 * number], sizeof to->to_world);
    }
}

static bool copy_instances(const glint_preview_scene_options *o, const int *first, scene *s, report *r)
{
    size_t count = 0;
    for (size_t i = 0; i < o->instance_count; ++i) {
        if (!check_instance(o, i, r))
            return false;
        count += (size_t)(first[o->instance_mesh[i] + 1] - first[o->instance_mesh[i]]);
    }
    if (count > INT_MAX)
        return report_error(r, "instances: found %zu with a material each, expected at most %d", count, INT_MAX);
    s->instances = calloc(count > 0 ? count : 1U, sizeof *s->instances);
    if (s->instances == NULL)
        return report_error(r, "no memory for %zu instances", count);
    for (size_t i = 0; i < o->instance_count; ++i)
        place_instance(o, i, first, s);
    return true;
}

static bool copy_geometry(const glint_preview_scene_options *o, scene *s, report *r)
{
    if (!check_array("meshes", o->meshes, o->mesh_count, r) ||
        !check_array("instance_to_world", o->instance_to_world, o->instance_count, r) ||
        !check_array("instance_mesh", o->instance_mesh, o->instance_count, r))
        return false;
    int *const first = calloc(o->mesh_count + 1, sizeof *first);
    if (first == NULL)
        return report_error(r, "no memory for %zu meshes", o->mesh_count);
    const bool done = copy_meshes(o, s, first, r) && copy_instances(o, first, s, r);
    free(first);
    return done;
}

/* ---- lights and world ---- */

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

static bool copy_lights(const glint_preview_scene_options *o, scene *s, report *r)
{
    if (!check_array("lights", o->lights, o->light_count, r))
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

static bool copy_world(const glint_preview_world *from, caller_world *to, report *r)
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

bool caller_scene_make(const glint_preview_scene_options *o, scene *out, caller_world *world, report *r)
{
    static const char none[] = "{\"materials\": []}";
    const char *const materials = o->materials != NULL ? o->materials : none;
    *out = (scene){ 0 };
    *world = (caller_world){ 0 };
    if (!copy_images(o, out, r) || !scene_build_materials(out, materials, strlen(materials), r) ||
        !copy_geometry(o, out, r) || !copy_lights(o, out, r) || !copy_world(&o->world, world, r))
        return false;
    scene_compute_bounds(out);
    return true;
}

void caller_scene_free(scene *s, caller_world *world)
{
    scene_free(s);
    free(world->map.rgb);
    *world = (caller_world){ 0 };
}
