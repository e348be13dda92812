/* Who owns what where scattered examples overlap: the one whose centre is nearest to a sub-region's centre (Xing et al.
 * 2024, Fig. 3). */
#include "model/example_view.h"

#define GLINT_LANES 4
#include "math/lanes.h"

/* Whether the footprint comes within a radius of (x, y). */
static int comes_near(const extent *r, float x, float y, float radius)
{
    const float dx = x - r->at[0], dy = y - r->at[1], reach = r->radius + radius;
    return fabsf(dx) <= r->half[0] + radius && fabsf(dy) <= r->half[1] + radius && dx * dx + dy * dy <= reach * reach;
}

void neighbours_find(const lattice *l, const example_footprint *f, const extent *r, uint32_t seed, neighbours *list)
{
    /* Centres lie up to half the jitter away from the middle of their square. */
    const float spare = l->most_radius + 0.5F * l->jitter - 0.5F;
    const int left = (int)floorf(r->at[0] - r->half[0] - spare), right = (int)floorf(r->at[0] + r->half[0] + spare);
    const int low = (int)floorf(r->at[1] - r->half[1] - spare), high = (int)floorf(r->at[1] + r->half[1] + spare);
    list->count = 0;
    for (int j = low; j <= high; j++)
        for (int i = left; i <= right && list->count < MOST_NEAR; i++) {
            instance *n = &list->at[list->count];
            const variant *v = lattice_centre(l, f->cell[0], f->cell[1], i, j, seed, &n->x, &n->y);
            if (!comes_near(r, n->x, n->y, v->radius))
                continue;
            n->as = *v;
            float a, b;
            instance_local(n, r->at[0], r->at[1], &a, &b);
            list->count += fabsf(a) <= 0.5F + r->radius * v->row[0] && fabsf(b) <= 0.5F + r->radius * v->row[1];
        }
}

rivals rivals_of(const neighbours *list, int self)
{
    const rivals all = list->count == MOST_NEAR ? ~(rivals)0 : ((rivals)1 << list->count) - 1;
    return self < 0 ? all : all & ~((rivals)1 << self);
}

uint32_t quarters_owned(const neighbours *list, const instance *self, rivals r, const float at[2], const float right[2],
                        const float up[2])
{
    const vfloat across = { -1.0F, 1.0F, -1.0F, 1.0F }, along = { -1.0F, -1.0F, 1.0F, 1.0F };
    const vfloat x = at[0] + across * right[0] + along * up[0], y = at[1] + across * right[1] + along * up[1];
    vfloat own = splat(1e30F);
    if (self) {
        const vfloat dx = x - self->x, dy = y - self->y;
        own = dx * dx + dy * dy;
    }
    vmask lost = { 0, 0, 0, 0 };
    for (const instance *n = list->at; r; n++, r >>= 1) {
        if (!(r & 1U))
            continue;
        const matrix2 m = n->as.to_local;
        const vfloat dx = x - n->x, dy = y - n->y;
        const vfloat a = abs_f(m.xx * dx + m.xy * dy), b = abs_f(m.yx * dx + m.yy * dy);
        lost |= less(dx * dx + dy * dy, own) & less_equal(max_f(a, b), splat(0.5F));
    }
    return (lost[0] ? 0U : 1U) | (lost[1] ? 0U : 2U) | (lost[2] ? 0U : 4U) | (lost[3] ? 0U : 8U);
}

int rivals_within(const neighbours *list, const instance *self, rivals *r, float x, float y, float radius)
{
    float own = 0.0F;
    if (self) {
        const float dx = x - self->x, dy = y - self->y;
        own = dx * dx + dy * dy;
    }
    rivals left = *r;
    for (int k = 0; left; k++, left >>= 1) {
        if (!(left & 1U))
            continue;
        const instance *n = &list->at[k];
        const float dx = x - n->x, dy = y - n->y, d2 = dx * dx + dy * dy, reach = n->as.radius + radius;
        /* The distance to the line between both is (d2 - own) / (2 |centre - centre|). */
        float ahead = -1.0F, margin2 = 0.0F;
        if (self) {
            const float cx = n->x - self->x, cy = n->y - self->y;
            ahead = d2 - own;
            margin2 = 4.0F * radius * radius * (cx * cx + cy * cy);
        }
        const int is_decided = ahead * ahead >= margin2;
        if (d2 >= reach * reach || (is_decided && ahead > 0.0F)) {
            *r &= ~((rivals)1 << k);
            continue;
        }
        float a, b;
        instance_local(n, x, y, &a, &b);
        const float border_a = radius * n->as.row[0], border_b = radius * n->as.row[1];
        if (fabsf(a) > 0.5F + border_a || fabsf(b) > 0.5F + border_b)
            *r &= ~((rivals)1 << k);
        else if (is_decided && fabsf(a) < 0.5F - border_a && fabsf(b) < 0.5F - border_b)
            return 0;
    }
    return 1;
}
