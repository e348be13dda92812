/* Shares the tiles of a picture out to threads. */
#ifndef PREVIEW_TILES_H
#define PREVIEW_TILES_H

#include "preview/film.h"

typedef struct tiles_job {
    const world *world;
    const preview_options *options; /* progress, cancel, threads */
    int left, top;                  /* of the film in the picture, pixels */
    image *film;
} tiles_job;

/* Renders the whole film. False: cancelled, then the film is unfinished. */
bool tiles_render(const tiles_job *job, ray_counts *counts);

#endif
