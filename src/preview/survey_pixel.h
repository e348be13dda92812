/* What one pixel of a view shows, before anything is left out. */
#ifndef PREVIEW_SURVEY_PIXEL_H
#define PREVIEW_SURVEY_PIXEL_H

#include "preview/choose_lights.h"
#include "preview/integrator.h"

/* One light at the pixel's first surface, or what surrounds the scene. */
typedef struct survey_light {
    int index;          /* of the world's lights; their number: surroundings */
    int shape;          /* entry of a pair's shapes; negative: it is no shape there */
    double cap_off;     /* of the light, relative, that a cap in place of the shape changes */
    double cap_share;   /* of the samples that take it where the plan allows caps up to this entry */
    double probability; /* with which it was chosen among many */
    double level;       /* of its light, without single facets */
    bool counts;        /* single facets, of which so many are lit in the pixel, N p: */
    double lit;
    double facet_level; /* and what of level is theirs */
    uint64_t glint_evals, smooth_evals, shadow_rays;
    bool is_blocked; /* by a shadow, some of it */
} survey_light;

typedef struct survey_pixel {
    double level; /* of the pixel, without single facets */
    double bounced;
    double bounce_rays, sky_rays;
    int material; /* of the first surface, that light could reach; negative: none */
    glint_plan_range alpha, facets_per_m2, footprint_m2;
    survey_light lights[MOST_LIGHTS + 1];
    int light_count; /* that were looked at */
} survey_pixel;

/* direct: the world without bounces. */
void survey_pixel_look(const world *w, const world *direct, int x, int y, survey_pixel *out);

#endif
