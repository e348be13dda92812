/* GLINT_LANES squares of the lattice at a time: the walk of example_density.c through the tiles of the example, where
 * all squares visit a tile together, and those of one kind share what its slopes answer.
 *
 * Which squares a tile is divided in differs; they move up in a list that the four quarters share.
 */
#include "model/example_kernel.h"

#include "math/elementary.h"
#include "model/example_tile.h"

/* A number for each kind of square, as lookup_f reads them. */
typedef struct by_kind {
    float of[8];
} by_kind;

typedef struct tile {
    uint16_t x, y;
    uint16_t level;
    uint16_t lit; /* a bit for each kind in which some of its seeds may have the slope */
} tile;

/* Four quarters for each level that is entered, and the first. */
enum { STACK = 3 * EXAMPLE_MOST_LEVELS + 1 };

/* Sums by the place in a list modulo MOST_LANES, so that every width adds the same numbers in the same order. */
typedef struct sums {
    float value[MOST_LANES], mass[MOST_LANES];
} sums;

/* Of each level the squares that its tiles are looked at in, and a bit for each kind among them. */
typedef struct walk {
    const example_view *views;
    by_kind turn, slope[2]; /* precision.xy and the slope that is asked for */
    example_squares *lists;
    uint32_t kinds[EXAMPLE_MOST_LEVELS];
    sums sums;
} walk;

static inline void add_to(float *lanes, size_t first, vfloat x)
{
    float *const at = lanes + first % MOST_LANES;
    store_f(at, load_f(at) + x);
}

/* Lanes of a list that begins at first; what follows its end is left out. */
static inline vmask within(size_t first, size_t count)
{
    static const float number[MOST_LANES] = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15 };
    return less(load_f(number), splat((float)count - (float)first));
}

static inline vfloat of_kind(const by_kind *numbers, const example_squares *list, size_t first)
{
    return lookup_f(numbers->of, load_i(list->kind + first));
}

/* The footprint's exponent at a place in the example, and its gradient. */
typedef struct offset {
    vfloat gx, gy, exponent;
} offset;

static inline offset offset_from(const walk *w, const example_squares *list, size_t first, float x, float y)
{
    const vfloat dx = load_f(list->x + first) - x, dy = load_f(list->y + first) - y;
    const vfloat xy = of_kind(&w->turn, list, first);
    const covariance2 *p = &w->views->precision;
    offset o = { p->xx * dx + xy * dy, xy * dx + p->yy * dy, splat(0.0F) };
    o.exponent = 0.5F * (dx * o.gx + dy * o.gy);
    return o;
}

/* 1 for the kinds whose bit is set. */
static by_kind flags_of(uint32_t bits)
{
    by_kind flags = { { 0.0F } };
    for (uint32_t k = 0; k < LATTICE_MIRRORED; k++)
        flags.of[k] = (float)(bits >> k & 1U);
    return flags;
}

/* ---- texels ---- */

/* exp(-exponent - d^T C^-1 d / 2) / (2 pi sqrt(det C)) of the slope, C = J posterior J^T + the roughness: Eq. 6, as in
 * example_quad.c. The posterior is h - h P h, h the variance of a seed. */
static inline vfloat texel_density(const walk *w, const example_texel *t, const offset *o, vfloat turn, vfloat slope_x,
                                   vfloat slope_y, vmask near)
{
    const example_view *v = w->views;
    const matrix2 j = t->jacobian;
    const float h = v->e->lattice.seed_variance;
    const vfloat px = h * o->gx, py = h * o->gy, pxy = -h * h * turn;
    const vfloat x = slope_x - t->slope[0] - j.xx * px - j.xy * py;
    const vfloat y = slope_y - t->slope[1] - j.yx * px - j.yy * py;
    const vfloat ax = j.xx * v->posterior.xx + j.xy * pxy, ay = j.xx * pxy + j.xy * v->posterior.yy;
    const vfloat cx = j.yx * v->posterior.xx + j.yy * pxy, cy = j.yx * pxy + j.yy * v->posterior.yy;
    const vfloat xx = ax * j.xx + ay * j.xy + v->slope_variance, xy = ax * j.yx + ay * j.yy;
    const vfloat yy = cx * j.yx + cy * j.yy + v->slope_variance;
    const vfloat det = xx * yy - xy * xy;
    const vfloat e = o->exponent + 0.5F * (yy * x * x - 2.0F * xy * x * y + xx * y * y) / det;
    const vmask seen = near & less(e, splat(2.0F * LAST_EXPONENT));
    if (!any(seen))
        return splat(0.0F);
    return choose(seen, exp_negative(-e) / (2.0F * MATH_PI * sqrt_f(det)), splat(0.0F));
}

