/* What the error budget leaves of a view. */
#ifndef PREVIEW_PLANNED_H
#define PREVIEW_PLANNED_H

#include "preview/integrator.h"

typedef struct planned {
    glint_plan *plan;
    materials materials;
    uint8_t *sights; /* of the world's */
} planned;

/* Plans for options->accuracy and makes *w obey. What *w points to then belongs to *p. Whether it succeeds or not,
 * planned_free frees what there is. with_noise: see survey_make. */
bool planned_make(planned *p, const preview_options *options, world *w, bool with_noise, report *r);
void planned_free(planned *p);

#endif
