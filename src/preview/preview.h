/* Renders a scene to an image: camera rays with differentials, direct light with shadows, indirect light by bounces. */
#ifndef PREVIEW_PREVIEW_H
#define PREVIEW_PREVIEW_H

#include <stdatomic.h>

#include "io/environment_map.h"
#include "io/image.h"
#include "scene/report.h"
#include "scene/scene.h"

typedef enum preview_model { PREVIEW_MODEL_AUTO = -1 } preview_model; /* else a glint_model */

/* Which facets there are. Those of another renderer are a flat grid of facets of equal projected area that the texture
 * coordinates alone decide: model explicit then shows flake by flake what that renderer shows, and the other models its
 * statistics. */
typedef enum preview_facets { PREVIEW_FACETS_OWN, PREVIEW_FACETS_CYCLES, PREVIEW_FACETS_POVRAY } preview_facets;

/* A sky that is a gradient in the height of the direction; radiance, linear RGB, y is up. */
typedef struct preview_sky {
    float zenith[3], horizon[3], ground[3];
} preview_sky;

/* Light from a map, which the caller keeps. */
typedef struct preview_environment {
    const environment_map *map;
    float rotation[4]; /* a quaternion x y z w that turns the map; unit within 1 percent */
    float scale;       /* radiance of a texel of 1 */
} preview_environment;

typedef struct preview_options {
    size_t size;                                 /* set by PREVIEW_OPTIONS_INIT */
    int width, height;                           /* pixels, [1, 65536] */
    int tile_x, tile_y, tile_width, tile_height; /* the part to render, inside the picture; width 0: all */
    int spp;       /* samples per pixel, [1, 65536]; powers of 4 are spread best. 0: as many as the accuracy takes */
    int bounces;   /* of indirect light from surface to surface, [0, 64]; 0: lights and sky only */
    int threads;   /* 0: one a core */
    uint32_t seed; /* of the sampling noise; the facets have the material's own */
    int model;     /* a glint_model for every material, or PREVIEW_MODEL_AUTO */
    preview_facets facets;
    const scene_camera *camera; /* NULL: the scene's first, or one framed around it */
    bool aov;                   /* the channels of --aov as well */
    /* From the calling thread, about ten times a second. */
    void (*progress)(double fraction, double elapsed_s, double left_s, void *user);
    void *user;
    const atomic_bool *cancel; /* may be NULL; when it turns true, rendering ends and returns false without an error */
    const preview_sky *sky;    /* NULL: that of the lookdev rig where the scene has no lights, else black */
    bool transparent;          /* camera rays do not see the sky: alpha 0 there */
    const preview_environment *environment; /* in place of any sky; NULL: that of the scene, if it has one */
    double accuracy; /* [0, 1], the error that a picture may have for speed: relative, root mean square over pixels,
                        against accuracy 0, which leaves nothing out. docs/plan.md */
    glint_area_light_method area_lights; /* of accuracy 0; else the plan chooses */
    /* From the calling thread, before the first ray of the picture; plan is NULL for accuracy 0. It dies with the
     * render. NULL: no one asks, and noise that nothing is decided by is not measured. */
    void (*planned)(const glint_plan *plan, void *user);
} preview_options;

#define PREVIEW_OPTIONS_INIT                                                                                           \
    {                                                                                                                  \
        sizeof(preview_options), 1280, 720, 0, 0, 0, 0, 16, 1, 0, 0, PREVIEW_MODEL_AUTO, PREVIEW_FACETS_OWN, 0, false, \
            0, 0, 0, 0, false, 0, 0.0, GLINT_AREA_LIGHT_EXACT, 0                                                       \
    }

typedef struct preview_statistics {
    double load_s, build_s, render_s;
    int samples; /* per pixel */
    uint64_t camera_rays, shadow_rays, bounce_rays, glint_evals, smooth_evals;
} preview_statistics;

