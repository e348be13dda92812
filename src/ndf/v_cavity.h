/* V-cavity masking and shadowing (Cook and Torrance 1982), which does not ask for the shape of the distribution.
 *
 * Chermain et al. 2020, Eqs. 15 and 16: G2 = G1(wo) G1(wi) with G1(w) = min(1, 2 (h.n)(w.n) / (w.h)). h is the half
 * vector, so that wo.h = wi.h > 0.
 */
#ifndef NDF_V_CAVITY_H
#define NDF_V_CAVITY_H

#include "math/vec3.h"

/* G1(w) / (w.n), finite for every w above the horizon: one of 1 / (w.n), where the facet is seen whole, and
 * 2 (h.n) / (w.h). */
static inline float v_cavity_masking_over_cosine(vec3 h, float h_dot_w, vec3 w)
{
    return 2.0F * h.z * w.z < h_dot_w ? 2.0F * h.z / h_dot_w : 1.0F / w.z;
}

static inline float v_cavity_masking(vec3 h, float h_dot_w, vec3 w)
{
    return 2.0F * h.z * w.z < h_dot_w ? 2.0F * h.z * w.z / h_dot_w : 1.0F;
}

#endif
