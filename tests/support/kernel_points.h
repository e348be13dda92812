/* Points for the counting kernel's own tests, one set a program: anything that it may be asked, or all of one kind. */
#ifndef TESTS_KERNEL_POINTS_H
#define TESTS_KERNEL_POINTS_H

#include <stdint.h>

#include "model/counting_kernel.h"
#include "statistics.h"

enum { COUNT = 4096 };

typedef struct arrays {
    double u[COUNT], v[COUNT];
    float dudx[COUNT], dudy[COUNT], dvdx[COUNT], dvdy[COUNT], density[COUNT], hx[COUNT], hy[COUNT], cap[COUNT],
        p[COUNT];
    uint32_t seed[COUNT];
} arrays;

static arrays a;
static const counting_points points = { a.u,       a.v,    a.dudx, a.dudy, a.dvdx, a.dvdy,
                                        a.density, a.seed, a.hx,   a.hy,   a.cap,  a.p };

/* Log-uniform over everything that an ordinary scene and a hostile one may ask. */
static inline void fill(uint64_t *random)
{
    for (int i = 0; i < COUNT; i++) {
        const double size = random_log_between(random, 1e-7, 10.0), turn = random_between(random, 0.0, 6.3);
        const double minor = size / random_log_between(random, 1.0, 1e4);
        /* Up to 10^12 cells from the origin: of a double's 52 bits, 12 are left for the place within the cell. */
        const double far = minor * random_log_between(random, 1e-3, 1e12);
        a.u[i] = random_between(random, -far, far);
        a.v[i] = random_between(random, -far, far);
        a.dudx[i] = (float)(size * cos(turn));
        a.dvdx[i] = (float)(size * sin(turn));
        a.dudy[i] = (float)(-minor * sin(turn));
        a.dvdy[i] = (float)(minor * cos(turn));
        if (random_bits(random) % 50 == 0)
            a.dudy[i] = a.dvdy[i] = 0.0F;
        const double n = random_log_between(random, 1e-6, 1e12);
        a.density[i] = (float)(n / (size * minor));
        a.hx[i] = (float)random_between(random, -0.7, 0.7);
        a.hy[i] = (float)random_between(random, -0.7, 0.7);
        a.cap[i] = (float)random_log_between(random, 1e-10, 3.0);
        a.p[i] = (float)random_log_between(random, 1e-12, 1.0);
        if (random_bits(random) % 20 == 0)
            a.p[i] = 1.0F - a.p[i];
        a.seed[i] = (uint32_t)random_bits(random);
    }
}

/* Points of N facets with this p, of which the kernel counts counted(i). */
static inline void fill_alike(uint64_t *random, double n, double p)
{
    fill(random);
    for (int i = 0; i < COUNT; i++) {
        a.u[i] = random_between(random, -1.0, 1.0);
        a.v[i] = random_between(random, -1.0, 1.0);
        a.dudx[i] = a.dvdy[i] = (float)random_log_between(random, 1e-5, 1e-1);
        a.dudy[i] = 0.0F;
        a.dvdx[i] = a.dudx[i] * (float)random_between(random, 0.0, 3.0);
        a.density[i] = (float)(n / ((double)a.dudx[i] * (double)a.dvdy[i]));
        a.p[i] = (float)p;
    }
}

/* Facets that are counted: root of det(density J J^T + I / 2). */
static inline double counted(int i)
{
    const double x = (double)a.dudx[i], y = (double)a.dudy[i], z = (double)a.dvdx[i], w = (double)a.dvdy[i];
    const double d = (double)a.density[i], uu = d * (x * x + y * y) + 0.5, vv = d * (z * z + w * w) + 0.5;
    const double uv = d * (x * z + y * w);
    return sqrt(uu * vv - uv * uv);
}

/* A table of this many colours, some channels black, and a hue. */
static inline tint_palette palette_of(uint32_t count, float variation)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.color_variation = variation;
    o.color_count = count;
    for (uint32_t i = 0; i < 3 * count; i++)
        o.colors[i / 3][i % 3] = (float)(i * 5 % 7) / 7.0F;
    return tint_palette_of(&o);
}

#endif
