/* Linearly transformed cosines: a microfacet lobe for one view as a clamped cosine whose directions a matrix has moved.
 */
#include "light/ltc.h"

#include "math/real.h"

/* Where x lies on a grid of LTC_SIDE points from 0 to 1: the point below, and how far behind it. */
static int locate(double x, double *fraction)
{
    const double at = real_min(real_max(x, 0.0), 1.0) * (LTC_SIDE - 1);
    const int i = at < LTC_SIDE - 1 ? (int)at : LTC_SIDE - 2;
    *fraction = at - i;
    return i;
}

ltc ltc_find(ndf_kind kind, double alpha, vec3d wo)
{
    double s, t;
    const int i = locate(sqrt(alpha), &s), j = locate(sqrt(real_max(0.0, 1.0 - wo.z) * (1.0 / 0.99)), &t);
    const float(*table)[LTC_SIDE][LTC_NUMBERS] = ltc_table[kind == NDF_BECKMANN];
    double n[LTC_NUMBERS];
    for (int k = 0; k < LTC_NUMBERS; k++) {
        const double low = (1.0 - t) * (double)table[i][j][k] + t * (double)table[i][j + 1][k];
        const double high = (1.0 - t) * (double)table[i + 1][j][k] + t * (double)table[i + 1][j + 1][k];
        n[k] = (1.0 - s) * low + s * high;
    }
    /* x' = along (x cos - z sin) + shift z, x away from the viewer; y' = across y; z' = z. A view closer to the horizon
     * than the table goes has the table's last lobe. */
    const double sine = sqrt(wo.x * wo.x + wo.y * wo.y);
    const double cosine = real_max(wo.z, 0.01), ex = sine > 0.0 ? -wo.x / sine : 1.0,
                 ey = sine > 0.0 ? -wo.y / sine : 0.0;
    const double along = n[0] * (cosine * cosine + alpha * alpha) / (2.0 * alpha * cosine);
    const double a = along * cosine, b = n[1] * alpha / (2.0 * cosine) - along * real_min(sine, sqrt(1.0 - 1e-4));
    const double across = n[2] / (2.0 * alpha);
    ltc l = {
        .row = { { a * ex, a * ey, b }, { -across * ey, across * ex, 0.0 }, { 0.0, 0.0, 1.0 } },
        .column = { { ex / a, ey / a, 0.0 }, { -ey / across, ex / across, 0.0 }, { -b / a * ex, -b / a * ey, 1.0 } },
        .determinant = a * across,
        .albedo = n[3],
        .schlick = n[4],
        .facets = n[5]
    };
    return l;
}

static vec3d transform(const ltc *l, vec3d v)
{
    return (vec3d){ vec3d_dot(l->row[0], v), vec3d_dot(l->row[1], v), v.z };
}

int ltc_move(const ltc *l, const area_light *light, area_light *moved)
{
    if (light->kind == AREA_POLYGON) {
        vec3d corner[AREA_MOST_CORNERS];
        for (int i = 0; i < light->corner_count; i++)
            corner[i] = transform(l, light->corner[i]);
        area_take_corners(moved, corner, light->corner_count);
        return area_measure(moved);
    }
    const conic *c = &light->cone;
    area_take_cone(moved, transform(l, c->axis_z), vec3d_scale(transform(l, c->axis_x), c->a),
                   vec3d_scale(transform(l, c->axis_y), c->b));
    return area_measure(moved);
}

double ltc_density_over_cosine(const ltc *l, vec3d direction)
{
    const vec3d v = transform(l, direction);
    const double length2 = vec3d_dot(v, v);
    return l->determinant / (REAL_PI * length2 * length2);
}
