/* The explicit model: every facet under the footprint, one by one, each a small mirror of its own. The truth for the
 * others.
 *
 * The surface is a flat grid of square cells of area 1 / density with one facet each. A pixel sees each facet by the
 * exact share of its own area (a box filter). A facet reflects the light where its normal sends the view into the
 * light's cap; a rough facet spreads that over its own lobe. Cost is linear in the facets under the pixel, up to
 * facet_limit.
 *
 * L = L_i F G2 / (4 cos_o) * integral of D-hat over the light, D-hat = D_H / N * sum of delta(h - h_k): Kneiphof and
 * Klein 2024, Eqs. 9 to 11, with shares in place of 1 / N.
 */
#include "footprint/coverage.h"

#define GLINT_LANES 1
#include "math/elementary.h"
#include "math/fade.h"
#include "math/float_bits.h"
#include "math/hash.h"
#include "model/area.h"
#include "model/explicit_area.h"
#include "model/facet.h"
#include "model/facet_lobe.h"
#include "model/lobe.h"
#include "model/tint.h"

/* What every facet of one evaluation has in common. */
typedef struct facet_sum {
    const model_query *q;
    ndf distribution;
    float total_area; /* D_H */
    vec3 h;           /* half vector */
    float chord2;     /* square of the chord from the middle of the light's cap to its rim */
    uint32_t seed;
    const tint_palette *palette; /* NULL: all facets have the base colour, and density[0] is for all channels */
    double density[3];           /* sum of what the facets add to D, averaged over the light */
    const area_light *area;      /* of real size: then rgb is summed instead, the lobe's integral over it */
    double rgb[3];
} facet_sum;

/* The part of one facet's reflection that meets the light's cap. A mirror shows the light or not. The lobe of a rough
 * facet is one of half vectors, round around its normal; among them the cap is a disc of 1 / (4 h.wo) of its solid
 * angle, taken as round. */
static float lit_part(const facet_sum *s, vec3 m)
{
    const vec3 wo = s->q->wo;
    const float cosine = vec3_dot(wo, m);
    if (!(cosine > 0.0F))
        return 0.0F;
    const float alpha = s->q->material->options.facet_alpha;
    if (!(alpha >= LEAST_FACET_ALPHA)) {
        const vec3 mirrored = vec3_add(vec3_scale(m, 2.0F * cosine), vec3_scale(wo, -1.0F));
        const vec3 off = vec3_add(mirrored, vec3_scale(s->q->wi, -1.0F));
        return vec3_dot(off, off) <= s->chord2 ? 1.0F : 0.0F;
    }
    const vec3 off = vec3_add(m, vec3_scale(s->h, -1.0F));
    const float scale = 1.0F / (alpha * alpha);
    const float d2 = fminf(vec3_dot(off, off) * scale, 1e12F);
    const float r2 = fminf(s->chord2 * scale / (4.0F * cosine), 1e12F);
    return facet_lobe_disk_mass(s->distribution.kind, d2, r2);
}

static void tint_of_facet(const facet_sum *s, int64_t x, int64_t y, float tint[3])
{
    tint[0] = tint[1] = tint[2] = 1.0F;
    if (s->palette)
        tint_of_uniform(s->palette, (float)facet_tint_hash(s->q->material->options.facet_hash, x, y, s->seed), tint);
}

static void add_facet(int64_t x, int64_t y, double share, void *user)
{
    facet_sum *s = user;
    const glint_material_options *o = &s->q->material->options;
    const vec3 h = facet_normal(&s->distribution, o->weighting, facet_hash(o->facet_hash, x, y, s->seed));
    /* What a facet of unit projected area, or of unit area, adds to D. */
    const float weight = o->weighting == GLINT_WEIGHTING_EQUAL_AREA ? s->total_area : 1.0F / h.z;
    float tint[3];
    if (s->area) {
        float rgb[3];
        explicit_area_facet(s->q, s->area, h, rgb);
        tint_of_facet(s, x, y, tint);
        for (int c = 0; c < 3; c++)
            s->rgb[c] += share * (double)(weight * rgb[c] * tint[c]);
        return;
    }
    const float lit = lit_part(s, h);
    if (!(lit > 0.0F))
        return;
    const double added = share * (double)(weight * 4.0F * vec3_dot(s->q->wo, h) * lit);
    if (!s->palette) {
        s->density[0] += added;
        return;
    }
    tint_of_facet(s, x, y, tint);
    for (int c = 0; c < 3; c++)
        s->density[c] += added * (double)tint[c];
}

/* The pixel in cells, which are round in the space where elongated facets are. */
static coverage_pixel pixel_of(const model_query *q)
{
    const glint_footprint *f = q->footprint;
    const double per_metre = sqrt((double)q->surface->facets_per_m2);
    const double stretch = sqrt((double)q->material->options.elongation);
    const double u = per_metre / stretch, v = per_metre * stretch;
    return (coverage_pixel){
        f->u * u, f->v * v, (double)f->dudx * u, (double)f->dudy * u, (double)f->dvdx * v, (double)f->dvdy * v
    };
}

/* What shows of facets that vary little. */
static float shown_share(const model_query *q, const glint_value *value)
{
    return fade_share(fade_deviation(value->facet_count * value->lit_probability),
                      q->material->options.smooth_deviation);
}

/* White Noise takes the seed as a float, which has room for 24 bits. An object whose number needs more has its own
 * mixed with the material's: added up and rounded, materials with seeds next to each other would have the same facets.
 */
