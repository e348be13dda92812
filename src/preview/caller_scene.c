/* Copies a caller's arrays into a scene; whatever cannot be is named by its place. */
#include "preview/caller_scene.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/scene_bounds.h"
#include "io/scene_build.h"
#include "preview/caller_light.h"

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

bool caller_check_array(const char *name, const void *array, size_t count, report *r)
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
    if (!caller_check_array("images", o->images, o->image_count, r))
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
    if (!caller_check_array("meshes", o->meshes, o->mesh_count, r) ||
        !caller_check_array("instance_to_world", o->instance_to_world, o->instance_count, r) ||
        !caller_check_array("instance_mesh", o->instance_mesh, o->instance_count, r))
        return false;
    int *const first = calloc(o->mesh_count + 1, sizeof *first);
    if (first == NULL)
        return report_error(r, "no memory for %zu meshes", o->mesh_count);
    const bool done = copy_meshes(o, s, first, r) && copy_instances(o, first, s, r);
    free(first);
    return done;
}

/* ---- the whole, and parts of it ---- */

static bool copy_materials(const glint_preview_scene_options *o, scene *s, report *r)
{
    static const char none[] = "{\"materials\": []}";
    const char *const text = o->materials != NULL ? o->materials : none;
    return scene_build_materials(s, text, strlen(text), r);
}

/* Of the images their number counts, which indices are checked with. */
static bool copy_materials_beside(const glint_preview_scene_options *o, const scene *images_of, scene *s, report *r)
{
    s->image_count = images_of->image_count;
    const bool done = copy_materials(o, s, r);
    s->image_count = 0;
    return done;
}

static bool copy_look(const glint_preview_scene_options *o, int parts, const scene *images_of, scene *s, report *r)
{
    if ((parts & GLINT_PREVIEW_IMAGES) != 0)
        return copy_images(o, s, r) && copy_materials(o, s, r);
    return (parts & GLINT_PREVIEW_MATERIALS) == 0 || copy_materials_beside(o, images_of, s, r);
}

bool caller_scene_make_parts(const glint_preview_scene_options *o, int parts, const scene *images_of, caller_scene *c,
                             report *r)
{
    *c = (caller_scene){ 0 };
    c->warnings.now = CALLER_LOOK;
    if (!copy_look(o, parts, images_of, &c->scene, r))
        return false;
    c->warnings.now = CALLER_LIGHTS;
    if ((parts & GLINT_PREVIEW_LIGHTS) != 0 && !caller_lights_copy(o, &c->scene, r))
        return false;
    c->warnings.now = CALLER_WORLD;
    return (parts & GLINT_PREVIEW_WORLD) == 0 || caller_world_copy(&o->world, &c->world, r);
}

bool caller_scene_make(const glint_preview_scene_options *o, caller_scene *c, report *r)
{
    if (!caller_scene_make_parts(o, CALLER_LOOKS, NULL, c, r))
        return false;
    c->warnings.now = CALLER_MESHES;
    if (!copy_geometry(o, &c->scene, r))
        return false;
    scene_compute_bounds(&c->scene);
    return true;
}

/* An environment points to the map beside it. */
static void point_to_own_map(caller_world *w)
{
    if (w->environment.map != NULL)
        w->environment.map = &w->map;
}

static void swap_worlds(caller_world *a, caller_world *b)
{
    const caller_world kept = *a;
    *a = *b;
    *b = kept;
    point_to_own_map(a);
    point_to_own_map(b);
}

/* Of *to those parts become what they are in *from. */
static void take_parts(scene *to, const scene *from, int parts)
{
    if ((parts & GLINT_PREVIEW_MATERIALS) != 0) {
        to->materials = from->materials;
        to->material_count = from->material_count;
    }
    if ((parts & GLINT_PREVIEW_IMAGES) != 0) {
        to->images = from->images;
        to->image_count = from->image_count;
    }
    if ((parts & GLINT_PREVIEW_LIGHTS) != 0) {
        to->lights = from->lights;
        to->light_count = from->light_count;
    }
}

void caller_scene_swap(caller_scene *a, caller_scene *b, int parts)
{
    const scene kept = a->scene;
    take_parts(&a->scene, &b->scene, parts);
    take_parts(&b->scene, &kept, parts);
    if ((parts & GLINT_PREVIEW_WORLD) != 0)
        swap_worlds(&a->world, &b->world);
}

/* What rays pass is decided in the tree. */
static bool stop_the_same_rays(const scene_material *a, const scene_material *b)
{
    return a->alpha_mode == b->alpha_mode && a->double_sided == b->double_sided &&
           (a->alpha_mode != SCENE_ALPHA_MASK || a->alpha_cutoff == b->alpha_cutoff);
}

bool caller_scene_same_meshes(const scene *a, const scene *b)
{
    if (a->material_count != b->material_count)
        return false;
    for (int i = 0; i < a->material_count; ++i) {
        if (!scene_build_same_meshes(&a->materials[i], &b->materials[i]) ||
            !stop_the_same_rays(&a->materials[i], &b->materials[i]))
            return false;
    }
    return true;
}

void caller_scene_free(caller_scene *c)
{
    scene_free(&c->scene);
    free(c->world.map.rgb);
    caller_warnings_free(&c->warnings);
    *c = (caller_scene){ 0 };
}
