/* A microfacet lobe over sectors of directions, summed at four points of each at a time.
 *
 * A sector is a triangle in (s, r), s, r >= 0, s + r <= 1: s + r goes from its middle to the rim, r / (s + r) along the
 * rim. The points are the middles of the triangle's quarters. How much they differ says whether they are enough; if
 * not, the quarters are looked at in the same way.
 *
 * Directions are p = (1 - s - r) m + (s + r) q, not unit, q on the rim. Over ds dr the cosine's integral is exactly
 * m . (q x q') p.z / |p|^4, q' the derivative along the rim.
 */
#include "model/area_quad.h"

#define GLINT_LANES 4
#include "math/elementary.h"
#include "ndf/beckmann_masked.h"

/* A part is uneven if its quarters' shares of the reflection differ by this much of the whole. Chosen so that the
 * errors in docs/lights.md hold: glint study --lights draws errors and costs over it. */
#define UNEVEN_GGX 0.08F
#define UNEVEN_BECKMANN 0.04F

enum { MOST_DEPTH = 6 };

/* What one quad adds, four lanes each. */
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
    vvec3 wo, back[2], middle, center, x, y;
    vfloat turn[3], visible_o; /* wo.z + masked_o */
    vfloat alpha2, inverse_alpha2, scale;
} quad_setting;

static vvec3 splat3(vec3 v)
{
    return (vvec3){ splat(v.x), splat(v.y), splat(v.z) };
}

static quad_setting setting_of(const quad_lobe *l, const quad_light *light)
{
    const float alpha2 = l->alpha * l->alpha;
    return (quad_setting){ l->is_ggx,
                           l->is_schlick,
                           splat3(l->wo),
                           { splat3(l->back[0]), splat3(l->back[1]) },
                           splat3(light->middle),
                           splat3(light->center),
                           splat3(light->x),
                           splat3(light->y),
                           { splat(light->turn[0]), splat(light->turn[1]), splat(light->turn[2]) },
                           splat(l->wo.z + l->masked_o),
                           splat(alpha2),
                           splat(1.0F / alpha2),
                           splat(1.0F / (MATH_PI * alpha2)) };
}

/* A sector, or one of the similar triangles that it is divided into. */
typedef struct part {
    float s, r, side; /* its first corner, and the length of its sides; below 0: it points the other way */
} part;

/* a x + b y + c z */
static inline vvec3 blend(vfloat a, vvec3 x, vfloat b, vvec3 y, vfloat c, vvec3 z)
{
    return (vvec3){ a * x.x + b * y.x + c * z.x, a * x.y + b * y.y + c * z.y, a * x.z + b * y.z + c * z.z };
}

