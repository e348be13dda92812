/* A microfacet lobe over sectors of directions, summed at eight points of each.
 *
 * A sector is a square in (u, t): u goes from the apex to the rim, t along the rim. The points are Gauss's, of four
 * nodes in u and two in t. How much they differ says whether they are enough; if not, the sector is cut in two across
 * the way in which they differ more, and its parts are looked at in the same way. An apex on the rim is no summit: from
 * there the lobe falls with the angle itself, the root of u, so at the tip the nodes are those of its polynomials.
 *
 * The angle x from the apex and X of the rim have 1 - cos x = u (1 - cos X), so that solid angles are even in u. Where
 * the rim runs through q(t), of any length, du dt is worth apex . (q x q') / (|q|^2 (1 + cos X)).
 */
#include "model/area_quad.h"

#define GLINT_LANES 8
#include "model/area_fold.h"
#include "model/area_lobe.h"

/* A cell is uneven if its points' shares of the reflection differ by this much of the whole. Chosen so that the
 * errors in docs/lights.md hold: glint study --lights draws errors and costs over it. */
#define UNEVEN_GGX 0.15F
#define UNEVEN_BECKMANN 0.05F

/* The cosine's integral is known: where it is missed by more than a hundredth from a rim that takes in little of the
 * lobe, sectors are slivers whose points saw the lobe by chance, by up to .71 of the whole too little. Cells count as
 * uneven that much sooner there: a fit, which leaves the costs of other lights alone. */
#define MISSED 0.01F
#define MISSED_RATE 4000.0F
#define MISSED_SHARE 0.2F

/* Halvings. Taste: a hundredth of the lights ask for as many. */
enum { MOST_SPLITS = 32, MOST_FIRST = LTC_MOST_SIDES + CONIC_ARCS };

/* What eight points add. */
typedef struct quad_terms {
    vfloat weight;
    area_terms of;
} quad_terms;

/* Gauss's four nodes along u, for both along t. Weights are one in the mean of what the nodes know; over them, shares
 * of the points are equal again. halfway: of u, where a cell is cut in two. */
typedef struct quad_nodes {
    vfloat u, weight, over_weight;
    float halfway;
} quad_nodes;

/* Of polynomials of u, and at the tip of its root. */
static const quad_nodes nodes_within = {
    { 0.0694318442F, 0.330009478F, 0.669990522F, 0.930568156F, 0.0694318442F, 0.330009478F, 0.669990522F,
      0.930568156F },
    { 0.69570969F, 1.30429031F, 1.30429031F, 0.69570969F, 0.69570969F, 1.30429031F, 1.30429031F, 0.69570969F },
    { 1.43738116F, 0.766700475F, 0.766700475F, 1.43738116F, 1.43738116F, 0.766700475F, 0.766700475F, 1.43738116F },
    0.5F
};

static const quad_nodes nodes_of_tip = {
    { 0.0195328197F, 0.173396928F, 0.522956027F, 0.889052497F, 0.0195328197F, 0.173396928F, 0.522956027F,
      0.889052497F },
    { 0.249447768F, 1.03878038F, 1.62771654F, 1.08405531F, 0.249447768F, 1.03878038F, 1.62771654F, 1.08405531F },
    { 4.00885528F, 0.962667392F, 0.614357582F, 0.92246216F, 4.00885528F, 0.962667392F, 0.614357582F, 0.92246216F },
    0.25F
};

/* Of the same times exp(-1.5 u) and exp(-2 sqrt(u)), as a Gaussian falls beside a cosine. The rates are a fit: without
 * them Beckmann's lights were .15 to .3 % too dark where it is narrow, with twice as much as bright. */
static const quad_nodes nodes_of_gaussian = {
    { 0.0597301871F, 0.294800668F, 0.631679649F, 0.918535698F, 0.0597301871F, 0.294800668F, 0.631679649F,
      0.918535698F },
    { 0.604288183F, 1.22290285F, 1.36796732F, 0.804841587F, 0.604288183F, 1.22290285F, 1.36796732F, 0.804841587F },
    { 1.65483958F, 0.817726445F, 0.731011613F, 1.24248053F, 1.65483958F, 0.817726445F, 0.731011613F, 1.24248053F },
    0.5F
};

