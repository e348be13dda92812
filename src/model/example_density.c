/* The distribution of slopes under a footprint: whole tiles from their maps, parts of them from smaller tiles and at
 * last from the seeds themselves (Xing et al. 2024, section 6.3).
 *
 * The footprint is a Gaussian. A tile is taken whole where the Gaussian hardly varies across it, and left out where
 * none of its slopes comes near the one that is asked for. Where examples overlap, the quarters of a tile are the
 * sub-regions that have an owner, so that the border is found to a quarter of a tile where tiles are taken whole and to
 * a texel where they are not.
 */
#include "model/example_density.h"

#define GLINT_LANES 1
#include "math/elementary.h"
#include "model/example_tile.h"

/* Most of the Gaussian's mass that a tile may hold that is taken whole where another example covers a part of it (fit:
 * see tests/unit/test_example_truth.c). */
#define MOST_SHARED_MASS 0.03F

/* Footprints narrower than this many texels see the ripple of the seeds, whose sum is not quite flat: their mass is
 * summed up, and taken as one for others. So do those over several scattered examples, which leave gaps of parts of a
 * texel where they meet, up to this many. */
#define RIPPLE_SIGMA 0.5F
#define SEAM_SIGMA 2.0F

/* So many quads are looked at one by one rather than by their tiles (cost). */
#define FEW_QUADS 100

/* A tile of the example. */
typedef struct node {
    uint16_t x, y;
    uint16_t level;
    uint16_t is_dark; /* none of its seeds can have the slope */
    rivals rivals;
} node;

/* Four children for each level that is entered, and the tiles that the descent starts with. */
enum { STACK = 3 * EXAMPLE_MOST_LEVELS + 9 };

static void to_frame(const example_view *v, float x, float y, float frame[2])
{
    const matrix2 m = v->self->as.to_frame;
    frame[0] = v->self->x + m.xx * (x - 0.5F) + m.xy * (y - 0.5F);
    frame[1] = v->self->y + m.yx * (x - 0.5F) + m.yy * (y - 0.5F);
}

/* Which quarters of a tile with this centre the example owns, a bit each. */
static uint32_t owned_quarters(const example_view *v, const node *n, float x, float y, float side)
{
    if (!n->rivals)
        return 15U;
    const matrix2 m = v->self->as.to_frame;
    float at[2];
    to_frame(v, x, y, at);
    const float right[2] = { 0.25F * side * m.xx, 0.25F * side * m.yx };
    const float up[2] = { 0.25F * side * m.xy, 0.25F * side * m.yy };
    return quarters_owned(v->others, v->owner, n->rivals, at, right, up);
}

static float share_of(uint32_t quarters)
{
    return 0.25F * (float)((quarters & 1U) + (quarters >> 1 & 1U) + (quarters >> 2 & 1U) + (quarters >> 3));
}

/* Leaves out the rivals of a disc that holds the tile. False: one of them owns all of it. */
static int narrow_rivals(const example_view *v, node *n, float x, float y, float side)
{
    if (!n->rivals)
        return 1;
    float at[2];
    to_frame(v, x, y, at);
    return rivals_within(v->others, v->owner, &n->rivals, at[0], at[1], side * v->self->as.radius);
}

/* Takes a tile, skips it, or says that its quarters are to be looked at. */
static int is_divided(const example_view *v, node *n, gathered *sum)
{
    const int dark = n->is_dark;
    const float side = (float)(2 << n->level) * v->texel, half = 0.5F * side;
    const float x = ((float)n->x + 0.5F) * side, y = ((float)n->y + 0.5F) * side;
    const float dx = v->mean[0] - x, dy = v->mean[1] - y;
    const covariance2 *p = &v->precision;
    const float gx = p->xx * dx + p->xy * dy, gy = p->xy * dx + p->yy * dy;
    const float exponent = 0.5F * (dx * gx + dy * gy);
    /* The exponent is convex: it lies above its tangent. */
    const float change = half * (fabsf(gx) + fabsf(gy));
    if (exponent - change > LAST_EXPONENT || !narrow_rivals(v, n, x, y, side))
        return 0;
    if (n->level == 0) {
        example_take_quad(v, n->x, n->y, owned_quarters(v, n, x, y, side), dark, sum);
        return 0;
    }
    const float nearest = exponent > change ? exponent - change : 0.0F;
    const float rarity = 1.0F + nearest + 0.5F * nearest * nearest; /* below exp(nearest) */
    /* Of a tile's facets only those that are lit show their tints: which ones, the map does not say. */
    const int divided = example_tints_texels(v) || change + tile_curve(v, n->level) > MOST_VARIATION * rarity ||
                        (n->rivals && v->norm * side * side > MOST_SHARED_MASS * rarity);
    const float density =
        !dark && (!divided || n->level >= LEAST_TRIED_LEVEL) ? tile_density(v, n->level, n->x, n->y) : 0.0F;
    if (divided)
        return density > 0.0F || v->wants_mass || n->level < LEAST_TRIED_LEVEL;
    if (!(density > 0.0F) && !v->wants_mass)
        return 0;
    const float mass = v->norm * exp_negative(-exponent) * side * side * share_of(owned_quarters(v, n, x, y, side));
    sum->mass += mass;
    sum->value += mass * v->slope_scale * density;
    if (v->palette)
        example_add_tint(v, 0, mass * v->slope_scale * density, sum);
    return 0;
}

