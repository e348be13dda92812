/* A plain light, in lanes: so small, in the eyes of the lobe, that few points of its surface know the integral over it.
 *
 * Nothing is fitted, moved or cut then: points of a square or a disk (light/cubature.h) become directions and solid
 * angles, and the lobe is summed over them. How many it takes depends on how near the lobe's singularities are (in the
 * complex plane, as Gauss's rules have it), as a share of the light's size. The density 1 / (1 + s^2)^2 of GGX in
 * slopes over the roughness has them at s = +-i; a Gaussian has none, but falls by exp(-2 s ds) over ds.
 */
#ifndef MODEL_AREA_PLAIN_H
#define MODEL_AREA_PLAIN_H

#include "light/cubature.h"
#include "model/area_lit.h"
#include "model/area_lobe.h"

/* What there is to know about one point and its light. */
typedef struct plain_query {
    lobe_query lobe; /* wi is not set */
    vfloat total_area, hidden;
    vint kind, two_sided;
    vfloat3 center, half_x, half_y;
    vfloat size; /* radius of a sphere, solid angle of a sun */
} plain_query;

/* Rules are numbered by shape and level; these are none. */
enum {
    PLAIN_POLYGON = CUBATURE_SHAPES * CUBATURE_LEVELS, /* those of the square, bent (area_polygon.h) */
    PLAIN_RULES = PLAIN_POLYGON + CUBATURE_LEVELS,
    PLAIN_DARK = -1,
    PLAIN_LEFT = -2
};

static inline const cubature *plain_rule(int rule)
{
    const int shape = rule < PLAIN_POLYGON ? rule / CUBATURE_LEVELS : CUBATURE_SQUARE;
    return &cubatures[shape][rule % CUBATURE_LEVELS];
}

/* Directions middle + x u + y v, for x and y of the rule: dark where the point sees nothing of the light, left where it
 * takes more than points. */
typedef struct plain_light {
    vfloat3 middle, u, v;
    vfloat size; /* its area seen along `middle`, in the units of u and v */
    vint rule;
    vfloat left; /* the share of the result that is left to the other method: neighbours that differ a little do not
                    jump */
} plain_light;

/* The size over the distance of singularities up to which each level is good for; the finest gives way to the other
 * method from PLAIN_FADES on. Of a pole the rules leave 2e-5, 5e-4, 8e-4 and 1.5e-3 there; of lights that come so near,
 * 95 of 100 are within 1e-3 (tests/study/plain_lights.c). */
#define PLAIN_SLIGHT 0.1F /* of a cell's other axis: two of Gauss's nodes */
#define PLAIN_COARSE 0.35F
#define PLAIN_MIDDLE 0.9F
#define PLAIN_FINE 1.6F
#define PLAIN_FADES 2.3F
#define PLAIN_FINEST 2.4F

/* How far each level goes. */
typedef struct plain_limits {
    float coarse, middle, fine, fades, finest;
} plain_limits;

static inline plain_limits plain_limits_fast(void)
{
    return (plain_limits){ PLAIN_COARSE, PLAIN_MIDDLE, PLAIN_FINE, PLAIN_FADES, PLAIN_FINEST };
}

/* Where the exact integral is asked for: as far as the rules leave about 1e-6 of a pole, since what one of degree d
 * leaves falls by the d + 1st power of the bend. The quadrature leaves more. */
static inline plain_limits plain_limits_of(const glint_material_options *o)
{
    return o->area_light_method == GLINT_AREA_LIGHT_EXACT ? (plain_limits){ 0.21F, 0.38F, 0.8F, 1.15F, 1.3F }
                                                          : plain_limits_fast();
}

/* ---- where the light is ---- */

/* |v| < 1e15 in every part, without comparing what may be no number. */
static inline vmask plain_is_usable(vfloat3 v)
{
    const vint most = (vint)bits_of(splat(1e15F));
    return less_i((vint)(bits_of(v.x) & 0x7fffffffU), most) & less_i((vint)(bits_of(v.y) & 0x7fffffffU), most) &
           less_i((vint)(bits_of(v.z) & 0x7fffffffU), most);
}

