/* Smith's masking for a distribution of slopes that is only known as a picture.
 *
 * Seen along v a surface of slopes s has the projected area E[(v.z + v.xy . s)+], and G1 = v.z over it: no direction
 * then reflects more than it gets, whatever the distribution (Heitz 2014, Eqs. 5 and 13). Of v.xy = |w| w', and c = v.z
 * / |w|, what masking adds to v.z is |w| T(w', c), with T = E[max(w' . s, -c)]. It is tabulated; since the projected
 * area is convex, interpolating it can only darken.
 */
#include "model/example.h"

#define GLINT_LANES 1
#include "math/elementary.h"

enum { BINS = 512 };

/* Unit vector of one direction of the table. */
static void table_direction(int index, float *x, float *y)
{
    const float half_turns = 2.0F * (float)index / EXAMPLE_MASKING_DIRECTIONS;
    float s, c;
    sincos_pi(half_turns < 1.0F ? half_turns : half_turns - 1.0F, &s, &c);
    *x = half_turns < 1.0F ? c : -c;
    *y = half_turns < 1.0F ? s : -s;
}

/* Cotangents get sparser as they grow: c = steepest * (k / last)^2. */
static float table_cotangent(const example_masking *m, int index)
{
    const float x = (float)index / (EXAMPLE_MASKING_ANGLES - 1);
    return m->steepest * x * x;
}

/* Weight of the slopes along a direction, and that times the slope. */
typedef struct histogram {
    float weight[BINS], moment[BINS];
} histogram;

static void project(const slope_maps *maps, float x, float y, float steepest, histogram *h)
{
    const slope_map *m = maps->maps;
    for (int i = 0; i < BINS; i++)
        h->weight[i] = h->moment[i] = 0.0F;
    const float per_unit = 0.5F * BINS / steepest, share = m->scale / (m->cells_per_unit * m->cells_per_unit);
    for (int j = 0; j < m->rows; j++)
        for (int i = 0; i < m->columns; i++) {
            const int code = maps->codes[m->first + (uint32_t)(j * m->columns + i)];
            if (code == 0)
                continue;
            const float weight = share * (float)(code * code);
            const float p =
                x * (m->low[0] + (float)i / m->cells_per_unit) + y * (m->low[1] + (float)j / m->cells_per_unit);
            const int bin = (int)((p + steepest) * per_unit);
            const int inside = bin < 0 ? 0 : bin < BINS ? bin : BINS - 1;
            h->weight[inside] += weight;
            h->moment[inside] += weight * p;
        }
}

/* E[max(p, -c)] from the bins above and below -c. */
static float mean_above(const histogram *h, float steepest, float c)
{
    float sum = 0.0F;
    for (int i = 0; i < BINS; i++) {
        const float low = steepest * (2.0F * (float)i / BINS - 1.0F), high = low + 2.0F * steepest / BINS;
        const float cut = -c * h->weight[i];
        if (low >= -c)
            sum += h->moment[i];
        else if (high <= -c)
            sum += cut;
        else /* somewhere in between: the larger of both bounds, for a bin is narrow */
            sum += h->moment[i] > cut ? h->moment[i] : cut;
    }
    return sum;
}

void example_masking_bake(example_masking *m, const slope_maps *overall)
{
    const slope_map *map = overall->maps;
    float most = 0.0F;
    for (int k = 0; k < 4; k++) {
        const float x = k & 1 ? map->low[0] : map->low[0] + (float)map->columns / map->cells_per_unit;
        const float y = k & 2 ? map->low[1] : map->low[1] + (float)map->rows / map->cells_per_unit;
        most = x * x + y * y > most ? x * x + y * y : most;
    }
    m->steepest = sqrtf(most);
    for (int d = 0; d < EXAMPLE_MASKING_DIRECTIONS; d++) {
        float x, y;
        histogram h;
        table_direction(d, &x, &y);
        m->direction[d][0] = x;
        m->direction[d][1] = y;
        project(overall, x, y, m->steepest, &h);
        for (int k = 0; k < EXAMPLE_MASKING_ANGLES; k++)
            m->table[d][k] = mean_above(&h, m->steepest, table_cotangent(m, k));
    }
}

/* T of one direction of the table, linear between cotangents. */
static float look_up(const example_masking *m, int direction, float cotangent)
{
    const float x = sqrtf(cotangent / m->steepest) * (EXAMPLE_MASKING_ANGLES - 1);
    const int k = x < (float)(EXAMPLE_MASKING_ANGLES - 2) ? (int)x : EXAMPLE_MASKING_ANGLES - 2;
    const float low = table_cotangent(m, k), high = table_cotangent(m, k + 1);
    const float f = (cotangent - low) / (high - low);
    const float *t = m->table[direction];
    return t[k] + (f < 0.0F ? 0.0F : f < 1.0F ? f : 1.0F) * (t[k + 1] - t[k]);
}

float example_masked(const example_masking *m, float x, float y, float z)
{
    const float length2 = x * x + y * y;
    if (!(length2 > 1e-20F))
        return 0.0F;
    const float length = sqrtf(length2), ux = x / length, uy = y / length;
    const float turn = turn_of(uy, ux) * EXAMPLE_MASKING_DIRECTIONS;
    const int d = turn < (float)(EXAMPLE_MASKING_DIRECTIONS - 1) ? (int)turn : EXAMPLE_MASKING_DIRECTIONS - 1;
    const int next = d + 1 < EXAMPLE_MASKING_DIRECTIONS ? d + 1 : 0;
    /* w' = a w1 + b w2, and by convexity E(w', c) <= a E(w1, c / (a + b)) + b E(w2, c / (a + b)). */
    const float *w1 = m->direction[d], *w2 = m->direction[next];
    const float sine = w1[0] * w2[1] - w1[1] * w2[0];
    const float a = fmaxf((ux * w2[1] - uy * w2[0]) / sine, 0.0F), b = fmaxf((w1[0] * uy - w1[1] * ux) / sine, 0.0F);
    const float cotangent = fminf(z / (length * (a + b)), m->steepest);
    return fmaxf(length * (a * look_up(m, d, cotangent) + b * look_up(m, next, cotangent)), 0.0F);
}
