/* The lattice that examples lie on, as transforms and as what a pixel sees of it (Xing et al. 2024, sections 6.1 and
 * 6.2).
 *
 * Three planes: the example, [0, 1]^2; the lattice, one example for every unit square; the surface in units of an
 * example's side. Slopes go the other way by the transpose: with x_surface = L x_example, s_example = L^T s_surface.
 */
#ifndef MODEL_EXAMPLE_PLACE_H
#define MODEL_EXAMPLE_PLACE_H

#include "model/model.h"

/* Half the diagonal of the largest scattered instance, in lattice units: what bounds the neighbours of a point. */
#define EXAMPLE_MOST_RADIUS 1.06F

typedef struct matrix2 {
    float xx, xy, yx, yy; /* rows (xx, xy) and (yx, yy) */
} matrix2;

static inline matrix2 matrix2_product(matrix2 a, matrix2 b)
{
    return (matrix2){ a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx,
                      a.yx * b.xy + a.yy * b.yy };
}

static inline float matrix2_determinant(matrix2 a)
{
    return a.xx * a.yy - a.xy * a.yx;
}

static inline matrix2 matrix2_inverse(matrix2 a)
{
    const float d = 1.0F / matrix2_determinant(a);
    return (matrix2){ a.yy * d, -a.xy * d, -a.yx * d, a.xx * d };
}

/* Symmetric 2 x 2. */
typedef struct covariance2 {
    float xx, xy, yy;
} covariance2;

/* a c a^T */
static inline covariance2 covariance2_mapped(matrix2 a, covariance2 c)
{
    const float px = a.xx * c.xx + a.xy * c.xy, py = a.xx * c.xy + a.xy * c.yy;
    const float qx = a.yx * c.xx + a.yy * c.xy, qy = a.yx * c.xy + a.yy * c.yy;
    return (covariance2){ px * a.xx + py * a.xy, px * a.yx + py * a.yy, qx * a.yx + qy * a.yy };
}

/* One of the ways in which an example may lie on the lattice. */
typedef struct variant {
    matrix2 to_frame; /* example to lattice */
    matrix2 to_local; /* and back */
    float radius;     /* half its longer diagonal */
    float row[2];     /* lengths of the rows of to_local: how far a circle of radius 1 reaches there */
} variant;

/* Enough that neighbours seldom look alike; 11 KiB, which stay in the cache (cost). */
enum { LATTICE_VARIANTS = 256 };

/* Those of tiled examples that are mirrored: along neither axis, one, the other, both. */
enum { LATTICE_MIRRORED = 4 };

typedef struct lattice {
    int is_scattered;
    int is_alike;         /* every square holds the same */
    uint32_t kinds;       /* variants that differ; the others repeat them in turn */
    float jitter;         /* see glint_example */
    float seed_variance;  /* sigma_h^2, example units */
    matrix2 from_lattice; /* to the surface: M of tiled examples, the unit matrix of scattered ones */
    matrix2 to_lattice;
    float most_radius;  /* of all variants */
    float most_stretch; /* of a length, from example to lattice, in all variants */
    variant variants[LATTICE_VARIANTS];
} lattice;

void lattice_make(lattice *l, const glint_example *o);

/* One example on the lattice. */
typedef struct instance {
    float x, y; /* centre, lattice units, from the corner of the reference cell */
    variant as;
} instance;

/* The centre of the instance of cell (i, j), offset cells from the reference cell; the result says which variant it is.
 */
const variant *lattice_centre(const lattice *l, uint32_t i, uint32_t j, int offset_i, int offset_j, uint32_t seed,
                              float *x, float *y);
instance lattice_instance(const lattice *l, uint32_t i, uint32_t j, int offset_i, int offset_j, uint32_t seed);

/* A place on the lattice in coordinates of an example, from its middle. */
static inline void instance_local(const instance *n, float x, float y, float *a, float *b)
{
    const matrix2 m = n->as.to_local;
    const float dx = x - n->x, dy = y - n->y;
    *a = m.xx * dx + m.xy * dy;
    *b = m.yx * dx + m.yy * dy;
}

/* Whether an instance covers a point of the lattice. */
static inline int instance_covers(const instance *n, float x, float y)
{
    float a, b;
    instance_local(n, x, y, &a, &b);
    return fabsf(a) <= 0.5F && fabsf(b) <= 0.5F;
}

/* A Gaussian footprint on the lattice. */
typedef struct example_footprint {
    uint32_t cell[2];   /* reference cell, modulo 2^32 */
    float at[2];        /* centre, from the corner of that cell, in [0, 1) */
    covariance2 spread; /* bounded: see lattice_footprint */
    float share;        /* [0, 1]: how much of the difference from the overall distribution such a footprint keeps */
} example_footprint;

/* The footprint of a query on the lattice of examples with this side. False: it has no area, or it lies too far out. */
int lattice_footprint(const lattice *l, const model_query *q, float side_m, example_footprint *f);

#endif
