/* A light of any size in cells over which the lobe hardly bends: as many as it takes, each with as many points.
 *
 * A cell that bends the lobe more than the finest rule knows is cut in two across the axis that bends more, and so on
 * while there is room; the worst first, so that what bends most in the end changes little where a light slides. Along
 * both axes a cell has as many points as it takes there.
 */
#include "model/area_cells.h"

#define GLINT_LANES 8
#include "model/area_patch.h"

/* Cells that bend the lobe more are cut. Closer to the finest rule's limit there are fewer cells, but errors of lights
 * with the peak of the lobe in them are all of one sign: too dark. */
#define CUT_FROM 2.1F

/* Of the shares that are left, from where they begin to where they are all: taste. */
#define FADE 0.3F

/* A map by chords has sin^2 of its own angle in it, which Gauss's rules know like a lobe that bends so much. */
#define BEND_OF_TURN 0.65F

/* Taste: four times as many spare few more lights the exact integral. */
enum { MOST_CELLS = 16 };

/* Gauss's rules of 2, 3, 4, 6 and 8 nodes; weights add up to one. */
typedef struct gauss {
    int count;
    float node[CUBATURE_ROW], weight[CUBATURE_ROW];
} gauss;

static const gauss gauss_rule[] = {
    { 2, { -0.577350259F, 0.577350259F }, { 0.5F, 0.5F } },
    { 3, { -0.774596691F, 0.0F, 0.774596691F }, { 0.277777791F, 0.444444448F, 0.277777791F } },
    { 4,
      { -0.861136317F, -0.339981049F, 0.339981049F, 0.861136317F },
      { 0.173927426F, 0.326072574F, 0.326072574F, 0.173927426F } },
    { 6,
      { -0.932469487F, -0.661209404F, -0.238619193F, 0.238619193F, 0.661209404F, 0.932469487F },
      { 0.0856622458F, 0.180380791F, 0.233956963F, 0.233956963F, 0.180380791F, 0.0856622458F } },
    { 8,
      { -0.960289836F, -0.796666503F, -0.525532424F, -0.183434635F, 0.183434635F, 0.525532424F, 0.796666503F,
        0.960289836F },
      { 0.0506142676F, 0.11119052F, 0.156853318F, 0.181341887F, 0.181341887F, 0.156853318F, 0.11119052F,
        0.0506142676F } },
};

/* Middles and halves of widths in the square; how much the lobe bends along both axes. Vectors are full: what follows
 * the last cell repeats the first. */
typedef struct cells {
    int count;
    float x[MOST_CELLS], y[MOST_CELLS], reach_x[MOST_CELLS], reach_y[MOST_CELLS];
    int32_t patch[MOST_CELLS];
    float bend_x[MOST_CELLS], bend_y[MOST_CELLS];
} cells;

/* ---- where to cut ---- */

/* Eight cells from `first` on. */
static void measure_eight(const area_lobe *l, const area_patches *from, cells *all, int first)
{
    const patch p = patches_at(from, load_i(all->patch + first));
    const patch_frame f = patch_frame_of(&p, load_f(all->x + first), load_f(all->y + first),
                                         load_f(all->reach_x + first), load_f(all->reach_y + first));
    const vfloat3 normal = cross_3(f.along_x, f.along_y);
    const vfloat inverse = 1.0F / sqrt_f(max_f(dot_3(f.middle, f.middle), splat(1e-12F)));
    const vfloat3 middle = scale_3(f.middle, inverse);
    const vfloat x2 = dot_3(f.along_x, f.along_x), y2 = dot_3(f.along_y, f.along_y);
    const vfloat x = sqrt_f(x2) * inverse, y = sqrt_f(y2) * inverse;
    const vfloat up_x = abs_f(f.along_x.z) * inverse, up_y = abs_f(f.along_y.z) * inverse;
    const plain_extent extent = { sqrt_f(x2 + y2) * inverse, min_f(up_x + up_y, middle.z),
                                  abs_f(dot_3(normal, middle)) / sqrt_f(max_f(dot_3(normal, normal), splat(1e-30F))) };
    const plain_nearness near = plain_nearness_of(l, middle, &extent);
    store_f(all->bend_x + first,
            max_f(plain_bend_along(l, middle, x, up_x, extent.reach, &near), BEND_OF_TURN * f.turn));
    store_f(all->bend_y + first, plain_bend_along(l, middle, y, up_y, extent.reach, &near));
}

static void copy_cell(cells *all, int from, int to)
{
    all->x[to] = all->x[from];
    all->y[to] = all->y[from];
    all->reach_x[to] = all->reach_x[from];
    all->reach_y[to] = all->reach_y[from];
    all->patch[to] = all->patch[from];
}

static void measure(const area_lobe *l, const area_patches *from, cells *all)
{
    for (int i = all->count; i % GLINT_LANES != 0; i++)
        copy_cell(all, 0, i);
    for (int i = 0; i < all->count; i += GLINT_LANES)
        measure_eight(l, from, all, i);
}

static float bend_of(const cells *all, int i)
{
    return all->bend_x[i] > all->bend_y[i] ? all->bend_x[i] : all->bend_y[i];
}

static int worst_of(const cells *all, int count)
{
    int worst = 0;
    for (int i = 1; i < count; i++)
        worst = bend_of(all, i) > bend_of(all, worst) ? i : worst;
    return worst;
}

