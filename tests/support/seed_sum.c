#include "seed_sum.h"

#include <math.h>
#include <stdlib.h>

static seed_matrix product(seed_matrix a, seed_matrix b)
{
    return (seed_matrix){ a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx,
                          a.yx * b.xy + a.yy * b.yy };
}

static seed_matrix transposed(seed_matrix a)
{
    return (seed_matrix){ a.xx, a.yx, a.xy, a.yy };
}

static seed_matrix inverse(seed_matrix a)
{
    const double d = a.xx * a.yy - a.xy * a.yx;
    return (seed_matrix){ a.yy / d, -a.xy / d, -a.yx / d, a.xx / d };
}

static void covariance(seed_matrix m, double variance, double c[3])
{
    const seed_matrix p = product(m, transposed(m));
    c[0] = variance * p.xx;
    c[1] = variance * p.xy;
    c[2] = variance * p.yy;
}

static void slope_of(const glint_example *e, int x, int y, double slope[2])
{
    const float *n = e->normals + ((size_t)y * e->size + (size_t)x) * e->components;
    const double a = (double)n[0], b = (double)n[1];
    const double z = e->components == 3 ? (double)n[2] : sqrt(1.0 - a * a - b * b);
    slope[0] = a / z;
    slope[1] = b / z;
}

/* Central differences; tiled examples go on around the edge, scattered ones end there. */
static seed_matrix jacobian_of(const glint_example *e, int x, int y)
{
    const int n = (int)e->size, around = e->placement == GLINT_EXAMPLE_TILED;
    double s[4][2];
    for (int k = 0; k < 4; k++) {
        int i = x + (k == 0 ? -1 : k == 1 ? 1 : 0), j = y + (k == 2 ? -1 : k == 3 ? 1 : 0);
        i = around ? (i + n) % n : i < 0 ? 0 : i == n ? n - 1 : i;
        j = around ? (j + n) % n : j < 0 ? 0 : j == n ? n - 1 : j;
        slope_of(e, i, j, s[k]);
    }
    return (seed_matrix){ 0.5 * n * (s[1][0] - s[0][0]), 0.5 * n * (s[3][0] - s[2][0]), 0.5 * n * (s[1][1] - s[0][1]),
                          0.5 * n * (s[3][1] - s[2][1]) };
}

static int covers(const seed_instance *n, const double at[2])
{
    const seed_matrix m = inverse(n->map);
    const double x = at[0] - n->at[0], y = at[1] - n->at[1];
    return fabs(m.xx * x + m.xy * y) <= 0.5 && fabs(m.yx * x + m.yy * y) <= 0.5;
}

/* Half the diagonal of the largest example that the library takes, and a bit. */
static const double FARTHEST = 1.07;

static int is_seen(const seed_instance *all, size_t count, size_t self, const double at[2])
{
    const double own = hypot(at[0] - all[self].at[0], at[1] - all[self].at[1]);
    for (size_t k = 0; k < count; k++)
        if (k != self && !all[k].is_ground && fabs(at[0] - all[k].at[0]) < FARTHEST &&
            fabs(at[1] - all[k].at[1]) < FARTHEST &&
            (all[self].is_ground || hypot(at[0] - all[k].at[0], at[1] - all[k].at[1]) < own) && covers(&all[k], at))
            return 0;
    return 1;
}

seed_surface seed_surface_export(const glint_example *e, double sigma_r, const seed_instance *instances, size_t count)
{
    const int n = (int)e->size;
    const int tiled = e->placement == GLINT_EXAMPLE_TILED;
    seed_surface s = { malloc(count * (size_t)(n * n) * sizeof(seed_gaussian)), 0 };
    for (size_t k = 0; k < count; k++)
        for (int i = 0; i < n * n; i++) {
            const int x = i % n, y = i / n;
            const seed_matrix m = instances[k].map, back = inverse(m), tilt = transposed(back);
            const double px = (x + 0.5) / n - 0.5, py = (y + 0.5) / n - 0.5;
            seed_gaussian g = { .at = { instances[k].at[0] + m.xx * px + m.xy * py,
                                        instances[k].at[1] + m.yx * px + m.yy * py } };
            if (!tiled && !is_seen(instances, count, k, g.at))
                continue;
            if (!instances[k].is_ground) {
                double slope[2];
                slope_of(e, x, y, slope);
                g.slope[0] = tilt.xx * slope[0] + tilt.xy * slope[1];
                g.slope[1] = tilt.yx * slope[0] + tilt.yy * slope[1];
                if (!e->flat)
                    g.jacobian = product(tilt, product(jacobian_of(e, x, y), back));
            }
            covariance(m, (double)e->sigma_h / n * (double)e->sigma_h / n, g.place);
            covariance(tilt, sigma_r * sigma_r, g.roughness);
            g.area = fabs(m.xx * m.yy - m.xy * m.yx) / (n * n);
            s.seeds[s.count++] = g;
        }
    return s;
}

