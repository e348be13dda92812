/* Pictures under an error budget, and what their plan said. */
#ifndef PLANNED_PICTURES_H
#define PLANNED_PICTURES_H

#include "pictures.h"

/* Of the last picture that had a budget. */
extern glint_plan_outcome foreseen;

/* accuracy 0: everything, without a plan. Free it with image_free. */
image planned_render(const scene *s, preview_options o, double accuracy, int spp);

#endif
