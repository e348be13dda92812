/* What a render owns, in two parts: the stage, which all pictures of a scene share, and the view of one camera. */
#ifndef PREVIEW_STAGE_H
#define PREVIEW_STAGE_H

#include "preview/planned.h"

typedef struct stage {
    const scene *scene;
    geometry geometry;
    trace_scene *trace;
    materials materials;
    textures *textures;
    shader shader;
    environment_map own_map; /* of the scene's image-based light */
    environment environment;
    bool has_environment;
    emitters emitters;
} stage;

/* Of the options counts what preview_stage_open says. The stage may not move afterwards: the tracer points into it.
 * samples: about how many its pictures will take in all; infinite where that is not known. Whether it succeeds or not,
 * stage_take_down frees what there is. */
bool stage_set_up(stage *st, const scene *s, const preview_options *o, double samples, preview_statistics *statistics,
                  report *r);
void stage_take_down(stage *st);

/* See preview_stage_change. */
bool stage_change(stage *st, const preview_change *change, const preview_options *o, report *r);
/* What surrounds the scene; has_environment says whether there is a map. */
bool stage_set_environment(stage *st, const preview_options *o, report *r);

typedef struct view {
    camera camera;
    light *lights;
    light_tree light_tree; /* of many lights */
    planned planned;       /* where the options leave something out */
    world world;
} view;

/* The view may not move either. */
bool view_set_up(view *v, const stage *st, const preview_options *o, report *r);
void view_take_down(view *v);
/* The plan of a view, and all that there is to say of it, its noise as well; the caller destroys it. On failure *plan
 * is NULL. */
bool view_plan(const stage *st, const preview_options *o, glint_plan **plan, report *r);

bool stage_check_options(const preview_options *o, report *r);
/* An error when the explicit model met more facets than it visits. */
bool stage_check_counts(const stage *st, const ray_counts *counts, report *r);
void stage_count(const ray_counts *counts, preview_statistics *statistics);

#endif
