/* Mean and variance of what a surface of explicit facets shows, in double precision and without drawing one. */
#include "facet_truth.h"

#include <math.h>

#define PI 3.14159265358979323846

double facet_distribution(const glint_material_options *o, const double h[3])
{
    const double ax = (double)o->surface.alpha_x, ay = (double)o->surface.alpha_y;
    const double x = h[0] / (h[2] * ax), y = h[1] / (h[2] * ay), r2 = x * x + y * y;
    const double p22 = o->distribution == GLINT_DISTRIBUTION_BECKMANN ? exp(-r2) : 1.0 / ((1.0 + r2) * (1.0 + r2));
    return p22 / (PI * ax * ay * pow(h[2], 4.0));
}

/* Integral of P22 sqrt(1 + slope^2), in (w, phi) with P22 uniform over the radius's distribution function 1 - (1 -
 * w)^2, which keeps the tail of GGX bounded: there the slope grows as 1 / (1 - w). */
double facet_total_area(const glint_material_options *o)
{
    enum { RADII = 2000, ANGLES = 400 };
    double sum = 0.0;
    for (int i = 0; i < RADII; i++) {
        const double w = (i + 0.5) / RADII, v = w * (2.0 - w);
        const double r = o->distribution == GLINT_DISTRIBUTION_BECKMANN ? sqrt(-log1p(-v)) : sqrt(v / (1.0 - v));
        for (int k = 0; k < ANGLES; k++) {
            const double phi = 2.0 * PI * (k + 0.5) / ANGLES;
            const double x = r * cos(phi) * (double)o->surface.alpha_x, y = r * sin(phi) * (double)o->surface.alpha_y;
            sum += 2.0 * (1.0 - w) * sqrt(1.0 + x * x + y * y) / ((double)RADII * ANGLES);
        }
    }
    return sum;
}

static void half_vector(const float wo[3], const double wi[3], double h[3])
{
    double length = 0.0;
    for (int k = 0; k < 3; k++) {
        h[k] = (double)wo[k] + wi[k];
        length += h[k] * h[k];
    }
    for (int k = 0; k < 3; k++)
        h[k] /= sqrt(length);
}

/* A facet of normal m adds c(m) where it sends the view into the light: c = D_H 4 (wo.m) for facets of equal area, of
 * which D / D_H have the normal m; 4 (wo.m) / (n.m) for facets of equal projected area, of which D (n.m) do. dm = dw /
 * (4 wo.m), so E X = integral of D over the light both times, and E X^2 = integral of D c. Fibonacci points on the cap.
 */
facet_moments facet_moments_of(const glint_material_options *o, const float wo[3], const float wi[3],
                               double solid_angle_sr)
{
    enum { POINTS = 4000 };
    const double cos_rim = 1.0 - solid_angle_sr / (2.0 * PI);
    const double z[3] = { (double)wi[0], (double)wi[1], (double)wi[2] };
    const double length = sqrt(z[0] * z[0] + z[2] * z[2]);
    const double x[3] = { z[2] / length, 0.0, -z[0] / length };
    const double y[3] = { z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0] };
    const int equal_area = o->weighting == GLINT_WEIGHTING_EQUAL_AREA;
    const double total = equal_area ? facet_total_area(o) : 1.0;
    facet_moments m = { 0 };
    for (int i = 0; i < POINTS; i++) {
        const double c = 1.0 - (1.0 - cos_rim) * (i + 0.5) / POINTS, s = sqrt(1.0 - c * c), phi = 2.39996322972865 * i;
        double w[3], h[3];
        for (int k = 0; k < 3; k++)
            w[k] = c * z[k] + s * (cos(phi) * x[k] + sin(phi) * y[k]);
        half_vector(wo, w, h);
        const double dot = (double)wo[0] * h[0] + (double)wo[1] * h[1] + (double)wo[2] * h[2];
        const double d = facet_distribution(o, h) / POINTS;
        m.mean += d;
        m.square += d * 4.0 * dot * (equal_area ? total : 1.0 / h[2]) / solid_angle_sr;
    }
    double middle[3];
    half_vector(wo, z, middle);
    const double smooth = facet_distribution(o, middle);
    return (facet_moments){ m.mean / smooth, m.square / (smooth * smooth) };
}

/* Autocorrelation of a box of width k and integral 1. */
static double triangle(double d, double k)
{
    return fmax(0.0, k - fabs(d)) / (k * k);
}

/* The fourth integral of a delta. A triangle's second derivative is three deltas, so two of them convolved are nine
 * cubics. */
static double cubic(double t)
{
    return t > 0.0 ? t * t * t / 6.0 : 0.0;
}

/* Autocorrelation, along one axis, of what the mean of k pixels sees. k tents side by side are a box of k convolved
 * with a box of one; its autocorrelation is triangle_1 convolved with triangle_k: nine cubics. */
static double autocorrelation(facet_filter filter, double d, double k)
{
    if (filter == FACET_BOX)
        return triangle(d, k);
    double sum = 0.0;
    for (int i = -1; i <= 1; i++)
        for (int j = -1; j <= 1; j++)
            sum += (i ? 1.0 : -2.0) * (j ? 1.0 : -2.0) * cubic(-fabs(d) - i - j * k);
    return fmax(sum, 0.0) / (k * k);
}

/* Two points lie in one cell of a grid that lies anywhere with the chance T(d) = (1 - |du|)(1 - |dv|), so E sum S_k^2
 * is the integral of T times the autocorrelation of the filter: by the midpoint rule, over the smaller of the two
 * squares where one of them ends. */
double facet_overlap(facet_filter filter, int k, const double jacobian[4])
{
    enum { STEPS = 200 };
    const double det = jacobian[0] * jacobian[3] - jacobian[1] * jacobian[2];
    const double reach = filter == FACET_BOX ? k : k + 1;
    const int over_pixels = fabs(det) * reach * reach < 1.0;
    double sum = 0.0;
    for (int i = 0; i < STEPS; i++)
        for (int j = 0; j < STEPS; j++) {
            const double a = (i + 0.5) * 2.0 / STEPS - 1.0, b = (j + 0.5) * 2.0 / STEPS - 1.0;
            double u = a, v = b, x = a * reach, y = b * reach;
            if (over_pixels) {
                u = jacobian[0] * x + jacobian[1] * y;
                v = jacobian[2] * x + jacobian[3] * y;
            } else {
                x = (jacobian[3] * u - jacobian[1] * v) / det;
                y = (jacobian[0] * v - jacobian[2] * u) / det;
            }
            sum += fmax(0.0, 1.0 - fabs(u)) * fmax(0.0, 1.0 - fabs(v)) * autocorrelation(filter, x, k) *
                   autocorrelation(filter, y, k);
        }
    return sum * 4.0 / ((double)STEPS * STEPS) * (over_pixels ? reach * reach : 1.0 / fabs(det));
}
