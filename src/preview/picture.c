/* A picture that grows: the sums of its pixels stay between passes, so that a pass goes on where the last one ended. */
#include <math.h>
#include <stdlib.h>

#include "preview/stage.h"
#include "preview/tiles.h"

struct preview_stage {
    stage stage;
};

struct preview_picture {
    const stage *stage;
    preview_options options;
    preview_sky sky;
    view view;
    image film;
    film_sums sums;
};

bool preview_stage_open(const scene *s, const preview_options *options, preview_stage **out, report *r)
{
    preview_statistics unused;
    *out = NULL;
    if (!stage_check_options(options, r))
        return false;
    preview_stage *const made = calloc(1, sizeof *made);
    if (made == NULL)
        return report_error(r, "no memory for the scene");
    if (!stage_set_up(&made->stage, s, options, (double)INFINITY, &unused, r)) {
        preview_stage_close(made);
        return false;
    }
    *out = made;
    return true;
}

bool preview_stage_change(preview_stage *s, const preview_change *change, const preview_options *options, report *r)
{
    return stage_check_options(options, r) && stage_change(&s->stage, change, options, r);
}

void preview_stage_close(preview_stage *s)
{
    if (s == NULL)
        return;
    stage_take_down(&s->stage);
    free(s);
}

bool preview_stage_plan(const preview_stage *s, const preview_options *options, glint_plan **plan, report *r)
{
    *plan = NULL;
    return stage_check_options(options, r) && view_plan(&s->stage, options, plan, r);
}

bool preview_picture_open(const preview_stage *s, const preview_options *options, preview_picture **out, report *r)
{
    *out = NULL;
    if (!stage_check_options(options, r))
        return false;
    preview_picture *const p = calloc(1, sizeof *p);
    if (p == NULL)
        return report_error(r, "no memory for a picture");
    p->stage = &s->stage;
    p->options = *options;
    if (options->sky != NULL) {
        p->sky = *options->sky;
        p->options.sky = &p->sky;
    }
    if (!view_set_up(&p->view, p->stage, &p->options, r) || !film_of_options(&p->options, &p->film, r) ||
        !film_sums_make(&p->sums, &p->film, r)) {
        preview_picture_close(p);
        return false;
    }
    p->options.camera = NULL; /* the caller's, and in the view by now */
    *out = p;
    return true;
}

int preview_picture_samples(const preview_picture *p)
{
    return p->view.world.spp;
}

bool preview_picture_refine(preview_picture *p, int samples, preview_statistics *statistics, report *r)
{
    const int most = preview_picture_samples(p);
    if (samples < 1 || samples > most)
        return report_error(r, "preview: samples is %d; expected 1 to the picture's %d", samples, most);
    const tiles_job job = {
        .world = &p->view.world, .options = &p->options, .samples = samples, .film = &p->film, .sums = &p->sums
    };
    ray_counts counts = { 0 };
    const bool finished = tiles_render(&job, &counts, r);
    if (statistics != NULL) {
        *statistics = (preview_statistics){ 0 };
        stage_count(&counts, statistics);
    }
    return stage_check_counts(p->stage, &counts, r) && finished;
}

const image *preview_picture_image(const preview_picture *p)
{
    return &p->film;
}

void preview_picture_close(preview_picture *p)
{
    if (p == NULL)
        return;
    view_take_down(&p->view);
    film_sums_free(&p->sums);
    image_free(&p->film);
    free(p);
}
