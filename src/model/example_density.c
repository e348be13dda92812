/* The distribution of slopes under a footprint: whole tiles from their maps, parts of them from smaller tiles and at
 * last from the seeds themselves. Xing et al. 2024, section 6.3; Eq. 6 below the smallest tile; overlaps as in Fig. 3.
 *
 * The footprint is a Gaussian. A tile is taken whole where the Gaussian hardly varies across it. Where examples
 * overlap, the one whose centre is nearest to a sub-region's centre owns it; the sub-regions are the quarters of a
 * tile, so that the border is found to a quarter of a tile where tiles are taken whole and to a texel where they are
 * not.
 */
#include "model/example.h"

#define GLINT_LANES 1
#include "math/elementary.h"

/* Most that the Gaussian may vary across a tile that is taken whole, in units of its peak, and most of its mass that
 * such a tile may hold where another example covers a part of it (fit: see tests/unit/test_example_truth.c). */
#define MOST_VARIATION 0.5F
#define MOST_SHARED_MASS 0.01F

/* Footprints narrower than this many texels see the ripple of the seeds, whose sum is not quite flat: their mass is
 * summed up, and taken as one for others. So do those of scattered examples, which leave gaps of parts of a texel where
 * they meet, up to this many. */
#define RIPPLE_SIGMA 0.5F
#define SEAM_SIGMA 2.0F

/* Half of the square of the reach: exponents beyond it are left out. */
#define LAST_EXPONENT (0.5F * SLOPE_REACH * SLOPE_REACH)

/* Instances that may own a part of one footprint. Spread and radius are bounded so that no more fit: 3.5 * .52 + 1.06
 * lattice units around, one centre a cell. */
enum { MOST_NEAR = 64 };

/* A tile of the example. */
typedef struct node {
    uint16_t x, y;
    int level;
    uint64_t rivals; /* which instances may own a part of it */
} node;

typedef struct near_list {
    instance at[MOST_NEAR];
    int count;
} near_list;

/* One example under the footprint, in its own coordinates. */
typedef struct local_view {
    const example *e;
    const instance *self;
    int is_ground;         /* the flat ground under scattered examples */
    float mean[2];         /* centre of the footprint */
    covariance2 precision; /* inverse of footprint and seed together */
    float norm;            /* 1 / (2 pi sqrt(det)) of it */
    covariance2 posterior; /* of the place within a seed, given the footprint */
    float slope[2];        /* what is asked for */
    float slope_variance;  /* of the surface and the light */
    float slope_scale;     /* density of slopes here to that on the lattice */
    int sum_mass;          /* count the mass of dark parts too */
    const near_list *others;
} local_view;

typedef struct gathered {
    float value, mass;
} gathered;

/* exp(-exponent - d^T C^-1 d / 2) / (2 pi sqrt(det C)) */
static float gaussian(covariance2 c, float x, float y, float exponent)
{
    const float det = c.xx * c.yy - c.xy * c.xy;
    const float e = exponent + 0.5F * (c.yy * x * x - 2.0F * c.xy * x * y + c.xx * y * y) / det;
    return e < 80.0F ? exp_negative(-e) / (2.0F * MATH_PI * sqrtf(det)) : 0.0F;
}

static float ground_density(const local_view *v)
{
    return gaussian((covariance2){ v->slope_variance, 0.0F, v->slope_variance }, v->slope[0], v->slope[1], 0.0F);
}

/* Whether no seed of a tile without a map can have the slope. */
static int is_dark(const local_view *v, const node *n)
{
    const uint32_t level = (uint32_t)n->level;
    const slope_range *r = &v->e->ranges[v->e->first_tile[level] + n->y * example_tiles_along(v->e, level) + n->x];
    const float reach = SLOPE_REACH * sqrtf(v->slope_variance);
    return v->slope[0] < r->low[0] - reach || v->slope[0] > r->high[0] + reach || v->slope[1] < r->low[1] - reach ||
           v->slope[1] > r->high[1] + reach;
}

