/* A counter hands out tiles; every thread writes pixels that no other touches, so neither order nor number shows. */
#include "preview/tiles.h"

#include <math.h>
#include <pthread.h>
#include <time.h>
#include <unistd.h>

#define TILE_SIZE 16
#define MOST_THREADS 256
#define PROGRESS_INTERVAL_S 0.1

typedef struct queue {
    const tiles_job *job;
    int columns, tile_count;
    atomic_int next, done;
    double started_s;
} queue;

/* A cache line apart, so that counting does not slow the neighbours down. */
typedef struct worker {
    _Alignas(64) queue *queue;
    ray_counts counts;
    pthread_t thread;
} worker;

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

static void render_pixel(const tiles_job *job, int x, int y, ray_counts *counts)
{
    const bool whole = job->options->tile_width == 0;
    const int left = whole ? 0 : job->options->tile_x;
    const int top = whole ? 0 : job->options->tile_y;
    film_pixel pixel = { 0 };
    if (job->sums != NULL)
        film_sums_load(job->sums, x, y, &pixel);
    while (pixel.samples < (uint32_t)job->samples) {
        pixel_sample sample;
        integrate(job->world, left + x, top + y, pixel.samples, &sample, counts);
        film_add(&pixel, &sample);
    }
    film_write(job->film, x, y, &pixel);
    if (job->sums != NULL)
        film_sums_store(job->sums, x, y, &pixel);
}

static void render_tile(const queue *q, int index, ray_counts *counts)
{
    const tiles_job *const job = q->job;
    const int left = index % q->columns * TILE_SIZE;
    const int top = index / q->columns * TILE_SIZE;
    const int right = left + TILE_SIZE < job->film->width ? left + TILE_SIZE : job->film->width;
    const int bottom = top + TILE_SIZE < job->film->height ? top + TILE_SIZE : job->film->height;
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right && !cancelled(job); ++x)
            render_pixel(job, x, y, counts);
    }
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
static void work(queue *q, ray_counts *counts, bool reports)
{
    double reported_s = q->started_s;
    for (;;) {
        const int index = atomic_fetch_add(&q->next, 1);
        if (index >= q->tile_count || cancelled(q->job))
            return;
        render_tile(q, index, counts);
        atomic_fetch_add(&q->done, 1);
        if (reports)
            report_progress(q, &reported_s);
    }
}

static void *run(void *argument)
{
    worker *const w = argument;
    work(w->queue, &w->counts, false);
    return NULL;
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

static int thread_count(const tiles_job *job, int tile_count)
{
    long count = job->options->threads > 0 ? job->options->threads : sysconf(_SC_NPROCESSORS_ONLN);
    count = count < MOST_THREADS ? count : MOST_THREADS;
    count = count < tile_count ? count : tile_count;
    return count > 1 ? (int)count : 1;
}

bool tiles_render(const tiles_job *job, ray_counts *counts)
{
    const int columns = (job->film->width + TILE_SIZE - 1) / TILE_SIZE;
    const int rows = (job->film->height + TILE_SIZE - 1) / TILE_SIZE;
    queue q = { .job = job, .columns = columns, .tile_count = columns * rows, .started_s = now_s() };
    atomic_init(&q.next, 0);
    atomic_init(&q.done, 0);

    /* A thread that the system refuses leaves its share to the others. */
    worker others[MOST_THREADS - 1] = { 0 };
    const int wanted = thread_count(job, q.tile_count) - 1;
    int started = 0;
    while (started < wanted) {
        others[started].queue = &q;
        if (pthread_create(&others[started].thread, NULL, run, &others[started]) != 0)
            break;
        ++started;
    }
    work(&q, counts, true);
    for (int i = 0; i < started; ++i) {
        pthread_join(others[i].thread, NULL);
        add_counts(counts, &others[i].counts);
    }
    double reported_s = 0.0;
    if (!cancelled(job))
        report_progress(&q, &reported_s);
    return !cancelled(job);
}
