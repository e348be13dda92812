/* Shares the tiles of a picture out to threads. */
#ifndef PREVIEW_TILES_H
#define PREVIEW_TILES_H

#include "preview/film.h"
#include "scene/report.h"

typedef struct tiles_job {
    const world *world;
    const preview_options *options; /* progress, cancel, threads, and which part of the picture the film is */
    int samples;                    /* that each pixel shall have in the end; at most world->spp */
    image *film;
    const film_sums *sums; /* what pixels have so far, and where it is kept; NULL: they start from nothing */
} tiles_job;

/* Renders the whole film. False without an error: cancelled, then the film is unfinished: its pixels have different
 * numbers of samples. */
bool tiles_render(const tiles_job *job, ray_counts *counts, report *r);

#endif