static const quad_nodes nodes_of_gaussian_tip = {
    { 0.0139554012F, 0.136359495F, 0.463080403F, 0.865871069F, 0.0139554012F, 0.136359495F, 0.463080403F,
      0.865871069F },
    { 0.182337809F, 0.878839677F, 1.65602188F, 1.2828003F, 0.182337809F, 0.878839677F, 1.65602188F, 1.2828003F },
    { 5.48432607F, 1.13786396F, 0.603856757F, 0.779544565F, 5.48432607F, 1.13786396F, 0.603856757F, 0.779544565F },
    0.25F
};

/* A lobe and a light in lanes. */
typedef struct quad_setting {
    area_lobe lobe;
    vfloat3 back[2], apex;
    const ltc_light *light;
    const quad_nodes *nodes; /* of sectors */
} quad_setting;

static vfloat3 splat3(vec3 v)
{
    return (vfloat3){ splat(v.x), splat(v.y), splat(v.z) };
}

static quad_setting setting_of(const quad_lobe *l, const ltc_light *light)
{
    const vfloat alpha = splat(l->alpha);
    const int is_on_rim = light->apex.z < 1.0F;
    const quad_nodes *const of_ggx = is_on_rim ? &nodes_of_tip : &nodes_within;
    const quad_nodes *const of_beckmann = is_on_rim ? &nodes_of_gaussian_tip : &nodes_of_gaussian;
    return (quad_setting){ area_lobe_of(l->is_ggx, l->is_schlick, splat3(l->wo), splat(l->wo.z + l->masked_o), alpha,
                                        alpha),
                           { splat3(l->back[0]), splat3(l->back[1]) },
                           splat3(light->apex),
                           light,
                           l->is_ggx ? of_ggx : of_beckmann };
}

/* A sector or a part of one: where it begins, and how far it reaches. */
typedef struct cell {
    int sector, is_arc;
    float u, t, reach_u, reach_t;
    const quad_nodes *nodes;
} cell;

/* Towards the rim, of any length, and apex . (rim x rim'). */
static inline vfloat3 rim_of_side(const ltc_light *l, int side, vfloat t, vfloat *turn)
{
    const int i = l->side[side];
    const vfloat bow = l->bend[i] * (t - t * t), b = t + bow * (1.0F - 2.0F * t), a = 1.0F - b;
    *turn = l->volume[i] * ((1.0F + l->bend[i]) - 6.0F * bow);
    return (vfloat3){ a * l->x[i] + b * l->x[i + 1], a * l->y[i] + b * l->y[i + 1], a * l->z[i] + b * l->z[i + 1] };
}

static inline vfloat3 rim_of_arc(const ltc_light *l, int i, vfloat t, vfloat *turn)
{
    vfloat s, c;
    sincos_pi(l->half_turns[i] * t, &s, &c);
    const vfloat cosine = l->arc[i][0] * c - l->arc[i][1] * s, sine = l->arc[i][1] * c + l->arc[i][0] * s;
    const vfloat x = l->sine_x * cosine, y = l->sine_y * sine, dx = -l->sine_x * sine, dy = l->sine_y * cosine;
    const vfloat z = sqrt_f(max_f(1.0F - x * x - y * y, splat(1e-12F))), dz = -(x * dx + y * dy) / z;
    const vec3 m = l->apex_in_axes;
    const vfloat worth = m.x * (y * dz - z * dy) + m.y * (z * dx - x * dz) + m.z * (x * dy - y * dx);
    *turn = (MATH_PI * l->half_turns[i]) * max_f(worth, splat(0.0F)); /* below it by rounding */
    return (vfloat3){ x * l->axis_x.x + y * l->axis_y.x + z * l->axis_z.x,
                      x * l->axis_x.y + y * l->axis_y.y + z * l->axis_z.y,
                      x * l->axis_x.z + y * l->axis_y.z + z * l->axis_z.z };
}

