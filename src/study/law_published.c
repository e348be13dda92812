/* The binomial law as others draw it: a Gaussian behind a gate. With libm, what depends on (N, p) alone computed once.
 */
#include <math.h>

#include "study/law.h"

static float uniform_of(uint32_t bits)
{
    return ((float)(bits >> 8) + 0.5F) * 0x1p-24F;
}

/* Inverse error function, M. Giles 2010. */
static float inverse_erf(float x)
{
    static const float near[9] = { 2.81022636e-08F, 3.43273939e-07F, -3.5233877e-06F, -4.39150654e-06F, 0.00021858087F,
                                   -0.00125372503F, -0.00417768164F, 0.246640727F,    1.50140941F };
    static const float far[9] = { -0.000200214257F, 0.000100950558F, 0.00134934322F, -0.00367342844F, 0.00573950773F,
                                  -0.0076224613F,   0.00943887047F,  1.00167406F,    2.83297682F };
    const float w = -logf((1.0F - x) * (1.0F + x));
    const float *const c = w < 5.0F ? near : far, t = w < 5.0F ? w - 2.5F : sqrtf(w) - 3.0F;
    float p = c[0];
    for (int i = 1; i < 9; i++)
        p = c[i] + p * t;
    return p * x;
}

/* Eqs. 16 and 17: the chance of any success, and the Gaussian of one trial less. */
typedef struct gated {
    float any, mean, sigma;
} gated;

static gated gated_of(float trials, float p)
{
    const float mean = (trials - 1.0F) * p;
    return (gated){ 1.0F - expf(trials * log1pf(-p)), mean, sqrtf(fmaxf(mean * (1.0F - p), 0.0F)) };
}

static float normal(const gated *g, uint32_t bits)
{
    return g->mean + g->sigma * 1.41421356F * inverse_erf(2.0F * uniform_of(bits) - 1.0F);
}

void law_as_published(float trials, float p, const law_source *source, float count[LAW_DRAWS])
{
    const gated g = gated_of(trials, p);
    for (int i = 0; i < LAW_DRAWS; i++)
        count[i] = uniform_of(source->uniform[0][i]) < g.any ? floorf(1.0F + normal(&g, source->uniform[1][i])) : 0.0F;
}

void law_gated(float trials, float p, const law_source *source, float count[LAW_DRAWS])
{
    const gated g = gated_of(trials, p);
    for (int i = 0; i < LAW_DRAWS; i++)
        count[i] = uniform_of(source->uniform[0][i]) < g.any
                       ? floorf(1.0F + fmaxf(normal(&g, source->uniform[1][i]), 0.0F))
                       : 0.0F;
}

void law_clamped(float trials, float p, const law_source *source, float count[LAW_DRAWS])
{
    const gated g = gated_of(trials, p);
    for (int i = 0; i < LAW_DRAWS; i++)
        count[i] = uniform_of(source->uniform[0][i]) < g.any
                       ? fminf(fmaxf(normal(&g, source->uniform[1][i]), 1.0F), fmaxf(trials, 1.0F))
                       : 0.0F;
}
