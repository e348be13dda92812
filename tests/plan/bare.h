/* A renderer of nothing but plain surfaces under round lights: no effect that a plan could switch off is in it. */
#ifndef PLAN_BARE_H
#define PLAN_BARE_H

#include "preview/integrator.h"

/* The pixels of tiles_render, bit for bit, where the world has only such surfaces and lights, no sky and no bounces.
 * film: R G B A, sides multiples of 8. */
void bare_render(const world *w, image *film);

#endif
