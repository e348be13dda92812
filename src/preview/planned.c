/* From an error budget to what each material may leave out.
 *
 * A pixel is the mean of glint_side^2 tiles, whose facets have nothing to do with each other, so it varies by
 * 1 / glint_side of what a tile varies by. Draws are new for every sample, and a pixel has spp of them.
 */
#include "preview/planned.h"

#include <stdlib.h>

static material_cut cut_of(const preview_options *o, const world *w)
{
    const float third = (float)(o->accuracy / sqrt(3.0)); /* facets, draws and light integrals: their variances add */
    /* A sample that stands for a patch of surroundings is not one of many of its kind. */
    const bool alone = w->environment != NULL || w->emitters != NULL;
    return (material_cut){ .smooth_deviation = alone ? third : third * (float)w->glint_side,
                           .draw_deviation = alone ? 0.0F : third * sqrtf((float)w->spp),
                           .area_light_method = GLINT_AREA_LIGHT_FAST };
}

bool planned_make(planned *p, const preview_options *options, world *w, report *r)
{
    const scene *const s = w->shader.scene;
    const size_t count = s->material_count > 0 ? (size_t)s->material_count : 1U;
    material_cut(*const cuts)[2] = calloc(count, sizeof *cuts);
    if (cuts == NULL)
        return report_error(r, "no memory for %d materials", s->material_count);
    for (size_t i = 0; i < count; ++i)
        cuts[i][0] = cuts[i][1] = cut_of(options, w);
    const bool made =
        materials_make(s, options->model, options->facets, (const material_cut(*)[2])cuts, &p->materials, r);
    free(cuts);
    w->shader.materials = &p->materials;
    return made;
}

void planned_free(planned *p)
{
    if (p->materials.scene != NULL)
        materials_free(&p->materials);
}
