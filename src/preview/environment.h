/* Light from all around, from a latitude-longitude map: radiance by direction, directions by radiance, and the solid
 * angle of the patch of even light that a direction belongs to.
 *
 * Small bright spots ("suns") are taken out of the map and become directional lights of their true size; what is left
 * is sampled by its radiance. docs/lighting.md has the method.
 */
#ifndef PREVIEW_ENVIRONMENT_H
#define PREVIEW_ENVIRONMENT_H

#include "io/environment_map.h"
#include "preview/light.h"
#include "preview/preview.h"

#define ENVIRONMENT_MOST_SUNS 8

typedef struct environment {
    const environment_map *map;
    double to_map[9];    /* rotation from world to map, row by row */
    float scale;         /* radiance per unit of the map */
    float *patch_sr;     /* of every texel: solid angle of its patch; 0 where a sun was; 4 pi: even all around */
    double *row_edges;   /* height + 1: the share of the light above a row */
    float *column_edges; /* (width + 1) a row: the share of a row's light to the left of a column */
    int patch_count;
    scene_light suns[ENVIRONMENT_MOST_SUNS];
    int sun_count;
} environment;

/* The map stays the caller's and must outlive the environment. */
bool environment_make(const preview_environment *from, environment *out, report *r);
void environment_free(environment *e);

/* What a camera sees: the texels blend into each other, suns included. */
void environment_seen(const environment *e, vec3 direction, float rgb[3]);

/* Light from a direction, without suns, and how to count facets under it. */
typedef struct environment_light {
    vec3 wi;              /* world, unit */
    float rgb[3];         /* radiance, even over a texel */
    float pdf;            /* per steradian, of environment_sample; 0 where nothing shines */
    float solid_angle_sr; /* of the patch; 0: light as even as this reaches all facets, count none */
} environment_light;

void environment_from(const environment *e, vec3 direction, environment_light *out);

/* Draws a direction by radiance, even over each texel, from two uniforms in [0, 1). False: the rest of the map is
 * black. */
bool environment_sample(const environment *e, const double u[2], environment_light *out);

/* ---- environment_suns.c, environment_patches.c: called by environment_make ---- */

/* Mean of the channels: what the map is split and sampled by. */
static inline double environment_level(const float rgb[3])
{
    return ((double)rgb[0] + (double)rgb[1] + (double)rgb[2]) / 3.0;
}

/* Solid angle of one texel of row y. */
double environment_texel_sr(const environment_map *m, int y);

/* Fills suns and sets patch_sr to 0 in their texels and to 1 elsewhere. */
bool environment_find_suns(environment *e, report *r);
/* Fills patch_sr where it is not 0. */
void environment_find_patches(environment *e);

#endif
