/* The dictionary model: a normalised distribution of normals for each patch of surface, from products of tabulated
 * marginals.
 *
 * Chermain et al. 2020: f = F G2 D_P / (4 cos_o cos_i) with V-cavity masking, D_P a weighted sum over the cells of a
 * MIP hierarchy (Eqs. 12 to 16). The paper has no sampling; since D_P is even, the visible normals of V-cavities (Heitz
 * and d'Eon 2014) sample exactly what is evaluated.
 */
#include "math/fade.h"
#include "model/area_points.h"
#include "model/dictionary_kernel.h"
#include "model/dictionary_patch.h"
#include "model/lobe.h"
#include "model/stretch.h"
#include "model/tint.h"
#include "ndf/v_cavity.h"

#define GLINT_LANES 1
#include "footprint/grid.h"
#include "math/hash.h"
#include "math/uniform.h"

/* Below this h is so close to the horizon that slopes are longer than any facet's. */
#define LEAST_COSINE 1e-6F

/* The lobes of a patch are wide: however large the light, the value varies as if it lit this share of the facets in the
 * middle of the highlight. Measured: the variance times N is 60 there at most, and less for more facets. */
#define LOBE_SHARE (1.0F / 64.0F)

/* Below this area, m^2, a footprint is a point or a line. */
#define LEAST_AREA 1e-30F

/* The distribution of normals at one point: smooth_share of the target and discrete_share of the cells. */
typedef struct point {
    dictionary_surface surface;
    float smooth_share, discrete_share;
    dictionary_patch patch; /* empty where discrete_share is 0 */
} point;

/* D at one normal: as facets with their tints reflect, and as sampling has it, without tints. */
typedef struct point_density {
    float tinted[3];
    float plain;
} point_density;

static int is_discrete(const model_query *q)
{
    const glint_footprint *f = q->footprint;
    return f && q->surface->discreteness > 0.0F && q->surface->facets_per_m2 > 0.0F &&
           grid_area(f->dudx, f->dudy, f->dvdx, f->dvdy) >= LEAST_AREA;
}

/* share: of the facets, that shows. */
static void find_point(const model_query *q, float share, point *p)
{
    const glint_material_options *o = &q->material->options;
    p->surface = (dictionary_surface){ q->material->baked,
                                       { o->distribution == GLINT_DISTRIBUTION_GGX ? NDF_GGX : NDF_BECKMANN,
                                         q->surface->alpha_x, q->surface->alpha_y },
                                       o->coverage,
                                       o->density_variation };
    p->patch.count = 0;
    if (share > 0.0F) {
        const glint_footprint f = stretch_footprint(q->footprint, o->elongation);
        dictionary_patch_find(&p->patch, &f, q->surface->facets_per_m2, o->max_anisotropy,
                              hash_full(o->seed * HASH_X + f.seed * HASH_Y));
        if (dictionary_is_smooth(&p->surface, p->patch.log4_facets[0]))
            p->patch.count = 0;
    }
    const float g = p->patch.count > 0 ? share * q->surface->discreteness : 0.0F;
    p->smooth_share = (1.0F - g) * o->coverage;
    p->discrete_share = g;
}

/* The cells of a patch that carry facets. */
typedef struct carriers {
    size_t count;
    dictionary_cells cells;
    float weight[DICTIONARY_MAX_CELLS];
} carriers;

static void find_carriers(const point *p, carriers *c)
{
    c->count = 0;
    for (int i = 0; i < p->patch.count; i++) {
        const dictionary_cell *cell = &p->patch.cell[i];
        const float coverage = dictionary_cell_coverage(&p->surface, cell->hash, p->patch.grain_level[cell->level]);
        if (!(coverage > 0.0F))
            continue;
        c->cells.hash[c->count] = cell->hash;
        c->cells.log4_facets[c->count] =
            dictionary_cell_log4(&p->surface, cell->hash, p->patch.log4_facets[cell->level], coverage);
        c->weight[c->count++] = p->discrete_share * cell->weight * coverage;
    }
}

/* D_P of Eq. 13 at h; target: D of the smooth distribution there. */
static point_density density_at(const point *p, const glint_material_options *o, vec3 h, float target)
{
    point_density d = { { 0.0F, 0.0F, 0.0F }, p->smooth_share * target };
    const int is_colored = tint_is_asked(o);
    const tint_palette palette = is_colored ? tint_palette_of(o) : (tint_palette){ 0 };
    const float cosine = fmaxf(h.z, LEAST_COSINE), cosine2 = cosine * cosine;
    carriers c;
    float density[DICTIONARY_ROOM];
    find_carriers(p, &c);
    dictionary_cells_density(&p->surface, &c.cells, c.count, (slope){ -h.x / cosine, -h.y / cosine }, density);
    float tinted[3] = { d.plain, d.plain, d.plain };
    for (size_t i = 0; i < c.count; i++) {
        const int is_target = dictionary_cell_is_target(c.cells.log4_facets[i]);
        const float one = c.weight[i] * (is_target ? target : density[i] / (cosine2 * cosine2));
        float tint[3] = { 1.0F, 1.0F, 1.0F };
        if (is_colored)
            tint_of(&palette, c.cells.hash[i], dictionary_cell_facets(c.cells.log4_facets[i]), tint);
        d.plain += one;
        for (int k = 0; k < 3; k++)
            tinted[k] += one * tint[k];
    }
    for (int k = 0; k < 3; k++)
        d.tinted[k] = tinted[k];
    return d;
}

