/* Smith's masking of the Beckmann distribution, in lanes. Include math/elementary.h first. */
#ifndef NDF_BECKMANN_MASKED_H
#define NDF_BECKMANN_MASKED_H

#include "math/elementary.h"

/* exp(x^2) erfc(x) for x >= 0, where erfc alone underflows; relative error below 3e-7. A fit of degree 10 in
 * t = 2.5 / (2.5 + x), weighted by the function itself. */
static inline vfloat erfcx_f(vfloat x)
{
    const vfloat t = 2.5F / (2.5F + x);
    static const float c[10] = { 0.225675833F,  0.225676081F,   0.207608054F, 0.171802345F,  0.118634124F,
                                 0.0852281591F, -0.0497441414F, 0.141435464F, -0.238736198F, 0.141926705F };
    vfloat p = splat(-0.0295064323F);
    for (int i = 9; i >= 0; i--)
        p = p * t + c[i];
    return p * t;
}

/* cos Lambda = (s exp(-a^2) / sqrt(pi) - cos erfc(a)) / 2 with a = cos / s. s: alpha times the sine. */
static inline vfloat beckmann_masked_at(vfloat s, vfloat cosine)
{
    /* exp(-81): nothing is masked */
    const vmask steep = less(cosine, 9.0F * s);
    const vfloat a = min_f(cosine / max_f(s, splat(1e-30F)), splat(9.0F));
    const vfloat m = 0.5F * exp_negative(-a * a) * (s * 0.564189584F - cosine * erfcx_f(a));
    return choose(steep, max_f(m, splat(0.0F)), splat(0.0F));
}

#endif
