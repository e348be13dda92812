/* The scenes of glint_preview.h: a stage, and what the caller said it shall show. */
#include "preview/glint_preview.h"

#include <stdlib.h>
#include <string.h>

#include "preview/caller_answer.h"

uint32_t glint_preview_abi(void)
{
    return GLINT_PREVIEW_ABI;
}

const char *glint_preview_version(void)
{
    return glint_version();
}

size_t glint_preview_size_of(const char *name)
{
    static const struct {
        const char *name;
        size_t size;
    } structs[] = {
        { "glint_preview_image", sizeof(glint_preview_image) },
        { "glint_preview_mesh", sizeof(glint_preview_mesh) },
        { "glint_preview_light", sizeof(glint_preview_light) },
        { "glint_preview_world", sizeof(glint_preview_world) },
        { "glint_preview_scene_options", sizeof(glint_preview_scene_options) },
        { "glint_preview_camera", sizeof(glint_preview_camera) },
        { "glint_preview_picture_options", sizeof(glint_preview_picture_options) },
    };
    for (size_t i = 0; name != NULL && i < sizeof structs / sizeof *structs; ++i) {
        if (strcmp(structs[i].name, name) == 0)
            return structs[i].size;
    }
    return 0;
}

static preview_options stage_options(const glint_preview_scene *s, int model)
{
    preview_options o = PREVIEW_OPTIONS_INIT;
    o.model = model;
    /* A viewport has no plan. The fit is off by a hundredth, and the first picture is there in a third of the time. */
    o.area_lights = GLINT_AREA_LIGHT_FAST;
    o.sky = &s->from.world.sky;
    if (s->from.world.map.rgb != NULL)
        o.environment = &s->from.world.environment;
    return o;
}

static bool make_scene(glint_preview_scene *s, const glint_preview_scene_options *o, report *r)
{
    if (!caller_scene_make(o, &s->from, r))
        return false;
    s->model = o->model;
    s->from.warnings.now = CALLER_LOOK;
    const preview_options stage = stage_options(s, s->model);
    return preview_stage_open(&s->from.scene, &stage, &s->stage, r);
}

glint_preview_result glint_preview_scene_create(const glint_preview_scene_options *options, glint_preview_scene **out,
                                                char *message, size_t message_size)
{
    report r = { .warn = caller_warnings_keep };
    if (out == NULL)
        return answer_wrong(message, message_size, "out is NULL");
    *out = NULL;
    if (options == NULL)
        return answer_wrong(message, message_size, "options is NULL");
    if (!caller_check_size("options", options->size, sizeof *options, &r))
        return answer_of(false, &r, message, message_size);
    glint_preview_scene *const s = calloc(1, sizeof *s);
    if (s == NULL)
        return answer_wrong(message, message_size, "no memory for a scene");
    r.user = &s->from.warnings;
    const bool done = make_scene(s, options, &r);
    caller_warnings_join(&s->from.warnings);
    if (done)
        *out = s;
    else
        glint_preview_scene_destroy(s);
    return answer_of(done, &r, message, message_size);
}

/* The warnings of what has changed. */
static void move_warnings(caller_warnings *to, caller_warnings *from, int parts)
{
    if ((parts & GLINT_PREVIEW_MATERIALS) != 0)
        caller_warnings_move(to, from, CALLER_LOOK);
    if ((parts & GLINT_PREVIEW_LIGHTS) != 0)
        caller_warnings_move(to, from, CALLER_LIGHTS);
    if ((parts & GLINT_PREVIEW_WORLD) != 0)
        caller_warnings_move(to, from, CALLER_WORLD);
    caller_warnings_join(to);
}

/* The stage sees the scene with its new parts; what they replaced is in parked, until it is clear who stays. */
static bool change_stage(glint_preview_scene *s, caller_scene *parked, int parts, int model, report *r)
{
    caller_scene_swap(&s->from, parked, parts);
    const preview_change change = { .before = (parts & GLINT_PREVIEW_MATERIALS) != 0 ? parked->scene.materials : NULL,
                                    .images = (parts & GLINT_PREVIEW_IMAGES) != 0,
                                    .environment = (parts & GLINT_PREVIEW_WORLD) != 0 };
    const preview_options stage = stage_options(s, model);
    parked->warnings.now = CALLER_LOOK;
    if (!preview_stage_change(s->stage, &change, &stage, r)) {
        caller_scene_swap(&s->from, parked, parts);
        return false;
    }
    s->model = model;
    move_warnings(&s->from.warnings, &parked->warnings, parts);
    return true;
}

static glint_preview_result change_scene(glint_preview_scene *s, const glint_preview_scene_options *o, int parts,
                                         caller_scene *next, char *message, size_t message_size)
{
    report r = { .warn = caller_warnings_keep, .user = &next->warnings };
    const int model = (parts & GLINT_PREVIEW_MATERIALS) != 0 ? o->model : s->model;
    if (!caller_scene_make_parts(o, parts, &s->from.scene, next, &r))
        return answer_of(false, &r, message, message_size);
    if ((parts & GLINT_PREVIEW_MATERIALS) != 0 && !caller_scene_same_meshes(&s->from.scene, &next->scene))
        return answer(GLINT_PREVIEW_OTHER_MESHES, "the materials ask for other meshes", message, message_size);
    return answer_of(change_stage(s, next, parts, model, &r), &r, message, message_size);
}

glint_preview_result glint_preview_scene_change(glint_preview_scene *s, int32_t parts,
                                                const glint_preview_scene_options *options, char *message,
                                                size_t message_size)
{
    report r = { 0 };
    if (s == NULL || options == NULL)
        return answer_wrong(message, message_size, "%s is NULL", s == NULL ? "scene" : "options");
    if (!caller_check_size("options", options->size, sizeof *options, &r))
        return answer_of(false, &r, message, message_size);
    if ((parts & ~CALLER_LOOKS) != 0)
        return answer_wrong(message, message_size, "parts is %d; expected a sum of 1, 2, 4 and 8", parts);
    if ((parts & GLINT_PREVIEW_IMAGES) != 0 && (parts & GLINT_PREVIEW_MATERIALS) == 0)
        return answer_wrong(message, message_size, "parts is %d: found images, expected the materials with them",
                            parts);
    caller_scene next;
    const glint_preview_result result = change_scene(s, options, parts, &next, message, message_size);
    caller_scene_free(&next);
    return result;
}

const char *glint_preview_scene_warnings(const glint_preview_scene *s)
{
    return s != NULL && s->from.warnings.all != NULL ? s->from.warnings.all : "";
}

void glint_preview_scene_destroy(glint_preview_scene *s)
{
    if (s == NULL)
        return;
    preview_stage_close(s->stage);
    caller_scene_free(&s->from);
    free(s);
}