/* The tiles of a level that an interval of the example touches; false: none. */
static int tiles_within(const example_view *v, int level, int axis, int *first, int *last)
{
    const int along = (int)example_tiles_along(v->e, (uint32_t)level);
    const float low = (v->mean[axis] - v->half[axis]) * (float)along;
    const float high = (v->mean[axis] + v->half[axis]) * (float)along;
    if (!(high >= 0.0F && low < (float)along))
        return 0;
    *first = low > 0.0F ? (int)low : 0;
    *last = high < (float)(along - 1) ? (int)high : along - 1;
    return 1;
}

/* Quarters of a tile that are worth a look for their slopes. */
static uint32_t lit_quarters(const example_view *v, int level, uint32_t x, uint32_t y)
{
    return v->wants_value ? example_lit_quarters(v, level, x, y) : 0U;
}

static int is_top(const example_view *v, int level)
{
    return level + 1 == (int)v->e->levels;
}

/* Begins with the smallest tiles of which two a side hold all that the footprint reaches. */
static int first_nodes(const example_view *v, rivals all, node *stack)
{
    const float reach = 2.0F * (v->half[0] > v->half[1] ? v->half[0] : v->half[1]);
    int level = 0;
    while (!is_top(v, level) && (float)(2 << level) * v->texel < reach)
        level++;
    int x0, x1, y0, y1, height = 0;
    if (!tiles_within(v, level, 0, &x0, &x1) || !tiles_within(v, level, 1, &y0, &y1))
        return 0;
    for (int y = y0; y <= y1; y++)
        for (int x = x0; x <= x1; x++) {
            const uint32_t quarter = ((uint32_t)x & 1U) + 2U * ((uint32_t)y & 1U);
            const uint32_t lit = is_top(v, level)
                                     ? 15U * (uint32_t)v->wants_value
                                     : lit_quarters(v, level + 1, (uint32_t)x / 2U, (uint32_t)y / 2U) >> quarter & 1U;
            stack[height++] = (node){ (uint16_t)x, (uint16_t)y, (uint16_t)level, lit == 0, all };
        }
    return height;
}

/* Those quads of a tile of four whose bits are set. */
static void take_quads(const example_view *v, uint32_t x, uint32_t y, uint32_t asked, gathered *sum)
{
    const uint32_t lit = example_lit_quarters(v, 1, x, y);
    for (uint32_t k = 0; k < 4; k++)
        if (asked >> k & (v->wants_mass ? 1U : lit >> k & 1U))
            example_take_quad(v, 2U * x + (k & 1U), 2U * y + (k >> 1), 15U, !(lit >> k & 1U), sum);
}

/* All quads within reach, one by one, where no larger tile at the centre could be taken whole and they are few. */
static int take_few(const example_view *v, gathered *sum)
{
    int x0, x1, y0, y1;
    if (!tiles_within(v, 0, 0, &x0, &x1) || !tiles_within(v, 0, 1, &y0, &y1))
        return 1;
    if (!(tile_curve(v, EXAMPLE_LEAST_MAP_LEVEL) > MOST_VARIATION) || (x1 - x0 + 1) * (y1 - y0 + 1) > FEW_QUADS)
        return 0;
    for (int y = y0 / 2; y <= y1 / 2; y++)
        for (int x = x0 / 2; x <= x1 / 2; x++) {
            const uint32_t columns = (2 * x >= x0 ? 5U : 0U) | (2 * x < x1 ? 10U : 0U);
            const uint32_t rows = (2 * y >= y0 ? 3U : 0U) | (2 * y < y1 ? 12U : 0U);
            take_quads(v, (uint32_t)x, (uint32_t)y, columns & rows, sum);
        }
    return 1;
}

