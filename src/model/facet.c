/* One facet of the explicit surface: from the cell that it fills to its normal. */
#include "model/facet.h"

#include <math.h>
#include <string.h>

#include "ndf/slopes.h"

static uint32_t bits_of_float(float x)
{
    uint32_t u;
    memcpy(&u, &x, sizeof(u));
    return u;
}

static uint32_t rotate(uint32_t x, int k)
{
    return x << k | x >> (32 - k);
}

/* B. Jenkins, lookup3 (2006, public domain): the final and the inner mix. */
static uint32_t jenkins_final(uint32_t a, uint32_t b, uint32_t c)
{
    c = (c ^ b) - rotate(b, 14);
    a = (a ^ c) - rotate(c, 11);
    b = (b ^ a) - rotate(a, 25);
    c = (c ^ b) - rotate(b, 16);
    a = (a ^ c) - rotate(c, 4);
    b = (b ^ a) - rotate(a, 14);
    return (c ^ b) - rotate(b, 24);
}

static void jenkins_mix(uint32_t *a, uint32_t *b, uint32_t *c)
{
    *a = (*a - *c) ^ rotate(*c, 4);
    *c += *b;
    *b = (*b - *a) ^ rotate(*a, 6);
    *a += *c;
    *c = (*c - *b) ^ rotate(*b, 8);
    *b += *a;
    *a = (*a - *c) ^ rotate(*c, 16);
    *c += *b;
    *b = (*b - *a) ^ rotate(*a, 19);
    *a += *c;
    *c = (*c - *b) ^ rotate(*b, 4);
    *b += *a;
}

/* Hash of (x, y, seed, channel). */
static uint32_t cycles_channel(uint32_t kx, uint32_t ky, uint32_t kz, float channel)
{
    const uint32_t four = 0xdeadbeefU + (4U << 2) + 13U;
    uint32_t a = four + kx, b = four + ky, c = four + kz;
    jenkins_mix(&a, &b, &c);
    return jenkins_final(a + bits_of_float(channel), b, c);
}

static facet_uniforms cycles_hash(int64_t x, int64_t y, uint32_t seed)
{
    const uint32_t kx = bits_of_float((float)x), ky = bits_of_float((float)y), kz = bits_of_float((float)seed);
    const uint32_t three = 0xdeadbeefU + (3U << 2) + 13U;
    const uint32_t first = jenkins_final(three + kx, three + ky, three + kz);
    return (facet_uniforms){ first / 4294967295.0, cycles_channel(kx, ky, kz, 1.0F) / 4294967295.0 };
}

#define POVRAY_MODULUS 94906247.0 /* a prime below 2^26.5: its squares are whole in a double */

static double povray_step(double h, double key)
{
    const double x = fmod(fmod(h + key + 47453123.0, POVRAY_MODULUS) + POVRAY_MODULUS, POVRAY_MODULUS);
    return fmod(fmod(x * x, POVRAY_MODULUS) * x, POVRAY_MODULUS);
}

static double povray_cell(int64_t x, int64_t y, uint32_t seed)
{
    return povray_step(povray_step(povray_step(0.0, (double)x), (double)y), (double)seed);
}

static facet_uniforms povray_hash(int64_t x, int64_t y, uint32_t seed)
{
    const double h = povray_cell(x, y, seed);
    return (facet_uniforms){ povray_step(h, 1234567.0) / POVRAY_MODULUS,
                             povray_step(povray_step(h, 7654321.0), 77777.0) / POVRAY_MODULUS };
}

facet_uniforms facet_hash(glint_facet_hash mode, int64_t x, int64_t y, uint32_t seed)
{
    return mode == GLINT_FACET_HASH_POVRAY ? povray_hash(x, y, seed) : cycles_hash(x, y, seed);
}

double facet_tint_hash(glint_facet_hash mode, int64_t x, int64_t y, uint32_t seed)
{
    if (mode == GLINT_FACET_HASH_POVRAY)
        return povray_step(povray_step(povray_cell(x, y, seed), 2718281.0), 31337.0) / POVRAY_MODULUS;
    const uint32_t kx = bits_of_float((float)x), ky = bits_of_float((float)y), kz = bits_of_float((float)seed);
    return cycles_channel(kx, ky, kz, 2.0F) / 4294967295.0;
}

vec3 facet_normal(const ndf *n, glint_weighting weighting, facet_uniforms u)
{
    const float radius = (float)u.radius, azimuth = u.azimuth < 0.99999994 ? (float)u.azimuth : 0.99999994F;
    const slope2 s = weighting == GLINT_WEIGHTING_EQUAL_AREA ? slopes_of_area(n, radius, azimuth)
                                                             : slopes_of_projected_area(n, radius, azimuth);
    return vec3_normalize((vec3){ s.x, s.y, 1.0F });
}
