/* From an example's normals to its seeds and multi-scale NDF maps: Xing et al. 2024, section 5.2, Eqs. 4 to 7. */
#include <string.h>

#include "model/example.h"

#define GLINT_LANES 1
#include "math/elementary.h"
#include "math/hash.h"

/* Steeper slopes than this, 83 degrees, would take the maps' resolution from all others. */
#define STEEPEST 8.0F

/* Patches of scattered surface that stand for all of it: cells along a side, points along a side of a cell (cost). */
enum { PATCH_CELLS = 24, PATCH_POINTS = 8 };

int example_normal_slope(const glint_example *o, uint32_t i, float slope[2])
{
    const float *n = o->normals + (size_t)i * o->components;
    uint32_t bits[3] = { 0, 0, 0 };
    memcpy(bits, n, o->components * sizeof(float));
    for (int k = 0; k < 3; k++)                    /* by bits: a NaN must not be compared */
        if ((bits[k] & 0x7f800000U) > 0x5d800000U) /* 2^60: squares stay finite */
            return 0;
    const float z2 = 1.0F - n[0] * n[0] - n[1] * n[1];
    const float z = o->components == 3 ? n[2] : z2 > 0.0F ? sqrtf(z2) : 0.0F;
    if (!(z > 0.0F && fabsf(n[0]) <= STEEPEST * z && fabsf(n[1]) <= STEEPEST * z))
        return 0;
    slope[0] = n[0] / z;
    slope[1] = n[1] / z;
    return slope[0] * slope[0] + slope[1] * slope[1] <= STEEPEST * STEEPEST;
}

/* A bijection of [0, count), count a power of two: neighbouring texels get unrelated strata. */
static uint32_t shuffle(uint32_t i, uint32_t count)
{
    const uint32_t mask = count - 1;
    for (int round = 0; round < 3; round++) {
        i = (i * HASH_X + HASH_Z) & mask;
        i ^= i >> 3;
    }
    return i;
}

/* Slope k of count that follow a distribution: strata of equal probability, turned by the golden ratio. */
static void distributed_slope(const glint_material_options *o, uint32_t k, uint32_t count, float slope[2])
{
    const float u = ((float)k + 0.5F) / (float)count;
    const float turn = 2.0F * (float)(k * 2654435769U >> 8) * 0x1p-24F;
    float sine, cosine;
    sincos_pi(turn < 1.0F ? turn : turn - 1.0F, &sine, &cosine);
    const float sign = turn < 1.0F ? 1.0F : -1.0F;
    float r = sqrtf(o->distribution == GLINT_DISTRIBUTION_BECKMANN ? -log_f(1.0F - u) : u / (1.0F - u));
    const float most = o->surface.alpha_x > o->surface.alpha_y ? o->surface.alpha_x : o->surface.alpha_y;
    r = r * most < STEEPEST ? r : STEEPEST / most;
    slope[0] = sign * r * cosine * o->surface.alpha_x;
    slope[1] = sign * r * sine * o->surface.alpha_y;
}

static void seed_slopes(example *e, const glint_material_options *o)
{
    const uint32_t count = e->size * e->size;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t x = i % e->size, y = i / e->size;
        example_quad *q = &e->quads[example_tile(e, 0, x / 2, y / 2)];
        float slope[2] = { 0.0F, 0.0F };
        if (o->example.normals)
            example_normal_slope(&o->example, i, slope);
        else
            distributed_slope(o, shuffle(i, count), count, slope);
        for (int k = 0; k < 2; k++)
            q->slope[k][(x & 1U) + 2U * (y & 1U)] = slope[k];
        for (int k = 0; k < 4; k++)
            q->jacobian[k][(x & 1U) + 2U * (y & 1U)] = 0.0F;
    }
}

/* The neighbour of a texel along an axis: around the edge where examples are tiled, up to it where they end there. */
static uint32_t neighbour(const example *e, uint32_t i, int step)
{
    if (!e->lattice.is_scattered)
        return (i + (uint32_t)step) & (e->size - 1);
    return step < 0 ? (i > 0 ? i - 1 : 0) : (i + 1 < e->size ? i + 1 : i);
}