/* Density of the mean of a tile's seeds, or of the ground. */
static float tile_density(const local_view *v, const node *n)
{
    if (v->is_ground)
        return ground_density(v);
    const uint32_t level = (uint32_t)n->level;
    const uint32_t chain = v->e->first_tile[level] + n->y * example_tiles_along(v->e, level) + n->x;
    return slope_maps_density(&v->e->tiles, chain, v->slope_variance, v->slope[0], v->slope[1]);
}

/* ---- who owns what ---- */

static int owns_point(const local_view *v, uint64_t rivals, float x, float y)
{
    const float dx = x - v->self->x, dy = y - v->self->y, own = dx * dx + dy * dy;
    for (int k = 0; rivals; k++, rivals >>= 1) {
        if (!(rivals & 1U))
            continue;
        const instance *r = &v->others->at[k];
        const float rx = x - r->x, ry = y - r->y;
        if ((v->is_ground || rx * rx + ry * ry < own) && instance_covers(r, x, y))
            return 0;
    }
    return 1;
}

/* Drops the rivals that cannot own a part of the disc around (x, y). False: one of them owns all of it. */
static int find_rivals(const local_view *v, uint64_t *rivals, float x, float y, float radius)
{
    const float dx = x - v->self->x, dy = y - v->self->y, own = dx * dx + dy * dy;
    for (int k = 0; k < v->others->count; k++) {
        const uint64_t bit = (uint64_t)1 << k;
        if (!(*rivals & bit))
            continue;
        const instance *r = &v->others->at[k];
        const float rx = x - r->x, ry = y - r->y, d2 = rx * rx + ry * ry;
        /* The distance to the line between both is (d2 - own) / (2 |centre - centre|). */
        const float cx = r->x - v->self->x, cy = r->y - v->self->y;
        const float margin = v->is_ground ? 0.0F : 2.0F * radius * sqrtf(cx * cx + cy * cy);
        const float reach = r->radius + radius;
        if (d2 >= reach * reach || (!v->is_ground && d2 - own >= margin)) {
            *rivals &= ~bit;
            continue;
        }
        const float a = r->to_local.xx * rx + r->to_local.xy * ry, b = r->to_local.yx * rx + r->to_local.yy * ry;
        const float border_a = radius * (fabsf(r->to_local.xx) + fabsf(r->to_local.xy));
        const float border_b = radius * (fabsf(r->to_local.yx) + fabsf(r->to_local.yy));
        if (fabsf(a) > 0.5F + border_a || fabsf(b) > 0.5F + border_b)
            *rivals &= ~bit;
        else if ((v->is_ground || own - d2 >= margin) && fabsf(a) < 0.5F - border_a && fabsf(b) < 0.5F - border_b)
            return 0;
    }
    return 1;
}

static void to_frame(const local_view *v, float x, float y, float frame[2])
{
    const matrix2 m = v->self->to_frame;
    frame[0] = v->self->x + m.xx * (x - 0.5F) + m.xy * (y - 0.5F);
    frame[1] = v->self->y + m.yx * (x - 0.5F) + m.yy * (y - 0.5F);
}

/* Share of a tile that the example owns, by its quarters. */
static float owned_share(const local_view *v, const node *n, float x, float y, float side)
{
    if (!n->rivals)
        return 1.0F;
    int owned = 0;
    for (int k = 0; k < 4; k++) {
        float at[2];
        to_frame(v, x + (k & 1 ? 0.25F : -0.25F) * side, y + (k & 2 ? 0.25F : -0.25F) * side, at);
        owned += owns_point(v, n->rivals, at[0], at[1]);
    }
    return 0.25F * (float)owned;
}

/* ---- descent ---- */

/* Eq. 6 for one texel: the integral of footprint times seed is a Gaussian in the slope, moved to where in the seed the
 * footprint lies. */
