/* How much of a rough facet's own reflection falls within a round light. */
#include "model/facet_lobe.h"

#include <math.h>

#define GLINT_LANES 1
#include "math/elementary.h"

/* GGX is a uniform sphere in stereographic projection, so the disk is a cap of that sphere: (1 - t / root) / 2. */
static float ggx_disk_mass(float d2, float r2)
{
    const float t = 1.0F + d2 - r2;
    const float root = sqrtf(t * t + 4.0F * r2);
    /* Without the difference of nearly equal numbers. */
    return t > 0.0F ? 2.0F * r2 / (root * (root + t)) : 0.5F * (1.0F - t / root);
}

/* exp(-x) I0(x) for x >= 0: Abramowitz and Stegun 9.8.1 and 9.8.2, error below 2e-7 in the function. */
static float bessel_scaled(float x)
{
    if (x < 3.75F) {
        const float t = x * x * (1.0F / 14.0625F);
        float p = 0.0045813F * t + 0.0360768F;
        p = p * t + 0.2659732F;
        p = p * t + 1.2067492F;
        p = p * t + 3.0899424F;
        p = p * t + 3.5156229F;
        return exp_negative(-x) * (p * t + 1.0F);
    }
    const float t = 3.75F / x;
    float p = 0.00392377F * t - 0.01647633F;
    p = p * t + 0.02635537F;
    p = p * t - 0.02057706F;
    p = p * t + 0.00916281F;
    p = p * t - 0.00157565F;
    p = p * t + 0.00225319F;
    p = p * t + 0.01328592F;
    return (p * t + 0.39894228F) / sqrtf(x);
}

/* Beyond this many widths from the middle of the disk the Gaussian has 2e-8 of its mass. */
#define BECKMANN_REACH 4.2F

/* Integral over 0 < s < r of 2 s exp(-(s - d)^2) exp(-2 s d) I0(2 s d), the chance that a Gaussian around d lies within
 * r of the origin (Rice), by Gauss and Legendre's rule of 24 points. */
static float beckmann_disk_mass(float d2, float r2)
{
    static const float rule[12][2] = {
        /* place and weight on [-1, 1], the other half mirrored */
        { 0.0640568929F, 0.127938195F }, { 0.191118867F, 0.125837456F },  { 0.31504268F, 0.121670473F },
        { 0.433793508F, 0.115505668F },  { 0.545421471F, 0.10744427F },   { 0.648093652F, 0.0976186521F },
        { 0.740124192F, 0.0861901615F }, { 0.820001986F, 0.0733464814F }, { 0.886415527F, 0.0592985849F },
        { 0.938274552F, 0.0442774388F }, { 0.974728556F, 0.0285313886F }, { 0.99518722F, 0.0123412298F }
    };
    const float d = sqrtf(d2);
    /* From d: far out the difference of two large numbers is taken once, and from their squares. */
    const float rim = (r2 - d2) / (sqrtf(r2) + d + 1e-30F);
    const float from = fmaxf(-d, -BECKMANN_REACH), to = fminf(rim, BECKMANN_REACH);
    if (to <= from)
        return 0.0F;
    const float middle = 0.5F * (to + from), half = 0.5F * (to - from);
    float sum = 0.0F;
    for (int i = 0; i < 24; i++) {
        const float *const point = rule[i / 2];
        const float x = middle + (i % 2 ? point[0] : -point[0]) * half, s = d + x;
        sum += point[1] * 2.0F * s * exp_negative(-x * x) * bessel_scaled(2.0F * s * d);
    }
    return fminf(sum * half, 1.0F);
}

float facet_lobe_disk_mass(ndf_kind kind, float d2, float r2)
{
    return kind == NDF_GGX ? ggx_disk_mass(d2, r2) : beckmann_disk_mass(d2, r2);
}