/* Directions, not unit, and what a unit of (s, r) is worth at them. */
static inline vvec3 points_of(const quad_setting *l, const quad_sector *q, const part *t, vfloat *volume)
{
    /* Where the middles of the quarters lie: one at each corner, one in the middle. */
    static const vfloat along_s = { 1.0F / 6.0F, 2.0F / 3.0F, 1.0F / 6.0F, 1.0F / 3.0F },
                        along_r = { 1.0F / 6.0F, 1.0F / 6.0F, 2.0F / 3.0F, 1.0F / 3.0F };
    const vfloat s = t->s + t->side * along_s, r = t->r + t->side * along_r, out = s + r, in = 1.0F - out;
    const float worth = t->side * t->side;
    if (!q->is_arc) {
        *volume = splat(worth * q->volume);
        return blend(in, l->middle, s, splat3(q->a), r, splat3(q->b));
    }
    vfloat sine, cosine;
    sincos_pi(q->half_turns * (r / out), &sine, &cosine);
    const vfloat x = q->from[0] * cosine - q->from[1] * sine, y = q->from[1] * cosine + q->from[0] * sine;
    const vvec3 rim = blend(splat(1.0F), l->center, x, l->x, y, l->y);
    const vfloat length2 = 1.0F / dot(rim, rim), length = out * sqrt_f(length2);
    const vfloat turn = l->turn[0] + (l->turn[1] * x + l->turn[2] * y);
    *volume = (worth * MATH_PI * q->half_turns) * length2 * max_f(turn, splat(0.0F)); /* below it by rounding */
    return (vvec3){ in * l->middle.x + length * rim.x, in * l->middle.y + length * rim.y,
                    in * l->middle.z + length * rim.z };
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

static inline void evaluate(const quad_setting *l, const quad_sector *q, const part *t, quad_terms *out)
{
    vfloat volume;
    vvec3 p = points_of(l, q, t, &volume);
    p.z = max_f(p.z, splat(1e-12F)); /* on the horizon, by rounding below it */
    const vfloat p2 = dot(p, p);
    const vvec3 b = { dot(l->back[0], p), dot(l->back[1], p), p.z };
    const vfloat inverse2 = 1.0F / max_f(dot(b, b), splat(1e-12F)), inverse = sqrt_f(inverse2);
    const vvec3 wi = { b.x * inverse, b.y * inverse, b.z * inverse };
    const vvec3 h = { wi.x + l->wo.x, wi.y + l->wo.y, wi.z + l->wo.z };
    const vfloat h2 = max_f(dot(h, h), splat(1e-12F)), cosine = min_f(0.5F * sqrt_f(h2), splat(1.0F));
    const vfloat d = density(l, h, h2), unit = 0.5F / cosine;

    /* Solid angles of directions and of half vectors, over the determinant. */
    const vfloat size = volume * inverse2 * inverse, half_size = 0.5F * size * unit;
    out->weight = volume * p.z / (p2 * p2);
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

static float sum_of(vfloat x)
{
    return (x[0] + x[1]) + (x[2] + x[3]);
}

static float span_of(vfloat x)
{
    const vfloat y = { x[1], x[0], x[3], x[2] }, high = max_f(x, y), low = min_f(x, y);
    return (high[0] > high[2] ? high[0] : high[2]) - (low[0] < low[2] ? low[0] : low[2]);
}

static void add(quad_terms *sum, const quad_terms *more, float share)
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

/* Quarter i: that at corner i, or the one in the middle. */
static part quarter(const part *t, int i)
{
    const float half = 0.5F * t->side;
    return (part){ t->s + (i == 1 || i == 3 ? half : 0.0F), t->r + (i == 2 || i == 3 ? half : 0.0F),
                   i < 3 ? half : -half };
}

/* A part and what its four points add. share: of it in the sum. */
typedef struct looked_at {
    part part;
    quad_terms terms;
    float share;
    int depth;
} looked_at;

/* Divides a sector until its parts are even. A part that is little more uneven than it may be counts with its quarters
 * half and half: where a light slides along a surface, nothing jumps. *left: quads that may still be evaluated. */
static void refine(const quad_setting *l, const quad_sector *sector, const quad_terms *whole, float uneven, int *left,
                   quad_terms *sum)
{
    looked_at stack[3 * MOST_DEPTH + 4];
    int count = 1;
    stack[0] = (looked_at){ { 0.0F, 0.0F, 1.0F }, *whole, 1.0F, 0 };
    while (count > 0) {
        const looked_at one = stack[--count];
        const float span = one.share * span_of(one.terms.reflected);
        if (one.depth >= MOST_DEPTH || *left < 4 || !(span > uneven)) {
            add(sum, &one.terms, one.share);
            continue;
        }
        const float share = span < 2.0F * uneven ? (span - uneven) / uneven : 1.0F;
        if (share < 1.0F)
            add(sum, &one.terms, one.share * (1.0F - share));
        *left -= 4;
        for (int i = 0; i < 4; i++) {
            looked_at *const more = &stack[count++];
            more->part = quarter(&one.part, i);
            more->share = one.share * share;
            more->depth = one.depth + 1;
            evaluate(l, sector, &more->part, &more->terms);
        }
    }
}

#if defined(__AVX2__) && defined(GLINT_AREA_QUAD_AVX2)
#define AREA_QUAD_SUM area_quad_sum_avx2
#else
#define AREA_QUAD_SUM area_quad_sum_base
#endif

void AREA_QUAD_SUM(const quad_lobe *lobe, const quad_light *light, int most_quads, quad_sums *sums)
{
    static const part whole = { 0.0F, 0.0F, 1.0F };
    const quad_setting setting = setting_of(lobe, light);
    quad_terms first[QUAD_MOST_SECTORS], sum = { 0 };
    vfloat reflected = splat(0.0F);
    for (int i = 0; i < light->count; i++) {
        evaluate(&setting, &light->sector[i], &whole, &first[i]);
        reflected += first[i].reflected;
    }
    const float uneven = (lobe->is_ggx ? UNEVEN_GGX : UNEVEN_BECKMANN) * sum_of(reflected);
    int left = most_quads;
    for (int i = 0; i < light->count; i++) {
        if (span_of(first[i].reflected) > uneven)
            refine(&setting, &light->sector[i], &first[i], uneven, &left, &sum);
        else
            add(&sum, &first[i], 1.0F);
    }
    *sums = (quad_sums){ sum_of(sum.weight), sum_of(sum.reflected), { sum_of(sum.fresnel[0]), sum_of(sum.fresnel[1]) },
                         sum_of(sum.facets), sum_of(sum.x),         sum_of(sum.y),
                         sum_of(sum.z),      sum_of(sum.cap) };
}
