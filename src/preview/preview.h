/* Renders a scene to an image: camera rays with differentials, direct light with shadows, indirect light by bounces. */
#ifndef PREVIEW_PREVIEW_H
#define PREVIEW_PREVIEW_H

#include <stdatomic.h>

#include "io/image.h"
#include "scene/report.h"
#include "scene/scene.h"

typedef enum preview_model { PREVIEW_MODEL_AUTO = -1 } preview_model; /* else a glint_model */

typedef struct preview_options {
    size_t size;               /* set by PREVIEW_OPTIONS_INIT */
    int width, height;
    int tile_x, tile_y, tile_width, tile_height; /* the part to render; width 0: all */
    int spp;                   /* samples per pixel */
    int bounces;               /* of indirect light; 0: direct only */
    int threads;               /* 0: one a core */
    uint32_t seed;
    int model;                 /* a glint_model for every material, or PREVIEW_MODEL_AUTO */
    const scene_camera *camera; /* NULL: the scene's first, or one framed around it */
    bool aov;                  /* the channels of --aov as well */
    void (*progress)(double fraction, double elapsed_s, double left_s, void *user);
    void *user;
    const atomic_bool *cancel; /* may be NULL; when it turns true, rendering ends and returns false without an error */
} preview_options;

#define PREVIEW_OPTIONS_INIT { sizeof(preview_options), 1280, 720, 0, 0, 0, 0, 16, 1, 0, 0, PREVIEW_MODEL_AUTO, 0, false, 0, 0, 0 }

typedef struct preview_statistics {
    double load_s, build_s, render_s;
    uint64_t camera_rays, shadow_rays, bounce_rays, glint_evals, smooth_evals;
} preview_statistics;

/* Pixels are scene-linear. The bits depend on the scene, the options and nothing else: not on the number of threads, the
 * tile or the machine. A scene without a camera gets a framed one; without lights, a lookdev rig. */
bool preview_render(const scene *s, const preview_options *options, image *out, preview_statistics *statistics, report *r);

/* What the two lines above add. */
scene_camera preview_framed_camera(const scene *s, int width, int height);
/* Appends a key light, a fill and a rim, sized to the scene, to s->lights. */
bool preview_add_lookdev_rig(scene *s, report *r);

#endif