/* J by central differences, per unit of the example. */
static void seed_jacobians(example *e)
{
    const float per_unit = 0.5F * (float)e->size;
    for (uint32_t y = 0; y < e->size; y++)
        for (uint32_t x = 0; x < e->size; x++) {
            example_quad *q = &e->quads[example_tile(e, 0, x / 2, y / 2)];
            const example_texel left = example_texel_at(e, neighbour(e, x, -1), y);
            const example_texel right = example_texel_at(e, neighbour(e, x, 1), y);
            const example_texel down = example_texel_at(e, x, neighbour(e, y, -1));
            const example_texel up = example_texel_at(e, x, neighbour(e, y, 1));
            for (int k = 0; k < 2; k++) {
                q->jacobian[2 * k][(x & 1U) + 2U * (y & 1U)] = per_unit * (right.slope[k] - left.slope[k]);
                q->jacobian[2 * k + 1][(x & 1U) + 2U * (y & 1U)] = per_unit * (up.slope[k] - down.slope[k]);
            }
        }
}

/* sigma_h^2 J J^T: the slopes that one seed spreads over (Eq. 5, integrated over the place). */
static covariance2 seed_spread(const example *e, const example_texel *t)
{
    const float h = e->lattice.seed_variance;
    return covariance2_mapped(t->jacobian, (covariance2){ h, 0.0F, h });
}

static const slope_range EMPTY = { { 1e30F, 1e30F }, { -1e30F, -1e30F } };

static void extend(slope_range *range, float x, float y, float reach_x, float reach_y)
{
    const float at[2] = { x, y }, reach[2] = { reach_x, reach_y };
    for (int k = 0; k < 2; k++) {
        range->low[k] = at[k] - reach[k] < range->low[k] ? at[k] - reach[k] : range->low[k];
        range->high[k] = at[k] + reach[k] > range->high[k] ? at[k] + reach[k] : range->high[k];
    }
}

/* Slopes of a tile's seeds, their spread over the place included. */
static slope_range tile_range(const example *e, uint32_t level, uint32_t tx, uint32_t ty)
{
    const uint32_t side = 2U << level;
    slope_range range = EMPTY;
    for (uint32_t y = ty * side; y < (ty + 1) * side; y++)
        for (uint32_t x = tx * side; x < (tx + 1) * side; x++) {
            const example_texel t = example_texel_at(e, x, y);
            const covariance2 c = seed_spread(e, &t);
            extend(&range, t.slope[0], t.slope[1], SLOPE_REACH * sqrtf(c.xx), SLOPE_REACH * sqrtf(c.yy));
        }
    return range;
}

static void quarter(const example *e, uint32_t level, uint32_t tx, uint32_t ty, quarter_slopes *of_parent)
{
    const uint32_t side = 2U << level, q = (tx & 1U) + 2U * (ty & 1U);
    slope_range range = EMPTY;
    covariance2 most = { 0.0F, 0.0F, 0.0F };
    for (uint32_t y = ty * side; y < (ty + 1) * side; y++)
        for (uint32_t x = tx * side; x < (tx + 1) * side; x++) {
            const example_texel t = example_texel_at(e, x, y);
            const covariance2 c = seed_spread(e, &t);
            extend(&range, t.slope[0], t.slope[1], 0.0F, 0.0F);
            most.xx = c.xx > most.xx ? c.xx : most.xx;
            most.yy = c.yy > most.yy ? c.yy : most.yy;
        }
    for (int k = 0; k < 2; k++) {
        of_parent->low[k][q] = range.low[k];
        of_parent->high[k][q] = range.high[k];
    }
    of_parent->variance[0][q] = most.xx;
    of_parent->variance[1][q] = most.yy;
}

static float width(const slope_range *r)
{
    const float x = r->high[0] - r->low[0], y = r->high[1] - r->low[1];
    return x > y ? x : y;
}

