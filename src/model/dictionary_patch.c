/* The cells of a MIP hierarchy under a footprint, with their Gaussian weights.
 *
 * Where this differs from the paper: its finest cell has a side of 2^-15 units whatever the density, so that coarse
 * glitter gets more facets than was asked for; here the finest cell is the one with a single facet. The paper names a
 * cell by its corner in units of the finest level; here the corner's own coordinates, exact in a double, are the name,
 * and the hierarchy has no finest level that all surfaces must share.
 */
#include "model/dictionary_kernel.h"

#include <math.h>
#include <string.h>

#define GLINT_LANES 1
#include "math/elementary.h"
#include "math/hash.h"

#define LOG2_OF_E 1.44269504F

/* J J^T: the ellipse of the footprint is { x : x^T (J J^T)^-1 x <= 1 }, m^2. */
typedef struct ellipse {
    float uu, uv, vv;
    float minor; /* length of the minor half axis, m */
} ellipse;

/* Makes the minor axis at least 1 / max_anisotropy of the major one: the paper's gamma. */
static ellipse clamped_ellipse(const glint_footprint *f, float max_anisotropy)
{
    ellipse e = { .uu = f->dudx * f->dudx + f->dudy * f->dudy,
                  .uv = f->dudx * f->dvdx + f->dudy * f->dvdy,
                  .vv = f->dvdx * f->dvdx + f->dvdy * f->dvdy };
    const float half_sum = 0.5F * (e.uu + e.vv), half_difference = 0.5F * (e.uu - e.vv);
    const float radius = sqrtf(half_difference * half_difference + e.uv * e.uv);
    const float major2 = half_sum + radius;
    /* In double: the difference of two nearly equal numbers where the footprint is long. */
    const double area = (double)f->dudx * (double)f->dvdy - (double)f->dudy * (double)f->dvdx;
    const float minor2 = (float)(area * area / (double)major2);
    const float least2 = major2 / (max_anisotropy * max_anisotropy);
    if (minor2 < least2) {
        /* What is missing, times the projection on the minor axis. */
        const float missing = 0.5F * (least2 - minor2);
        const float length = fmaxf(radius, 1e-30F);
        e.uu += missing * (1.0F - half_difference / length);
        e.vv += missing * (1.0F + half_difference / length);
        e.uv -= missing * (e.uv / length);
    }
    e.minor = sqrtf(fmaxf(minor2, least2));
    return e;
}

static uint64_t bits_of_coordinate(double x)
{
    x += 0.0; /* -0 is 0 */
    uint64_t u;
    memcpy(&u, &x, sizeof(u));
    return u;
}

/* A coordinate of a cell's corner, which names it: a cell has the random numbers of that one of its four children whose
 * corner it shares (Eq. 8, coherent indexing). */
static uint32_t hash_row(double x, uint32_t seed)
{
    const uint64_t u = bits_of_coordinate(x);
    return hash_full(hash_full(seed + (uint32_t)u) + (uint32_t)(u >> 32));
}

/* Named and weighed; weights of all sum to level_weight. */
static void put_cells(dictionary_patch *patch, dictionary_corners *corners, int count, int level, float level_weight)
{
    uint32_t hash[DICTIONARY_ROOM];
    float weight[DICTIONARY_ROOM], sum = 0.0F;
    dictionary_corners_weigh(corners, (size_t)count, hash, weight);
    for (int k = 0; k < count; k++)
        sum += weight[k];
    const float normalize = level_weight / sum;
    for (int k = 0; k < count; k++)
        patch->cell[patch->count++] = (dictionary_cell){ hash[k], weight[k] * normalize, level };
}

/* The cells of one level whose centres lie in the ellipse, which is made larger by one cell all around, so that there
 * always are some. Their weights sum to level_weight. */
static void gather_level(dictionary_patch *patch, const glint_footprint *f, const ellipse *e, int exponent, int level,
                         float level_weight, uint32_t seed)
{
    const float side = exp2_i(exponent), per_side = exp2_i(-exponent);
    const double column = floor(f->u * (double)per_side), row = floor(f->v * (double)per_side);
    /* The footprint's centre as seen from the centre of its own cell, in cells. */
    const float u = (float)(f->u * (double)per_side - column) - 0.5F;
    const float v = (float)(f->v * (double)per_side - row) - 0.5F;

    const float scale = per_side * per_side;
    const float uu = e->uu * scale + 1.0F, uv = e->uv * scale, vv = e->vv * scale + 1.0F;
    /* By rows: the ellipse at height y is centred at y uv / vv and has the width that is left of uu - uv^2 / vv. */
    const float slant = uv / vv, width2 = fmaxf(uu - uv * slant, 1.0F), height = sqrtf(vv);
    dictionary_corners corners;
    int count = 0;
    for (int j = (int)ceilf(v - height); (float)j <= v + height; j++) {
        const uint32_t row_hash = hash_row((row + (double)j) * (double)side, seed);
        const float y = (float)j - v, y2 = y * y / vv;
        const float half = sqrtf(fmaxf(width2 * (1.0F - y2), 0.0F)), middle = u + y * slant;
        for (int i = (int)ceilf(middle - half); (float)i <= middle + half; i++) {
            const float x = (float)i - middle, r2 = x * x / width2 + y2;
            if (!(r2 < 1.0F))
                continue;
            const uint64_t bits = bits_of_coordinate((column + (double)i) * (double)side);
            corners.row[count] = row_hash;
            corners.low[count] = (uint32_t)bits;
            corners.high[count] = (uint32_t)(bits >> 32);
            corners.r2[count++] = r2;
        }
    }
    put_cells(patch, &corners, count, level, level_weight);
}

void dictionary_patch_find(dictionary_patch *patch, const glint_footprint *footprint, float facets_per_m2,
                           float max_anisotropy, uint32_t seed)
{
    const ellipse e = clamped_ellipse(footprint, max_anisotropy);
    /* A cell of level l has 4^l rho facets: one at l = -log4 rho. */
    const float log4_density = 0.5F * LOG2_OF_E * log_f(fmaxf(facets_per_m2, 1e-30F));
    const float level = fmaxf(LOG2_OF_E * log_f(fmaxf(e.minor, 1e-30F)), -log4_density);
    const float finer = floorf(level), grain = floorf(-log4_density);
    const float weight[2] = { 1.0F - (level - finer), level - finer };
    patch->count = 0;
    for (int k = 0; k < 2; k++) {
        patch->log4_facets[k] = finer + (float)k + log4_density;
        patch->grain_level[k] = (int)(finer + (float)k - grain);
        gather_level(patch, footprint, &e, (int)finer + k, k, weight[k], seed);
    }
}
