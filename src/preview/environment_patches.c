/* Cuts the sphere into patches over each of which the light is about even, as large as they can be.
 *
 * A facet that reflects a patch is lit, whatever the place in it. Were the patches smaller, facets that reflect the
 * same sky would be told apart, and an even sky would sparkle; were they larger, a bright window would not.
 */
#include "preview/environment.h"

/* Variance of the radiance in a patch over the square of its mean, at most: a standard deviation of half the mean.
 * Taste. */
#define EVEN 0.25
/* Each split halves a side of at most 2^13 texels. */
#define MOST_PENDING 64

typedef struct area {
    int x0, y0, x1, y1; /* texels, the upper ends excluded */
} area;

/* Integrals of 1, L and L^2; suns have none. */
typedef struct integrals {
    double solid_angle, level, square;
} integrals;

static integrals integrate(const environment *e, area a)
{
    const size_t width = (size_t)e->map->width;
    integrals sum = { 0.0, 0.0, 0.0 };
    for (int y = a.y0; y < a.y1; ++y) {
        double count = 0.0, level = 0.0, square = 0.0;
        for (int x = a.x0; x < a.x1; ++x) {
            const size_t i = (size_t)y * width + (size_t)x;
            if (!(e->patch_sr[i] > 0.0F))
                continue;
            const double l = environment_level(&e->map->rgb[3 * i]);
            count += 1.0;
            level += l;
            square += l * l;
        }
        const double sr = environment_texel_sr(e->map, y);
        sum.solid_angle += sr * count;
        sum.level += sr * level;
        sum.square += sr * square;
    }
    return sum;
}

static integrals add(integrals a, integrals b)
{
    return (integrals){ a.solid_angle + b.solid_angle, a.level + b.level, a.square + b.square };
}

/* Integral of (L - mean)^2. */
static double unevenness(integrals i)
{
    return i.solid_angle > 0.0 ? fmax(i.square - i.level * i.level / i.solid_angle, 0.0) : 0.0;
}

static bool is_even(integrals i)
{
    /* A hair more: an even map may round. */
    return i.square * i.solid_angle <= (1.0 + EVEN) * i.level * i.level * (1.0 + 1e-9);
}

static void fill(environment *e, area a, double solid_angle)
{
    for (int y = a.y0; y < a.y1; ++y) {
        for (int x = a.x0; x < a.x1; ++x) {
            float *const to = &e->patch_sr[(size_t)y * (size_t)e->map->width + (size_t)x];
            if (*to > 0.0F)
                *to = (float)solid_angle;
        }
    }
}

/* Halves an area that is not one texel along the side that leaves its halves more even. False: it is a patch. */
static bool split(const environment *e, area a, area halves[2], double *solid_angle)
{
    const int x = (a.x0 + a.x1) / 2, y = (a.y0 + a.y1) / 2;
    const integrals q[4] = { integrate(e, (area){ a.x0, a.y0, x, y }), integrate(e, (area){ x, a.y0, a.x1, y }),
                             integrate(e, (area){ a.x0, y, x, a.y1 }), integrate(e, (area){ x, y, a.x1, a.y1 }) };
    const integrals all = add(add(q[0], q[1]), add(q[2], q[3]));
    *solid_angle = all.solid_angle;
    const bool wide = a.x1 - a.x0 > 1, high = a.y1 - a.y0 > 1;
    if (is_even(all) || (!wide && !high))
        return false;
    const double beside = unevenness(add(q[0], q[2])) + unevenness(add(q[1], q[3]));
    const double above = unevenness(add(q[0], q[1])) + unevenness(add(q[2], q[3]));
    if (wide && (!high || beside < above)) {
        halves[0] = (area){ a.x0, a.y0, x, a.y1 };
        halves[1] = (area){ x, a.y0, a.x1, a.y1 };
    } else {
        halves[0] = (area){ a.x0, a.y0, a.x1, y };
        halves[1] = (area){ a.x0, y, a.x1, a.y1 };
    }
    return true;
}

void environment_find_patches(environment *e)
{
    const area whole = { 0, 0, e->map->width, e->map->height };
    area pending[MOST_PENDING] = { whole };
    for (int count = 1; count > 0;) {
        const area a = pending[--count];
        area halves[2];
        double solid_angle;
        if (split(e, a, halves, &solid_angle)) {
            pending[count++] = halves[0];
            pending[count++] = halves[1];
            continue;
        }
        const bool even_all_around = a.x1 - a.x0 == whole.x1 && a.y1 - a.y0 == whole.y1;
        ++e->patch_count;
        fill(e, a, even_all_around ? 4.0 * PREVIEW_PI : solid_angle);
    }
}
