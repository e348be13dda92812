/* The cone of directions over an ellipse, in the frame of its own axes, cut at the horizon.
 *
 * A linear transform of such a cone is one again, so that linearly transformed cosines integrate over disks and spheres
 * as exactly as over polygons. Heitz and Hill 2017 find the axes by the roots of a cubic and clip at the horizon by a
 * table; here the horizon cuts the rim itself, and the integral over the arc that is left has a closed form.
 */
#include "light/conic.h"

#include "math/real.h"

/* Below this, squared sines of half angles are rounding. */
#define LEAST_SIZE 1e-26

/* K = a a^T + b b^T - c c^T: its eigenvectors are the axes of the cone over c + x a + y b, its eigenvalues those of
 * tangents squared, and one negative. */
typedef struct dual {
    vec3d a, b, c;
} dual;

static vec3d dual_row(const dual *k, double ax, double bx, double cx)
{
    return vec3d_add(vec3d_scale(k->a, ax), vec3d_mad(vec3d_scale(k->b, bx), k->c, -cx));
}

static double dual_form(const dual *k, vec3d u, vec3d v)
{
    return vec3d_dot(k->a, u) * vec3d_dot(k->a, v) + vec3d_dot(k->b, u) * vec3d_dot(k->b, v) -
           vec3d_dot(k->c, u) * vec3d_dot(k->c, v);
}

/* K(u, u) K(v, v) - K(u, v)^2, which would lose a long ellipse's digits, by squares of areas (Cauchy and Binet). */
static double dual_minor(const dual *k, vec3d u, vec3d v)
{
    const double au = vec3d_dot(k->a, u), av = vec3d_dot(k->a, v), bu = vec3d_dot(k->b, u), bv = vec3d_dot(k->b, v);
    const double cu = vec3d_dot(k->c, u), cv = vec3d_dot(k->c, v);
    const double ab = au * bv - av * bu, ac = au * cv - av * cu, bc = bu * cv - bv * cu;
    return ab * ab - ac * ac - bc * bc;
}

/* The negative eigenvalue. Newton's method from below it, where the characteristic polynomial is monotone: the largest
 * |eigenvalue| that c alone can make is |c|^2. */
static double negative_eigenvalue(const dual *k)
{
    const vec3d x = dual_row(k, k->a.x, k->b.x, k->c.x), y = dual_row(k, k->a.y, k->b.y, k->c.y),
                z = dual_row(k, k->a.z, k->b.z, k->c.z);
    const double trace = x.x + y.y + z.z;
    const double minors = (x.x * y.y - x.y * x.y) + (x.x * z.z - x.z * x.z) + (y.y * z.z - y.z * y.z);
    const double volume = vec3d_dot(k->a, vec3d_cross(k->b, k->c));
    const double determinant = -volume * volume;
    double e = -vec3d_dot(k->c, k->c);
    for (int i = 0; i < 40; i++) {
        const double value = ((e - trace) * e + minors) * e - determinant;
        const double slope = (3.0 * e - 2.0 * trace) * e + minors;
        if (!(value < 0.0) || !(slope > 0.0))
            break;
        const double step = -value / slope;
        e += step;
        /* The root is simple, and a step squares what is left. */
        if (!(step > -1e-8 * e))
            break;
    }
    return e;
}

/* The eigenvector of a symmetric matrix of rank two: the longest cross product of its rows. */
static vec3d kernel_of(vec3d x, vec3d y, vec3d z)
{
    const vec3d n[3] = { vec3d_cross(x, y), vec3d_cross(y, z), vec3d_cross(z, x) };
    int best = 0;
    for (int i = 1; i < 3; i++)
        if (vec3d_dot(n[i], n[i]) > vec3d_dot(n[best], n[best]))
            best = i;
    return vec3d_normalize(n[best]);
}

/* The cone does not change when all three are scaled. 0: they are no numbers to speak of. */
static int dual_of(vec3d center, vec3d half_x, vec3d half_y, dual *k)
{
    const double size2 = vec3d_dot(center, center) + vec3d_dot(half_x, half_x) + vec3d_dot(half_y, half_y);
    if (!(size2 > 1e-60 && size2 < 1e60))
        return 0;
    const double scale = 1.0 / sqrt(size2);
    *k = (dual){ vec3d_scale(half_x, scale), vec3d_scale(half_y, scale), vec3d_scale(center, scale) };
    return 1;
}

int conic_make(conic *c, vec3d center, vec3d half_x, vec3d half_y)
{
    dual k;
    if (!dual_of(center, half_x, half_y, &k))
        return 0;
    const double negative = negative_eigenvalue(&k);
    if (!(negative < -1e-30))
        return 0;
    vec3d x = dual_row(&k, k.a.x, k.b.x, k.c.x), y = dual_row(&k, k.a.y, k.b.y, k.c.y),
          z = dual_row(&k, k.a.z, k.b.z, k.c.z);
    x.x -= negative;
    y.y -= negative;
    z.z -= negative;
    vec3d axis = kernel_of(x, y, z);
    if (vec3d_dot(axis, k.c) < 0.0)
        axis = vec3d_scale(axis, -1.0);
    if (!(vec3d_dot(axis, axis) > 0.5))
        return 0;
    /* What is left is a symmetric 2 x 2 matrix in the plane normal to the axis; its axes by the half-angle formulas. */
    const vec3d u = vec3d_any_normal(axis), v = vec3d_cross(axis, u);
    const double uu = dual_form(&k, u, u), vv = dual_form(&k, v, v), uv = dual_form(&k, u, v);
    const double half_sum = 0.5 * (uu + vv), half_difference = 0.5 * (uu - vv);
    const double radius = sqrt(half_difference * half_difference + uv * uv);
    double cosine = 1.0, sine = 0.0;
    if (radius > 1e-14 * half_sum && radius > 0.0) {
        const double c2 = half_difference / radius;
        cosine = sqrt(real_max(0.0, 0.5 * (1.0 + c2)));
        sine = (uv < 0.0 ? -1.0 : 1.0) * sqrt(real_max(0.0, 0.5 * (1.0 - c2)));
    }
    const double a2 = (half_sum + radius) / -negative;
    const double b2 = half_sum + radius > 0.0 ? dual_minor(&k, u, v) / (half_sum + radius) / -negative : 0.0;
    if (!(b2 > LEAST_SIZE && a2 < 1e30))
        return 0;
    *c = (conic){ .axis_x = vec3d_mad(vec3d_scale(u, cosine), v, sine), .axis_z = axis, .a = sqrt(a2), .b = sqrt(b2) };
    c->axis_y = vec3d_cross(axis, c->axis_x);
    return 1;
}