void seed_surface_slope(const glint_example *e, const seed_instance *instances, size_t count, const double at[2],
                        double slope[2])
{
    const seed_instance *owner = NULL;
    double best = 1e30;
    for (size_t k = 0; k < count; k++) {
        const double away = hypot(at[0] - instances[k].at[0], at[1] - instances[k].at[1]);
        if (!instances[k].is_ground && away < best && covers(&instances[k], at)) {
            best = away;
            owner = &instances[k];
        }
    }
    slope[0] = slope[1] = 0.0;
    if (!owner)
        return;
    const seed_matrix back = inverse(owner->map), tilt = transposed(back);
    const double dx = at[0] - owner->at[0], dy = at[1] - owner->at[1], n = e->size;
    const int x = (int)fmin(fmax((back.xx * dx + back.xy * dy + 0.5) * n, 0.0), n - 1.0);
    const int y = (int)fmin(fmax((back.yx * dx + back.yy * dy + 0.5) * n, 0.0), n - 1.0);
    double own[2];
    slope_of(e, x, y, own);
    slope[0] = tilt.xx * own[0] + tilt.xy * own[1];
    slope[1] = tilt.yx * own[0] + tilt.yy * own[1];
}

/* exp(-d^T C^-1 d / 2) / (2 pi sqrt(det C)) */
static double gaussian(const double c[3], double x, double y)
{
    const double det = c[0] * c[2] - c[1] * c[1];
    return exp(-0.5 * (c[2] * x * x - 2.0 * c[1] * x * y + c[0] * y * y) / det) /
           (2.0 * 3.14159265358979323846 * sqrt(det));
}

double seed_surface_density(const seed_surface *s, const double at[2], const double spread[3], const double slope[2],
                            double light_variance)
{
    double value = 0.0, mass = 0.0;
    for (size_t k = 0; k < s->count; k++) {
        const seed_gaussian *g = &s->seeds[k];
        const double c[3] = { spread[0] + g->place[0], spread[1] + g->place[1], spread[2] + g->place[2] };
        const double dx = at[0] - g->at[0], dy = at[1] - g->at[1];
        const double weight = g->area * gaussian(c, dx, dy);
        if (weight < 1e-20)
            continue;
        /* Where in the seed the footprint lies: mean and covariance given both. */
        const seed_matrix joint = inverse((seed_matrix){ c[0], c[1], c[1], c[2] });
        const seed_matrix place = { g->place[0], g->place[1], g->place[1], g->place[2] };
        const seed_matrix gain = product(place, joint), taken = product(gain, place);
        const double ux = gain.xx * dx + gain.xy * dy, uy = gain.yx * dx + gain.yy * dy;
        const seed_matrix left = { place.xx - taken.xx, place.xy - taken.xy, place.yx - taken.yx, place.yy - taken.yy };
        const seed_matrix j = g->jacobian, spread_slope = product(j, product(left, transposed(j)));
        const double r[3] = { g->roughness[0] + light_variance + spread_slope.xx, g->roughness[1] + spread_slope.xy,
                              g->roughness[2] + light_variance + spread_slope.yy };
        value += weight * gaussian(r, slope[0] - g->slope[0] - j.xx * ux - j.xy * uy,
                                   slope[1] - g->slope[1] - j.yx * ux - j.yy * uy);
        mass += weight;
    }
    return value / mass;
}
