/* Built-in examples: slopes of periodic height fields, so that maps tile without a seam (the microstructures of Xing et
 * al. 2024, Fig. 6 and Table 2, which the paper names but does not define). */
#include "model/example.h"

#define GLINT_LANES 1
#include "math/elementary.h"
#include "math/hash.h"

enum { WAVES = 64, MOST_GROOVES = 64, MOST_CUSHIONS = 64 };

/* Bounds the slope where the root mean square is dominated by a few texels. */
#define STEEPEST_SLOPE 7.9F

/* One term of a noise: cos(2 pi (kx x + ky y) + phase), whole kx and ky. */
typedef struct wave {
    float x, y, phase;
} wave;

/* A V-shaped groove: its middle, direction, half length and half width in units of the map. */
typedef struct groove {
    float x, y, along_x, along_y, half_length, half_width;
} groove;

typedef struct pattern {
    glint_example_kind kind;
    uint32_t count;
    wave waves[WAVES];
    groove grooves[MOST_GROOVES];
    uint32_t cushions; /* along a side */
    float cushion[MOST_CUSHIONS * MOST_CUSHIONS][2];
} pattern;

static float uniform(uint32_t seed, uint32_t index)
{
    return (float)(hash_full(hash_full(seed) + index * HASH_X) >> 8) * 0x1p-24F;
}

static void sincos_turn(float turn, float *sine, float *cosine)
{
    const float half_turns = 2.0F * (turn - floor_f(turn));
    float s, c;
    sincos_pi(half_turns < 1.0F ? half_turns : half_turns - 1.0F, &s, &c);
    const float sign = half_turns < 1.0F ? 1.0F : -1.0F;
    *sine = sign * s;
    *cosine = sign * c;
}

static float nearest_whole(float x)
{
    return floor_f(x + 0.5F);
}

/* From -1/2 to 1/2: the nearest of the copies of a periodic pattern. */
static float wrap(float x)
{
    return x - nearest_whole(x);
}

/* ---- noise: a sum of waves with random directions; features of this size, this much longer along x ---- */

static void make_noise(pattern *p, uint32_t size, const glint_example_shape *shape, float aspect, uint32_t seed)
{
    /* A Gaussian spectrum whose bumps have a standard deviation of half a feature. */
    const float frequency = (float)size / (MATH_PI * shape->feature_texels);
    p->count = WAVES;
    for (uint32_t i = 0; i < WAVES; i++) {
        wave *w = &p->waves[i];
        const float most = 0.5F * (float)size - 1.0F; /* what texels can still show */
        w->x = nearest_whole(frequency / aspect * normal_quantile(2.0F * uniform(seed, 3 * i) - 0.99999F));
        w->y = nearest_whole(frequency * normal_quantile(2.0F * uniform(seed, 3 * i + 1) - 0.99999F));
        w->x = w->x > most ? most : w->x < -most ? -most : w->x;
        w->y = w->y > most ? most : w->y < -most ? -most : w->y;
        /* A wave without a frequency would be no bump at all. */
        w->y = w->x == 0.0F && w->y == 0.0F ? 1.0F : w->y;
        w->phase = uniform(seed, 3 * i + 2);
    }
}

static void noise_slope(const pattern *p, float x, float y, float slope[2])
{
    slope[0] = slope[1] = 0.0F;
    for (uint32_t i = 0; i < p->count; i++) {
        const wave *w = &p->waves[i];
        float s, c;
        sincos_turn(w->x * x + w->y * y + w->phase, &s, &c);
        slope[0] += w->x * s;
        slope[1] += w->y * s;
    }
}

/* ---- scratches ---- */

static void make_scratches(pattern *p, uint32_t size, const glint_example_shape *shape, uint32_t seed)
{
    p->count = shape->count;
    for (uint32_t i = 0; i < p->count; i++) {
        groove *g = &p->grooves[i];
        float s, c;
        sincos_turn(uniform(seed, 4 * i), &s, &c);
        *g = (groove){ uniform(seed, 4 * i + 1),
                       uniform(seed, 4 * i + 2),
                       c,
                       s,
                       0.15F + 0.3F * uniform(seed, 4 * i + 3),
                       0.5F * shape->feature_texels / (float)size };
    }
}

/* The walls of a groove are parabolas, so that a groove reflects a streak and not two spots. Deeper grooves cut through
 * shallower ones: the steepest wall is seen. */
static void scratch_slope(const pattern *p, float x, float y, float slope[2])
{
    float most = 0.0F;
    slope[0] = slope[1] = 0.0F;
    for (uint32_t i = 0; i < p->count; i++) {
        const groove *g = &p->grooves[i];
        const float dx = wrap(x - g->x), dy = wrap(y - g->y);
        const float along = dx * g->along_x + dy * g->along_y, across = dy * g->along_x - dx * g->along_y;
        const float wall = across / g->half_width;
        if (fabsf(along) > g->half_length || fabsf(wall) >= 1.0F || fabsf(wall) <= most)
            continue;
        most = fabsf(wall);
        slope[0] = wall * g->along_y;
        slope[1] = -wall * g->along_x;
    }
}

/* ---- leather ---- */

static void make_leather(pattern *p, uint32_t size, const glint_example_shape *shape, uint32_t seed)
{
    const uint32_t across = (uint32_t)((float)size / shape->feature_texels + 0.5F);
    p->cushions = across < 2 ? 2 : across > MOST_CUSHIONS ? MOST_CUSHIONS : across;
    for (uint32_t i = 0; i < p->cushions * p->cushions; i++)
        for (uint32_t k = 0; k < 2; k++)
            p->cushion[i][k] =
                ((float)(k ? i / p->cushions : i % p->cushions) + 0.15F + 0.7F * uniform(seed, 2 * i + k)) /
                (float)p->cushions;
}

