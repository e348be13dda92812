/* Distributions of slopes as pictures: rasterised Gaussians, a chain of blurs, bilinear look-up (Xing et al. 2024,
 * section 5.2). */
#include "model/slope_map.h"

#include <math.h>

#define GLINT_LANES 1
#include "math/elementary.h"

/* Cells of a standard deviation (cost): bilinear interpolation leaves 1 / (1 - 1 / (6 * 1.5^2)) - 1 = 8 % of the peak
 * of a Gaussian that stands alone, at its middle, and -4 % between cells; sums of many even out. */
#define CELLS_PER_SIGMA 1.5F

/* The widest blur, in slopes: a light of half the sky. */
#define WIDEST_VARIANCE 4.0F

/* Less of a map than this is left out of a blend (cost). */
#define LEAST_BLEND 0.02F

uint32_t slope_chain_length(float variance)
{
    uint32_t length = 1;
    for (float v = variance; v < WIDEST_VARIANCE && length < SLOPE_MOST_LENGTH; v *= 2.0F)
        length++;
    return length;
}

/* Bilinear interpolation blurs by the tent's variance, a sixth of a cell squared; codes hold that much less. */
static float tent_variance(const slope_map *map)
{
    return 1.0F / (6.0F * map->cells_per_unit * map->cells_per_unit);
}

void slope_maps_place(slope_maps *maps, uint32_t chain, const slope_range *range, size_t *code_count)
{
    float variance = maps->variance;
    for (uint32_t b = 0; b < maps->length; b++, variance *= 2.0F) {
        slope_map *m = &maps->maps[chain * maps->length + b];
        const float sigma = sqrtf(variance), margin = SLOPE_REACH * sigma;
        m->cells_per_unit = CELLS_PER_SIGMA / sigma;
        m->scale = 0.0F;
        uint16_t count[2];
        for (int k = 0; k < 2; k++) {
            const float width = (range->high[k] - range->low[k] + 2.0F * margin) * m->cells_per_unit;
            /* One cell more, so that the last lies at or beyond the range's end. */
            count[k] = (uint16_t)(width < (float)(SLOPE_MAP_SIDE - 2) ? (int)width + 2 : SLOPE_MAP_SIDE);
            m->low[k] = range->low[k] - margin;
        }
        m->columns = count[0];
        m->rows = count[1];
        m->first = (uint32_t)*code_count;
        *code_count += (size_t)m->columns * m->rows;
    }
}

/* Whole cells from a to b that lie within [0, count). */
static int first_cell(float a, int count)
{
    return a <= 0.0F ? 0 : a >= (float)count ? count : (int)a + ((float)(int)a < a);
}

static int end_cell(float b, int count)
{
    return b < 0.0F ? 0 : b >= (float)(count - 1) ? count : (int)b + 1;
}

/* exp of a quadratic along the cells of one row: two products a cell, from g = exp(-e(0)) and its first two ratios. */
static void add_row(float *row, int first, int end, float g, float ratio, float ratio2)
{
    for (int i = first; i < end; i++) {
        row[i] += g;
        g *= ratio;
        ratio *= ratio2;
    }
}

void slope_map_add(const slope_map *map, float *density, slope_lobe lobe)
{
    const float cells = map->cells_per_unit, step = 1.0F / cells, tent = tent_variance(map);
    const float xx = lobe.xx - tent, yy = lobe.yy - tent;
    const float det = xx * yy - lobe.xy * lobe.xy;
    const float a = yy / det, b = -lobe.xy / det;
    const float peak = lobe.weight / (2.0F * MATH_PI * sqrtf(det));
    const float ratio2 = exp_negative(-a * step * step);
    const float high = SLOPE_REACH * sqrtf(yy);
    const int end_row = end_cell((lobe.y + high - map->low[1]) * cells, map->rows);
    for (int j = first_cell((lobe.y - high - map->low[1]) * cells, map->rows); j < end_row; j++) {
        const float dy = map->low[1] + (float)j * step - lobe.y;
        /* a dx^2 + 2 b dx dy + c dy^2 = a (dx - centre)^2 + dy^2 / yy */
        const float across = dy * dy / yy, centre = lobe.x - b / a * dy;
        const float left = SLOPE_REACH * SLOPE_REACH - across;
        const float half = left > 0.0F ? sqrtf(left / a) : 0.0F;
        const int first = first_cell((centre - half - map->low[0]) * cells, map->columns);
        const int end = end_cell((centre + half - map->low[0]) * cells, map->columns);
        if (first >= end)
            continue;
        const float dx = map->low[0] + (float)first * step - centre;
        const float g = peak * exp_negative(-0.5F * (a * dx * dx + across));
        /* g(x + step) / g(x); its exponent may be positive. */
        const float rise = -a * step * (dx + 0.5F * step);
        const float ratio = rise < 0.0F ? exp_negative(rise) : 1.0F / exp_negative(-rise);
        add_row(density + (size_t)j * map->columns, first, end, g, ratio, ratio2);
    }
}