/* What f cos_i of Eq. 14 has besides F and D: G2 / (4 cos_o). */
static float masking(const model_query *q, const lobe_value *lobe)
{
    if (!(lobe->h.z > 0.0F))
        return 0.0F;
    return 0.25F * v_cavity_masking_over_cosine(lobe->h, lobe->h_dot_wi, q->wo) *
           v_cavity_masking(lobe->h, lobe->h_dot_wi, q->wi);
}

/* What shows of the facets where they vary little. A lobe covers less of the slopes away from the middle, as D does. */
static float shown_share(const model_query *q, const lobe_value *lobe, const glint_value *value)
{
    const float limit = q->material->options.smooth_deviation;
    if (!(limit > 0.0F))
        return 1.0F;
    const float cosine2 = lobe->h.z * lobe->h.z;
    const float over_middle = MATH_PI * q->surface->alpha_x * q->surface->alpha_y * lobe->density * (cosine2 * cosine2);
    const float lit = value->facet_count * fminf(value->lit_probability, LOBE_SHARE * over_middle);
    return fade_share(fade_deviation(lit), limit);
}

static void dictionary_eval(const model_query *q, glint_value *value)
{
    if (q->area_light) {
        area_points_eval(q, value);
        return;
    }
    lobe_value lobe;
    lobe_eval(q, &lobe);
    const float coverage = q->material->options.coverage, g2 = masking(q, &lobe);
    *value = (glint_value){ 0 };
    for (int c = 0; c < 3; c++)
        value->rgb[c] = value->smooth[c] = coverage * lobe.fresnel[c] * g2 * lobe.density + lobe.diffuse[c];
    if (!is_discrete(q) || !(q->solid_angle_sr > 0.0F))
        return;
    const glint_footprint *f = q->footprint;
    value->facet_count = fminf(grid_area(f->dudx, f->dudy, f->dvdx, f->dvdy) * q->surface->facets_per_m2, 1e30F);
    value->lit_probability = lobe_lit_probability(q, &lobe, lobe_lit_solid_angle(q, &lobe));
    point p;
    find_point(q, shown_share(q, &lobe, value), &p);
    if (p.patch.count == 0)
        return;
    const point_density d = density_at(&p, &q->material->options, lobe.h, lobe.density);
    for (int c = 0; c < 3; c++)
        value->rgb[c] = lobe.fresnel[c] * g2 * d.tinted[c] + lobe.diffuse[c];
}

static void dictionary_eval_many(const model_query *q, size_t count, glint_value *value)
{
    for (size_t i = 0; i < count; i++)
        dictionary_eval(&q[i], &value[i]);
}

/* ---- sampling ---- */

/* Integral of D (n.h): the share of the point that carries facets. */
static float covered(const point *p)
{
    float sum = p->smooth_share;
    for (int i = 0; i < p->patch.count; i++)
        sum +=
            p->discrete_share * p->patch.cell[i].weight *
            dictionary_cell_coverage(&p->surface, p->patch.cell[i].hash, p->patch.grain_level[p->patch.cell[i].level]);
    return sum;
}

/* Where there are no facets there is only the base. */
static float facets_chance(const model_query *q, float mass)
{
    return mass > 0.0F ? lobe_specular_chance(q) : 0.0F;
}

/* A slope with density P22 / mass; what is left of the choice is uniform again. */
static slope sample_slope(const point *p, float mass, float *choice, float u1, float u2)
{
    const float wanted = *choice * mass;
    if (p->patch.count == 0 || wanted < p->smooth_share) {
        *choice = uniform_within(wanted, 0.0F, p->smooth_share);
        return dictionary_target_sample(&p->surface.target, u1, u2);
    }
    float below = p->smooth_share, coverage = 0.0F, share = 0.0F;
    const dictionary_cell *chosen = NULL;
    for (int i = 0; i < p->patch.count; i++) {
        const dictionary_cell *cell = &p->patch.cell[i];
        const float c = dictionary_cell_coverage(&p->surface, cell->hash, p->patch.grain_level[cell->level]);
        if (!(c > 0.0F))
            continue;
        below += share;
        coverage = c;
        chosen = cell;
        share = p->discrete_share * cell->weight * c;
        if (wanted < below + share)
            break;
    }
    if (!chosen)
        return dictionary_target_sample(&p->surface.target, u1, u2);
    *choice = uniform_within(wanted, below, below + share);
    dictionary_cell_slopes s;
    dictionary_cell_find(
        &s, &p->surface, chosen->hash,
        dictionary_cell_log4(&p->surface, chosen->hash, p->patch.log4_facets[chosen->level], coverage));
    return s.count > 0 ? dictionary_cell_sample(&s, &p->surface.target, choice, u1, u2)
                       : dictionary_target_sample(&p->surface.target, u1, u2);
}

