/* Which facets a light of real size lights, in lanes: of its integrals over the half vectors. */
#ifndef MODEL_AREA_LIT_H
#define MODEL_AREA_LIT_H

#include "model/lobe_lanes.h"

/* Integrals over the half vectors that lie in the light: of D, of D h (z: the projected area), and of their own area
 * seen from above. */
typedef struct area_halves {
    vfloat facets, x, y, z, cap;
} area_halves;

/* As area_value has them. */
typedef struct area_lit {
    vfloat3 h;
    vfloat cap, p;
} area_lit;

/* p of Kneiphof and Klein 2024, Eq. 12, with the lobe of a rough facet as more half vectors around those of the light.
 * total_area: D_H, 0 where it is not known yet. */
static inline area_lit area_lit_of(const glint_material_options *o, const lobe_query *q, vfloat total_area,
                                   const area_halves *halves)
{
    const ndf_kind kind = lobe_kind(o);
    const vfloat one = splat(1.0F);
    area_lit lit;
    const vmask some = less(splat(1e-35F), halves->facets);
    const vfloat in = 1.0F / choose(some, halves->facets, one);
    /* A mean of unit vectors is no longer than one, unless what was summed is rounding. */
    const vfloat3 mean = { halves->x * in, halves->y * in, halves->z * in };
    const vfloat shorter = 1.0F / max_f(sqrt_f(dot_3(mean, mean)), one);
    const vfloat3 up = { splat(0.0F), splat(0.0F), one };
    lit.h = choose_3(some, scale_3(mean, shorter), up);
    /* The cap is seen from above, the lobe of a facet is not. */
    const vfloat solid_angle = min_f(halves->cap / max_f(lit.h.z, splat(1e-6F)), splat(2.0F * MATH_PI));
    const vfloat all = ndf_lit_solid_angle_of(kind, solid_angle, o->facet_alpha);
    const vmask wide = less(splat(1e-30F), solid_angle);
    vfloat p = halves->z;
    if (o->weighting == GLINT_WEIGHTING_EQUAL_AREA) {
        const vmask known = less(splat(0.0F), total_area);
        if (any(~known))
            total_area = choose(known, total_area, ndf_total_area_of(kind, q->alpha_x, q->alpha_y));
        p = halves->facets / total_area;
    }
    if (o->facet_alpha > 0.0F)
        p = p * choose(wide, all / choose(wide, solid_angle, one), one);
    lit.p = min_f(p, one);
    lit.cap = all * lit.h.z;
    return lit;
}

#endif
