/* The baked example: its seeds, its maps and its masking, over the lattice of example_place.h (Xing et al. 2024,
 * section 5.2). The density under a footprint, in example_density.h, is made of it. */
#ifndef MODEL_EXAMPLE_H
#define MODEL_EXAMPLE_H

#include "model/example_place.h"
#include "model/slope_map.h"

enum {
    EXAMPLE_LEAST_SIZE = 8,
    EXAMPLE_MOST_SIZE = 256,
    EXAMPLE_LEAST_MAP_LEVEL = 1, /* tiles of 4 x 4 texels; of 2 x 2 the four Gaussians are the shorter code */
    EXAMPLE_MOST_LEVELS = 8
};

/* A seed Gaussian of Eq. 4: mean slope and its Jacobian per unit of the example. Its place is its index. */
typedef struct example_texel {
    float slope[2];
    matrix2 jacobian;
} example_texel;

/* The seeds of 2 x 2 texels, side by side for vectors: (0, 0), (1, 0), (0, 1), (1, 1). */
typedef struct example_quad {
    float slope[2][4];
    float jacobian[4][4]; /* xx, xy, yx, yy */
} example_quad;

/* Mean slopes of the seeds in each quarter of a tile, in the order of a quad, and the most that one of them spreads
 * along each axis. */
typedef struct quarter_slopes {
    float low[2][4], high[2][4], variance[2][4];
} quarter_slopes;

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
    uint32_t size, levels;                     /* levels - 1 is the top: one tile */
    int is_flat;                               /* texels are flat facets */
    uint32_t first_chain[EXAMPLE_MOST_LEVELS]; /* of each level with maps, in the chains of tiles and in slopes */
    float slope_variance;                      /* sigma_r^2 and the facets' own roughness */
    example_quad *quads;                       /* size^2 / 4 */
    quarter_slopes *slopes;                    /* of the tiles that have maps */
    slope_maps tiles;                          /* chains, level by level */
    slope_maps overall;                        /* one chain: the whole surface */
    float *row_sums;                           /* of the first map of overall */
    example_masking masking;
    lattice lattice;
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

static inline uint32_t example_tile(const example *e, uint32_t level, uint32_t x, uint32_t y)
{
    return y * example_tiles_along(e, level) + x;
}

static inline example_texel example_texel_at(const example *e, uint32_t x, uint32_t y)
{
    const example_quad *q = &e->quads[example_tile(e, 0, x / 2, y / 2)];
    const uint32_t k = (x & 1U) + 2U * (y & 1U);
    return (example_texel){ { q->slope[0][k], q->slope[1][k] },
                            { q->jacobian[0][k], q->jacobian[1][k], q->jacobian[2][k], q->jacobian[3][k] } };
}

/* Slope of texel i of the options' normals; false when it is larger than 8, or not a number. */
int example_normal_slope(const glint_example *o, uint32_t i, float slope[2]);

/* Fills quads, slopes and slope_variance from the options; the lattice is there. */
void example_seed(example *e, const glint_material_options *o);
/* Places every map; returns how many codes the maps need. */
size_t example_place_maps(example *e);
/* Fills the maps and the masking; work: SLOPE_WORK floats of zero. */
void example_fill_maps(example *e, float *work);

void example_masking_bake(example_masking *m, const slope_maps *overall);

/* cos Lambda(v): what masking adds to the projected area v.z. x and y are v's, times the stretch of slopes there. */
float example_masked(const example_masking *m, float x, float y, float z);

#endif
