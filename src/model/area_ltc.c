/* A light of real size over the facets that reflect it, by linearly transformed cosines.
 *
 * Kneiphof and Klein 2024, section 4: one transformed cosine stands for the reflection and for the facets, each with a
 * scale of its own (directional albedo; D_PR, Eq. 19). A transformed cosine alone is off by what the fit leaves: up to
 * tens of percent where only a part of the lobe is lit. So it only says where to look: both integrals are sums over
 * points of the moved light, and the cosine's own sum, which is known, corrects what the points have in common. Of a
 * light that takes in the whole lobe the scale is the integral.
 */
#include "light/ltc.h"
#include "math/real.h"
#include "model/area_facets.h"
#include "model/area_quad.h"
#include "model/lobe.h"

static quad_lobe lobe_of(const model_query *q, const ltc *fit)
{
    const ndf n = lobe_ndf(q);
    return (quad_lobe){ .is_ggx = n.kind == NDF_GGX,
                        .is_schlick = q->material->options.fresnel == GLINT_FRESNEL_SCHLICK,
                        .alpha = n.alpha_x,
                        .masked_o = ndf_masked(&n, q->wo),
                        .wo = q->wo,
                        .back = { { (float)fit->column[0].x, (float)fit->column[1].x, (float)fit->column[2].x },
                                  { (float)fit->column[0].y, (float)fit->column[1].y, (float)fit->column[2].y } } };
}

/* The mean reflectance of the facets that light the viewer. Schlick's is exact; others are taken at the two angles that
 * have the mean and the spread of all. */
static void find_reflectance(const model_query *q, const quad_sums *s, float reflectance[3])
{
    if (q->material->options.fresnel == GLINT_FRESNEL_SCHLICK) {
        const float fifth = s->fresnel[0] / s->reflected;
        for (int c = 0; c < 3; c++)
            reflectance[c] = q->surface->f0[c] + (q->surface->f90[c] - q->surface->f0[c]) * fifth;
        return;
    }
    const float mean = s->fresnel[0] / s->reflected, variance = s->fresnel[1] / s->reflected - mean * mean;
    const float spread = variance > 0.0F ? sqrtf(variance) : 0.0F;
    const float low = mean > spread ? mean - spread : 0.0F, high = mean + spread < 1.0F ? mean + spread : 1.0F;
    for (int c = 0; c < 3; c++)
        reflectance[c] = 0.5F * (lobe_facet_reflectance(q, c, low) + lobe_facet_reflectance(q, c, high));
}

/* What there is for processors of the base and for those with AVX2. */
typedef struct kernel {
    ltc_find *find;
    ltc_move *move;
    area_quad_sum *sum;
} kernel;

static kernel kernel_for_this_machine(void)
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
        return (kernel){ ltc_find_avx2, ltc_move_avx2, area_quad_sum_avx2 };
#endif
    return (kernel){ ltc_find_base, ltc_move_base, area_quad_sum_base };
}

void area_facets_fast(const model_query *q, const area_light *light, area_facets *value)
{
    const kernel k = kernel_for_this_machine();
    const ltc fit = k.find(lobe_ndf(q).kind, (double)q->surface->alpha_x, vec3d_of(q->wo));
    ltc_light moved;
    *value = (area_facets){ .cap = 0.0 };
    if (!k.move(&fit, light, &moved))
        return;
    quad_sums s;
    const quad_lobe lobe = lobe_of(q, &fit);
    k.sum(&lobe, &moved, &s);
    if (!(s.weight > 0.0F) || !(s.reflected > 0.0F) || !(s.facets > 0.0F))
        return;
    const double unit = moved.share * REAL_PI / (fit.determinant * (double)s.weight);
    /* What is known of the whole lobe takes over where next to nothing of it is left out: of GGX's long tail as much as
     * of the cosine, of Beckmann's short one less. */
    const double share2 = moved.share * moved.share, share4 = share2 * share2, share8 = share4 * share4;
    const double whole = share8 * share8 * share8 * share8;
    const double known = whole * (lobe.is_ggx ? moved.share : 1.0), found = (1.0 - whole) * unit;
    const double reflected = real_min(known * fit.albedo + found * (double)s.reflected, fit.albedo);
    float reflectance[3];
    find_reflectance(q, &s, reflectance);
    for (int c = 0; c < 3; c++)
        value->specular[c] = reflected * (double)reflectance[c];
    value->cap = real_min(unit * (double)s.cap, REAL_PI);
    value->facets = real_min(known * fit.facets + found * (double)s.facets, fit.facets);
    const double mean = value->facets / (double)s.facets;
    value->projected = mean * (double)s.z;
    value->x = mean * (double)s.x;
    value->y = mean * (double)s.y;
}
