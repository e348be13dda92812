/* What the error budget leaves of a view: the same world with materials that count less. */
#ifndef PREVIEW_PLANNED_H
#define PREVIEW_PLANNED_H

#include "preview/integrator.h"

typedef struct planned {
    materials materials;
} planned;

/* Makes *w obey the plan for options->accuracy, which is above 0. What *w points to then belongs to *p. */
bool planned_make(planned *p, const preview_options *options, world *w, report *r);
void planned_free(planned *p);

#endif