/* Adds the half axes of round lights around the unit vector w: as long as the tangent of their angular radius. Others
 * add nothing. */
static inline void plain_add_round(const plain_query *q, vmask is_sphere, vmask is_round, vfloat distance_inverse,
                                   vfloat3 w, vfloat3 *u, vfloat3 *v)
{
    const vfloat zero = splat(0.0F), one = splat(1.0F);
    const vfloat size = max_f(choose(is_round, q->size, zero), zero);
    const vfloat of_sphere = min_f(choose(is_sphere, size, zero) * distance_inverse, one);
    /* A cap of solid angle 2 pi (1 - cos). */
    const vfloat versine = min_f(size * (0.5F / MATH_PI), one);
    const vfloat sine = choose(is_sphere, of_sphere, sqrt_f(versine * (2.0F - versine)));
    const vfloat cosine = choose(is_sphere, sqrt_f((1.0F - of_sphere) * (1.0F + of_sphere)), 1.0F - versine);
    const vfloat tangent = sine / max_f(cosine, splat(0.5F));
    const vmask level = less(abs_f(w.x), splat(0.7F));
    const vfloat3 across =
        normalize_3(choose_3(level, (vfloat3){ zero, zero - w.z, w.y }, (vfloat3){ w.z, zero, zero - w.x }));
    *u = add_3(*u, scale_3(across, tangent));
    *v = add_3(*v, scale_3(cross_3(w, across), tangent));
}

/* ---- how much the lobe bends over it ---- */

/* The widest that a light is seen, by the squares of its half axes: up to 55 degrees to either side. */
#define PLAIN_WIDEST 4.0F

/* Of slopes: how far the half vectors of the light reach, g, and how far its middle is from the peak, s. From the half
 * vector to slopes its angle is stretched by 1 / cos^2, and from the light's directions by 1 / (2 h.wi) across the
 * plane of both. */
static inline vfloat plain_bend_of_density(const area_lobe *l, vfloat3 middle, vfloat size, vfloat reach)
{
    const vfloat3 h = add_3(middle, l->wo);
    const vfloat length = sqrt_f(max_f(dot_3(h, h), splat(1e-6F))), z = max_f(h.z, splat(1e-3F)), cosine = z / length;
    const vfloat x = h.x * l->inverse_alpha_x / z, y = h.y * l->inverse_alpha_y / z, s = sqrt_f(x * x + y * y);
    const vfloat sharpest = max_f(l->inverse_alpha_x, l->inverse_alpha_y);
    const vfloat stretch = 0.5F * sharpest / (cosine * min_f(cosine, 0.5F * length));
    const vfloat g = size * stretch;
    if (!l->is_ggx)
        return 0.8F * sqrt_f(g * (g + 0.5F * s));
    const vfloat nearest = max_f(s - reach * stretch, splat(0.0F));
    return g / sqrt_f(1.0F + nearest * nearest);
}

/* Where a light lies from its middle, whose distance is one. */
typedef struct plain_extent {
    vfloat reach, height; /* how far it goes in all, and up or down */
    vfloat off_plane;     /* how far the point is from the plane of the light */
} plain_extent;

/* The inverse distances of what bends all lobes alike: masking, near the horizon; solid angles, near the light, where
 * slopes are not linear over it either, which is why they count more: a fit; and half vectors, whose density is
 * infinite opposite to the viewer, below the horizon. */
typedef struct plain_nearness {
    vfloat of_horizon, of_poles;
} plain_nearness;

static inline plain_nearness plain_nearness_of(const area_lobe *l, vfloat3 middle, const plain_extent *e)
{
    const vfloat lowest = middle.z - e->height, alpha = min_f(l->alpha_x, l->alpha_y);
    const vfloat3 h = add_3(middle, l->wo);
    const vfloat to_light = (1.0F / 1.6F) * max_f(1.0F - e->reach, e->off_plane),
                 to_opposite = max_f(sqrt_f(dot_3(h, h)) - e->reach, lowest + l->wo.z);
    return (plain_nearness){ 1.0F / sqrt_f(lowest * lowest + alpha * alpha),
                             1.0F / max_f(min_f(to_light, to_opposite), splat(1e-3F)) };
}