/* Unit directions, and the solid angles that the points of a cell stand for. */
static inline vfloat3 points_of(const quad_setting *l, const cell *c, vfloat *solid_angle)
{
    static const vfloat along_t = { 0.211324865F, 0.211324865F, 0.211324865F, 0.211324865F,
                                    0.788675135F, 0.788675135F, 0.788675135F, 0.788675135F };
    const quad_nodes *const n = c->nodes;
    const vfloat u = c->u + c->reach_u * n->u, t = c->t + c->reach_t * along_t;
    vfloat turn;
    const vfloat3 rim =
        c->is_arc ? rim_of_arc(l->light, c->sector, t, &turn) : rim_of_side(l->light, c->sector, t, &turn);
    const vfloat in2 = 1.0F / max_f(dot_3(rim, rim), splat(1e-12F)), in = sqrt_f(in2),
                 cosine = dot_3(l->apex, rim) * in;
    const vfloat wide = 1.0F / max_f(1.0F + cosine, splat(1e-6F)), versine = u * (1.0F - cosine);
    const vfloat out = sqrt_f(max_f(u * (2.0F - versine) * wide, splat(0.0F))), back = (1.0F - versine) - out * cosine;
    *solid_angle = (c->reach_u * c->reach_t) * (turn * in2 * wide) * n->weight;
    const vfloat far = out * in;
    return (vfloat3){ back * l->apex.x + far * rim.x, back * l->apex.y + far * rim.y, back * l->apex.z + far * rim.z };
}

static inline __attribute__((always_inline)) void evaluate(const quad_setting *l, const cell *c, quad_terms *out)
{
    vfloat solid_angle;
    vfloat3 p = points_of(l, c, &solid_angle);
    p.z = max_f(p.z, splat(1e-12F)); /* on the horizon, by rounding below it */
    const vfloat3 b = { dot_3(l->back[0], p), dot_3(l->back[1], p), p.z };
    const vfloat inverse2 = 1.0F / max_f(dot_3(b, b), splat(1e-12F)), inverse = sqrt_f(inverse2);
    /* Solid angles over the determinant. */
    area_terms_at(&l->lobe, scale_3(b, inverse), solid_angle * inverse2 * inverse, &out->of);
    out->weight = solid_angle * p.z;
}

/* How much the points of a cell differ. */
static inline float span_of(const cell *c, vfloat reflected)
{
    const vfloat x = c->nodes->over_weight * reflected, a = { x[4], x[5], x[6], x[7], x[0], x[1], x[2], x[3] };
    const vfloat high = max_f(x, a), low = min_f(x, a);
    const vfloat q = { high[1], high[0], high[3], high[2], high[5], high[4], high[7], high[6] };
    const vfloat r = { low[1], low[0], low[3], low[2], low[5], low[4], low[7], low[6] };
    const vfloat higher = max_f(high, q), lower = min_f(low, r);
    return (higher[0] > higher[2] ? higher[0] : higher[2]) - (lower[0] < lower[2] ? lower[0] : lower[2]);
}

static inline void add(quad_terms *sum, const quad_terms *more)
{
    sum->weight += more->weight;
    area_add_terms(&sum->of, &more->of);
}

static inline void add_share(quad_terms *sum, const quad_terms *more, float share)
{
    const area_terms *const of = &more->of;
    const quad_terms scaled = { share * more->weight,
                                { share * of->reflected,
                                  { share * of->fresnel[0], share * of->fresnel[1] },
                                  share * of->facets,
                                  share * of->x,
                                  share * of->y,
                                  share * of->z,
                                  share * of->cap } };
    add(sum, &scaled);
}

/* Two halves of a cell, of which a share is in the sum. */
typedef struct split {
    cell half[2];
    float share, reflected; /* reflected: by the whole cell, as far as its own points say */
} split;

/* Across the way along which its points f differ more: in the middle, which at a tip is that of its root. */
static void halve(const cell *c, vfloat reflected, split *s)
{
    const vfloat f = c->nodes->over_weight * reflected;
    const float along_u = fabsf(((f[0] + f[4]) + (f[1] + f[5])) - ((f[2] + f[6]) + (f[3] + f[7])));
    const float along_t = fabsf(((f[0] + f[1]) + (f[2] + f[3])) - ((f[4] + f[5]) + (f[6] + f[7])));
    s->half[0] = *c;
    if (along_u > along_t) {
        s->half[0].reach_u *= c->nodes->halfway;
        s->half[1] = s->half[0];
        s->half[1].u += s->half[0].reach_u;
        s->half[1].reach_u = c->reach_u - s->half[0].reach_u;
        s->half[1].nodes = &nodes_within;
    } else {
        s->half[0].reach_t *= 0.5F;
        s->half[1] = s->half[0];
        s->half[1].t += s->half[0].reach_t;
    }
}

/* Splits that wait, in the order in which they are looked at; the sum, and what it will be of reflected light. */
typedef struct quad_queue {
    split splits[MOST_SPLITS];
    int count;
    float whole, uneven;
    quad_terms *sum;
} quad_queue;

