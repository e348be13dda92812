/* Looks into a material that is made: a file of its own, since a renderer sees nothing of the models. */
#include "lanes.h"

#include <string.h>

#include "model/counting_kernel.h"
#include "model/model.h"

/* What a counting material bakes begins with the kernel for many points. */
void lanes_hold(const glint_material *m, size_t lanes)
{
    if (m != NULL && strcmp(m->model->name, "counting") == 0)
        *(counting_width *)m->baked = counting_widest(lanes);
}
