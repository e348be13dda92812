/* Another look for a stage that stands: what came of materials, images and surroundings is made anew beside the old,
 * and takes its place when all of it is there. Meshes and Embree's tree, which take the time, stay. */
#include "preview/stage.h"

#include <stdlib.h>

/* ---- textures ---- */

/* A texture file is decoded for each image, once as colour and once as data. */
static size_t decoded_as(const scene_texture *use)
{
    return 2 * (size_t)use->image + (use->srgb ? 1U : 0U);
}

/* Marks what the materials use, or looks whether all of it is marked. */
static bool walk_uses(const scene_material *list, int count, bool *marks, bool only_look)
{
    for (int m = 0; m < count; ++m) {
        const scene_texture *uses[SCENE_MATERIAL_TEXTURES];
        scene_material_textures(&list[m], uses);
        for (int i = 0; i < SCENE_MATERIAL_TEXTURES; ++i) {
            if (uses[i]->image == SCENE_NONE)
                continue;
            if (only_look && !marks[decoded_as(uses[i])])
                return false;
            marks[decoded_as(uses[i])] = true;
        }
    }
    return true;
}

/* Whether all that the materials use now has been decoded for those before. Without memory to know: no. */
static bool textures_serve(const scene *s, const scene_material *before)
{
    bool *const marks = calloc(2 * (size_t)s->image_count + 1, sizeof *marks);
    const bool serve = marks != NULL && walk_uses(before, s->material_count, marks, false) &&
                       walk_uses(s->materials, s->material_count, marks, true);
    free(marks);
    return serve;
}

/* ---- the stage ---- */

/* next is a copy of the stage; its shader points to the stage's materials, where those of next will lie. */
static bool make_look(stage *next, const preview_change *change, const preview_options *o, report *r)
{
    const scene *const s = next->scene;
    if (change->images || !textures_serve(s, change->before)) {
        next->textures = NULL;
        if (!textures_open(s, &next->textures, r))
            return false;
        next->shader.textures = next->textures;
    }
    geometry_warn_of_flat(next->emitters.geometry, r); /* said again with what else there is to say */
    return shader_open(&next->shader, r) && materials_make(s, o, NULL, &next->materials, r) &&
           emitters_make(next->emitters.geometry, &next->emitters, r);
}

/* Frees what a change has replaced in one stage and not in the other. */
static void free_parts(stage *of, const stage *other, const preview_change *change)
{
    if (of->textures != other->textures)
        textures_close(of->textures);
    if (change->before != NULL) {
        shader_close(&of->shader);
        emitters_free(&of->emitters);
        if (of->materials.scene != NULL)
            materials_free(&of->materials);
    }
    if (change->environment) {
        environment_free(&of->environment);
        environment_map_free(&of->own_map);
    }
}

bool stage_change(stage *st, const preview_change *change, const preview_options *o, report *r)
{
    stage next = *st;
    if (change->before != NULL) {
        next.shader.constants = NULL;
        next.materials = (materials){ 0 };
        next.emitters = (emitters){ .geometry = &st->geometry };
    }
    if (change->environment) {
        next.environment = (environment){ 0 };
        next.own_map = (environment_map){ 0 };
        next.has_environment = false;
    }
    const bool done = (change->before == NULL || make_look(&next, change, o, r)) &&
                      (!change->environment || stage_set_environment(&next, o, r));
    stage old = *st;
    if (done)
        *st = next;
    free_parts(done ? &old : &next, done ? &next : &old, change);
    return done;
}