static uint32_t seed_of_facets(const model_query *q)
{
    const glint_material_options *o = &q->material->options;
    if (o->facet_hash != GLINT_FACET_HASH_CYCLES || q->footprint->seed < 1U << 24)
        return o->seed + q->footprint->seed;
    return hash_full(o->seed * HASH_X + q->footprint->seed * HASH_Y) >> 8;
}

/* The smooth value where there is nothing discrete to see, or too much. */
static void explicit_eval_area(const model_query *q, glint_value *value)
{
    area_value smooth;
    area_light light;
    area_eval(q, &smooth);
    *value = (glint_value){ 0 };
    for (int c = 0; c < 3; c++)
        value->rgb[c] = value->smooth[c] = smooth.specular[c] + smooth.diffuse[c];
    if (!q->footprint || !(q->surface->facets_per_m2 > 0.0F) || !(q->surface->discreteness > 0.0F) ||
        !area_see(q, &light) || !area_measure(&light))
        return;
    const coverage_pixel pixel = pixel_of(q);
    const double area = coverage_area(&pixel);
    value->facet_count = (float)area;
    value->lit_probability = smooth.lit_probability;
    const float shown = shown_share(q, value);
    value->over_limit = shown > 0.0F && coverage_cell_bound(&pixel) > (double)q->material->options.facet_limit;
    if (!(area > 0.0) || !(shown > 0.0F) || value->over_limit)
        return;
    const int is_tinted = tint_is_asked(&q->material->options);
    const tint_palette palette = is_tinted ? tint_palette_of(&q->material->options) : (tint_palette){ 0 };
    facet_sum s = { .q = q,
                    .palette = is_tinted ? &palette : NULL,
                    .distribution = lobe_ndf(q),
                    .seed = seed_of_facets(q),
                    .area = &light };
    s.total_area = q->total_area > 0.0F ? q->total_area : ndf_total_area(&s.distribution);
    coverage_each(&pixel, add_facet, &s);
    const float g = shown * q->surface->discreteness;
    const float discrete = q->material->options.coverage * (1.0F - clamp_to(q->area_light->hidden, 0.0F, 1.0F));
    for (int c = 0; c < 3; c++)
        value->rgb[c] = (1.0F - g) * smooth.specular[c] + g * discrete * (float)s.rgb[c] + smooth.diffuse[c];
}

static void explicit_eval(const model_query *q, glint_value *value)
{
    if (q->area_light) {
        explicit_eval_area(q, value);
        return;
    }
    lobe_value lobe;
    lobe_eval(q, &lobe);
    *value = (glint_value){ 0 };
    float density[3] = { lobe.density, lobe.density, lobe.density };
    if (q->footprint && q->solid_angle_sr > 0.0F && q->surface->facets_per_m2 > 0.0F &&
        q->surface->discreteness > 0.0F) {
        const coverage_pixel pixel = pixel_of(q);
        const double area = coverage_area(&pixel);
        const float solid_angle = lobe_lit_solid_angle(q, &lobe);
        value->facet_count = (float)area;
        value->lit_probability = lobe_lit_probability(q, &lobe, solid_angle);
        const float shown = shown_share(q, value);
        value->over_limit = shown > 0.0F && coverage_cell_bound(&pixel) > (double)q->material->options.facet_limit;
        if (area > 0.0 && shown > 0.0F && !value->over_limit) {
            const int is_tinted = tint_is_asked(&q->material->options);
            const tint_palette palette = is_tinted ? tint_palette_of(&q->material->options) : (tint_palette){ 0 };
            /* Cap of solid angle 2 pi (1 - cos): the chord to its rim is 2 sin(half the angle), squared solid_angle /
             * pi. */
            facet_sum s = { .q = q,
                            .palette = is_tinted ? &palette : NULL,
                            .distribution = lobe_ndf(q),
                            .h = lobe.h,
                            .chord2 = q->solid_angle_sr / MATH_PI,
                            .seed = seed_of_facets(q) };
            s.total_area = q->total_area > 0.0F ? q->total_area : ndf_total_area(&s.distribution);
            coverage_each(&pixel, add_facet, &s);
            const float g = shown * q->surface->discreteness;
            for (int c = 0; c < 3; c++) {
                const float discrete = (float)(s.density[is_tinted ? c : 0] / (double)q->solid_angle_sr);
                density[c] = (1.0F - g) * density[c] + g * discrete;
            }
        }
    }
    for (int c = 0; c < 3; c++) {
        value->smooth[c] = lobe.specular[c] + lobe.diffuse[c];
        value->rgb[c] = lobe.reflectance[c] * density[c] + lobe.diffuse[c];
    }
}

static void explicit_eval_many(const model_query *q, size_t count, glint_value *value)
{
    for (size_t i = 0; i < count; i++)
        explicit_eval(&q[i], &value[i]);
}

const struct model explicit_model = {
    .name = "explicit",
    .features = GLINT_FEATURE_DISCRETE | GLINT_FEATURE_GGX | GLINT_FEATURE_BECKMANN | GLINT_FEATURE_ANISOTROPIC |
                GLINT_FEATURE_SAMPLE | GLINT_FEATURE_VARYING_SURFACE | GLINT_FEATURE_EQUAL_AREA |
                GLINT_FEATURE_EQUAL_PROJECTED_AREA | GLINT_FEATURE_COLOR,
    .eval = explicit_eval,
    .eval_many = explicit_eval_many,
    .sample = lobe_sample,
    .pdf = lobe_pdf,
};