/* Resamples lines of one map along one axis onto the cells of the next, with a Gaussian of this variance. */
static void widen_axis(const float *in, size_t in_step, size_t in_line, int in_count, float in_low, float in_cells,
                       float *out, size_t out_step, size_t out_line, int out_count, float out_low, float out_cells,
                       int lines, float variance)
{
    enum { MOST = 64 };
    const float reach = 4.0F * sqrtf(variance), norm = 1.0F / (in_cells * sqrtf(2.0F * MATH_PI * variance));
    for (int i = 0; i < out_count; i++) {
        const float x = out_low + (float)i / out_cells;
        const int first = first_cell((x - reach - in_low) * in_cells, in_count);
        int end = end_cell((x + reach - in_low) * in_cells, in_count);
        end = end < first + MOST ? end : first + MOST;
        float weight[MOST];
        for (int k = first; k < end; k++) {
            const float d = in_low + (float)k / in_cells - x;
            weight[k - first] = norm * exp_negative(-0.5F * d * d / variance);
        }
        for (int line = 0; line < lines; line++) {
            const float *from = in + (size_t)line * in_line;
            float sum = 0.0F;
            for (int k = first; k < end; k++)
                sum += weight[k - first] * from[(size_t)k * in_step];
            out[(size_t)i * out_step + (size_t)line * out_line] = sum;
        }
    }
}

static void encode(slope_map *map, uint8_t *codes, const float *density)
{
    const size_t count = (size_t)map->columns * map->rows;
    float most = 0.0F;
    for (size_t i = 0; i < count; i++)
        most = density[i] > most ? density[i] : most;
    const float per_code = most > 0.0F ? 65025.0F / most : 0.0F;
    uint64_t sum = 0;
    for (size_t i = 0; i < count; i++) {
        codes[i] = (uint8_t)(sqrtf(density[i] * per_code) + 0.5F);
        sum += (uint64_t)codes[i] * codes[i];
    }
    map->scale = sum > 0 ? map->cells_per_unit * map->cells_per_unit / (float)sum : 0.0F;
}

void slope_maps_encode(slope_maps *maps, uint32_t chain, float *work)
{
    float *density = work, *other = work + (size_t)SLOPE_MAP_SIDE * SLOPE_MAP_SIDE;
    float variance = maps->variance;
    slope_map *m = &maps->maps[(size_t)chain * maps->length];
    encode(m, maps->codes + m->first, density);
    for (uint32_t b = 1; b < maps->length; b++, variance *= 2.0F) {
        slope_map *n = m + 1;
        const float more = variance + tent_variance(m) - tent_variance(n);
        widen_axis(density, 1, m->columns, m->columns, m->low[0], m->cells_per_unit, other, 1, n->columns, n->columns,
                   n->low[0], n->cells_per_unit, m->rows, more);
        widen_axis(other, n->columns, 1, m->rows, m->low[1], m->cells_per_unit, density, n->columns, 1, n->rows,
                   n->low[1], n->cells_per_unit, n->columns, more);
        encode(n, maps->codes + n->first, density);
        m = n;
    }
    for (int i = 0; i < SLOPE_WORK; i++)
        work[i] = 0.0F;
}

static float map_density(const slope_maps *maps, const slope_map *m, float x, float y)
{
    const float cx = (x - m->low[0]) * m->cells_per_unit, cy = (y - m->low[1]) * m->cells_per_unit;
    /* The outermost cells are empty beyond their tents. */
    if (!(cx > -1.0F && cy > -1.0F && cx < (float)m->columns && cy < (float)m->rows))
        return 0.0F;
    const int i = (int)(cx + 1.0F) - 1, j = (int)(cy + 1.0F) - 1;
    const float fx = cx - (float)i, fy = cy - (float)j;
    const uint8_t *codes = maps->codes + m->first;
    /* The four around it, in the order of rows; beyond the edge they are zero. */
    int code[4] = { 0, 0, 0, 0 };
    if (i >= 0 && j >= 0 && i + 1 < m->columns && j + 1 < m->rows) {
        const uint8_t *c = codes + j * m->columns + i;
        code[0] = c[0];
        code[1] = c[1];
        code[2] = c[m->columns];
        code[3] = c[m->columns + 1];
    } else {
        for (int k = 0; k < 4; k++) {
            const int a = i + (k & 1), b = j + (k >> 1);
            if (a >= 0 && a < m->columns && b >= 0 && b < m->rows)
                code[k] = codes[b * m->columns + a];
        }
    }
    if ((code[0] | code[1] | code[2] | code[3]) == 0)
        return 0.0F;
    const float left = (float)(code[0] * code[0]), above = (float)(code[2] * code[2]);
    const float low = left + fx * ((float)(code[1] * code[1]) - left);
    const float high = above + fx * ((float)(code[3] * code[3]) - above);
    return m->scale * (low + fy * (high - low));
}

