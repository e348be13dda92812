/* Richardson-Lucy deconvolution of a lobe by the lobe of one texel, then a stratified sample of the result. */
#include "exporters/gltf/flakes.h"

#include <math.h>

enum {
    RINGS = FLAKES_RINGS,
    TURNS = 96,       /* azimuths of the quadrature around a ring */
    ITERATIONS = 300, /* the error no longer falls */
    QUARTER = 4       /* texels get a quarter of the lobe's roughness, or a facet's own: taste */
};
#define PI 3.14159265358979323846
/* The ring of the steepest facets, as a multiple of alpha: GGX leaves 1 / (1 + 12^2) = .7 % of its facets beyond. */
#define STEEPEST 12.0
/* A texel's lobe that is wider loses light below the horizon of steep texels: at alpha .8 the mean would be off by 9 %.
 */
#define WIDEST_REST 0.05
/* Fitted to alpha .28 by .04, at which 1 is off by up to 3.6 % of the peak, 1.2 by 1.4 % and 2 by 4 %. */
#define EXPONENT 1.2

static double density(glint_distribution distribution, double alpha, double cosine)
{
    if (cosine <= 0.0)
        return 0.0;
    const double c2 = cosine * cosine, t2 = (1.0 - c2) / c2, a2 = alpha * alpha;
    if (distribution == GLINT_DISTRIBUTION_BECKMANN)
        return exp(-t2 / a2) / (PI * a2 * c2 * c2);
    const double d = 1.0 + t2 / a2;
    return 1.0 / (PI * a2 * c2 * c2 * d * d);
}

typedef flakes_rings rings;

/* The mean over azimuths of a texel's lobe. */
static double ring_mean(double alpha, double theta_h, double theta_n)
{
    double sum = 0.0;
    for (int k = 0; k < TURNS; ++k) {
        const double phi = PI * (k + 0.5) / TURNS;
        sum += density(GLINT_DISTRIBUTION_GGX, alpha,
                       cos(theta_h) * cos(theta_n) + sin(theta_h) * sin(theta_n) * cos(phi));
    }
    return sum / TURNS;
}

static void prepare(rings *r, glint_distribution distribution, double alpha, double alpha_rest)
{
    /* Even near the normal, sparse where facets are rare. */
    for (int i = 0; i <= RINGS; ++i) {
        const double t = (double)i / RINGS;
        r->edge[i] = alpha * STEEPEST * t * t;
    }
    for (int i = 0; i < RINGS; ++i) {
        r->angle[i] = atan(0.5 * (r->edge[i] + r->edge[i + 1]));
        r->wanted[i] = density(distribution, alpha, cos(r->angle[i]));
        r->weight[i] = (atan(r->edge[i + 1]) - atan(r->edge[i])) * sin(r->angle[i]) * cos(r->angle[i]) * 2.0 * PI;
        r->mass[i] = r->wanted[i] * r->weight[i];
    }
    for (int i = 0; i < RINGS; ++i)
        for (int j = 0; j < RINGS; ++j)
            r->kernel[i][j] = ring_mean(alpha_rest, r->angle[i], r->angle[j]) / cos(r->angle[j]);
}

static void iterate(rings *r)
{
    double ratio[RINGS];
    for (int i = 0; i < RINGS; ++i) {
        double sum = 0.0;
        for (int j = 0; j < RINGS; ++j)
            sum += r->kernel[i][j] * r->mass[j];
        ratio[i] = sum > 0.0 ? r->wanted[i] / sum : 0.0;
    }
    for (int j = 0; j < RINGS; ++j) {
        double above = 0.0, below = 0.0;
        for (int i = 0; i < RINGS; ++i) {
            above += r->weight[i] * r->kernel[i][j] * ratio[i];
            below += r->weight[i] * r->kernel[i][j];
        }
        r->mass[j] *= below > 0.0 ? above / below : 0.0;
    }
}

static void deconvolve(rings *r)
{
    for (int i = 0; i < ITERATIONS; ++i)
        iterate(r);
    double total = 0.0;
    for (int j = 0; j < RINGS; ++j)
        total += r->mass[j];
    for (int j = 0; j < RINGS; ++j)
        r->mass[j] /= total;
}