static void take_texel(const local_view *v, uint32_t tx, uint32_t ty, uint64_t rivals, gathered *sum)
{
    const float side = 1.0F / (float)v->e->size;
    const float x = ((float)tx + 0.5F) * side, y = ((float)ty + 0.5F) * side;
    const float dx = v->mean[0] - x, dy = v->mean[1] - y;
    const covariance2 *p = &v->precision;
    const float gx = p->xx * dx + p->xy * dy, gy = p->xy * dx + p->yy * dy;
    const float exponent = 0.5F * (dx * gx + dy * gy);
    if (exponent > LAST_EXPONENT)
        return;
    if (rivals) {
        float at[2];
        to_frame(v, x, y, at);
        if (!owns_point(v, rivals, at[0], at[1]))
            return;
    }
    const float area = v->norm * side * side;
    const example_texel *t = &v->e->texels[ty * v->e->size + tx];
    if (v->sum_mass)
        sum->mass += area * exp_negative(-exponent);
    if (v->is_ground) {
        sum->value += area * exp_negative(-exponent) * ground_density(v);
        return;
    }
    const float place_x = v->e->seed_variance * gx, place_y = v->e->seed_variance * gy;
    const float from_x = v->slope[0] - t->slope[0] - t->jacobian.xx * place_x - t->jacobian.xy * place_y;
    const float from_y = v->slope[1] - t->slope[1] - t->jacobian.yx * place_x - t->jacobian.yy * place_y;
    covariance2 c = covariance2_mapped(t->jacobian, v->posterior);
    c.xx += v->slope_variance;
    c.yy += v->slope_variance;
    sum->value += area * v->slope_scale * gaussian(c, from_x, from_y, exponent);
}

/* A tile whose quarters are texels. */
static void take_texels(const local_view *v, const node *n, gathered *sum)
{
    if (!v->sum_mass && !v->is_ground && is_dark(v, n))
        return;
    for (uint32_t k = 0; k < 4; k++)
        take_texel(v, 2U * n->x + (k & 1), 2U * n->y + (k >> 1), n->rivals, sum);
}

/* Takes a tile whole, skips it, or says that its quarters are to be looked at. */
static int is_divided(const local_view *v, node *n, gathered *sum)
{
    const float side = (float)(2 << n->level) / (float)v->e->size, half = 0.5F * side;
    const float x = ((float)n->x + 0.5F) * side, y = ((float)n->y + 0.5F) * side;
    const float dx = v->mean[0] - x, dy = v->mean[1] - y;
    const covariance2 *p = &v->precision;
    const float gx = p->xx * dx + p->xy * dy, gy = p->xy * dx + p->yy * dy;
    const float exponent = 0.5F * (dx * gx + dy * gy);
    /* The exponent is convex: it lies above its tangent. */
    const float change = half * (fabsf(gx) + fabsf(gy));
    if (exponent - change > LAST_EXPONENT)
        return 0;
    const int has_map = n->level >= EXAMPLE_LEAST_MAP_LEVEL || v->is_ground;
    const float density = has_map ? tile_density(v, n) : 0.0F;
    if (has_map && !(density > 0.0F) && !v->sum_mass)
        return 0;
    if (n->rivals) {
        float at[2];
        to_frame(v, x, y, at);
        if (!find_rivals(v, &n->rivals, at[0], at[1], side * v->self->radius))
            return 0;
    }
    const float curve = 0.5F * half * half * (p->xx + 2.0F * fabsf(p->xy) + p->yy);
    const float nearest = exponent > change ? exponent - change : 0.0F;
    const float rarity = 1.0F + nearest + 0.5F * nearest * nearest; /* below exp(nearest) */
    if (!has_map || change + curve > MOST_VARIATION * rarity ||
        (n->rivals && v->norm * side * side > MOST_SHARED_MASS * rarity))
        return 1;
    const float mass = v->norm * exp_negative(-exponent) * side * side * owned_share(v, n, x, y, side);
    sum->value += mass * density * v->slope_scale;
    sum->mass += mass;
    return 0;
}

