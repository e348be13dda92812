/* The colours of the example model: a tint for each flat texel of each instance, or for each instance. */
#define GLINT_LANES 1
#include "math/hash.h"
#include "model/example_view.h"

/* The centre of an instance lies in its own square of the lattice. */
uint32_t example_tint_seed(const example_footprint *f, const instance *self, uint32_t seed)
{
    const uint32_t column = f->cell[0] + (uint32_t)(int)floor_f(self->x);
    const uint32_t row = f->cell[1] + (uint32_t)(int)floor_f(self->y);
    return hash_full(hash_full(column * HASH_X + seed + HASH_Z) + row * HASH_Y);
}

void example_add_tint(const example_view *v, uint32_t texel, float value, gathered *sum)
{
    float tint[3];
    tint_of(v->palette, v->tint_seed + (v->e->is_flat ? texel * HASH_X : 0U), 1.0F, tint);
    for (int c = 0; c < 3; c++)
        sum->tint[c] += value * (tint[c] - 1.0F);
}
