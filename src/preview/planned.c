/* Looks at the view, makes its plan, and lets the world obey: materials that leave out, fewer bounces and shadows. */
#include "preview/planned.h"

#include <stdlib.h>

#include "preview/survey.h"

static bool prove_sights(const world *w, uint8_t **table, report *r)
{
    const size_t count = (size_t)w->shader.scene->material_count * (size_t)w->light_count;
    *table = calloc(count + 1U, sizeof **table);
    if (*table == NULL)
        return report_error(r, "no memory for what %d materials see of %d lights", w->shader.scene->material_count,
                            w->light_count);
    return clear_sight_find(w->geometry, w->lights, w->light_count, *table, r);
}

static bool make_plan(planned *p, const preview_options *options, const world *w, bool with_noise, report *r)
{
    survey seen;
    char message[256] = "";
    if (!survey_make(w, p->sights, options, with_noise, &seen, r))
        return false;
    const glint_result result = glint_plan_create(&seen.summary, &p->plan, message, sizeof message);
    survey_free(&seen);
    if (result != GLINT_OK)
        return report_error(r, "preview: no plan: %s", message[0] != '\0' ? message : glint_result_text(result));
    return true;
}

/* Leaves in the table only the shadows that the plan leaves out. */
static void leave_shadows_out(planned *p, world *w)
{
    const int count = w->shader.scene->material_count * w->light_count;
    uint8_t *const own = p->sights;
    bool is_any = false;
    /* What the plan says is marked first. */
    enum { MARK = 0x80 };
    for (uint32_t i = 0; i < glint_plan_decision_count(p->plan); ++i) {
        const glint_decision *const d = glint_plan_decision(p->plan, i);
        if (d->effect == GLINT_EFFECT_SHADOWS && !d->is_on && d->material >= 0)
            own[d->material * w->light_count + d->light] |= MARK;
    }
    for (int i = 0; i < count; ++i) {
        own[i] = (own[i] & MARK) != 0 ? (uint8_t)(own[i] & ~MARK) : (uint8_t)CLEAR_UNKNOWN;
        is_any = is_any || own[i] != CLEAR_UNKNOWN;
    }
    w->sights = is_any ? own : NULL;
}

bool planned_make(planned *p, const preview_options *options, world *w, bool with_noise, report *r)
{
    if (!prove_sights(w, &p->sights, r) || !make_plan(p, options, w, with_noise, r))
        return false;
    const bool made = materials_make(w->shader.scene, options, p->plan, &p->materials, r);
    w->shader.materials = &p->materials;
    const glint_plan_outcome out = glint_plan_result(p->plan);
    world_take_samples(w, (int)out.samples, options->model);
    leave_shadows_out(p, w);
    w->bounces = (int)out.bounces;
    w->cap_error = (double)out.cap_error;
    if (w->bounces == 0)
        w->emitters = NULL;
    return made;
}

void planned_free(planned *p)
{
    if (p->materials.scene != NULL)
        materials_free(&p->materials);
    glint_plan_destroy(p->plan);
    free(p->sights);
    *p = (planned){ 0 };
}