static void descend(const local_view *v, uint64_t rivals, gathered *sum)
{
    node stack[3 * EXAMPLE_MOST_LEVELS + 1];
    int height = 1;
    stack[0] = (node){ 0, 0, (int)v->e->levels - 1, rivals };
    while (height > 0) {
        node n = stack[--height];
        if (!is_divided(v, &n, sum))
            continue;
        if (n.level == 0) {
            take_texels(v, &n, sum);
            continue;
        }
        for (int k = 0; k < 4; k++)
            stack[height++] =
                (node){ (uint16_t)(2 * n.x + (k & 1)), (uint16_t)(2 * n.y + (k >> 1)), n.level - 1, n.rivals };
    }
}

/* The footprint and the slope as one example sees them. */
static local_view view_of(const example *e, const example_footprint *f, const instance *self, const float slope[2],
                          float light_variance)
{
    local_view v = { .e = e, .self = self };
    const float dx = f->at[0] - self->x, dy = f->at[1] - self->y;
    const matrix2 l = self->to_frame, b = self->to_local;
    v.mean[0] = b.xx * dx + b.xy * dy + 0.5F;
    v.mean[1] = b.yx * dx + b.yy * dy + 0.5F;
    covariance2 c = covariance2_mapped(b, f->spread);
    c.xx += e->seed_variance;
    c.yy += e->seed_variance;
    /* The seed's part alone keeps this from zero, even where the footprint is a line. */
    const float least = e->seed_variance * e->seed_variance, det = c.xx * c.yy - c.xy * c.xy;
    const float inverse = 1.0F / (det > least ? det : least);
    v.precision = (covariance2){ c.yy * inverse, -c.xy * inverse, c.xx * inverse };
    v.norm = sqrtf(inverse) / (2.0F * MATH_PI);
    /* S_h - S_h (S_P + S_h)^-1 S_h */
    const float h = e->seed_variance;
    v.posterior =
        (covariance2){ h * (1.0F - h * v.precision.xx), -h * h * v.precision.xy, h * (1.0F - h * v.precision.yy) };
    v.slope[0] = l.xx * slope[0] + l.yx * slope[1];
    v.slope[1] = l.xy * slope[0] + l.yy * slope[1];
    v.slope_scale = fabsf(matrix2_determinant(l));
    /* The light's round spot becomes an ellipse; a round one of the same mean size stands for it. */
    const float stretch = 0.5F * (l.xx * l.xx + l.xy * l.xy + l.yx * l.yx + l.yy * l.yy);
    v.slope_variance = e->slope_variance + stretch * light_variance;
    return v;
}

/* ---- what lies under the footprint ---- */

/* The ellipse that a footprint reaches, as a box and a circle. */
typedef struct extent {
    float x, y, radius;
} extent;

static extent extent_of(const example *e, const example_footprint *f)
{
    /* Seeds reach a little beyond their example; the largest is stretched by one and a half. */
    const float seed = 1.5F * sqrtf(e->seed_variance);
    const float half = 0.5F * (f->spread.xx - f->spread.yy);
    const float major2 = 0.5F * (f->spread.xx + f->spread.yy) + sqrtf(half * half + f->spread.xy * f->spread.xy);
    return (extent){ SLOPE_REACH * (sqrtf(f->spread.xx) + seed), SLOPE_REACH * (sqrtf(f->spread.yy) + seed),
                     SLOPE_REACH * (sqrtf(major2) + seed) };
}

/* Whether it comes within a radius of (x, y). */
static int comes_near(const example_footprint *f, const extent *r, float x, float y, float radius)
{
    const float dx = x - f->at[0], dy = y - f->at[1], reach = r->radius + radius;
    return fabsf(dx) <= r->x + radius && fabsf(dy) <= r->y + radius && dx * dx + dy * dy <= reach * reach;
}