static void take_texel(walk *w, const by_kind *lit, uint32_t x, uint32_t y)
{
    const example_view *v = w->views;
    const example_squares *list = &w->lists[0];
    const example_texel t = example_texel_at(v->e, x, y);
    const float area = v->norm * v->texel * v->texel;
    for (size_t i = 0; i < list->count; i += GLINT_LANES) {
        const offset o = offset_from(w, list, i, ((float)x + 0.5F) * v->texel, ((float)y + 0.5F) * v->texel);
        vmask near = less(o.exponent, splat(LAST_EXPONENT)) & within(i, list->count);
        if (v->wants_mass && any(near))
            add_to(w->sums.mass, i, choose(near, area * exp_negative(-o.exponent), splat(0.0F)));
        near = near & less(splat(0.0F), of_kind(lit, list, i));
        if (!any(near))
            continue;
        const vfloat density = texel_density(w, &t, &o, of_kind(&w->turn, list, i), of_kind(&w->slope[0], list, i),
                                             of_kind(&w->slope[1], list, i), near);
        add_to(w->sums.value, i, area * v->slope_scale * density);
    }
}

static void take_quad(walk *w, const tile *t)
{
    const by_kind lit = flags_of(t->lit);
    for (uint32_t k = 0; k < 4; k++)
        take_texel(w, &lit, 2U * t->x + (k & 1U), 2U * t->y + (k >> 1));
}

/* ---- tiles ---- */

/* So that vectors find numbers behind the end. */
static inline void pad(example_squares *list)
{
    memset(list->x + list->count, 0, MOST_LANES * sizeof(float));
    memset(list->y + list->count, 0, MOST_LANES * sizeof(float));
    memset(list->kind + list->count, 0, MOST_LANES * sizeof(int32_t));
}

/* Appends the squares that are set; returns a bit for each kind among them. */
static inline uint32_t move_up(const example_squares *list, size_t first, vmask set, example_squares *up)
{
    int32_t bits[GLINT_LANES];
    const vint taken = mask_bits(set);
    memcpy(bits, &taken, sizeof(bits));
    uint32_t kinds = 0;
    size_t count = up->count;
    for (size_t k = 0; k < GLINT_LANES; k++) {
        up->x[count] = list->x[first + k];
        up->y[count] = list->y[first + k];
        up->kind[count] = list->kind[first + k];
        kinds |= ((uint32_t)bits[k] & 1U) << list->kind[first + k];
        count += (uint32_t)bits[k] & 1U;
    }
    up->count = count;
    return kinds;
}

/* How dense the slope is in a tile, for the kinds whose bits are set. */
static by_kind densities(const walk *w, const tile *t, uint32_t kinds)
{
    by_kind density = { { 0.0F } };
    for (uint32_t k = 0; k < LATTICE_MIRRORED; k++)
        if (kinds >> k & 1U)
            density.of[k] = tile_density(&w->views[k], t->level, t->x, t->y);
    return density;
}

