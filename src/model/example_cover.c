/* Who owns what where scattered examples overlap: the one whose centre is nearest to a sub-region's centre (Xing et al.
 * 2024, Fig. 3). */
#include "model/example_view.h"

#define GLINT_LANES 1
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
    const int left = (int)floor_f(r->at[0] - r->half[0] - spare), right = (int)floor_f(r->at[0] + r->half[0] + spare);
    const int low = (int)floor_f(r->at[1] - r->half[1] - spare), high = (int)floor_f(r->at[1] + r->half[1] + spare);
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

int owns_point(const neighbours *list, const instance *self, rivals r, float x, float y)
{
    float own = 1e30F;
    if (self) {
        const float dx = x - self->x, dy = y - self->y;
        own = dx * dx + dy * dy;
    }
    for (const instance *n = list->at; r; n++, r >>= 1) {
        if (!(r & 1U))
            continue;
        const float dx = x - n->x, dy = y - n->y;
        if (dx * dx + dy * dy < own && instance_covers(n, x, y))
            return 0;
    }
    return 1;
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
        float ahead = -1.0F, margin = 0.0F;
        if (self) {
            const float cx = n->x - self->x, cy = n->y - self->y;
            ahead = d2 - own;
            margin = 2.0F * radius * sqrtf(cx * cx + cy * cy);
        }
        if (d2 >= reach * reach || ahead >= margin) {
            *r &= ~((rivals)1 << k);
            continue;
        }
        float a, b;
        instance_local(n, x, y, &a, &b);
        const float border_a = radius * n->as.row[0], border_b = radius * n->as.row[1];
        if (fabsf(a) > 0.5F + border_a || fabsf(b) > 0.5F + border_b)
            *r &= ~((rivals)1 << k);
        else if (-ahead >= margin && fabsf(a) < 0.5F - border_a && fabsf(b) < 0.5F - border_b)
            return 0;
    }
    return 1;
}
