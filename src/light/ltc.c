/* Linearly transformed cosines: a microfacet lobe for one view as a clamped cosine whose directions a matrix has moved.
 */
#include "light/ltc.h"

#define GLINT_LANES 8
#include "math/lanes.h"
#include "math/real.h"

/* Where x lies on a grid of LTC_SIDE points from 0 to 1: the point below, and how far behind it. */
static inline int locate(double x, float *fraction)
{
    const double at = real_min(real_max(x, 0.0), 1.0) * (LTC_SIDE - 1);
    const int i = at < LTC_SIDE - 1 ? (int)at : LTC_SIDE - 2;
    *fraction = (float)(at - i);
    return i;
}

#if defined(__AVX2__) && defined(GLINT_LTC_AVX2)
#define LTC_FIND ltc_find_avx2
#else
#define LTC_FIND ltc_find_base
#endif

ltc LTC_FIND(ndf_kind kind, double alpha, vec3d wo)
{
    float s, t, n[LTC_STRIDE];
    const int i = locate(sqrt(alpha), &s), j = locate(sqrt(real_max(0.0, 1.0 - wo.z) * (1.0 / 0.99)), &t);
    /* Two neighbours along the view lie side by side. */
    const float *low = ltc_table[kind == NDF_BECKMANN][i][j], *high = ltc_table[kind == NDF_BECKMANN][i + 1][j];
    const vfloat at_low = load_f(low) + t * (load_f(low + LTC_STRIDE) - load_f(low));
    const vfloat at_high = load_f(high) + t * (load_f(high + LTC_STRIDE) - load_f(high));
    store_f(n, at_low + s * (at_high - at_low));
    /* x' = along (x cos - z sin) + shift z, x away from the viewer; y' = across y; z' = z. A view closer to the horizon
     * than the table goes has the table's last lobe. */
    const double sine = sqrt(wo.x * wo.x + wo.y * wo.y), cosine = real_max(wo.z, 0.01);
    const double in_sine = sine > 0.0 ? -1.0 / sine : 0.0, ex = sine > 0.0 ? wo.x * in_sine : 1.0, ey = wo.y * in_sine;
    const double half = 0.5 / (alpha * cosine);
    const double along = (double)n[0] * (cosine * cosine + alpha * alpha) * half;
    const double a = along * cosine,
                 b = (double)n[1] * (alpha * alpha * half) - along * real_min(sine, sqrt(1.0 - 1e-4));
    const double across = (double)n[2] * (cosine * half), in_a = 1.0 / a, in_across = 1.0 / across;
    ltc l = { .row = { { a * ex, a * ey, b }, { -across * ey, across * ex, 0.0 }, { 0.0, 0.0, 1.0 } },
              .column = { { ex * in_a, ey * in_a, 0.0 },
                          { -ey * in_across, ex * in_across, 0.0 },
                          { -b * in_a * ex, -b * in_a * ey, 1.0 } },
              .determinant = a * across,
              .albedo = (double)n[3],
              .schlick = (double)n[4],
              .facets = (double)n[5] };
    return l;
}
