/* The fit of a linearly transformed cosine to a microfacet lobe, for one roughness and one view.
 *
 * Heitz et al. 2016 fit a matrix with four entries that may turn the hemisphere. Ours maps the horizon to itself,
 * (x, y, z) -> (along (x cos - z sin) + shift z, across y, z): no light leaks below the surface, and a light that has
 * been cut at the horizon once need not be cut again. What is minimised is the chi-square distance of the two lobes,
 * the integral of (f - g)^2 / (f + g), by Nelder and Mead's simplex.
 */
#include "ltc_fit.h"

#include <math.h>

#define PI 3.14159265358979323846

typedef struct lobe {
    int is_beckmann;
    double alpha, cosine, sine, albedo;
} lobe;

static double lambda(const lobe *l, double cosine)
{
    const double tangent = sqrt(fmax(0.0, 1.0 - cosine * cosine)) / cosine;
    const double a = 1.0 / (l->alpha * tangent);
    if (!(a < 1e6))
        return 0.0;
    if (!l->is_beckmann)
        return 0.5 * (sqrt(1.0 + 1.0 / (a * a)) - 1.0);
    return 0.5 * (exp(-a * a) / (a * sqrt(PI)) - erfc(a));
}

static double density(const lobe *l, double cosine)
{
    const double c2 = cosine * cosine, t2 = (1.0 - c2) / c2 / (l->alpha * l->alpha);
    const double scale = 1.0 / (PI * l->alpha * l->alpha * c2 * c2);
    return l->is_beckmann ? scale * exp(-t2) : scale / ((1.0 + t2) * (1.0 + t2));
}

/* f cos theta_i at (x, y, z); the mirrored view is (sine, 0, cosine). */
static double reflection(const lobe *l, double x, double y, double z)
{
    const double hx = x - l->sine, hz = z + l->cosine;
    const double length = sqrt(hx * hx + y * y + hz * hz);
    const double g2 = 1.0 / (1.0 + lambda(l, l->cosine) + lambda(l, z));
    return density(l, fmin(hz / length, 1.0)) * g2 / (4.0 * l->cosine);
}

/* ---- integrals over facets, in the coordinates in which their distribution is uniform ---- */

static void integrate(lobe *l, ltc_fit *fit)
{
    enum { LEVELS = 256, TURNS = 256 };
    double albedo = 0.0, schlick = 0.0, facets = 0.0;
    for (int i = 0; i < LEVELS; i++) {
        /* Levels v = sqrt(1 - u) of the distribution function u, as in light/sweep.h: dense where facets are steep. */
        const double v = (i + 0.5) / LEVELS;
        const double slope = l->alpha * (l->is_beckmann ? sqrt(-2.0 * log(v)) : sqrt(1.0 - v * v) / v);
        const double nz = 1.0 / sqrt(1.0 + slope * slope), area = v / nz / LEVELS / TURNS * 2.0;
        for (int j = 0; j < TURNS; j++) {
            const double phi = PI * (j + 0.5) / TURNS; /* the other half is the same */
            const double ho = nz * (l->cosine - slope * cos(phi) * l->sine);
            const double z = 2.0 * ho * nz - l->cosine;
            if (!(ho > 0.0) || !(z > 0.0))
                continue;
            const double f = area * ho / l->cosine / (1.0 + lambda(l, l->cosine) + lambda(l, z));
            albedo += f;
            schlick += f * pow(fmax(0.0, 1.0 - ho), 5.0);
            facets += area;
        }
    }
    l->albedo = fit->albedo = albedo;
    fit->schlick = schlick;
    fit->facets = facets;
}

/* ---- the fit ---- */

typedef struct transform {
    double along, shift, across;
} transform;

static transform transform_of(const lobe *l, const double p[3])
{
    const double c = l->cosine, a = l->alpha;
    return (transform){ exp(p[0]) * (c * c + a * a) / (2.0 * a * c), p[1] * a / (2.0 * c), exp(p[2]) / (2.0 * a) };
}

/* What the distance of two lobes is summed over: points that are uniform in g, so each stands for the same share of it.
 * *residual: half of the integral of |f - g|. */
static double distance(const lobe *l, const double p[3], double *residual)
{
    enum { RINGS = 24, TURNS = 24 };
    const transform t = transform_of(l, p);
    double sum = 0.0, difference = 0.0;
    for (int i = 0; i < RINGS; i++) {
        /* Rings bunch towards the rim, where the tail is: r = 1 - (1 - s)^2. */
        const double s = (i + 0.5) / RINGS, r = 1.0 - (1.0 - s) * (1.0 - s);
        const double ring = 2.0 * r * 2.0 * (1.0 - s) / RINGS / TURNS;
        const double z = sqrt((1.0 - r) * (1.0 + r));
        for (int j = 0; j < TURNS; j++) {
            const double phi = PI * (j + 0.5) / TURNS;
            /* Back through the transform: x' = along (x cos - z sin) + shift z. */
            const double x = ((r * cos(phi) - t.shift * z) / t.along + z * l->sine) / l->cosine;
            const double y = r * sin(phi) / t.across;
            const double n = sqrt(x * x + y * y + z * z);
            /* g dw = ring; g = z' |M| / (pi |M w|^4) with |M w| = 1 / n, the unit w = (x, y, z) / n. */
            const double g = z / n * t.along * l->cosine * t.across * n * n * n * n / PI;
            const double q = reflection(l, x / n, y / n, z / n) / (l->albedo * g);
            sum += ring * (q - 1.0) * (q - 1.0) / (q + 1.0);
            difference += ring * fabs(q - 1.0);
        }
    }
    *residual = 0.5 * difference;
    return sum;
}

