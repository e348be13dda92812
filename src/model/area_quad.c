/* A microfacet lobe over sectors of directions, summed at eight points of each.
 *
 * A sector is a square in (u, t): u goes from the apex to the rim, t along the rim. The points are Gauss's, of four
 * nodes in u and two in t. How much they differ says whether they are enough; if not, the sector is halved across the
 * way in which they differ more, and its halves are looked at in the same way.
 *
 * The angle x from the apex and X of the rim have 1 - cos x = u (1 - cos X), so that solid angles are even in u. Where
 * the rim runs through q(t), of any length, du dt is worth apex . (q x q') / (|q|^2 (1 + cos X)).
 */
#include "model/area_quad.h"

#define GLINT_LANES 8
#include "math/elementary.h"
#include "ndf/beckmann_masked.h"

/* A cell is uneven if its points' shares of the reflection differ by this much of the whole. Chosen so that the
 * errors in docs/lights.md hold: glint study --lights draws errors and costs over it. */
#define UNEVEN_GGX 0.1F
#define UNEVEN_BECKMANN 0.03F

/* Halvings. Taste: a hundredth of the lights ask for as many. */
enum { MOST_SPLITS = 32, MOST_FIRST = LTC_MOST_SIDES + CONIC_ARCS };

/* What eight points add. */
typedef struct quad_terms {
    vfloat weight, reflected, fresnel[2], facets, x, y, z, cap;
} quad_terms;

/* Three numbers in lanes. */
typedef struct vvec3 {
    vfloat x, y, z;
} vvec3;