void example_descend(const example_view *v, rivals all, gathered *sum)
{
    if (!all && v->wants_value && take_few(v, sum))
        return;
    node stack[STACK];
    int height = first_nodes(v, all, stack);
    while (height > 0) {
        node n = stack[--height];
        if (!is_divided(v, &n, sum))
            continue;
        if (n.level == 1 && !n.rivals && v->wants_value) {
            take_quads(v, n.x, n.y, 15U, sum);
            continue;
        }
        const uint32_t lit = lit_quarters(v, n.level, n.x, n.y);
        for (uint32_t k = 0; k < 4; k++)
            if (v->wants_mass || lit >> k & 1U)
                stack[height++] = (node){ (uint16_t)(2U * n.x + (k & 1U)), (uint16_t)(2U * n.y + (k >> 1)),
                                          (uint16_t)(n.level - 1U), !(lit >> k & 1U), n.rivals };
    }
}

/* ---- what lies under the footprint ---- */

example_view example_view_of(const question *q, const instance *self)
{
    const example *e = q->e;
    example_view v = { .e = e, .self = self, .owner = self, .wants_value = 1, .texel = 1.0F / (float)e->size };
    const matrix2 l = self->as.to_frame, b = self->as.to_local;
    const float h = e->lattice.seed_variance;
    instance_local(self, q->f->at[0], q->f->at[1], &v.mean[0], &v.mean[1]);
    v.mean[0] += 0.5F;
    v.mean[1] += 0.5F;
    covariance2 c = covariance2_mapped(b, q->f->spread);
    c.xx += h;
    c.yy += h;
    v.half[0] = SLOPE_REACH * sqrtf(c.xx);
    v.half[1] = SLOPE_REACH * sqrtf(c.yy);
    /* The seed's part alone keeps this from zero, even where the footprint is a line. */
    const float least = h * h, det = c.xx * c.yy - c.xy * c.xy;
    const float inverse = 1.0F / (det > least ? det : least);
    v.precision = (covariance2){ c.yy * inverse, -c.xy * inverse, c.xx * inverse };
    v.norm = sqrtf(inverse) / (2.0F * MATH_PI);
    v.quad_curve = 0.5F * v.texel * v.texel * (v.precision.xx + 2.0F * fabsf(v.precision.xy) + v.precision.yy);
    /* S_h - S_h (S_P + S_h)^-1 S_h */
    v.posterior =
        (covariance2){ h * (1.0F - h * v.precision.xx), -h * h * v.precision.xy, h * (1.0F - h * v.precision.yy) };
    v.slope[0] = l.xx * q->slope[0] + l.yx * q->slope[1];
    v.slope[1] = l.xy * q->slope[0] + l.yy * q->slope[1];
    v.slope_scale = fabsf(matrix2_determinant(l));
    /* The light's round spot becomes an ellipse; a round one of the same mean size stands for it. */
    const float stretch = 0.5F * (l.xx * l.xx + l.xy * l.xy + l.yx * l.yx + l.yy * l.yy);
    v.slope_variance = e->slope_variance + stretch * q->light_variance;
    v.blend = slope_maps_blend(&e->tiles, v.slope_variance);
    v.palette = q->palette;
    if (q->palette)
        v.tint_seed = example_tint_seed(q->f, self, q->seed);
    return v;
}

static extent extent_of(const example *e, const example_footprint *f)
{
    const float seed = e->lattice.most_stretch * e->lattice.most_stretch * e->lattice.seed_variance;
    const float half = 0.5F * (f->spread.xx - f->spread.yy);
    const float major2 = 0.5F * (f->spread.xx + f->spread.yy) + sqrtf(half * half + f->spread.xy * f->spread.xy);
    return (extent){ { f->at[0], f->at[1] },
                     { SLOPE_REACH * sqrtf(f->spread.xx + seed), SLOPE_REACH * sqrtf(f->spread.yy + seed) },
                     SLOPE_REACH * sqrtf(major2 + seed) };
}

