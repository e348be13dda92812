/* Random lights, views and roughnesses for tests of lights of real size. */
#ifndef TESTS_AREA_CASES_H
#define TESTS_AREA_CASES_H

#include <math.h>
#include <string.h>

#include "area_truth.h"
#include "statistics.h"

#define AREA_PI 3.14159265358979323846

typedef struct area_case {
    double roughness, view; /* sqrt(alpha); radians */
    area_truth_lobe lobe;
    float wo[3];
    glint_area_light light;
} area_case;

static inline void area_unit(float v[3])
{
    const float n = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++)
        v[k] /= n;
}

/* A light of about this solid angle towards the unit direction d, one metre away, tilted and stretched at random. */
static inline glint_area_light area_light_towards(uint64_t *random, glint_area_kind kind, const float d[3],
                                                  double solid_angle)
{
    const double versine = fmin(solid_angle / (2.0 * AREA_PI), 1.0);
    const double sine = sqrt(versine * (2.0 - versine)), tangent = sine / fmax(1.0 - versine, 0.05);
    glint_area_light l = {
        .kind = kind, .two_sided = 1U, .solid_angle_sr = (float)solid_angle, .radius = (float)fmin(sine, 0.9999)
    };
    memcpy(l.center, d, sizeof(l.center));
    /* Half axes across d, one of them tilted by up to 45 degrees. */
    const float other[3] = { (float)random_between(random, -1.0, 1.0), (float)random_between(random, -1.0, 1.0),
                             (float)random_between(random, -1.0, 1.0) };
    float x[3] = { d[1] * other[2] - d[2] * other[1], d[2] * other[0] - d[0] * other[2],
                   d[0] * other[1] - d[1] * other[0] };
    area_unit(x);
    float y[3] = { d[1] * x[2] - d[2] * x[1], d[2] * x[0] - d[0] * x[2], d[0] * x[1] - d[1] * x[0] };
    const double tilt = random_between(random, 0.0, 0.25 * AREA_PI), aspect = random_between(random, 0.2, 1.0);
    for (int k = 0; k < 3; k++) {
        l.half_x[k] = (float)(tangent * (cos(tilt) * (double)x[k] + sin(tilt) * (double)d[k]));
        l.half_y[k] = (float)(tangent * aspect * (double)y[k]);
    }
    l.corner_count = 3U + (uint32_t)(random_bits(random) % 6U);
    const double turn = random_between(random, 0.0, 2.0 * AREA_PI);
    for (uint32_t i = 0; i < l.corner_count; i++) {
        const double a = turn + 2.0 * AREA_PI * i / l.corner_count;
        for (int k = 0; k < 3; k++)
            l.corners[i][k] = d[k] + (float)cos(a) * l.half_x[k] + (float)sin(a) * l.half_y[k];
    }
    return l;
}

/* Roughness .1 to 1, views 0 to 85 degrees, lights from 1e-4 sr to a hemisphere: half of them anywhere above the
 * horizon, half between there and the mirrored view. */
static inline area_case area_case_of(uint64_t *random, int anisotropic)
{
    area_case c;
    c.lobe.is_beckmann = (int)(random_bits(random) & 1U);
    c.roughness = random_between(random, 0.1, 1.0);
    c.lobe.alpha_x = c.lobe.alpha_y = (double)(float)(c.roughness * c.roughness);
    if (anisotropic) {
        c.lobe.alpha_x = (double)(float)random_log_between(random, 0.01, 1.0);
        c.lobe.alpha_y = (double)(float)random_log_between(random, 0.01, 1.0);
    }
    c.view = random_between(random, 0.0, 85.0 * AREA_PI / 180.0);
    const double azimuth = random_between(random, 0.0, 2.0 * AREA_PI);
    c.wo[0] = (float)(sin(c.view) * cos(azimuth));
    c.wo[1] = (float)(sin(c.view) * sin(azimuth));
    c.wo[2] = (float)cos(c.view);
    const double z = random_uniform(random), r = sqrt(1.0 - z * z), phi = random_between(random, 0.0, 2.0 * AREA_PI);
    float d[3] = { (float)(r * cos(phi)), (float)(r * sin(phi)), (float)z };
    if (random_bits(random) & 1U) {
        const float w = (float)random_uniform(random);
        for (int k = 0; k < 3; k++)
            d[k] = w * d[k] + (1.0F - w) * (k < 2 ? -c.wo[k] : c.wo[k]);
        area_unit(d);
    }
    const glint_area_kind kind = (glint_area_kind)(random_bits(random) % 5U);
    c.light = area_light_towards(random, kind, d, random_log_between(random, 1e-4, 2.0 * AREA_PI));
    return c;
}

/* Whether there is enough light to speak of relative errors: 1e-5 of what a white diffuse surface would show. */
static inline int area_is_lit(const area_truth *truth)
{
    return truth->solid_angle > 1e-7 && truth->specular > 1e-5 * truth->cosine / AREA_PI && truth->cosine > 0.0;
}

#endif
