/* Lights of real size by brute force, without the library. */
#include "area_truth.h"

#include <math.h>

#define PI 3.14159265358979323846

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

double area_truth_density(const area_truth_lobe *l, const double h[3])
{
    const double c2 = h[2] * h[2];
    const double x = h[0] / l->alpha_x, y = h[1] / l->alpha_y, t2 = (x * x + y * y) / c2;
    if (l->is_beckmann)
        return exp(-t2) / (PI * l->alpha_x * l->alpha_y * c2 * c2);
    return 1.0 / (PI * l->alpha_x * l->alpha_y * c2 * c2 * (1.0 + t2) * (1.0 + t2));
}

static double lambda(const area_truth_lobe *l, const double w[3])
{
    const double x = w[0] * l->alpha_x, y = w[1] * l->alpha_y, slope = sqrt(x * x + y * y);
    if (!(slope > 0.0))
        return 0.0;
    const double a = w[2] / slope;
    if (l->is_beckmann)
        return 0.5 * (erf(a) - 1.0) + exp(-a * a) / (2.0 * a * sqrt(PI));
    return 0.5 * (sqrt(1.0 + 1.0 / (a * a)) - 1.0);
}

double area_truth_masking(const area_truth_lobe *l, const double wo[3], const double wi[3])
{
    return 1.0 / (1.0 + lambda(l, wo) + lambda(l, wi));
}

void area_truth_add(area_truth *sum, const area_truth_lobe *l, const double wo[3], const double p[3],
                    double solid_angle)
{
    const double length = sqrt(dot(p, p));
    const double wi[3] = { p[0] / length, p[1] / length, p[2] / length };
    if (!(wi[2] > 0.0))
        return;
    double h[3] = { wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2] };
    const double n = sqrt(dot(h, h));
    for (int k = 0; k < 3; k++)
        h[k] /= n;
    const double d = area_truth_density(l, h), ho = dot(h, wo);
    const double f = d * area_truth_masking(l, wo, wi) / (4.0 * wo[2]) * solid_angle;
    sum->specular += f;
    sum->schlick += f * pow(fmax(0.0, 1.0 - ho), 5.0);
    sum->facets += d / (4.0 * ho) * solid_angle;
    sum->projected += d * h[2] / (4.0 * ho) * solid_angle;
    sum->cosine += wi[2] * solid_angle;
    sum->solid_angle += solid_angle;
}

/* A parallelogram or, by squares mapped to rings of equal area, an ellipse: points of equal area. */
static void add_flat(area_truth *sum, const area_truth_lobe *l, const double wo[3], const double c[3],
                     const double x[3], const double y[3], int is_round, int side)
{
    double normal[3];
    cross(x, y, normal);
    const double area = (is_round ? PI : 4.0) / ((double)side * side);
    const double facing = fabs(dot(normal, c));
    for (int i = 0; i < side; i++)
        for (int j = 0; j < side; j++) {
            double s = 2.0 * (i + 0.5) / side - 1.0, t = 2.0 * (j + 0.5) / side - 1.0;
            if (is_round) {
                const double r = sqrt((i + 0.5) / side), phi = 2.0 * PI * (j + 0.5) / side;
                s = r * cos(phi);
                t = r * sin(phi);
            }
            double p[3];
            for (int k = 0; k < 3; k++)
                p[k] = c[k] + s * x[k] + t * y[k];
            const double d2 = dot(p, p);
            area_truth_add(sum, l, wo, p, area * facing / (d2 * sqrt(d2)));
        }
}

static void to_double(const float v[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (double)v[k];
}

/* A cone of directions of equal solid angles. */
static void add_round(area_truth *sum, const area_truth_lobe *l, const double wo[3], const double axis[3],
                      double versine, int side)
{
    const double length = sqrt(dot(axis, axis)), a[3] = { axis[0] / length, axis[1] / length, axis[2] / length };
    const double up[3] = { fabs(a[0]) < 0.5, fabs(a[0]) >= 0.5, 0.0 };
    double x[3], y[3];
    cross(up, a, x);
    const double n = sqrt(dot(x, x));
    for (int k = 0; k < 3; k++)
        x[k] /= n;
    cross(a, x, y);
    for (int i = 0; i < side; i++)
        for (int j = 0; j < side; j++) {
            const double v = versine * (i + 0.5) / side, s = sqrt(v * (2.0 - v)), phi = 2.0 * PI * (j + 0.5) / side;
            double p[3];
            for (int k = 0; k < 3; k++)
                p[k] = (1.0 - v) * a[k] + s * (cos(phi) * x[k] + sin(phi) * y[k]);
            area_truth_add(sum, l, wo, p, 2.0 * PI * versine / ((double)side * side));
        }
}

/* A fan of triangles around the middle, each a parallelogram folded over. */
static void add_polygon(area_truth *sum, const area_truth_lobe *l, const double wo[3], const glint_area_light *light,
                        int side)
{
    const int n = (int)light->corner_count;
    double first[3];
    to_double(light->corners[0], first);
    for (int i = 1; i + 1 < n; i++) {
        double b[3], c[3], normal[3];
        to_double(light->corners[i], b);
        to_double(light->corners[i + 1], c);
        for (int k = 0; k < 3; k++) {
            b[k] -= first[k];
            c[k] -= first[k];
        }
        cross(b, c, normal);
        for (int u = 0; u < side; u++)
            for (int v = 0; v < side; v++) {
                double s = (u + 0.5) / side, t = (v + 0.5) / side, p[3];
                if (s + t > 1.0) {
                    s = 1.0 - s;
                    t = 1.0 - t;
                }
                for (int k = 0; k < 3; k++)
                    p[k] = first[k] + s * b[k] + t * c[k];
                const double d2 = dot(p, p);
                area_truth_add(sum, l, wo, p, 0.5 * fabs(dot(normal, p)) / (d2 * sqrt(d2)) / ((double)side * side));
            }
    }
}

area_truth area_truth_of(const area_truth_lobe *lobe, const float wo_f[3], const glint_area_light *light, int side)
{
    area_truth sum = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
    double wo[3], c[3], x[3], y[3];
    to_double(wo_f, wo);
    to_double(light->center, c);
    to_double(light->half_x, x);
    to_double(light->half_y, y);
    switch (light->kind) {
    case GLINT_AREA_SUN:
        add_round(&sum, lobe, wo, c, (double)light->solid_angle_sr / (2.0 * PI), side);
        break;
    case GLINT_AREA_SPHERE: {
        const double s2 = (double)light->radius * (double)light->radius / dot(c, c);
        add_round(&sum, lobe, wo, c, s2 / (1.0 + sqrt(1.0 - s2)), side);
        break;
    }
    case GLINT_AREA_RECTANGLE:
    case GLINT_AREA_DISK:
        add_flat(&sum, lobe, wo, c, x, y, light->kind == GLINT_AREA_DISK, side);
        break;
    case GLINT_AREA_POLYGON:
        add_polygon(&sum, lobe, wo, light, side);
        break;
    }
    return sum;
}