/* What scattered examples leave free of the ground: its mass, square by square. */
static float ground_mass(const question *q, const neighbours *others, rivals all)
{
    const extent *r = &q->reach;
    const int left = (int)floor_f(r->at[0] - r->half[0]), right = (int)floor_f(r->at[0] + r->half[0]);
    const int low = (int)floor_f(r->at[1] - r->half[1]), high = (int)floor_f(r->at[1] + r->half[1]);
    gathered sum = { 0 };
    for (int j = low; j <= high; j++)
        for (int i = left; i <= right; i++) {
            const matrix2 unit = { 1.0F, 0.0F, 0.0F, 1.0F };
            const instance n = { (float)i + 0.5F, (float)j + 0.5F, { unit, unit, 0.70710678F, { 1.0F, 1.0F } } };
            example_view v = example_view_of(q, &n);
            v.owner = NULL;
            v.palette = NULL;
            v.others = others;
            v.wants_value = 0;
            v.wants_mass = 1;
            example_descend(&v, all, &sum);
        }
    return sum.mass;
}

/* The ground is flat, and as rough as a texel. */
static float ground_density(const question *q)
{
    const float variance = q->e->slope_variance + q->light_variance;
    const float e = 0.5F * (q->slope[0] * q->slope[0] + q->slope[1] * q->slope[1]) / variance;
    return e < 80.0F ? exp_negative(-e) / (2.0F * MATH_PI * variance) : 0.0F;
}

/* True: several examples, or one and the ground, share the footprint. */
static int gather_scattered(const question *q, int is_narrow, int sees_ripple, gathered *sum)
{
    const extent *r = &q->reach;
    neighbours list;
    neighbours_find(&q->e->lattice, q->f, r, q->seed, &list);
    rivals seen[MOST_NEAR + 1];
    int shown[MOST_NEAR + 1], count = 0;
    /* -1 is the ground. */
    for (int k = -1; k < list.count; k++) {
        seen[count] = rivals_of(&list, k);
        shown[count] = k;
        const instance *self = k < 0 ? NULL : &list.at[k];
        count += rivals_within(&list, self, &seen[count], r->at[0], r->at[1], r->radius) &&
                 (!self || rivals_within(&list, self, &seen[count], self->x, self->y, self->as.radius));
    }
    const int wants_mass = count > 1 ? is_narrow : sees_ripple;
    const float flat = ground_density(q);
    for (int k = 0; k < count; k++) {
        if (shown[k] < 0) {
            if (!wants_mass && !(flat > 0.0F))
                continue;
            const float mass = ground_mass(q, &list, seen[k]);
            sum->mass += mass;
            sum->value += mass * flat;
            continue;
        }
        example_view v = example_view_of(q, &list.at[shown[k]]);
        v.others = &list;
        v.wants_mass = wants_mass;
        example_descend(&v, seen[k], sum);
    }
    return wants_mass;
}

/* Sums over all that lies under the footprint, over their mass. */
static gathered gather(const question *q)
{
    const covariance2 *s = &q->f->spread;
    const float half = 0.5F * (s->xx - s->yy);
    const float minor2 = 0.5F * (s->xx + s->yy) - sqrtf(half * half + s->xy * s->xy);
    const float ripple = RIPPLE_SIGMA / (float)q->e->size, seam = SEAM_SIGMA / (float)q->e->size;
    gathered sum = { 0 };
    int wants_mass = minor2 < ripple * ripple;
    if (q->e->lattice.is_scattered)
        wants_mass = gather_scattered(q, minor2 < seam * seam, wants_mass, &sum);
    else
        example_gather_tiled(q, wants_mass, &sum);
    /* What lies beyond the reach looks like the rest: 1 - exp(-3.5^2 / 2). */
    const float mass = wants_mass ? sum.mass : 0.99781F;
    sum.value = mass > 0.0F ? sum.value / mass : 0.0F;
    for (int c = 0; c < 3; c++)
        sum.tint[c] = mass > 0.0F ? sum.tint[c] / mass : 0.0F;
    return sum;
}

float example_density(const example *e, const example_footprint *f, const float slope[2], float light_variance,
                      uint32_t seed)
{
    const question q = { e, f, slope, light_variance, seed, extent_of(e, f), NULL };
    return gather(&q).value;
}

void example_tint(const example *e, const example_footprint *f, const float slope[2], float light_variance,
                  uint32_t seed, const tint_palette *palette, float rgb[3])
{
    const question q = { e, f, slope, light_variance, seed, extent_of(e, f), palette };
    const gathered sum = gather(&q);
    for (int c = 0; c < 3; c++)
        rgb[c] = sum.value > 0.0F ? fmaxf(1.0F + sum.tint[c] / sum.value, 0.0F) : 1.0F;
}