/* Renders into *out, which has the size of the tile.
 *
 * Pixels are scene-linear. The bits depend on the scene and the options, not on the number of threads or the tile.
 * Another machine gives the same bits but for the last ones of libm's sin, cos and tan, and for a ray in a million that
 * meets an edge between two triangles. A scene without a camera gets a framed one; without lights and environment, and
 * where the options bring neither sky nor environment, a lookdev rig and its sky.
 *
 * Channels: R G B A, with RGB multiplied by A. With aov also, all as means over the samples of the pixel:
 *   smooth.R/G/B    the same picture, sample by sample, without discreteness
 *   glints.N        facets under the pixel, in the layer and the surface that the camera sees first
 *   glints.p        probability that one of them reflects the light that is brightest there to the camera
 *   normal.X/Y/Z    shading normal of the base, world space, towards the camera
 *   albedo.R/G/B    base colour
 *   depth.Z         metres along the viewing direction, the mean over the samples that hit something; 0: none did
 * On failure *out is zeroed. statistics may be NULL. */
bool preview_render(const scene *s, const preview_options *options, image *out, preview_statistics *statistics,
                    report *r);

/* What a render with these options would leave out, and what it would cost; of accuracy 0: what all of it costs. The
 * caller destroys it. On failure *plan is NULL. */
bool preview_plan(const scene *s, const preview_options *options, glint_plan **plan, report *r);

/* ---- many pictures of one scene, and pictures that grow ---- */

/* A scene made ready for rays: of the options count model, facets, area_lights,
 * environment and sky. */
typedef struct preview_stage preview_stage;

/* The scene and the environment's map must outlive the stage. On failure *out is NULL. */
bool preview_stage_open(const scene *s, const preview_options *options, preview_stage **out, report *r);
/* NULL is allowed. Its pictures must be closed before. */
void preview_stage_close(preview_stage *stage);

/* What a stage makes anew after its caller has put something else into the scene: meshes and instances stay, and with
 * them the tree. Lights need nothing. */
typedef struct preview_change {
    const scene_material *before; /* NULL, or the materials that the scene had, as many as now */
    bool images;                  /* the scene has other images */
    bool environment;             /* that of the options is another one */
} preview_change;

/* Of the options counts what preview_stage_open says. No picture of the stage may be open. On failure the stage is as
 * it was before, and the scene must become so again. */
bool preview_stage_change(preview_stage *stage, const preview_change *change, const preview_options *options,
                          report *r);

/* As preview_plan, of a stage that stands. */
bool preview_stage_plan(const preview_stage *stage, const preview_options *options, glint_plan **plan, report *r);

/* One picture under way. Any number may be open on a stage, each in a thread of its own. */
typedef struct preview_picture preview_picture;

/* Of the options counts all but model, facets, area_lights and environment, which are the stage's; sky and camera are
 * copied, and cancel must outlive the picture. spp is the number of samples in the end: it decides how large the
 * footprint of each is. On failure *out is NULL. */
bool preview_picture_open(const preview_stage *stage, const preview_options *options, preview_picture **out, report *r);
/* Of a pixel in the end: spp, or what the plan has chosen. */
int preview_picture_samples(const preview_picture *p);
/* Adds samples to every pixel until it has as many as are asked for, [1, preview_picture_samples]. The picture then is,
 * bit for bit, that of any other way to the same number; with all of them it is that of preview_render, but where
 * surfaces coincide: see trace_trees_for.
 *
 * False without an error: cancelled. Pixels then have different numbers of samples, each is the mean of its own, and a
 * further call goes on. False with an error: what preview_render says of too many facets; the pixels are good. */
bool preview_picture_refine(preview_picture *p, int samples, preview_statistics *statistics, report *r);
/* Its pixels so far; the picture's own. */
const image *preview_picture_image(const preview_picture *p);
/* NULL is allowed. */
void preview_picture_close(preview_picture *p);

/* ---- what a scene without a camera or without light gets ---- */

scene_camera preview_framed_camera(const scene *s, int width, int height);
/* Appends a key light, a fill and a rim, placed around the view of the first camera, to s->lights. */
bool preview_add_lookdev_rig(scene *s, report *r);

/* ---- light sets: lights that suit any file ---- */

/* The name of a set ("three-point"), from 0 on; NULL behind the last. */
const char *preview_light_set_name(int set);
/* Puts a set in the place of the scene's lights and its image-based light: as large as what the middle of the view
 * shows, and around it. *sky is what surrounds it, for preview_options. */
bool preview_use_light_set(scene *s, int set, const scene_camera *view, preview_sky *sky, report *r);

#endif