slope_blend slope_maps_blend(const slope_maps *maps, float variance)
{
    const float ratio = variance / maps->variance;
    if (!(ratio > 1.0F))
        return (slope_blend){ 0, 0, 1.0F };
    const uint32_t b = (uint32_t)exponent_of(ratio);
    if (b + 1 >= maps->length)
        return (slope_blend){ maps->length - 1, maps->length - 1, 1.0F };
    /* Between variances 1 and 2 the blend that has the peak of the Gaussian in between: w + (1 - w) / 2 = 1 / ratio.
     * Within two hundredths of one of them it is that one alone, which changes the peak by at most one hundredth. */
    const float w = (2.0F / mantissa_of(ratio) - 1.0F - LEAST_BLEND) / (1.0F - 2.0F * LEAST_BLEND);
    return (slope_blend){ b, b + 1, w > 0.0F ? (w < 1.0F ? w : 1.0F) : 0.0F };
}

float slope_maps_blended(const slope_maps *maps, uint32_t chain, const slope_blend *blend, float x, float y)
{
    const slope_map *m = &maps->maps[(size_t)chain * maps->length];
    const float w = blend->weight;
    const float narrow_part = w > 0.0F ? w * map_density(maps, m + blend->narrow, x, y) : 0.0F;
    return narrow_part + (w < 1.0F ? (1.0F - w) * map_density(maps, m + blend->wide, x, y) : 0.0F);
}

float slope_maps_density(const slope_maps *maps, uint32_t chain, float variance, float x, float y)
{
    const slope_blend blend = slope_maps_blend(maps, variance);
    return slope_maps_blended(maps, chain, &blend, x, y);
}

static uint32_t row_sum(const slope_maps *maps, const slope_map *map, int row)
{
    const uint8_t *codes = maps->codes + map->first + (size_t)row * map->columns;
    uint32_t sum = 0;
    for (int i = 0; i < map->columns; i++)
        sum += (uint32_t)(codes[i] * codes[i]);
    return sum;
}

void slope_map_row_sums(const slope_maps *maps, const slope_map *map, float *sums)
{
    uint64_t sum = 0;
    sums[0] = 0.0F;
    for (int j = 0; j < map->rows; j++) {
        sum += row_sum(maps, map, j);
        sums[j + 1] = (float)sum;
    }
}

/* Inverse of the tent's distribution function over (-1, 1). */
static float tent_quantile(float u)
{
    return u < 0.5F ? sqrtf(2.0F * u) - 1.0F : 1.0F - sqrtf(2.0F - 2.0F * u);
}

static float below_one(float u)
{
    return u < 0.99999994F ? u : 0.99999994F;
}

void slope_map_sample(const slope_maps *maps, const slope_map *map, const float *row_sums, float u1, float u2,
                      float slope[2])
{
    /* The row, by bisection of the sums; what is left of u1 draws within its tent. */
    const float target = u1 * row_sums[map->rows];
    int low = 0, high = map->rows;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (row_sums[middle] <= target)
            low = middle;
        else
            high = middle;
    }
    const float height = row_sums[low + 1] - row_sums[low];
    const float left_y = height > 0.0F ? below_one((target - row_sums[low]) / height) : 0.5F;

    const uint8_t *codes = maps->codes + map->first + (size_t)low * map->columns;
    const float along = u2 * (float)row_sum(maps, map, low);
    uint32_t sum = 0, code2 = 0;
    int i = 0;
    for (; i < map->columns; i++) {
        code2 = (uint32_t)(codes[i] * codes[i]);
        if ((float)(sum + code2) > along)
            break;
        sum += code2;
    }
    const float left_x = code2 > 0 ? below_one((along - (float)sum) / (float)code2) : 0.5F;
    slope[0] = map->low[0] + ((float)i + tent_quantile(left_x)) / map->cells_per_unit;
    slope[1] = map->low[1] + ((float)low + tent_quantile(left_y)) / map->cells_per_unit;
}