/* Takes a tile in some squares, skips it in others; those where its quarters are to be looked at move up. */
static void take_tile(walk *w, const tile *t)
{
    const example_view *v = w->views;
    const example_squares *list = &w->lists[t->level];
    example_squares *up = &w->lists[t->level - 1];
    const uint32_t asked = t->lit & w->kinds[t->level];
    const int is_tried = t->level >= LEAST_TRIED_LEVEL;
    const float side = (float)(2 << t->level) * v->texel, half = 0.5F * side;
    const float x = ((float)t->x + 0.5F) * side, y = ((float)t->y + 0.5F) * side, curve = tile_curve(v, t->level);
    int is_known = 0;
    by_kind density, lit;
    if (!is_tried)
        lit = flags_of(asked);
    up->count = 0;
    w->kinds[t->level - 1] = 0;
    for (size_t i = 0; i < list->count; i += GLINT_LANES) {
        const offset o = offset_from(w, list, i, x, y);
        /* The exponent is convex: it lies above its tangent. */
        const vfloat change = half * (abs_f(o.gx) + abs_f(o.gy));
        const vfloat nearest = max_f(o.exponent - change, splat(0.0F));
        vmask near = less_equal(o.exponent - change, splat(LAST_EXPONENT)) & within(i, list->count);
        const vfloat rarity = 1.0F + nearest + 0.5F * nearest * nearest; /* below exp(nearest) */
        const vmask varies = less(MOST_VARIATION * rarity, change + curve);
        if (!any(near))
            continue;
        if (!is_known && (is_tried || any(near & ~varies))) {
            density = densities(w, t, asked);
            is_known = 1;
            if (is_tried)
                lit = density;
        }
        if (!v->wants_mass)
            near = near & less(splat(0.0F), of_kind(&lit, list, i));
        const vmask whole = near & ~varies;
        if (any(near & varies))
            w->kinds[t->level - 1] |= move_up(list, i, near & varies, up);
        if (!any(whole))
            continue;
        const vfloat mass = choose(whole, v->norm * side * side * exp_negative(-o.exponent), splat(0.0F));
        add_to(w->sums.mass, i, mass);
        add_to(w->sums.value, i, mass * (v->slope_scale * of_kind(&density, list, i)));
    }
    if (up->count > 0)
        pad(up);
}

static int push_quarters(const walk *w, const tile *t, tile *stack, int height)
{
    uint32_t lit[LATTICE_MIRRORED] = { 0 };
    for (uint32_t k = 0; k < LATTICE_MIRRORED; k++)
        if (w->kinds[t->level - 1] >> k & 1U)
            lit[k] = example_lit_quarters(&w->views[k], t->level, t->x, t->y);
    for (uint32_t q = 0; q < 4; q++) {
        uint32_t kinds = 0;
        for (uint32_t k = 0; k < LATTICE_MIRRORED; k++)
            kinds |= (lit[k] >> q & 1U) << k;
        if (kinds || w->views->wants_mass)
            stack[height++] = (tile){ (uint16_t)(2U * t->x + (q & 1U)), (uint16_t)(2U * t->y + (q >> 1)),
                                      (uint16_t)(t->level - 1U), (uint16_t)kinds };
    }
    return height;
}

static void begin(walk *w, const example_squares *squares, uint16_t top)
{
    example_squares *list = &w->lists[top];
    list->count = squares->count;
    memcpy(list->x, squares->x, squares->count * sizeof(float));
    memcpy(list->y, squares->y, squares->count * sizeof(float));
    memcpy(list->kind, squares->kind, squares->count * sizeof(int32_t));
    pad(list);
    const uint32_t kinds = w->views->e->lattice.kinds;
    w->kinds[top] = (1U << kinds) - 1U;
    for (uint32_t k = 0; k < LATTICE_MIRRORED; k++) {
        const example_view *v = &w->views[k < kinds ? k : 0];
        w->turn.of[k] = v->precision.xy;
        w->slope[0].of[k] = v->slope[0];
        w->slope[1].of[k] = v->slope[1];
    }
}

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

void JOIN(example_look_, GLINT_LANES)(const example_view *views, const example_squares *squares, gathered *sum)
{
    example_squares lists[EXAMPLE_MOST_LEVELS];
    walk w = { .views = views, .lists = lists };
    const uint16_t top = (uint16_t)(views->e->levels - 1U);
    begin(&w, squares, top);
    tile stack[STACK];
    stack[0] = (tile){ 0, 0, top, (uint16_t)w.kinds[top] };
    for (int height = 1; height > 0;) {
        const tile t = stack[--height];
        if (t.level == 0) {
            take_quad(&w, &t);
            continue;
        }
        take_tile(&w, &t);
        if (lists[t.level - 1].count > 0)
            height = push_quarters(&w, &t, stack, height);
    }
    for (int k = 0; k < MOST_LANES; k++) {
        sum->value += w.sums.value[k];
        sum->mass += w.sums.mass[k];
    }
}