static float intrinsic_roughness(const example *e, const glint_material_options *o)
{
    float sum = 0.0F;
    for (uint32_t i = 0; i < e->size * e->size; i++) {
        const example_texel t = example_texel_at(e, i % e->size, i / e->size);
        sum += t.slope[0] * t.slope[0] + t.slope[1] * t.slope[1];
    }
    const float rms = sqrtf(sum / (float)(e->size * e->size));
    /* A sixth: 36 spots across a Gaussian distribution, which the eye still tells apart (taste). */
    const float sigma = o->example.sigma_r > 0.0F ? o->example.sigma_r : rms / 6.0F;
    const slope_range all = tile_range(e, e->levels - 1, 0, 0);
    const float least = width(&all) / SLOPE_CELLS;
    return sigma > least ? (sigma > 1e-3F ? sigma : 1e-3F) : (least > 1e-3F ? least : 1e-3F);
}

void example_seed(example *e, const glint_material_options *o)
{
    seed_slopes(e, o);
    if (o->example.normals && !o->example.flat)
        seed_jacobians(e);
    const float sigma_r = intrinsic_roughness(e, o);
    /* A Beckmann lobe of roughness alpha has slopes of variance alpha^2 / 2. */
    e->slope_variance = sigma_r * sigma_r + 0.5F * o->facet_alpha * o->facet_alpha;
    for (uint32_t level = 0; level + 1 < e->levels; level++)
        for (uint32_t y = 0; y < example_tiles_along(e, level); y++)
            for (uint32_t x = 0; x < example_tiles_along(e, level); x++)
                quarter(e, level, x, y,
                        &e->slopes[e->first_chain[level + 1] + example_tile(e, level + 1, x / 2, y / 2)]);
}

/* ---- the whole surface ---- */

typedef struct overall_pass {
    example *e;
    float *density; /* NULL: only measure */
    slope_range range;
    float least_variance;
} overall_pass;

static float least_eigenvalue(covariance2 c)
{
    const float half = 0.5F * (c.xx - c.yy);
    return 0.5F * (c.xx + c.yy) - sqrtf(half * half + c.xy * c.xy);
}

/* One seed as it lies on the surface: slopes go through the inverse transpose of M. */
static void overall_seed(overall_pass *p, const float slope[2], covariance2 spread, matrix2 to_local)
{
    const matrix2 a = { to_local.xx, to_local.yx, to_local.xy, to_local.yy };
    const float variance = p->e->slope_variance;
    const float x = a.xx * slope[0] + a.xy * slope[1], y = a.yx * slope[0] + a.yy * slope[1];
    covariance2 c = covariance2_mapped(a, (covariance2){ spread.xx + variance, spread.xy, spread.yy + variance });
    const float least = least_eigenvalue(c);
    if (p->density) {
        const float more = p->e->overall.variance > least ? p->e->overall.variance - least : 0.0F;
        slope_map_add(p->e->overall.maps, p->density, (slope_lobe){ x, y, c.xx + more, c.xy, c.yy + more, 1.0F });
        return;
    }
    extend(&p->range, x, y, SLOPE_REACH * sqrtf(c.xx), SLOPE_REACH * sqrtf(c.yy));
    p->least_variance = least < p->least_variance ? least : p->least_variance;
}

static void overall_tiled(overall_pass *p)
{
    const example *e = p->e;
    /* The first four variants are the four mirrored ones. */
    for (int m = 0; m < (e->lattice.is_alike ? 1 : 4); m++) {
        const matrix2 to_local = matrix2_product(e->lattice.variants[m].to_local, e->lattice.to_lattice);
        for (uint32_t i = 0; i < e->size * e->size; i++) {
            const example_texel t = example_texel_at(e, i % e->size, i / e->size);
            overall_seed(p, t.slope, seed_spread(e, &t), to_local);
        }
    }
}