/* Size over distance of the nearest singularity along an axis that goes so far from the middle, in all and up or down.
 */
static inline vfloat plain_bend_along(const area_lobe *l, vfloat3 middle, vfloat size, vfloat height, vfloat reach,
                                      const plain_nearness *near)
{
    return max_f(plain_bend_of_density(l, middle, size, reach),
                 max_f(size * near->of_poles, height * near->of_horizon));
}

/* Of the longer axis. */
static inline vfloat plain_bend(const area_lobe *l, vfloat3 middle, vfloat size, const plain_extent *e)
{
    const plain_nearness near = plain_nearness_of(l, middle, e);
    return plain_bend_along(l, middle, size, e->height, e->reach, &near);
}

static inline vint plain_level(vfloat bend, const plain_limits *most)
{
    const vint finest = choose_i(less(bend, splat(most->fine)), splat_i(CUBATURE_FINE), splat_i(CUBATURE_FINEST));
    const vint fine = choose_i(less(bend, splat(most->middle)), splat_i(CUBATURE_MIDDLE), finest);
    return choose_i(less(bend, splat(most->coarse)), splat_i(CUBATURE_COARSE), fine);
}

/* Of a light that bends the lobe so much, up to most. */
static inline vfloat plain_share_left(vfloat bend, float fades, float most)
{
    return min_f(max_f((bend - fades) * (1.0F / (most - fades)), splat(0.0F)), splat(1.0F));
}

/* Of a square or a disk. */
static inline plain_extent plain_extent_of(const plain_light *p, vmask is_square)
{
    const vfloat3 normal = cross_3(p->u, p->v);
    const vfloat square = abs_f(p->u.z) + abs_f(p->v.z), disk = sqrt_f(p->u.z * p->u.z + p->v.z * p->v.z);
    return (plain_extent){ sqrt_f(dot_3(p->u, p->u) + dot_3(p->v, p->v)), choose(is_square, square, disk),
                           abs_f(dot_3(normal, p->middle)) / sqrt_f(max_f(dot_3(normal, normal), splat(1e-36F))) };
}