/* The slope below which a share u of the texels lie. */
static double quantile(const rings *r, double u)
{
    int j = 0;
    for (; j < RINGS - 1 && u > r->mass[j]; ++j)
        u -= r->mass[j];
    const double t = r->mass[j] > 0.0 ? fmin(u / r->mass[j], 1.0) : 0.5;
    /* Even in area within a ring. */
    const double low = r->edge[j] * r->edge[j], high = r->edge[j + 1] * r->edge[j + 1];
    return sqrt(low + t * (high - low));
}

/* splitmix64 */
static uint64_t next_random(uint64_t *state)
{
    uint64_t z = *state += 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
}

static uint8_t to_byte(double x)
{
    return (uint8_t)(0.5 + 255.0 * fmin(fmax(0.5 + 0.5 * x, 0.0), 1.0));
}

static void store(const double slope[2], double scale, uint8_t *rgb)
{
    const double x = slope[0] / scale, y = slope[1] / scale;
    const double length = sqrt(x * x + y * y + 1.0);
    rgb[0] = to_byte(x / length);
    rgb[1] = to_byte(y / length);
    rgb[2] = to_byte(1.0 / length);
}

/* How wide the normals spread along a direction of roughness alpha, relative to those of roughness mean. Widths of
 * lobes add as their powers: squares where tails are short; EXPONENT where both are GGX, whose slopes have neither a
 * variance nor, as Cauchy's law, widths that add themselves. */
static double spread(double alpha, double mean, double rest)
{
    return pow((pow(alpha, EXPONENT) - pow(rest, EXPONENT)) / (pow(mean, EXPONENT) - pow(rest, EXPONENT)),
               1.0 / EXPONENT);
}

/* Facet k of all, in the order of its quantile; azimuths by the golden ratio, so that both are even. */
static void facet_slope(const rings *r, const flakes_request *q, double rest, uint32_t k, double slope[2])
{
    const double mean = sqrt((double)q->alpha_x * (double)q->alpha_y);
    const double radius = quantile(r, (k + 0.5) / FLAKES_COUNT);
    const double phi = 2.0 * PI * fmod(k * 0.61803398874989485, 1.0);
    const double x = radius * cos(phi) * spread((double)q->alpha_x, mean, rest);
    const double y = radius * sin(phi) * spread((double)q->alpha_y, mean, rest);
    const double c = cos(q->direction_rad), s = sin(q->direction_rad);
    slope[0] = c * x - s * y;
    slope[1] = s * x + c * y;
}

/* Where each facet lies: a permutation. */
static void shuffle(uint32_t *places, uint32_t seed)
{
    uint64_t state = seed;
    for (uint32_t i = 0; i < FLAKES_COUNT; ++i)
        places[i] = i;
    for (uint32_t i = FLAKES_COUNT - 1; i > 0; --i) {
        const uint32_t j = (uint32_t)(next_random(&state) % (i + 1));
        const uint32_t kept = places[i];
        places[i] = places[j];
        places[j] = kept;
    }
}

bool flakes_make(const flakes_request *request, flakes *out)
{
    const double alpha = sqrt((double)request->alpha_x * (double)request->alpha_y);
    const double least = (double)fminf(request->alpha_x, request->alpha_y);
    const double rest = fmax((double)request->facet_alpha, fmin(least / QUARTER, WIDEST_REST));
    if (!(rest < least))
        return false;
    rings *const r = &out->work;
    prepare(r, request->distribution, alpha, rest);
    deconvolve(r);
    shuffle(out->places, request->seed);
    /* Slopes up to this one are stored below 45 degrees. */
    out->scale = (float)fmin(1.0, quantile(r, 0.98) * (double)fmaxf(request->alpha_x, request->alpha_y) / alpha);
    out->alpha_rest = (float)rest;
    for (uint32_t k = 0; k < FLAKES_COUNT; ++k) {
        double slope[2];
        facet_slope(r, request, rest, k, slope);
        store(slope, (double)out->scale, &out->rgb[3 * (size_t)out->places[k]]);
    }
    return true;
}
