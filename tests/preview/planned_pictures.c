/* Renders with a plan, and keeps what it said. */
#include "planned_pictures.h"

glint_plan_outcome foreseen;

static void note_outcome(const glint_plan *plan, void *user)
{
    (void)user;
    foreseen = glint_plan_result(plan);
}

image planned_render(const scene *s, preview_options o, double accuracy, int spp)
{
    o.accuracy = accuracy;
    o.spp = spp;
    o.planned = accuracy > 0.0 ? note_outcome : NULL;
    return pictures_render(s, &o);
}