static inline plain_light plain_light_of(const area_lobe *l, const plain_query *q, const plain_limits *most)
{
    const vfloat zero = splat(0.0F), one = splat(1.0F);
    const vfloat3 none = { zero, zero, zero }, up = { zero, zero, one };
    const vmask is_sphere = equal_i(q->kind, splat_i(GLINT_AREA_SPHERE));
    const vmask is_disk = equal_i(q->kind, splat_i(GLINT_AREA_DISK));
    const vmask is_flat = is_disk | equal_i(q->kind, splat_i(GLINT_AREA_RECTANGLE));
    const vmask is_round = is_sphere | equal_i(q->kind, splat_i(GLINT_AREA_SUN));

    const vfloat3 size = { q->size, q->size, q->size };
    const vmask usable =
        plain_is_usable(q->center) &
        ((is_round & plain_is_usable(size)) | (is_flat & plain_is_usable(q->half_x) & plain_is_usable(q->half_y)));
    const vfloat3 center = choose_3(usable, q->center, up);
    const vfloat distance2 = dot_3(center, center);
    const vfloat3 half_x = choose_3(usable & is_flat, q->half_x, none);
    const vfloat3 half_y = choose_3(usable & is_flat, q->half_y, none);
    /* Farther than it is wide, and so that no square is too large or too small a number. */
    vmask plain = usable & less(splat(1e-30F), distance2) &
                  less(dot_3(half_x, half_x) + dot_3(half_y, half_y), PLAIN_WIDEST * distance2);
    const vfloat inverse = choose(plain, 1.0F / choose(plain, sqrt_f(distance2), one), zero);
    plain_light p = { .middle = scale_3(center, inverse),
                      .u = scale_3(half_x, inverse),
                      .v = scale_3(half_y, inverse) };
    if (any(is_round))
        plain_add_round(q, is_sphere, is_round & plain, inverse, p.middle, &p.u, &p.v);

    const vmask is_square = is_flat & ~is_disk;
    const vfloat u2 = dot_3(p.u, p.u), v2 = dot_3(p.v, p.v), facing = dot_3(cross_3(p.u, p.v), p.middle);
    /* Seen at an angle, neither so wide that plain_add_round does not know it nor so small that its area has no digits.
     */
    plain = plain & less(u2 + v2, splat(PLAIN_WIDEST)) & less(splat(1e-16F), u2) & less(splat(1e-16F), v2) &
            less(4e-4F * (u2 * v2), facing * facing);
    const plain_extent extent = plain_extent_of(&p, is_square);
    const vfloat height = extent.height, bend = plain_bend(l, p.middle, sqrt_f(max_f(u2, v2)), &extent);
    const vmask is_away = is_flat & equal_i(q->two_sided, splat_i(0)) & less(zero, facing);
    const vmask is_dark = plain & (is_away | less(p.middle.z + height, splat(-1e-4F)));
    plain = plain & less(height, p.middle.z) & less(bend, splat(most->finest)) & ~is_dark;

    const vint shape =
        choose_i(is_square, splat_i(CUBATURE_SQUARE * CUBATURE_LEVELS), splat_i(CUBATURE_DISK * CUBATURE_LEVELS));
    const vint rule = choose_i(is_dark, splat_i(PLAIN_DARK), splat_i(PLAIN_LEFT));
    p.rule = choose_i(plain, shape + plain_level(bend, most), rule);
    p.left = choose(plain, plain_share_left(bend, most->fades, most->finest), choose(is_dark, zero, one));
    p.size = abs_f(facing) * choose(is_square, splat(4.0F), splat(MATH_PI));
    return p;
}

/* Gives lanes that follow no rule, or that of a polygon, something to compute that is a number. */
static inline plain_light plain_light_for_sums(const plain_light *p)
{
    const vfloat zero = splat(0.0F);
    const vfloat3 none = { zero, zero, zero }, up = { zero, zero, splat(1.0F) };
    const vmask plain = less_i(splat_i(-1), p->rule) & less_i(p->rule, splat_i(PLAIN_POLYGON));
    return (plain_light){ choose_3(plain, p->middle, up),
                          choose_3(plain, p->u, none),
                          choose_3(plain, p->v, none),
                          choose(plain, p->size, zero),
                          p->rule,
                          p->left };
}

/* ---- sums ---- */

typedef struct plain_sums {
    area_terms of;
    vfloat cosine[3]; /* solid angles times cos theta_i and its powers */
} plain_sums;

/* Of the direction `at`, of any length, towards a part of the light whose area is seen so large along it. has_base:
 * asks for the cosines. */
static inline void plain_direction_terms(const area_lobe *l, vfloat3 at, vfloat area, int has_base, plain_sums *out)
{
    const vfloat inverse2 = 1.0F / dot_3(at, at), inverse = sqrt_f(inverse2);
    vfloat3 wi = scale_3(at, inverse);
    wi.z = max_f(wi.z, splat(1e-12F));
    const vfloat solid_angle = area * (inverse2 * inverse);
    area_terms_at(l, wi, solid_angle, &out->of);
    if (!has_base)
        return;
    out->cosine[0] = solid_angle * wi.z;
    out->cosine[1] = out->cosine[0] * wi.z;
    out->cosine[2] = out->cosine[1] * wi.z;
}

/* Of the point (x, y) of the light. */
static inline void plain_terms_at(const area_lobe *l, const plain_light *p, vfloat x, vfloat y, vfloat weight,
                                  int has_base, plain_sums *out)
{
    const vfloat3 at = add_3(p->middle, add_3(scale_3(p->u, x), scale_3(p->v, y)));
    plain_direction_terms(l, at, p->size * weight, has_base, out);
}