/* The facet with this slope or the one that faces it across the cavity, whichever the viewer sees more of: normals with
 * density G1(wo) D(m) max(0, wo.m) / cos_o. */
static vec3 visible_facet(slope s, vec3 wo, float choice)
{
    const vec3 here = vec3_normalize((vec3){ -s.x, -s.y, 1.0F }), there = { -here.x, -here.y, here.z };
    const float seen_here = fmaxf(vec3_dot(wo, here), 0.0F), seen_there = fmaxf(vec3_dot(wo, there), 0.0F);
    return choice * (seen_here + seen_there) < seen_here ? here : there;
}

static float pdf_of(const model_query *q, const lobe_value *lobe, float density, float mass)
{
    const float chance = facets_chance(q, mass);
    const float base = (1.0F - chance) * (q->wi.z / MATH_PI);
    if (!(chance > 0.0F) || !(lobe->h.z > 0.0F))
        return base;
    return chance * 0.25F * v_cavity_masking_over_cosine(lobe->h, lobe->h_dot_wi, q->wo) * (density / mass) + base;
}

static int dictionary_sample(const model_query *q, const float random[3], glint_sample *sample)
{
    point p;
    find_point(q, is_discrete(q) ? 1.0F : 0.0F, &p);
    const float mass = covered(&p), chance = facets_chance(q, mass);
    model_query lit = *q;
    if (random[0] < chance) {
        float choice = uniform_within(random[0], 0.0F, chance);
        const slope s = sample_slope(&p, mass, &choice, random[1], random[2]);
        const vec3 h = visible_facet(s, q->wo, choice);
        lit.wi = vec3_normalize(vec3_add(vec3_scale(h, 2.0F * vec3_dot(q->wo, h)), vec3_scale(q->wo, -1.0F)));
    } else {
        lit.wi = lobe_cosine_direction(random[1], random[2]);
    }
    if (!(lit.wi.z > 0.0F))
        return 0;
    lobe_value lobe;
    lobe_eval(&lit, &lobe);
    const point_density d = density_at(&p, &q->material->options, lobe.h, lobe.density);
    const float pdf = pdf_of(&lit, &lobe, d.plain, mass);
    if (!(pdf > 0.0F))
        return 0;
    const float g2 = masking(&lit, &lobe);
    *sample = (glint_sample){ { lit.wi.x, lit.wi.y, lit.wi.z }, pdf, { 0.0F, 0.0F, 0.0F } };
    for (int c = 0; c < 3; c++)
        sample->weight[c] = (lobe.fresnel[c] * g2 * d.tinted[c] + lobe.diffuse[c]) / pdf;
    return 1;
}

static float dictionary_pdf(const model_query *q)
{
    point p;
    find_point(q, is_discrete(q) ? 1.0F : 0.0F, &p);
    lobe_value lobe;
    lobe_eval(q, &lobe);
    return pdf_of(q, &lobe, density_at(&p, &q->material->options, lobe.h, lobe.density).plain, covered(&p));
}

/* ---- set-up ---- */

static glint_result dictionary_setup(struct glint_material *material)
{
    const glint_allocator *a = &material->options.allocator;
    dictionary *table = a->allocate(sizeof(*table), a->user);
    if (!table)
        return GLINT_ERROR_MEMORY;
    dictionary_scratch *scratch = a->allocate(sizeof(*scratch), a->user);
    if (!scratch) {
        a->release(table, a->user);
        return GLINT_ERROR_MEMORY;
    }
    dictionary_build(table, scratch, material->options.seed);
    a->release(scratch, a->user);
    material->baked = table;
    return GLINT_OK;
}

static void dictionary_free(struct glint_material *material)
{
    material->options.allocator.release(material->baked, material->options.allocator.user);
}

const struct model dictionary_model = {
    .name = "dictionary",
    .features = GLINT_FEATURE_DISCRETE | GLINT_FEATURE_GGX | GLINT_FEATURE_BECKMANN | GLINT_FEATURE_ANISOTROPIC |
                GLINT_FEATURE_SAMPLE | GLINT_FEATURE_VARYING_SURFACE | GLINT_FEATURE_EQUAL_AREA |
                GLINT_FEATURE_EQUAL_PROJECTED_AREA | GLINT_FEATURE_SAMPLE_FOOTPRINT | GLINT_FEATURE_COLOR,
    .setup = dictionary_setup,
    .free = dictionary_free,
    .eval = dictionary_eval,
    .eval_many = dictionary_eval_many,
    .sample = dictionary_sample,
    .pdf = dictionary_pdf,
};
