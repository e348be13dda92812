/* What the files of the example model share: the baked example and its lattice of instances (Xing et al. 2024).
 *
 * Three planes: the example, [0, 1]^2, y up; the lattice, one example for every unit square; the surface in units of an
 * example's side. Slopes go the other way by the transpose: with x_surface = L x_example, s_example = L^T s_surface.
 */
#ifndef MODEL_EXAMPLE_H
#define MODEL_EXAMPLE_H

#include "model/model.h"
#include "model/slope_map.h"

enum {
    EXAMPLE_LEAST_SIZE = 8,
    EXAMPLE_MOST_SIZE = 256,
    EXAMPLE_LEAST_MAP_LEVEL = 1, /* tiles of 4 x 4 texels; of 2 x 2 the four Gaussians are the shorter code */
    EXAMPLE_MOST_LEVELS = 8
};

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

/* A seed Gaussian of Eq. 4: mean slope and its Jacobian per unit of the example. Its place is its index. */
typedef struct example_texel {
    float slope[2];
    matrix2 jacobian;
} example_texel;

/* E[max(w . s, -c)] over the slopes s of the whole surface, for directions w and cotangents c: see example_masking.c.
 */
enum { EXAMPLE_MASKING_DIRECTIONS = 32, EXAMPLE_MASKING_ANGLES = 32 };

typedef struct example_masking {
    float steepest; /* above every slope */
    float direction[EXAMPLE_MASKING_DIRECTIONS][2];
    float table[EXAMPLE_MASKING_DIRECTIONS][EXAMPLE_MASKING_ANGLES];
} example_masking;

/* Seeds, maps and masking of one material. */
typedef struct example {
    const glint_example *options;
    uint32_t size, levels;                    /* levels - 1 is the top: one tile */
    uint32_t first_tile[EXAMPLE_MOST_LEVELS]; /* of each level, in ranges or in the chains of tiles */
    float seed_variance;                      /* sigma_h^2, example units */
    float slope_variance;                     /* sigma_r^2 and the facets' own roughness */
    example_texel *texels;                    /* size * size */
    slope_range *ranges;                      /* of tiles of the levels without a map */
    slope_maps tiles;                         /* chains of the other levels, level by level */
    slope_maps overall;                       /* one chain: the whole surface */
    float *row_sums;                          /* of the first map of overall */
    example_masking masking;
    matrix2 from_lattice; /* lattice to surface: M of tiled examples, the unit matrix of scattered ones */
    matrix2 to_lattice;
    void *maps_block, *codes_block; /* memory of the maps and of their codes */
} example;

/* Tiles of a level along one side, and how many tiles lie in levels first to level - 1: the index of a level's first.
 */
static inline uint32_t example_tiles_along(const example *e, uint32_t level)
{
    return e->size >> (level + 1);
}

static inline uint32_t example_tiles_before(const example *e, uint32_t first, uint32_t level)
{
    uint32_t count = 0;
    for (uint32_t l = first; l < level; l++)
        count += example_tiles_along(e, l) * example_tiles_along(e, l);
    return count;
}

/* M = rotation * (scale_x, shear_x; shear_y, scale_y): Eq. 9. */
matrix2 example_transform(const glint_example *o);

/* Longer diagonal of the unit square under a map. */
float example_diagonal(matrix2 m);

/* Slope of texel i of the options' normals; false when it is larger than 8, or not a number. */
int example_normal_slope(const glint_example *o, uint32_t i, float slope[2]);

/* Fills texels, ranges and variances from the options. */
void example_seed(example *e, const glint_material_options *o);
/* Places every map; returns how many codes the maps need. */
size_t example_place_maps(example *e);
/* Fills the maps and the masking; work: SLOPE_WORK floats of zero. */
void example_fill_maps(example *e, float *work);

void example_masking_bake(example_masking *m, const slope_maps *overall);

/* cos Lambda(v): what masking adds to the projected area v.z. x and y are v's, times the stretch of slopes there. */
float example_masked(const example_masking *m, float x, float y, float z);

/* One example on the lattice. */
typedef struct instance {
    float x, y;       /* centre, lattice units, from the corner of the reference cell */
    matrix2 to_frame; /* example to lattice */
    matrix2 to_local; /* and back */
    float radius;     /* half its longer diagonal */
} instance;

/* The instance of cell (i, j), offset cells from the reference cell. */
instance example_instance(const example *e, uint32_t i, uint32_t j, int offset_i, int offset_j, uint32_t seed);

/* Whether an instance covers a point of the lattice. */
static inline int instance_covers(const instance *n, float x, float y)
{
    const float dx = x - n->x, dy = y - n->y;
    const float a = n->to_local.xx * dx + n->to_local.xy * dy, b = n->to_local.yx * dx + n->to_local.yy * dy;
    return fabsf(a) <= 0.5F && fabsf(b) <= 0.5F;
}

/* A Gaussian footprint on the lattice. */
typedef struct example_footprint {
    uint32_t cell[2];   /* reference cell, modulo 2^32 */
    float at[2];        /* centre, from the corner of that cell, in [0, 1) */
    covariance2 spread; /* bounded: see example_footprint_of */
    float share;        /* [0, 1]: how much of the difference from the overall distribution such a footprint keeps */
} example_footprint;

/* The footprint of a query on the lattice of examples with this side. False: it has no area, or it lies too far out. */
int example_footprint_of(const example *e, const model_query *q, float side_m, example_footprint *f);

/* Density of slopes under a footprint: Eq. 6 with Eq. 7 for whole tiles, at the lattice slope, blurred by the light's
 * variance in lattice slopes. */
float example_density(const example *e, const example_footprint *f, const float slope[2], float light_variance,
                      uint32_t seed);

#endif