static inline void plain_add(plain_sums *sum, const plain_sums *more, int has_base)
{
    area_add_terms(&sum->of, &more->of);
    for (int i = 0; has_base && i < 3; i++)
        sum->cosine[i] = sum->cosine[i] + more->cosine[i];
}

static inline plain_sums plain_no_sums(void)
{
    const vfloat zero = splat(0.0F);
    return (plain_sums){ { zero, { zero, zero }, zero, zero, zero, zero, zero }, { zero, zero, zero } };
}

/* ---- what they come to ---- */

typedef struct plain_value {
    vfloat specular[3], diffuse[3];
} plain_value;

/* The mean of a function of a cosine, by the two values that have the mean and the spread of all. */
typedef struct plain_pair {
    vfloat low, high;
} plain_pair;

static inline plain_pair plain_pair_of(vfloat inverse_weight, vfloat first, vfloat second)
{
    const vfloat zero = splat(0.0F), one = splat(1.0F);
    const vfloat mean = first * inverse_weight, spread = sqrt_f(max_f(second * inverse_weight - mean * mean, zero));
    return (plain_pair){ max_f(mean - spread, zero), min_f(mean + spread, one) };
}

static inline vfloat plain_base(const glint_material_options *o, const lobe_query *q, int channel, plain_pair cosine)
{
    return 0.5F *
           (lobe_base_albedo_of(o, channel, q->diffuse[channel], q->f0[channel], q->f90[channel], q->wo.z, cosine.low) +
            lobe_base_albedo_of(o, channel, q->diffuse[channel], q->f0[channel], q->f90[channel], q->wo.z,
                                cosine.high));
}

/* The mean reflectance of the facets that light the viewer: Schlick's is exact. */
static inline vfloat plain_reflectance(const glint_material_options *o, const lobe_query *q, int channel,
                                       vfloat inverse, const vfloat fresnel[2])
{
    const vfloat f0 = q->f0[channel], f90 = q->f90[channel];
    if (o->fresnel == GLINT_FRESNEL_SCHLICK)
        return f0 + (f90 - f0) * (fresnel[0] * inverse);
    const plain_pair cosine = plain_pair_of(inverse, fresnel[0], fresnel[1]);
    return 0.5F * (lobe_reflectance_of(o, channel, f0, f90, cosine.low) +
                   lobe_reflectance_of(o, channel, f0, f90, cosine.high));
}

static inline void plain_shade(const glint_material_options *o, const plain_query *q, const plain_sums *s, int has_base,
                               plain_value *value)
{
    const vfloat zero = splat(0.0F), one = splat(1.0F), seen = 1.0F - q->hidden;
    const vmask reflects = less(splat(1e-35F), s->of.reflected);
    const vfloat reflected = choose(reflects, s->of.reflected, one), inverse = 1.0F / reflected;
    const vfloat weight = choose(reflects, seen * o->coverage * reflected, zero);
    for (int c = 0; c < 3; c++) {
        value->specular[c] = weight * plain_reflectance(o, &q->lobe, c, inverse, s->of.fresnel);
        value->diffuse[c] = zero;
    }
    if (has_base) {
        const vmask lit = less(splat(1e-35F), s->cosine[0]);
        const vfloat weight_of_base = choose(lit, seen * s->cosine[0] * (1.0F / MATH_PI), zero);
        const plain_pair cosine = plain_pair_of(1.0F / choose(lit, s->cosine[0], one), s->cosine[1], s->cosine[2]);
        for (int c = 0; c < 3; c++)
            value->diffuse[c] = weight_of_base * plain_base(o, &q->lobe, c, cosine);
    }
}

/* Which facets are lit. */
static inline area_lit plain_lit(const glint_material_options *o, const plain_query *q, const plain_sums *s)
{
    const area_halves halves = { s->of.facets, s->of.x, s->of.y, s->of.z, s->of.cap };
    area_lit lit = area_lit_of(o, &q->lobe, q->total_area, &halves);
    lit.p = lit.p * (1.0F - q->hidden);
    return lit;
}

#endif
