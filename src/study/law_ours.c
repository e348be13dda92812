/* The library's binomial law, compiled once for each mean up to which it walks (BINOMIAL_WALK_MEAN, LAW_OURS). */
#include "study/law.h"

#define GLINT_LANES 1
#include "math/binomial.h"

void LAW_OURS(float trials, float p, const law_source *source, float count[LAW_DRAWS])
{
    vint u[LAW_DRAWS];
    vfloat weight[LAW_DRAWS];
    for (int i = 0; i < LAW_DRAWS; i++) {
        u[i] = (vint)source->uniform[0][i];
        weight[i] = 1.0F;
    }
    const vfloat dither = (float)(source->uniform[1][0] >> 8) * 0x1p-24F;
    const binomial_chance chance = binomial_chance_of(p);
    binomial_weighted_sum(trials, &chance, u, weight, dither, count, (binomial_many){ LAW_DRAWS, LAW_DRAWS });
}
