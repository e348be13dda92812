/* The smooth lobe in double, by the same formulas as the library's in float: what the other type costs and brings. */
#include <math.h>

#include "study/arithmetic.h"

static double masked(double alpha, const double v[3])
{
    const double t = alpha * alpha * (v[0] * v[0] + v[1] * v[1]);
    return 0.5 * t / (sqrt(t + v[2] * v[2]) + v[2]);
}

double arithmetic_lobe(double alpha, const double wo[3], const double wi[3])
{
    double h[3], length2 = 0.0;
    for (int k = 0; k < 3; k++) {
        h[k] = wo[k] + wi[k];
        length2 += h[k] * h[k];
    }
    const double inverse = 1.0 / sqrt(length2);
    for (int k = 0; k < 3; k++)
        h[k] *= inverse;
    const double x = h[0] / alpha, y = h[1] / alpha, t = x * x + y * y + h[2] * h[2];
    const double density = 1.0 / (3.14159265358979323846 * alpha * alpha * t * t);
    return 0.25 * density * wi[2] / (wo[2] * wi[2] + masked(alpha, wo) * wi[2] + masked(alpha, wi) * wo[2]);
}