/* Adds a cell, and asks for its halves if it is uneven. If it is little more so than it may be it counts with its
 * halves in part: where a light slides along a surface, nothing jumps. */
static void take(quad_queue *q, const cell *c, float share, const quad_terms *terms)
{
    const float most = q->uneven * q->whole, span = share * span_of(c, terms->of.reflected);
    if (!(span > most) || q->count >= MOST_SPLITS) {
        add_share(q->sum, terms, share);
        return;
    }
    const float finer = span < 2.0F * most ? (span - most) / most : 1.0F;
    if (finer < 1.0F)
        add_share(q->sum, terms, share * (1.0F - finer));
    split *const s = &q->splits[q->count++];
    s->share = share * finer;
    s->reflected = fold_one(terms->of.reflected);
    halve(c, terms->of.reflected, s);
}

static cell sector_of(const quad_setting *l, int i)
{
    const int is_arc = i >= l->light->side_count;
    return (cell){ is_arc ? i - l->light->side_count : i, is_arc, 0.0F, 0.0F, 1.0F, 1.0F, l->nodes };
}

/* Sectors, and halves of what is uneven. */
static void refine(const quad_setting *l, const quad_terms *sectors, int count, float uneven, quad_terms *sum)
{
    quad_terms terms[2];
    quad_queue q;
    q.count = 0;
    q.whole = fold_one(sum->of.reflected);
    q.uneven = uneven;
    q.sum = sum;
    memset(sum, 0, sizeof(*sum));
    for (int i = 0; i < count; i++) {
        const cell c = sector_of(l, i);
        take(&q, &c, 1.0F, &sectors[i]);
    }
    for (int k = 0; k < q.count; k++) {
        const split s = q.splits[k];
        for (int i = 0; i < 2; i++)
            evaluate(l, &s.half[i], &terms[i]);
        q.whole += s.share * (fold_one(terms[0].of.reflected + terms[1].of.reflected) - s.reflected);
        for (int i = 0; i < 2; i++)
            take(&q, &s.half[i], s.share, &terms[i]);
    }
}

static inline quad_sums sums_of(const quad_terms *t)
{
    const area_terms *const of = &t->of;
    const vfloat s =
        fold_eight(t->weight, of->reflected, of->fresnel[0], of->fresnel[1], of->facets, of->x, of->y, of->z);
    return (quad_sums){ s[0], s[1], { s[2], s[3] }, s[4], s[5], s[6], s[7], fold_one(of->cap) };
}

#if defined(__AVX2__) && defined(GLINT_AREA_QUAD_AVX2)
#define AREA_QUAD_SUM area_quad_sum_avx2
#else
#define AREA_QUAD_SUM area_quad_sum_base
#endif

/* Of the whole, by which points of a cell may differ. weight: the sectors' own sum of the cosine. */
static float evenness_of(const quad_lobe *lobe, const ltc_light *light, int sectors, float weight)
{
    /* Of many sectors each has less of the whole. */
    const float uneven = (lobe->is_ggx ? UNEVEN_GGX : UNEVEN_BECKMANN) * (sectors > 4 ? 4.0F / (float)sectors : 1.0F);
    const float missed = fabsf(weight * (0.125F / MATH_PI) - 1.0F) - MISSED;
    const float small = 1.0F - (float)light->share * (1.0F / MISSED_SHARE);
    return light->apex.z < 1.0F && missed > 0.0F && small > 0.0F ? uneven / (1.0F + MISSED_RATE * missed * small)
                                                                 : uneven;
}

void AREA_QUAD_SUM(const quad_lobe *lobe, const ltc_light *light, quad_sums *sums)
{
    const quad_setting setting = setting_of(lobe, light);
    const int count = light->side_count + light->arc_count;
    quad_terms sum, sectors[MOST_FIRST];
    float span = 0.0F;
    for (int i = 0; i == 0 || i < count; i++) {
        const cell c = sector_of(&setting, i);
        evaluate(&setting, &c, &sectors[i]);
        const float own = span_of(&c, sectors[i].of.reflected);
        span = own > span ? own : span;
        if (i > 0)
            add(&sum, &sectors[i]);
        else
            sum = sectors[0];
    }
    const float uneven = evenness_of(lobe, light, count, fold_one(sum.weight));
    if (span > uneven * fold_one(sum.of.reflected))
        refine(&setting, sectors, count, uneven, &sum);
    *sums = sums_of(&sum);
}