static void find_near(const example *e, const example_footprint *f, const extent *r, uint32_t seed, near_list *list)
{
    const float radius = EXAMPLE_MOST_RADIUS + 0.70710678F; /* jitter moves a centre by half a diagonal */
    const int columns = (int)(r->x + radius + 1.0F), rows = (int)(r->y + radius + 1.0F);
    list->count = 0;
    for (int j = -rows; j <= rows; j++)
        for (int i = -columns; i <= columns; i++) {
            if (!comes_near(f, r, (float)i + 0.5F, (float)j + 0.5F, radius) || list->count == MOST_NEAR)
                continue;
            list->at[list->count] = example_instance(e, f->cell[0], f->cell[1], i, j, seed);
            const instance *n = &list->at[list->count];
            list->count += comes_near(f, r, n->x, n->y, n->radius);
        }
}

static uint64_t every_rival(const near_list *list)
{
    return list->count == MOST_NEAR ? ~(uint64_t)0 : ((uint64_t)1 << list->count) - 1;
}

/* One question about one footprint. */
typedef struct question {
    const example *e;
    const example_footprint *f;
    const float *slope;
    float light_variance;
    uint32_t seed;
    int sum_mass;
    extent reach;
} question;

static void gather_one(const question *q, const instance *self, int is_ground, const near_list *others, uint64_t rivals,
                       gathered *sum)
{
    local_view v = view_of(q->e, q->f, self, q->slope, q->light_variance);
    v.is_ground = is_ground;
    v.sum_mass = q->sum_mass;
    v.others = others;
    descend(&v, rivals, sum);
}

/* Every cell of the lattice: a tiled example, or the ground below scattered ones. */
static void gather_cells(const question *q, const near_list *others, gathered *sum)
{
    const int columns = (int)(q->reach.x + 1.0F), rows = (int)(q->reach.y + 1.0F);
    for (int j = -rows; j <= rows; j++)
        for (int i = -columns; i <= columns; i++) {
            if (!comes_near(q->f, &q->reach, (float)i + 0.5F, (float)j + 0.5F, 0.70710678F))
                continue;
            instance n = { (float)i + 0.5F, (float)j + 0.5F, { 1, 0, 0, 1 }, { 1, 0, 0, 1 }, 0.70710678F };
            if (!others)
                n = example_instance(q->e, q->f->cell[0], q->f->cell[1], i, j, q->seed);
            gather_one(q, &n, others != NULL, others, others ? every_rival(others) : 0, sum);
        }
}

float example_density(const example *e, const example_footprint *f, const float slope[2], float light_variance,
                      uint32_t seed)
{
    const float half = 0.5F * (f->spread.xx - f->spread.yy);
    const float minor2 = 0.5F * (f->spread.xx + f->spread.yy) - sqrtf(half * half + f->spread.xy * f->spread.xy);
    const int tiled = e->options->placement == GLINT_EXAMPLE_TILED;
    const float texel = (tiled ? RIPPLE_SIGMA : SEAM_SIGMA) / (float)e->size;
    const question q = { e, f, slope, light_variance, seed, minor2 < texel * texel, extent_of(e, f) };
    gathered sum = { 0.0F, 0.0F };
    if (tiled) {
        gather_cells(&q, NULL, &sum);
    } else {
        near_list list;
        find_near(e, f, &q.reach, seed, &list);
        for (int k = 0; k < list.count; k++)
            gather_one(&q, &list.at[k], 0, &list, every_rival(&list) & ~((uint64_t)1 << k), &sum);
        const covariance2 flat = { e->slope_variance + light_variance, 0.0F, e->slope_variance + light_variance };
        if (q.sum_mass || gaussian(flat, slope[0], slope[1], 0.0F) > 0.0F)
            gather_cells(&q, &list, &sum);
    }
    /* What lies beyond the reach looks like the rest: 1 - exp(-3.5^2 / 2). */
    if (!q.sum_mass)
        return sum.value / 0.99781F;
    return sum.mass > 0.0F ? sum.value / sum.mass : 0.0F;
}