static void bisect(conic *c, int from, int middle, int to)
{
    const double x = c->node[from][0] + c->node[to][0], y = c->node[from][1] + c->node[to][1];
    const double length = sqrt(x * x + y * y);
    c->node[middle][0] = length > 0.0 ? x / length : c->node[from][0];
    c->node[middle][1] = length > 0.0 ? y / length : c->node[from][1];
}

int conic_cut(conic *c)
{
    /* Height of the rim: axis_z.z + reach cos(t - t0), t0 the direction of (c0, s0). */
    const double x = c->a * c->axis_x.z, y = c->b * c->axis_y.z, reach = sqrt(x * x + y * y);
    c->is_cut = 0;
    if (c->axis_z.z <= -reach)
        return 0;
    const double c0 = reach > 0.0 ? x / reach : 1.0, s0 = reach > 0.0 ? y / reach : 0.0;
    double cosine = -1.0, sine = 0.0;
    if (c->axis_z.z < reach) {
        c->is_cut = 1;
        cosine = -c->axis_z.z / reach;
        sine = sqrt(real_max(0.0, (1.0 - cosine) * (1.0 + cosine)));
    }
    c->node[2][0] = c0;
    c->node[2][1] = s0;
    c->node[0][0] = c0 * cosine + s0 * sine;
    c->node[0][1] = s0 * cosine - c0 * sine;
    c->node[4][0] = c0 * cosine - s0 * sine;
    c->node[4][1] = s0 * cosine + c0 * sine;
    if (c->is_cut) {
        bisect(c, 0, 1, 2);
        bisect(c, 2, 3, 4);
        return 1;
    }
    c->node[1][0] = s0;
    c->node[1][1] = -c0;
    c->node[3][0] = -s0;
    c->node[3][1] = c0;
    return 1;
}

vec3d conic_moment(const conic *c)
{
    /* 1/2 of the integral of p x p' / |p|^2 along the rim, p = (a cos t, b sin t, 1) in the cone's own frame. */
    const double root_a = sqrt(1.0 + c->a * c->a), root_b = sqrt(1.0 + c->b * c->b);
    if (!c->is_cut)
        return vec3d_scale(c->axis_z, REAL_PI * c->a * c->b / (root_a * root_b));
    /* p x p' = (-b cos t, -a sin t, a b), |p|^2 = root_a^2 - k sin^2 t = root_b^2 + k cos^2 t. */
    const double k = sqrt(real_max(0.0, (c->a - c->b) * (c->a + c->b)));
    double x = 0.0, y = 0.0, turn = 0.0;
    for (int i = 0; i <= CONIC_ARCS; i += CONIC_ARCS) {
        const double sign = i > 0 ? 1.0 : -1.0, cosine = c->node[i][0], sine = c->node[i][1];
        x -= sign * c->b * sine * real_atanh_over(k * sine / root_a) / (root_a * root_a);
        y += sign * c->a * cosine * real_atan_over(k * cosine / root_b) / (root_b * root_b);
    }
    for (int i = 0; i < CONIC_ARCS; i++) {
        const double x0 = root_a * c->node[i][0], y0 = root_b * c->node[i][1];
        const double x1 = root_a * c->node[i + 1][0], y1 = root_b * c->node[i + 1][1];
        turn += real_atan2(x0 * y1 - y0 * x1, x0 * x1 + y0 * y1);
    }
    const double z = c->a * c->b * turn / (root_a * root_b);
    const vec3d arc =
        vec3d_add(vec3d_mad(vec3d_scale(c->axis_x, 0.5 * x), c->axis_y, 0.5 * y), vec3d_scale(c->axis_z, 0.5 * z));
    /* The line along the horizon, from the last node to the first: its angle, upright. From one end and the way to the
     * other: the product of two directions that are nearly the same would have no digit of a small light. */
    const double *last = c->node[CONIC_ARCS], *first = c->node[0];
    const vec3d from =
        vec3d_add(c->axis_z, vec3d_mad(vec3d_scale(c->axis_x, c->a * last[0]), c->axis_y, c->b * last[1]));
    const vec3d way =
        vec3d_mad(vec3d_scale(c->axis_x, c->a * (first[0] - last[0])), c->axis_y, c->b * (first[1] - last[1]));
    const double cross = from.x * way.y - from.y * way.x, along = from.x * way.x + from.y * way.y;
    const vec3d line = { 0.0, 0.0, 0.5 * real_atan2(cross, from.x * from.x + from.y * from.y + along) };
    return vec3d_add(arc, line);
}
