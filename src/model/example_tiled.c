/* Examples side by side, one in every square of the lattice: those that lie alike are walked through together, since
 * whether a tile has the slope is the same in all of them (Xing et al. 2024, section 6.1). */
#include "model/example_kernel.h"

#define GLINT_LANES 1
#include "math/elementary.h"
#include "model/example_tile.h"

static example_look *widest(void)
{
    switch (machine_lanes(MOST_LANES)) {
#if defined(__x86_64__)
    case 16:
        return example_look_16;
    case 8:
        return example_look_8;
#endif
#if defined(__x86_64__) || defined(__aarch64__)
    case 4:
        return example_look_4;
#endif
    default:
        return example_look_1;
    }
}

void example_find_squares(const question *q, example_squares *s, float centre[2][EXAMPLE_MOST_SQUARES])
{
    const lattice *l = &q->e->lattice;
    const extent *r = &q->reach;
    const int left = (int)floor_f(r->at[0] - r->half[0]), right = (int)floor_f(r->at[0] + r->half[0]);
    const int low = (int)floor_f(r->at[1] - r->half[1]), high = (int)floor_f(r->at[1] + r->half[1]);
    s->count = 0;
    for (int j = low; j <= high; j++)
        for (int i = left; i <= right && s->count < EXAMPLE_MOST_SQUARES; i++) {
            const size_t k = s->count++;
            instance n;
            const variant *as = lattice_centre(l, q->f->cell[0], q->f->cell[1], i, j, q->seed, &n.x, &n.y);
            centre[0][k] = n.x;
            centre[1][k] = n.y;
            n.as.to_local = as->to_local;
            instance_local(&n, r->at[0], r->at[1], &s->x[k], &s->y[k]);
            s->x[k] += 0.5F;
            s->y[k] += 0.5F;
            s->kind[k] = (int32_t)((uint32_t)(as - l->variants) % l->kinds);
        }
}

/* The view of a mirror image, from that of the example as it is. */
static example_view mirrored(const example_view *v, const variant *as)
{
    example_view m = *v;
    const float x = as->to_frame.xx, y = as->to_frame.yy; /* 1 or -1 */
    m.slope[0] *= x;
    m.slope[1] *= y;
    m.precision.xy *= x * y;
    m.posterior.xy *= x * y;
    return m;
}

/* So few squares are walked through one after another: most lanes would be empty (cost). */
#define FEW_SQUARES 4

/* Footprints of a few texels go to those at once. */
static int is_small(const example_view *v)
{
    return tile_curve(v, EXAMPLE_LEAST_MAP_LEVEL) > MOST_VARIATION;
}

/* One square after another. */
static void take_singly(const question *q, const example_view *views, const example_squares *s,
                        float centre[2][EXAMPLE_MOST_SQUARES], gathered *sum)
{
    for (size_t i = 0; i < s->count; i++) {
        example_view v = views[s->kind[i]];
        const instance self = { centre[0][i], centre[1][i], q->e->lattice.variants[s->kind[i]] };
        v.self = v.owner = &self;
        v.mean[0] = s->x[i];
        v.mean[1] = s->y[i];
        if (v.palette)
            v.tint_seed = example_tint_seed(q->f, &self, q->seed);
        example_descend(&v, 0, sum);
    }
}

void example_gather_tiled(const question *q, int wants_mass, gathered *sum)
{
    const lattice *l = &q->e->lattice;
    example_squares squares;
    float centre[2][EXAMPLE_MOST_SQUARES];
    example_find_squares(q, &squares, centre);
    const instance unturned = { 0.0F, 0.0F, l->variants[0] };
    example_view views[LATTICE_MIRRORED];
    views[0] = example_view_of(q, &unturned);
    views[0].wants_mass = wants_mass;
    for (uint32_t k = 1; k < l->kinds; k++)
        views[k] = mirrored(views, &l->variants[k]);
    if (views->palette || squares.count <= FEW_SQUARES || is_small(views))
        take_singly(q, views, &squares, centre, sum);
    else
        widest()(views, &squares, sum);
}
