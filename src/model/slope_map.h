/* Distributions of slopes as pictures of eight bits: the NDF maps of Xing et al. 2024, section 5.2, made small.
 *
 * The plane is that of slopes, s = (n_x / n_z, n_y / n_z), where a linear map of the surface stays linear (Eq. 9). Each
 * map covers only the slopes that occur, in cells of two thirds of its standard deviation, holds square roots in eight
 * bits and is read bilinearly; what that costs is measured in tests/unit/test_example_map.c. A chain of maps, each of
 * twice the variance of the one before, stands for wider lights.
 */
#ifndef MODEL_SLOPE_MAP_H
#define MODEL_SLOPE_MAP_H

#include <stddef.h>
#include <stdint.h>

enum {
    SLOPE_MAP_SIDE = 256,   /* most cells along a side */
    SLOPE_MOST_LENGTH = 32, /* of a chain: variances from 1e-9 up */
    SLOPE_CELLS = 160       /* most standard deviations in the range of slopes that fit, margins apart */
};

/* Gaussians end here, in standard deviations; what is left out is exp(-3.5^2 / 2) = .2 % of them. */
#define SLOPE_REACH 3.5F

/* One Gaussian: mean, covariance, weight. */
typedef struct slope_lobe {
    float x, y, xx, xy, yy, weight;
} slope_lobe;

typedef struct slope_range {
    float low[2], high[2];
} slope_range;

/* One picture. */
typedef struct slope_map {
    float low[2]; /* slope of the first cell */
    float cells_per_unit;
    float scale; /* density = scale * code^2 */
    uint16_t columns, rows;
    uint32_t first; /* index of the first code */
} slope_map;

/* Chains of equal length; map b of chain c is maps[c * length + b]. */
typedef struct slope_maps {
    slope_map *maps;
    uint8_t *codes;
    uint32_t length;
    float variance; /* of the first map of a chain: the least that a lobe may have */
} slope_maps;

/* How many maps take a variance to that of the whole plane. */
uint32_t slope_chain_length(float variance);

/* Places a chain for lobes whose means, spread and all, lie in the range; its codes begin at *code_count, which moves
 * on. The range is at most SLOPE_CELLS standard deviations wide. */
void slope_maps_place(slope_maps *maps, uint32_t chain, const slope_range *range, size_t *code_count);

/* Floats that slope_maps_encode needs. The first SLOPE_MAP_SIDE^2 are the density that slope_map_add adds to. */
enum { SLOPE_WORK = 2 * SLOPE_MAP_SIDE * SLOPE_MAP_SIDE };

/* Adds a lobe, base variance included, to the density of the first map of a chain. */
void slope_map_add(const slope_map *map, float *density, slope_lobe lobe);

/* Widens and encodes the density into the maps of a chain; each integrates to one. Leaves work zero. */
void slope_maps_encode(slope_maps *maps, uint32_t chain, float *work);

/* Two neighbours of a chain and the weight of the narrower, 0 to 1: what stands for a variance. */
typedef struct slope_blend {
    uint32_t narrow, wide;
    float weight;
} slope_blend;

/* For a variance of at least that of the maps. */
slope_blend slope_maps_blend(const slope_maps *maps, float variance);
float slope_maps_blended(const slope_maps *maps, uint32_t chain, const slope_blend *blend, float x, float y);

/* Density of the slope (x, y), blurred to this variance: both in one. */
float slope_maps_density(const slope_maps *maps, uint32_t chain, float variance, float x, float y);

/* Sums of squared codes below each row of a map, of rows + 1 entries. */
void slope_map_row_sums(const slope_maps *maps, const slope_map *map, float *sums);

/* Draws a slope with the density of the map itself: a cell by its square, then a tent around it. u1, u2 in [0, 1). */
void slope_map_sample(const slope_maps *maps, const slope_map *map, const float *row_sums, float u1, float u2,
                      float slope[2]);

#endif