static vfloat dot(vvec3 a, vvec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* A lobe and a light in lanes. */
typedef struct quad_setting {
    int is_ggx, is_schlick;
    vvec3 wo, back[2], apex;
    vfloat visible_o; /* wo.z + masked_o */
    vfloat alpha2, inverse_alpha2, scale;
    const ltc_light *light;
} quad_setting;

static vvec3 splat3(vec3 v)
{
    return (vvec3){ splat(v.x), splat(v.y), splat(v.z) };
}

static quad_setting setting_of(const quad_lobe *l, const ltc_light *light)
{
    const float alpha2 = l->alpha * l->alpha;
    return (quad_setting){ l->is_ggx,
                           l->is_schlick,
                           splat3(l->wo),
                           { splat3(l->back[0]), splat3(l->back[1]) },
                           splat3(light->apex),
                           splat(l->wo.z + l->masked_o),
                           splat(alpha2),
                           splat(1.0F / alpha2),
                           splat(1.0F / (MATH_PI * alpha2)),
                           light };
}

/* A sector or a part of one: where it begins, and how far it reaches. */
typedef struct cell {
    int sector, is_arc;
    float u, t, reach_u, reach_t;
} cell;

/* Towards the rim, of any length, and apex . (rim x rim'). */
static inline vvec3 rim_of_side(const ltc_light *l, int side, vfloat t, vfloat *turn)
{
    const int i = l->side[side];
    const vfloat bow = l->bend[i] * (t - t * t), b = t + bow * (1.0F - 2.0F * t), a = 1.0F - b;
    *turn = l->volume[i] * ((1.0F + l->bend[i]) - 6.0F * bow);
    return (vvec3){ a * l->x[i] + b * l->x[i + 1], a * l->y[i] + b * l->y[i + 1], a * l->z[i] + b * l->z[i + 1] };
}

static inline vvec3 rim_of_arc(const ltc_light *l, int i, vfloat t, vfloat *turn)
{
    vfloat s, c;
    sincos_pi(l->half_turns[i] * t, &s, &c);
    const vfloat cosine = l->arc[i][0] * c - l->arc[i][1] * s, sine = l->arc[i][1] * c + l->arc[i][0] * s;
    const vfloat x = l->sine_x * cosine, y = l->sine_y * sine, dx = -l->sine_x * sine, dy = l->sine_y * cosine;
    const vfloat z = sqrt_f(max_f(1.0F - x * x - y * y, splat(1e-12F))), dz = -(x * dx + y * dy) / z;
    const vec3 m = l->apex_in_axes;
    const vfloat worth = m.x * (y * dz - z * dy) + m.y * (z * dx - x * dz) + m.z * (x * dy - y * dx);
    *turn = (MATH_PI * l->half_turns[i]) * max_f(worth, splat(0.0F)); /* below it by rounding */
    return (vvec3){ x * l->axis_x.x + y * l->axis_y.x + z * l->axis_z.x,
                    x * l->axis_x.y + y * l->axis_y.y + z * l->axis_z.y,
                    x * l->axis_x.z + y * l->axis_y.z + z * l->axis_z.z };
}

/* Gauss's, of four nodes along u and two along t: one in the mean. And over them, what makes shares of the points equal
 * again. */
static const vfloat node_weight = { 0.695709690F, 1.30429031F, 1.30429031F, 0.695709690F,
                                    0.695709690F, 1.30429031F, 1.30429031F, 0.695709690F };
static const vfloat over_weight = { 1.43738110F, 0.766700182F, 0.766700182F, 1.43738110F,
                                    1.43738110F, 0.766700182F, 0.766700182F, 1.43738110F };

/* Unit directions, and the solid angles that the points of a cell stand for. */
static inline vvec3 points_of(const quad_setting *l, const cell *c, vfloat *solid_angle)
{
    static const vfloat along_u = { 0.0694318442F, 0.330009478F, 0.669990522F, 0.930568156F,
                                    0.0694318442F, 0.330009478F, 0.669990522F, 0.930568156F };
    static const vfloat along_t = { 0.211324865F, 0.211324865F, 0.211324865F, 0.211324865F,
                                    0.788675135F, 0.788675135F, 0.788675135F, 0.788675135F };
    const vfloat u = c->u + c->reach_u * along_u, t = c->t + c->reach_t * along_t;
    vfloat turn;
    const vvec3 rim =
        c->is_arc ? rim_of_arc(l->light, c->sector, t, &turn) : rim_of_side(l->light, c->sector, t, &turn);
    const vfloat in2 = 1.0F / max_f(dot(rim, rim), splat(1e-12F)), in = sqrt_f(in2), cosine = dot(l->apex, rim) * in;
    const vfloat wide = 1.0F / max_f(1.0F + cosine, splat(1e-6F)), versine = u * (1.0F - cosine);
    const vfloat out = sqrt_f(max_f(u * (2.0F - versine) * wide, splat(0.0F))), back = (1.0F - versine) - out * cosine;
    *solid_angle = (c->reach_u * c->reach_t) * (turn * in2 * wide) * node_weight;
    const vfloat far = out * in;
    return (vvec3){ back * l->apex.x + far * rim.x, back * l->apex.y + far * rim.y, back * l->apex.z + far * rim.z };
}

/* D(h), for h of squared length h2. */
static inline vfloat density(const quad_setting *l, vvec3 h, vfloat h2)
{
    const vfloat slope2 = (h.x * h.x + h.y * h.y) * l->inverse_alpha2, z2 = h.z * h.z;
    if (l->is_ggx) {
        const vfloat t = h2 / (slope2 + z2); /* at most 1, for alpha is */
        return l->scale * t * t;
    }
    const vfloat exponent = slope2 / max_f(z2, splat(1e-24F)), inverse = h2 / max_f(z2, splat(1e-3F) * h2);
    return choose(less(exponent, splat(87.0F)), l->scale * inverse * inverse * exp_negative(-exponent), splat(0.0F));
}

/* G2 / (4 cos_o cos_i) (see ndf_correlated_masking), of unit directions. */
static inline vfloat masking(const quad_setting *l, vvec3 w)
{
    const vfloat t = l->alpha2 * (w.x * w.x + w.y * w.y), from_o = l->visible_o * w.z, least = splat(1e-12F);
    if (!l->is_ggx)
        return 0.25F / max_f(from_o + beckmann_masked_at(sqrt_f(t), w.z) * l->wo.z, least);
    /* masked = t / 2 / (length + cos): one division for both. */
    const vfloat sum = sqrt_f(t + w.z * w.z) + w.z;
    return 0.25F * sum / max_f(from_o * sum + 0.5F * t * l->wo.z, least * sum);
}

static inline __attribute__((always_inline)) void evaluate(const quad_setting *l, const cell *c, quad_terms *out)
{
    vfloat solid_angle;
    vvec3 p = points_of(l, c, &solid_angle);
    p.z = max_f(p.z, splat(1e-12F)); /* on the horizon, by rounding below it */
    const vvec3 b = { dot(l->back[0], p), dot(l->back[1], p), p.z };
    const vfloat inverse2 = 1.0F / max_f(dot(b, b), splat(1e-12F)), inverse = sqrt_f(inverse2);
    const vvec3 wi = { b.x * inverse, b.y * inverse, b.z * inverse };
    const vvec3 h = { wi.x + l->wo.x, wi.y + l->wo.y, wi.z + l->wo.z };
    const vfloat h2 = max_f(dot(h, h), splat(1e-12F)), cosine = min_f(0.5F * sqrt_f(h2), splat(1.0F));
    const vfloat d = density(l, h, h2), unit = 0.5F / cosine;

    /* Solid angles of directions and of half vectors, over the determinant. */
    const vfloat size = solid_angle * inverse2 * inverse, half_size = 0.5F * size * unit;
    out->weight = solid_angle * p.z;
    out->reflected = size * wi.z * d * masking(l, wi);
    const vfloat m = 1.0F - cosine, m2 = m * m;
    out->fresnel[0] = out->reflected * (l->is_schlick ? m2 * m2 * m : cosine);
    out->fresnel[1] = out->fresnel[0] * cosine;
    out->facets = half_size * d;
    const vfloat along = out->facets * unit;
    out->x = along * h.x;
    out->y = along * h.y;
    out->z = along * h.z;
    out->cap = half_size * (h.z * unit);
}

static inline float sum_of(vfloat x)
{
    return ((x[0] + x[4]) + (x[1] + x[5])) + ((x[2] + x[6]) + (x[3] + x[7]));
}

/* How much the points of a cell differ. */
static inline float span_of(vfloat reflected)
{
    const vfloat x = over_weight * reflected, a = { x[4], x[5], x[6], x[7], x[0], x[1], x[2], x[3] };
    const vfloat high = max_f(x, a), low = min_f(x, a);
    const vfloat b = { high[1], high[0], high[3], high[2], high[5], high[4], high[7], high[6] };
    const vfloat c = { low[1], low[0], low[3], low[2], low[5], low[4], low[7], low[6] };
    const vfloat higher = max_f(high, b), lower = min_f(low, c);
    return (higher[0] > higher[2] ? higher[0] : higher[2]) - (lower[0] < lower[2] ? lower[0] : lower[2]);
}

static inline void add(quad_terms *sum, const quad_terms *more, float share)
{
    sum->weight += share * more->weight;
    sum->reflected += share * more->reflected;
    sum->fresnel[0] += share * more->fresnel[0];
    sum->fresnel[1] += share * more->fresnel[1];
    sum->facets += share * more->facets;
    sum->x += share * more->x;
    sum->y += share * more->y;
    sum->z += share * more->z;
    sum->cap += share * more->cap;
}

/* Two halves of a cell, of which a share is in the sum. */
typedef struct split {
    cell half[2];
    float share, reflected; /* reflected: by the whole cell, as far as its own points say */
} split;

/* Across the way along which its points f differ more. */
static void halve(const cell *c, vfloat reflected, split *s)
{
    const vfloat f = over_weight * reflected;
    const float along_u = fabsf(((f[0] + f[4]) + (f[1] + f[5])) - ((f[2] + f[6]) + (f[3] + f[7])));
    const float along_t = fabsf(((f[0] + f[1]) + (f[2] + f[3])) - ((f[4] + f[5]) + (f[6] + f[7])));
    s->half[0] = *c;
    if (along_u > along_t) {
        s->half[0].reach_u *= 0.5F;
        s->half[1] = s->half[0];
        s->half[1].u += s->half[0].reach_u;
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
    const float most = q->uneven * q->whole, span = share * span_of(terms->reflected);
    if (!(span > most) || q->count >= MOST_SPLITS) {
        add(q->sum, terms, share);
        return;
    }
    const float finer = span < 2.0F * most ? (span - most) / most : 1.0F;
    if (finer < 1.0F)
        add(q->sum, terms, share * (1.0F - finer));
    split *const s = &q->splits[q->count++];
    s->share = share * finer;
    s->reflected = sum_of(terms->reflected);
    halve(c, terms->reflected, s);
}

static cell sector_of(const ltc_light *light, int i)
{
    const int is_arc = i >= light->side_count;
    return (cell){ is_arc ? i - light->side_count : i, is_arc, 0.0F, 0.0F, 1.0F, 1.0F };
}

/* All sectors again, and halves of what is uneven. */
static void refine(const quad_setting *l, int count, float uneven, quad_terms *sum)
{
    quad_terms terms[2];
    quad_queue q;
    q.count = 0;
    q.whole = sum_of(sum->reflected);
    q.uneven = uneven;
    q.sum = sum;
    memset(sum, 0, sizeof(*sum));
    for (int i = 0; i < count; i++) {
        const cell c = sector_of(l->light, i);
        evaluate(l, &c, &terms[0]);
        take(&q, &c, 1.0F, &terms[0]);
    }
    for (int k = 0; k < q.count; k++) {
        const split s = q.splits[k];
        for (int i = 0; i < 2; i++)
            evaluate(l, &s.half[i], &terms[i]);
        q.whole += s.share * (sum_of(terms[0].reflected + terms[1].reflected) - s.reflected);
        for (int i = 0; i < 2; i++)
            take(&q, &s.half[i], s.share, &terms[i]);
    }
}

/* Halves of two vectors, then quarters, then eighths, until every lane is the sum of a vector. */
static inline vfloat fold_halves(vfloat a, vfloat b)
{
    return (vfloat){ a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3] } +
           (vfloat){ a[4], a[5], a[6], a[7], b[4], b[5], b[6], b[7] };
}

static inline vfloat fold_quarters(vfloat a, vfloat b)
{
    return (vfloat){ a[0], a[1], b[0], b[1], a[4], a[5], b[4], b[5] } +
           (vfloat){ a[2], a[3], b[2], b[3], a[6], a[7], b[6], b[7] };
}

static inline vfloat fold_eighths(vfloat a, vfloat b)
{
    return (vfloat){ a[0], a[2], b[0], b[2], a[4], a[6], b[4], b[6] } +
           (vfloat){ a[1], a[3], b[1], b[3], a[5], a[7], b[5], b[7] };
}

static inline quad_sums sums_of(const quad_terms *t)
{
    const vfloat left = fold_quarters(fold_halves(t->weight, t->facets), fold_halves(t->reflected, t->x));
    const vfloat right = fold_quarters(fold_halves(t->fresnel[0], t->y), fold_halves(t->fresnel[1], t->z));
    const vfloat s = fold_eighths(left, right);
    return (quad_sums){ s[0], s[1], { s[2], s[3] }, s[4], s[5], s[6], s[7], sum_of(t->cap) };
}

#if defined(__AVX2__) && defined(GLINT_AREA_QUAD_AVX2)
#define AREA_QUAD_SUM area_quad_sum_avx2
#else
#define AREA_QUAD_SUM area_quad_sum_base
#endif

void AREA_QUAD_SUM(const quad_lobe *lobe, const ltc_light *light, quad_sums *sums)
{
    const quad_setting setting = setting_of(lobe, light);
    const int count = light->side_count + light->arc_count;
    /* Of many sectors each has less of the whole. */
    const float uneven = (lobe->is_ggx ? UNEVEN_GGX : UNEVEN_BECKMANN) * (count > 4 ? 4.0F / (float)count : 1.0F);
    quad_terms sum, terms;
    float span = 0.0F;
    for (int i = 0; i < count; i++) {
        const cell c = sector_of(light, i);
        evaluate(&setting, &c, i == 0 ? &sum : &terms);
        const float own = span_of(i == 0 ? sum.reflected : terms.reflected);
        span = own > span ? own : span;
        if (i > 0)
            add(&sum, &terms, 1.0F);
    }
    if (span > uneven * sum_of(sum.reflected))
        refine(&setting, count, uneven, &sum);
    *sums = sums_of(&sum);
}