static void halve(cells *all, int i)
{
    const int k = all->count++, is_tall = all->bend_x[i] < all->bend_y[i];
    float *const at = is_tall ? all->y : all->x, *const reach = is_tall ? all->reach_y : all->reach_x;
    copy_cell(all, i, k);
    reach[i] = reach[k] = 0.5F * reach[i];
    at[k] = at[i] + reach[i];
    at[i] = at[i] - reach[i];
    all->bend_x[i] = all->bend_y[i] = 0.0F; /* not again before it is measured */
}

static float share_left(float bend, float from)
{
    const float share = (bend - from) * (1.0F / FADE);
    return share < 0.0F ? 0.0F : share < 1.0F ? share : 1.0F;
}

/* Returns the share of the result that cells do not know. */
static float find_cells(const area_lobe *l, const area_patches *from, cells *all)
{
    if (from->count < 1)
        return 1.0F;
    all->count = from->count;
    for (int i = 0; i < from->count; i++) {
        all->x[i] = all->y[i] = 0.0F;
        all->reach_x[i] = all->reach_y[i] = 1.0F;
        all->patch[i] = i;
    }
    measure(l, from, all);
    int worst = worst_of(all, all->count);
    while (bend_of(all, worst) > CUT_FROM && all->count < MOST_CELLS) {
        const int count = all->count;
        while (bend_of(all, worst) > CUT_FROM && all->count < MOST_CELLS) {
            halve(all, worst);
            worst = worst_of(all, count);
        }
        measure(l, from, all);
        worst = worst_of(all, all->count);
    }
    return share_left(bend_of(all, worst), CUT_FROM);
}

/* ---- sums ---- */

/* The points of a cell: of a rule over the square, or rows of Gauss's eight along the axis that bends more. */
typedef struct cell_rule {
    const cubature *square;
    const gauss *rows; /* NULL: the square's */
    int is_tall;
} cell_rule;

static cell_rule rule_of(float bend_x, float bend_y)
{
    cell_rule r = { .square = &cubatures[CUBATURE_SQUARE][CUBATURE_FINE], .is_tall = bend_x < bend_y };
    const float most = r.is_tall ? bend_y : bend_x, least = r.is_tall ? bend_x : bend_y;
    if (most < PLAIN_MIDDLE)
        r.square = &cubatures[CUBATURE_SQUARE][most < PLAIN_COARSE ? CUBATURE_COARSE : CUBATURE_MIDDLE];
    else if (least < PLAIN_MIDDLE || most >= PLAIN_FINE)
        r.rows = &gauss_rule[(least >= PLAIN_SLIGHT) + (least >= PLAIN_COARSE) + (least >= PLAIN_MIDDLE) +
                             (least >= PLAIN_FINE)];
    return r;
}

typedef struct cell_row {
    vfloat x, y, weight;
} cell_row;

static inline cell_row row_of(const cell_rule *r, int k)
{
    if (!r->rows) {
        const float(*const row)[CUBATURE_ROW] = r->square->row[k];
        return (cell_row){ load_f(row[0]), load_f(row[1]), load_f(row[2]) };
    }
    const gauss *const eight = &gauss_rule[4];
    const vfloat along = load_f(eight->node), across = splat(r->rows->node[k]);
    return (cell_row){ r->is_tall ? across : along, r->is_tall ? along : across,
                       r->rows->weight[k] * load_f(eight->weight) };
}

static inline __attribute__((always_inline)) void
add_cells(const area_lobe *l, const area_patches *from, const cells *all, int is_round, int has_base, plain_sums *sum)
{
    for (int i = 0; i < all->count; i++) {
        const cell_rule rule = rule_of(all->bend_x[i], all->bend_y[i]);
        const int count = rule.rows ? rule.rows->count : rule.square->row_count;
        const patch p = patch_at(from, all->patch[i], is_round);
        const float share = all->reach_x[i] * all->reach_y[i];
        for (int k = 0; k < count; k++) {
            const cell_row row = row_of(&rule, k);
            plain_sums terms;
            vfloat area;
            const vfloat3 at =
                patch_point(&p, all->x[i] + all->reach_x[i] * row.x, all->y[i] + all->reach_y[i] * row.y, &area);
            plain_direction_terms(l, at, area * (share * row.weight), has_base, &terms);
            plain_add(sum, &terms, has_base);
        }
    }
}

#if defined(__AVX2__) && defined(GLINT_AREA_QUAD_AVX2)
#define AREA_CELLS_SUM area_cells_sum_avx2
#else
#define AREA_CELLS_SUM area_cells_sum_base
#endif

float AREA_CELLS_SUM(const area_eye *eye, const area_patches *patches, area_node_sums *sums)
{
    const area_lobe lobe = area_lobe_seen(eye);
    cells all;
    const float left = find_cells(&lobe, patches, &all);
    if (left >= 1.0F)
        return left;
    plain_sums sum = plain_no_sums();
    if (patches->is_round)
        add_cells(&lobe, patches, &all, 1, eye->has_base, &sum);
    else
        add_cells(&lobe, patches, &all, 0, eye->has_base, &sum);
    area_fold_sums(&sum, eye->has_base, sums);
    return left;
}