static double at(const lobe *l, const double p[3])
{
    double residual;
    return distance(l, p, &residual);
}

/* Nelder and Mead 1965. */
static void minimise(const lobe *l, double best[3])
{
    enum { N = 3, STEPS = 250 };
    double p[N + 1][N], value[N + 1];
    for (int i = 0; i <= N; i++) {
        for (int k = 0; k < N; k++)
            p[i][k] = best[k] + (i == k + 1 ? 0.05 : 0.0);
        value[i] = at(l, p[i]);
    }
    for (int step = 0; step < STEPS; step++) {
        int low = 0, high = 0, next = 0;
        for (int i = 1; i <= N; i++) {
            low = value[i] < value[low] ? i : low;
            high = value[i] > value[high] ? i : high;
        }
        for (int i = 0; i <= N; i++)
            if (i != high && (next == high || value[i] > value[next]))
                next = i;
        double middle[N] = { 0.0, 0.0, 0.0 }, tried[N], further[N];
        for (int i = 0; i <= N; i++)
            for (int k = 0; k < N && i != high; k++)
                middle[k] += p[i][k] / N;
        for (int k = 0; k < N; k++)
            tried[k] = 2.0 * middle[k] - p[high][k];
        double v = at(l, tried);
        const double far = v < value[low] ? 3.0 : v < value[next] ? 0.0 : v < value[high] ? 1.5 : 0.5;
        if (far > 0.0) {
            for (int k = 0; k < N; k++)
                further[k] = middle[k] + (far - 1.0) * (middle[k] - p[high][k]);
            const double w = at(l, further);
            if (w < v || v >= value[high]) {
                v = w;
                for (int k = 0; k < N; k++)
                    tried[k] = further[k];
            }
        }
        if (v < value[high]) {
            value[high] = v;
            for (int k = 0; k < N; k++)
                p[high][k] = tried[k];
            continue;
        }
        for (int i = 0; i <= N; i++) {
            for (int k = 0; k < N; k++)
                p[i][k] = 0.5 * (p[i][k] + p[low][k]);
            value[i] = at(l, p[i]);
        }
    }
    for (int k = 0; k < N; k++)
        best[k] = p[0][k];
}

/* ---- the grid ---- */

double ltc_fit_alpha(int i)
{
    const double roughness = (double)i / (LTC_FIT_SIDE - 1);
    return fmax(roughness * roughness, 1e-4);
}

double ltc_fit_cosine(int j)
{
    const double t = (double)j / (LTC_FIT_SIDE - 1);
    return 1.0 - 0.99 * t * t;
}

/* What z adds to x' in the transform of one view, and the p[1] that adds as much in that of another: a lobe close to
 * the horizon moves less with the view than along and shift do. */
static double lift_of(const lobe *l, const double p[3])
{
    const transform t = transform_of(l, p);
    return t.shift - t.along * l->sine;
}

static double shift_for(const lobe *l, const double p[3], double lift)
{
    return (lift + transform_of(l, p).along * l->sine) * 2.0 * l->cosine / l->alpha;
}

void ltc_fit_row(int distribution, double alpha, ltc_fit row[LTC_FIT_SIDE])
{
    /* A narrow lobe is 2 alpha wide. p[0] and p[2] are logarithms here: both are positive. */
    double p[3] = { 0.0, 0.0, 0.0 };
    lobe l = { distribution == LTC_FIT_BECKMANN, alpha, 1.0, 0.0, 1.0 };
    for (int j = 0; j < LTC_FIT_SIDE; j++) {
        const double lift = lift_of(&l, p);
        const int is_low = l.cosine < alpha;
        l.cosine = ltc_fit_cosine(j);
        l.sine = sqrt((1.0 - l.cosine) * (1.0 + l.cosine));
        if (is_low)
            p[1] = shift_for(&l, p, lift);
        integrate(&l, &row[j]);
        minimise(&l, p);
        minimise(&l, p);
        if (j == 0) {
            /* Around the normal the lobe is round: along = across. */
            const double round = 0.5 * (p[2] + p[0] + log(1.0 + alpha * alpha));
            p[0] = round - log(1.0 + alpha * alpha);
            p[1] = 0.0;
            p[2] = round;
        }
        distance(&l, p, &row[j].residual);
        row[j].p[0] = exp(p[0]);
        row[j].p[1] = p[1];
        row[j].p[2] = exp(p[2]);
    }
}
