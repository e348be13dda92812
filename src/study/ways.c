/* Ways to integrate over a rectangle: its middle, the library's integrals, Gauss's rules of growing order, and points
 * at random. */
#include "study/ways.h"

#include <math.h>

const char *const way_names[WAYS] = {
    [WAY_POINT] = "point",         [WAY_CAP] = "cap",
    [WAY_FAST] = "fast (LTC)",     [WAY_EXACT] = "exact",
    [WAY_GAUSS_2] = "Gauss 2 x 2", [WAY_GAUSS_4] = "Gauss 4 x 4",
    [WAY_GAUSS_8] = "Gauss 8 x 8", [WAY_GAUSS_16] = "Gauss 16 x 16",
    [WAY_RANDOM_4] = "4 random",   [WAY_RANDOM_16] = "16 random",
    [WAY_RANDOM_64] = "64 random", [WAY_RANDOM_256] = "256 random",
};

/* Along a side, where they are Gauss's; in all, where they are at random. */
static const int points_of[WAYS] = {
    [WAY_GAUSS_2] = 2,  [WAY_GAUSS_4] = 4,    [WAY_GAUSS_8] = 8,    [WAY_GAUSS_16] = 16,
    [WAY_RANDOM_4] = 4, [WAY_RANDOM_16] = 16, [WAY_RANDOM_64] = 64, [WAY_RANDOM_256] = 256,
};

/* The half of Gauss and Legendre's nodes on [-1, 1] that is above 0, of 2, 4, 8 and 16 points, and their weights. */
static const double nodes[4][8] = {
    { 0.577350269189625765 },
    { 0.339981043584856265, 0.861136311594052575 },
    { 0.183434642495649805, 0.525532409916328986, 0.796666477413626740, 0.960289856497536232 },
    { 0.095012509837637440, 0.281603550779258913, 0.458016777657227386, 0.617876244402643748, 0.755404408355003034,
      0.865631202387831744, 0.944575023073232576, 0.989400934991649933 },
};
static const double weights[4][8] = {
    { 1.0 },
    { 0.652145154862546143, 0.347854845137453857 },
    { 0.362683783378361983, 0.313706645877887287, 0.222381034453374471, 0.101228536290376259 },
    { 0.189450610455068496, 0.182603415044923589, 0.169156519395002538, 0.149595988816576732, 0.124628971255533872,
      0.095158511682492785, 0.062253523938647893, 0.027152459411754095 },
};

/* What the lobe sends from the point (x, y) in [-1, 1]^2, with the solid angle there is to a unit of x and y. */
static double at_point(const glint_material *m, const glint_surface *s, const area_case *c, double x, double y,
                       double *solid_angle)
{
    const glint_area_light *const l = &c->light;
    double p[3], length2 = 0.0, facing = 0.0;
    for (int k = 0; k < 3; k++) {
        p[k] = (double)l->center[k] + x * (double)l->half_x[k] + y * (double)l->half_y[k];
        length2 += p[k] * p[k];
    }
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        facing += p[k] * ((double)l->half_x[a] * (double)l->half_y[b] - (double)l->half_x[b] * (double)l->half_y[a]);
    }
    const double length = sqrt(length2);
    const float wi[3] = { (float)(p[0] / length), (float)(p[1] / length), (float)(p[2] / length) };
    float rgb[3];
    glint_eval(m, s, NULL, c->wo, wi, NULL, rgb);
    *solid_angle = fabs(facing) / (length2 * length);
    return (double)rgb[0];
}

static double sample(const glint_material *m, const glint_surface *s, const area_case *c, double x, double y)
{
    double solid_angle;
    const double lobe = at_point(m, s, c, x, y, &solid_angle);
    return lobe * solid_angle;
}

/* Of a triangle of directions of any length: Van Oosterom and Strackee 1983. */
static double triangle_sr(const double a[3], const double b[3], const double c[3])
{
    const double volume =
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    const double ab = a[0] * b[0] + a[1] * b[1] + a[2] * b[2], bc = b[0] * c[0] + b[1] * c[1] + b[2] * c[2],
                 ca = c[0] * a[0] + c[1] * a[1] + c[2] * a[2];
    const double la = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]), lb = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]),
                 lc = sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    return 2.0 * fabs(atan2(volume, la * lb * lc + ab * lc + bc * la + ca * lb));
}

/* All that the light fills, as if it were around its middle. */
static double cap(const glint_material *m, const glint_surface *s, const area_case *c)
{
    double corner[4][3], unused;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++)
            corner[i][k] = (double)c->light.center[k] + (i == 0 || i == 3 ? 1.0 : -1.0) * (double)c->light.half_x[k] +
                           (i < 2 ? 1.0 : -1.0) * (double)c->light.half_y[k];
    return at_point(m, s, c, 0.0, 0.0, &unused) *
           (triangle_sr(corner[0], corner[1], corner[2]) + triangle_sr(corner[0], corner[2], corner[3]));
}

static double gauss(int count, const glint_material *m, const glint_surface *s, const area_case *c)
{
    const int rule = count == 2 ? 0 : count == 4 ? 1 : count == 8 ? 2 : 3;
    double sum = 0.0;
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++) {
            const double x = nodes[rule][i / 2], y = nodes[rule][j / 2];
            sum += weights[rule][i / 2] * weights[rule][j / 2] * sample(m, s, c, i % 2 ? x : -x, j % 2 ? y : -y);
        }
    return sum;
}

static double at_random(int count, const glint_material *m, const glint_surface *s, const area_case *c,
                        uint64_t *random)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        const double x = random_between(random, -1.0, 1.0);
        sum += sample(m, s, c, x, random_between(random, -1.0, 1.0));
    }
    return 4.0 * sum / count;
}

double way_integrate(integral_way w, const glint_material *const m[2], const glint_surface *s, const area_case *c,
                     uint64_t *random)
{
    glint_value v;
    switch (w) {
    case WAY_POINT:
        return 4.0 * sample(m[0], s, c, 0.0, 0.0);
    case WAY_CAP:
        return cap(m[0], s, c);
    case WAY_FAST:
    case WAY_EXACT:
        glint_eval_area(m[w == WAY_EXACT], s, NULL, c->wo, &c->light, &v);
        return (double)v.smooth[0];
    default:
        return w < WAY_RANDOM_4 ? gauss(points_of[w], m[0], s, c) : at_random(points_of[w], m[0], s, c, random);
    }
}