/* A paraboloid around the nearest of random centres: cushions, with creases where two meet. */
static void leather_slope(const pattern *p, float x, float y, float slope[2])
{
    float nearest = 4.0F;
    const int cell_x = (int)(x * (float)p->cushions), cell_y = (int)(y * (float)p->cushions), n = (int)p->cushions;
    for (int k = 0; k < 25; k++) {
        const int i = (cell_x + k % 5 - 2 + 2 * n) % n, j = (cell_y + k / 5 - 2 + 2 * n) % n;
        const float dx = wrap(x - p->cushion[j * n + i][0]), dy = wrap(y - p->cushion[j * n + i][1]);
        const float d2 = dx * dx + dy * dy;
        if (d2 < nearest) {
            nearest = d2;
            slope[0] = dx;
            slope[1] = dy;
        }
    }
}

/* ---- structure ---- */

/* A weave: humps that run along x and along y in turn, as on a chequerboard. */
static void structure_slope(const pattern *p, float x, float y, float slope[2])
{
    const float n = (float)p->cushions;
    const int along_x = ((int)(x * n) + (int)(y * n)) & 1;
    float s, c;
    sincos_turn(along_x ? y * n : x * n, &s, &c);
    slope[0] = along_x ? 0.0F : s;
    slope[1] = along_x ? s : 0.0F;
}

static void make_structure(pattern *p, uint32_t size, const glint_example_shape *shape)
{
    /* An even number, so that the chequerboard continues around the edge. */
    const uint32_t pairs = (uint32_t)(0.5F * (float)size / shape->feature_texels + 0.5F);
    p->cushions = 2 * (pairs < 1 ? 1 : pairs);
}

/* ---- all ---- */

static void make_pattern(pattern *p, uint32_t size, const glint_example_shape *shape, uint32_t seed)
{
    switch (p->kind) {
    case GLINT_EXAMPLE_SCRATCHES:
        make_scratches(p, size, shape, seed);
        return;
    case GLINT_EXAMPLE_LEATHER:
        make_leather(p, size, shape, seed);
        return;
    case GLINT_EXAMPLE_STRUCTURE:
        make_structure(p, size, shape);
        return;
    case GLINT_EXAMPLE_ISOTROPIC_NOISE:
        make_noise(p, size, shape, 1.0F, seed);
        return;
    case GLINT_EXAMPLE_BRUSHED:
        /* A brush leaves grooves as long as the map and more. */
        make_noise(p, size, shape, 2.0F * shape->aspect, seed);
        return;
    case GLINT_EXAMPLE_ANISOTROPIC_NOISE:
        make_noise(p, size, shape, shape->aspect, seed);
        return;
    }
}

static void pattern_slope(const pattern *p, float x, float y, float slope[2])
{
    if (p->kind == GLINT_EXAMPLE_SCRATCHES)
        scratch_slope(p, x, y, slope);
    else if (p->kind == GLINT_EXAMPLE_LEATHER)
        leather_slope(p, x, y, slope);
    else if (p->kind == GLINT_EXAMPLE_STRUCTURE)
        structure_slope(p, x, y, slope);
    else
        noise_slope(p, x, y, slope);
}

/* Brings the slopes, in the first two of each three numbers, to this root mean square, and makes them normals. */
static void finish(float *normals, size_t count, float rms)
{
    float sum = 0.0F;
    for (size_t i = 0; i < count; i++)
        sum += normals[3 * i] * normals[3 * i] + normals[3 * i + 1] * normals[3 * i + 1];
    const float scale = sum > 0.0F ? rms / sqrtf(sum / (float)count) : 0.0F;
    for (size_t i = 0; i < count; i++) {
        float *n = normals + 3 * i;
        const float x = n[0] * scale, y = n[1] * scale, steep = sqrtf(x * x + y * y);
        const float less = steep > STEEPEST_SLOPE ? STEEPEST_SLOPE / steep : 1.0F;
        const vec3 unit = vec3_normalize((vec3){ x * less, y * less, 1.0F });
        n[0] = unit.x;
        n[1] = unit.y;
        n[2] = unit.z;
    }
}

/* low <= x <= high by bits, so that a NaN raises nothing. 0 <= low. */
static int in_range(float x, float low, float high)
{
    const vuint u = bits_of(x);
    return u >= bits_of(low) && u <= bits_of(high);
}

glint_result glint_example_generate(glint_example_kind kind, uint32_t size, const glint_example_shape *shape,
                                    uint32_t seed, float *normals)
{
    if (!shape || !normals)
        return GLINT_ERROR_ARGUMENT;
    if ((unsigned)kind > GLINT_EXAMPLE_ANISOTROPIC_NOISE || size < EXAMPLE_LEAST_SIZE || size > EXAMPLE_MOST_SIZE ||
        (size & (size - 1)) != 0 || !in_range(shape->slope, 1e-6F, 2.0F) ||
        !in_range(shape->feature_texels, 1.0F, 64.0F) || !in_range(shape->aspect, 1.0F, 64.0F) || shape->count < 1 ||
        shape->count > MOST_GROOVES)
        return GLINT_ERROR_RANGE;
    pattern p = { .kind = kind };
    make_pattern(&p, size, shape, seed);
    for (uint32_t j = 0; j < size; j++)
        for (uint32_t i = 0; i < size; i++)
            pattern_slope(&p, ((float)i + 0.5F) / (float)size, ((float)j + 0.5F) / (float)size,
                          normals + 3 * ((size_t)j * size + i));
    finish(normals, (size_t)size * size, shape->slope);
    return GLINT_OK;
}
