/* A counter hands out tiles; every thread writes pixels that no other touches, so neither order nor number shows. */
#include "preview/tiles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "preview/block.h"
#include "preview/threads.h"

#define PROGRESS_INTERVAL_S 0.1

typedef struct queue {
    const tiles_job *job;
    block_window window; /* which part of the picture the film is; tiles and blocks are those of the whole */
    int first_column, first_row, columns, tile_count;
    atomic_int next, done;
    double started_s;
} queue;

/* A cache line apart, so that counting does not slow the neighbours down. */
typedef struct worker {
    _Alignas(64) ray_counts counts;
    block block;
    film_pixel pixels[BLOCK_PIXELS];
} worker;

typedef struct crew {
    queue queue;
    worker *workers;
} crew;

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool cancelled(const tiles_job *job)
{
    return job->options->cancel != NULL && atomic_load(job->options->cancel);
}

/* All pixels of a block have as many samples: a picture that grows has the same blocks every time. */
static void render_block(const queue *q, int x, int y, worker *own)
{
    const tiles_job *const job = q->job;
    const bool described = film_is_described(job->film);
    block *const b = &own->block;
    uint32_t index = 0;
    block_begin(b, x, y, &q->window, job->world->seed);
    memset(own->pixels, 0, sizeof own->pixels);
    for (int i = 0; job->sums != NULL && i < BLOCK_PIXELS; ++i)
        if (b->is_seen[i]) {
            film_sums_load(job->sums, b->x[i] - q->window.left, b->y[i] - q->window.top, &own->pixels[i]);
            index = own->pixels[i].samples;
        }
    for (; index < (uint32_t)job->samples && !cancelled(job); ++index) {
        block_integrate(job->world, b, index, described, &own->counts);
        for (int i = 0; i < BLOCK_PIXELS; ++i)
            if (b->is_seen[i])
                film_add(&own->pixels[i], &b->seen[i], described);
    }
    for (int i = 0; i < BLOCK_PIXELS; ++i)
        if (b->is_seen[i]) {
            film_write(job->film, b->x[i] - q->window.left, b->y[i] - q->window.top, &own->pixels[i]);
            if (job->sums != NULL)
                film_sums_store(job->sums, b->x[i] - q->window.left, b->y[i] - q->window.top, &own->pixels[i]);
        }
}

/* A tile is a block: the fewer pixels it has, the less the threads wait for the last one, which shows in pictures of a
 * few thousand. */
static void render_tile(const queue *q, int index, worker *own)
{
    const int column = q->first_column + index % q->columns, row = q->first_row + index / q->columns;
    render_block(q, column * BLOCK_SIDE, row * BLOCK_SIDE, own);
}

static void report_progress(const queue *q, double *reported_s)
{
    const preview_options *const o = q->job->options;
    const double now = now_s();
    const int done = atomic_load(&q->done);
    const bool last = done == q->tile_count;
    if (o->progress == NULL || (!last && now - *reported_s < PROGRESS_INTERVAL_S))
        return;
    const double fraction = (double)done / q->tile_count;
    const double elapsed = now - q->started_s;
    *reported_s = now;
    o->progress(fraction, elapsed, fraction > 0.0 ? elapsed * (1.0 - fraction) / fraction : 0.0, o->user);
}

/* Takes tiles until there are none. The calling thread alone reports progress. */
static void work(queue *q, worker *own, bool reports)
{
    double reported_s = q->started_s;
    for (;;) {
        const int index = atomic_fetch_add(&q->next, 1);
        if (index >= q->tile_count || cancelled(q->job))
            return;
        render_tile(q, index, own);
        atomic_fetch_add(&q->done, 1);
        if (reports)
            report_progress(q, &reported_s);
    }
}

static void run(void *user, int thread)
{
    crew *const c = user;
    work(&c->queue, &c->workers[thread], thread == 0);
}

static void add_counts(ray_counts *sum, const ray_counts *part)
{
    sum->camera_rays += part->camera_rays;
    sum->shadow_rays += part->shadow_rays;
    sum->bounce_rays += part->bounce_rays;
    sum->glint_evals += part->glint_evals;
    sum->smooth_evals += part->smooth_evals;
    sum->over_limit += part->over_limit;
    sum->most_facets = fmaxf(sum->most_facets, part->most_facets);
}

static queue queue_of(const tiles_job *job)
{
    const preview_options *const o = job->options;
    const int left = o->tile_width == 0 ? 0 : o->tile_x, top = o->tile_width == 0 ? 0 : o->tile_y;
    queue q = { .job = job,
                .window = { left, top, left + job->film->width, top + job->film->height },
                .first_column = left / BLOCK_SIDE,
                .first_row = top / BLOCK_SIDE,
                .started_s = now_s() };
    q.columns = (q.window.right - 1) / BLOCK_SIDE - q.first_column + 1;
    q.tile_count = q.columns * ((q.window.bottom - 1) / BLOCK_SIDE - q.first_row + 1);
    atomic_init(&q.next, 0);
    atomic_init(&q.done, 0);
    return q;
}

/* All that the threads work on is here before the first tile. */
bool tiles_render(const tiles_job *job, ray_counts *counts, report *r)
{
    crew c = { .queue = queue_of(job) };
    const int count = threads_count(job->options->threads, c.queue.tile_count);
    c.workers = aligned_alloc(_Alignof(worker), (size_t)count * sizeof *c.workers);
    if (c.workers == NULL)
        return report_error(r, "no memory for %d threads", count);
    for (int i = 0; i < count; ++i)
        c.workers[i].counts = (ray_counts){ 0 };
    threads_run(count, run, &c);
    for (int i = 0; i < count; ++i)
        add_counts(counts, &c.workers[i].counts);
    free(c.workers);
    double reported_s = 0.0;
    if (!cancelled(job))
        report_progress(&c.queue, &reported_s);
    return !cancelled(job);
}
