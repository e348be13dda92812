/* The tilt and the tint of a flake, as glint.inc and libglint's explicit model have it: for meshes with a normal for
 * each flake. */
#include "exporters/povray/flake.h"

#include <math.h>

#define PI 3.14159265358979323846
#define MODULUS 94906247.0 /* a prime below 2^26.5: its squares are whole in a double */
#define MAX_SLOPE 7.0      /* as Glint_Max_Slope of glint.inc */

/* exp(x^2) erfc(x); its continued fraction where the product would overflow. */
static double erfcx(double x)
{
    if (x < 5.0)
        return exp(x * x) * erfc(x);
    double f = 0.0;
    for (int i = 60; i > 0; --i)
        f = 0.5 * i / (x + f);
    return 1.0 / (sqrt(PI) * (x + f));
}

/* Square of the slope at roughness one that a share q of the surface exceeds. */
static double slope2(const flake_law *law, double q)
{
    return law->distribution == GLINT_DISTRIBUTION_GGX ? (1.0 - q) / q : -log(q);
}

/* Area of the flakes beyond that slope; its derivative by q is *w. */
static double tail_area(const flake_law *law, double q, double *w)
{
    const double a = law->alpha;
    *w = sqrt(1.0 + a * a * slope2(law, q));
    if (law->distribution == GLINT_DISTRIBUTION_GGX) {
        const double b = sqrt(fmax(1.0 - a * a, 1e-9));
        return q * *w + a * a * atanh(b / *w) / b;
    }
    return q * (*w + 0.5 * sqrt(PI) * a * erfcx(*w / a));
}

flake_law flake_law_of(glint_distribution distribution, double alpha_x, double alpha_y)
{
    flake_law law = { .distribution = distribution, .alpha_x = alpha_x, .alpha_y = alpha_y };
    double w;
    law.alpha = sqrt(alpha_x * alpha_y);
    law.total_area = tail_area(&law, 1.0, &w);
    return law;
}

static double step(double h, double key)
{
    const double x = fmod(fmod(h + key + 47453123.0, MODULUS) + MODULUS, MODULUS);
    return fmod(fmod(x * x, MODULUS) * x, MODULUS);
}

static double cell(int64_t x, int64_t y, uint32_t seed)
{
    return step(step(step(0.0, (double)x), (double)y), (double)seed);
}

double flake_tint(int64_t x, int64_t y, uint32_t seed)
{
    return step(step(cell(x, y, seed), 2718281.0), 31337.0) / MODULUS;
}

void flake_slopes(const flake_law *law, int64_t x, int64_t y, uint32_t seed, double slopes[2])
{
    const double h = cell(x, y, seed);
    const double tail = fmax(1.0 - step(h, 1234567.0) / MODULUS, 1e-7);
    const double azimuth = 2.0 * PI * step(step(h, 7654321.0), 77777.0) / MODULUS;
    double q = tail;
    for (int i = 0; i < 20; ++i) {
        double w;
        const double area = tail_area(law, q, &w);
        q = fmin(fmax(q - (area - tail * law->total_area) / w, 0.1 * q), 1.0);
    }
    const double radius = fmin(sqrt(fmax(slope2(law, q), 0.0)), MAX_SLOPE / law->alpha);
    slopes[0] = law->alpha_x * radius * cos(azimuth);
    slopes[1] = law->alpha_y * radius * sin(azimuth);
}
