/* Looks at the view, makes its plan, and lets the world obey: materials that leave out, fewer bounces. */
#include "preview/planned.h"

#include "preview/survey.h"

bool planned_make(planned *p, const preview_options *options, world *w, bool with_noise, report *r)
{
    survey seen;
    char message[256] = "";
    if (!survey_make(w, options, with_noise, &seen, r))
        return false;
    const glint_result result = glint_plan_create(&seen.summary, &p->plan, message, sizeof message);
    survey_free(&seen);
    if (result != GLINT_OK)
        return report_error(r, "preview: no plan: %s", message[0] != '\0' ? message : glint_result_text(result));
    const bool made = materials_make(w->shader.scene, options, p->plan, &p->materials, r);
    w->shader.materials = &p->materials;
    const glint_plan_outcome out = glint_plan_result(p->plan);
    world_take_samples(w, (int)out.samples, options->model);
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
    *p = (planned){ 0 };
}