/* What a patch of the surface shows, at the points of a grid. */
static void overall_scattered(overall_pass *p)
{
    enum { AROUND = 5 };
    const example *e = p->e;
    for (uint32_t cell = 0; cell < PATCH_CELLS * PATCH_CELLS; cell++) {
        instance near[AROUND * AROUND];
        for (int k = 0; k < AROUND * AROUND; k++)
            near[k] = lattice_instance(&e->lattice, cell % PATCH_CELLS, cell / PATCH_CELLS, k % AROUND - 2,
                                       k / AROUND - 2, 0U);
        for (int i = 0; i < PATCH_POINTS * PATCH_POINTS; i++) {
            /* Skewed from row to row, so that points do not fall on the same texels everywhere. */
            const uint32_t bits = hash_full(cell * HASH_X + (uint32_t)i * HASH_Y);
            const int column = i % PATCH_POINTS, row = i / PATCH_POINTS;
            const float x = ((float)column + (float)(bits & 0xffffU) * 0x1p-16F) / PATCH_POINTS;
            const float y = ((float)row + (float)(bits >> 16) * 0x1p-16F) / PATCH_POINTS;
            const instance *owner = NULL;
            float best = 1e30F;
            for (int k = 0; k < AROUND * AROUND; k++) {
                const float dx = x - near[k].x, dy = y - near[k].y, d2 = dx * dx + dy * dy;
                if (d2 < best && instance_covers(&near[k], x, y)) {
                    best = d2;
                    owner = &near[k];
                }
            }
            const matrix2 unit = { 1.0F, 0.0F, 0.0F, 1.0F };
            if (owner) {
                const float n = (float)e->size;
                float a, b;
                instance_local(owner, x, y, &a, &b);
                a = (a + 0.5F) * n;
                b = (b + 0.5F) * n;
                const example_texel t = example_texel_at(e, a < n - 1.0F ? (uint32_t)a : e->size - 1,
                                                         b < n - 1.0F ? (uint32_t)b : e->size - 1);
                overall_seed(p, t.slope, seed_spread(e, &t), owner->as.to_local);
            } else {
                const float flat[2] = { 0.0F, 0.0F };
                overall_seed(p, flat, (covariance2){ 0.0F, 0.0F, 0.0F }, unit);
            }
        }
    }
}

static void overall_seeds(overall_pass *p)
{
    if (p->e->lattice.is_scattered)
        overall_scattered(p);
    else
        overall_tiled(p);
}

/* ---- maps ---- */

size_t example_place_maps(example *e)
{
    size_t codes = 0;
    uint32_t chain = 0;
    for (uint32_t level = EXAMPLE_LEAST_MAP_LEVEL; level < e->levels; level++)
        for (uint32_t y = 0; y < example_tiles_along(e, level); y++)
            for (uint32_t x = 0; x < example_tiles_along(e, level); x++) {
                const slope_range range = tile_range(e, level, x, y);
                slope_maps_place(&e->tiles, chain++, &range, &codes);
            }
    overall_pass p = { e, NULL, EMPTY, 1e30F };
    overall_seeds(&p);
    const float sigma = width(&p.range) / SLOPE_CELLS;
    e->overall.variance = sigma * sigma > p.least_variance ? sigma * sigma : p.least_variance;
    e->overall.length = slope_chain_length(e->overall.variance);
    slope_maps_place(&e->overall, 0, &p.range, &codes);
    return codes;
}

/* The mean of a tile's seeds: Eq. 7. */
static void fill_tile(example *e, uint32_t level, uint32_t tx, uint32_t ty, uint32_t chain, float *work)
{
    const uint32_t side = 2U << level;
    const float variance = e->slope_variance;
    for (uint32_t y = ty * side; y < (ty + 1) * side; y++)
        for (uint32_t x = tx * side; x < (tx + 1) * side; x++) {
            const example_texel t = example_texel_at(e, x, y);
            const covariance2 c = seed_spread(e, &t);
            slope_map_add(&e->tiles.maps[(size_t)chain * e->tiles.length], work,
                          (slope_lobe){ t.slope[0], t.slope[1], c.xx + variance, c.xy, c.yy + variance, 1.0F });
        }
    slope_maps_encode(&e->tiles, chain, work);
}

void example_fill_maps(example *e, float *work)
{
    uint32_t chain = 0;
    for (uint32_t level = EXAMPLE_LEAST_MAP_LEVEL; level < e->levels; level++)
        for (uint32_t y = 0; y < example_tiles_along(e, level); y++)
            for (uint32_t x = 0; x < example_tiles_along(e, level); x++)
                fill_tile(e, level, x, y, chain++, work);
    overall_pass p = { e, work, EMPTY, 0.0F };
    overall_seeds(&p);
    slope_maps_encode(&e->overall, 0, work);
    example_masking_bake(&e->masking, &e->overall);
    slope_map_row_sums(&e->overall, e->overall.maps, e->row_sums);
}
