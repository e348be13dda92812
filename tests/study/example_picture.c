#include "example_picture.h"

#include <string.h>

#include "io/image.h"

static const uint32_t CELL[2] = { 100U, 200U };
static const uint32_t SEED = 5U;
enum { BESIDE = 2, SAMPLES = 512 };

static void *room(size_t count, size_t size)
{
    void *memory = calloc(count, size);
    if (!memory) {
        fprintf(stderr, "example: no memory for %zu times %zu bytes\n", count, size);
        exit(1);
    }
    return memory;
}

/* Every instance that the picture may show. */
static void place_instances(example_picture *p, int columns, int rows)
{
    const example *e = p->b->material.baked;
    p->instances = room(2 * (size_t)(columns + 2 * BESIDE) * (size_t)(rows + 2 * BESIDE), sizeof(seed_instance));
    for (int j = -BESIDE; j < rows + BESIDE; j++)
        for (int i = -BESIDE; i < columns + BESIDE; i++) {
            const instance n = lattice_instance(&e->lattice, CELL[0], CELL[1], i, j, SEED);
            const matrix2 m = n.as.to_frame;
            p->instances[p->instance_count++] = (seed_instance){
                { (double)n.x, (double)n.y }, { (double)m.xx, (double)m.xy, (double)m.yx, (double)m.yy }, 0
            };
            if (e->lattice.is_scattered)
                p->instances[p->instance_count++] = (seed_instance){ { i + 0.5, j + 0.5 }, { 1.0, 0.0, 0.0, 1.0 }, 1 };
        }
}

/* Seeds by the square of the lattice that they lie in: first[k] to first[k + 1] - 1. */
typedef struct sorted_seeds {
    seed_surface all;
    size_t *first;
    int columns, rows;
} sorted_seeds;

static int square_of(const sorted_seeds *s, const seed_gaussian *g)
{
    const int i = (int)floor(g->at[0]) + BESIDE, j = (int)floor(g->at[1]) + BESIDE;
    return i < 0 || j < 0 || i >= s->columns || j >= s->rows ? -1 : j * s->columns + i;
}

static sorted_seeds sort_seeds(seed_surface surface, int columns, int rows)
{
    sorted_seeds s = { .columns = columns + 2 * BESIDE, .rows = rows + 2 * BESIDE };
    const size_t squares = (size_t)s.columns * (size_t)s.rows;
    s.first = room(squares + 1, sizeof(*s.first));
    s.all.seeds = room(surface.count, sizeof(*s.all.seeds));
    size_t *next = room(squares + 1, sizeof(*next));
    for (size_t k = 0; k < surface.count; k++)
        if (square_of(&s, &surface.seeds[k]) >= 0)
            s.first[square_of(&s, &surface.seeds[k]) + 1]++;
    for (size_t k = 0; k < squares; k++)
        s.first[k + 1] += s.first[k];
    memcpy(next, s.first, squares * sizeof(*next));
    for (size_t k = 0; k < surface.count; k++)
        if (square_of(&s, &surface.seeds[k]) >= 0)
            s.all.seeds[next[square_of(&s, &surface.seeds[k])]++] = surface.seeds[k];
    s.all.count = s.first[squares];
    free(next);
    free(surface.seeds);
    return s;
}

/* The seeds within reach of a point. */
static void gather(const sorted_seeds *s, const double at[2], double reach, seed_surface *near)
{
    near->count = 0;
    for (int j = (int)floor(at[1] - reach); j <= (int)floor(at[1] + reach); j++)
        for (int i = (int)floor(at[0] - reach); i <= (int)floor(at[0] + reach); i++) {
            const int square = (j + BESIDE) * s->columns + i + BESIDE;
            for (size_t k = s->first[square]; k < s->first[square + 1]; k++)
                if (hypot(s->all.seeds[k].at[0] - at[0], s->all.seeds[k].at[1] - at[1]) < reach)
                    near->seeds[near->count++] = s->all.seeds[k];
        }
}

/* Root mean square slope along an axis. */
static double rms_slope(const example *e)
{
    double square = 0.0;
    for (uint32_t i = 0; i < e->size * e->size; i++) {
        const example_texel t = example_texel_at(e, i % e->size, i / e->size);
        square += (double)(t.slope[0] * t.slope[0] + t.slope[1] * t.slope[1]) / (2.0 * e->size * e->size);
    }
    return sqrt(square);
}

static void shade(example_picture *p, const sorted_seeds *s, double sigma, seed_surface *near)
{
    const example *e = p->b->material.baked;
    const double reach =
        (double)SLOPE_REACH * hypot(sigma, (double)e->lattice.most_stretch * sqrt((double)e->lattice.seed_variance));
    const double spread[3] = { sigma * sigma, 0.0, sigma * sigma };
    for (int k = 0; k < p->width * p->height; k++) {
        const int x = k % p->width, y = k / p->width;
        const double at[2] = { (x + 0.5) * p->pixel, (y + 0.5) * p->pixel };
        const double slope[2] = { p->steepest * (2.0 * (x + 0.5) / p->width - 1.0),
                                  p->steepest * (2.0 * (y + 0.5) / p->height - 1.0) };
        const int i = (int)at[0], j = (int)at[1];
        const example_footprint f = { { CELL[0] + (uint32_t)i, CELL[1] + (uint32_t)j },
                                      { (float)(at[0] - i), (float)(at[1] - j) },
                                      { (float)spread[0], 0.0F, (float)spread[2] },
                                      1.0F };
        const float own_slope[2] = { (float)slope[0], (float)slope[1] };
        gather(s, at, reach, near); /* the search is not counted */
        const double begin = bench_seconds();
        p->own[k] = (double)example_density(e, &f, own_slope, 0.0F, SEED);
        const double middle = bench_seconds();
        p->sum[k] = seed_surface_density(near, at, spread, slope, 0.0);
        p->sum_s += bench_seconds() - middle;
        p->own_s += middle - begin;
    }
}

void example_picture_make(example_picture *p, const bench *b, int width, int height, double sigma_texels)
{
    const example *e = b->material.baked;
    const double sigma = sigma_texels / e->size;
    *p = (example_picture){ .b = b, .width = width, .height = height, .pixel = sigma * sqrt(12.0) };
    p->steepest = 3.0 * rms_slope(e);
    p->own = room((size_t)width * (size_t)height, sizeof(double));
    p->sum = room((size_t)width * (size_t)height, sizeof(double));
    const int columns = (int)ceil(width * p->pixel), rows = (int)ceil(height * p->pixel);
    place_instances(p, columns, rows);
    sorted_seeds s = sort_seeds(seed_surface_export(&b->material.options.example, sqrt((double)e->slope_variance),
                                                    p->instances, p->instance_count),
                                columns, rows);
    p->truth_mib = (double)s.all.count * 40.0 / 1048576.0;
    seed_surface near = { room(s.all.count, sizeof(seed_gaussian)), 0 };
    shade(p, &s, sigma, &near);
    free(near.seeds);
    free(s.all.seeds);
    free(s.first);
}

void example_picture_free(example_picture *p)
{
    free(p->own);
    free(p->sum);
    free(p->instances);
}

static double largest(const example_picture *p)
{
    double most = 0.0;
    for (int k = 0; k < p->width * p->height; k++)
        most = fmax(most, p->sum[k]);
    return most;
}

example_difference example_picture_compare(const example_picture *p)
{
    moments square = { 0 }, value = { 0 };
    double worst = 0.0;
    for (int k = 0; k < p->width * p->height; k++) {
        const double d = p->own[k] - p->sum[k];
        moments_add(&square, d * d);
        moments_add(&value, p->sum[k]);
        worst = fmax(worst, fabs(d));
    }
    return (example_difference){ sqrt(square.mean) / value.mean, worst / largest(p) };
}

/* Writes colours of four times the pixels, so that one can be told from the next. */
static int write_colors(const example_picture *p, const float (*rgb)[3], const char *path)
{
    enum { ZOOM = 4 };
    static const char names[3][2] = { "R", "G", "B" };
    report r = { 0 };
    image picture;
    int done = image_allocate(&picture, ZOOM * p->width, ZOOM * p->height, 3, &r);
    for (int c = 0; done && c < 3; c++)
        done = image_name_channel(&picture, c, names[c], path, &r);
    for (int k = 0; done && k < picture.width * picture.height; k++) {
        const int x = k % picture.width / ZOOM, y = k / picture.width / ZOOM;
        memcpy(&picture.pixels[3 * k], rgb[y * p->width + x], 3 * sizeof(float));
    }
    done = done && image_write_png(path, &picture, 0.0F, &r);
    image_free(&picture);
    if (!done)
        fprintf(stderr, "example: %s\n", r.error);
    return done;
}

int example_picture_write(const example_picture *p, const double *values, const char *path)
{
    const double white = largest(p) / 3.0;
    float(*rgb)[3] = room((size_t)p->width * (size_t)p->height, sizeof(*rgb));
    for (int k = 0; k < p->width * p->height; k++)
        rgb[k][0] = rgb[k][1] = rgb[k][2] = (float)fmin(values[k] / white, 1.0);
    const int done = write_colors(p, rgb, path);
    free(rgb);
    return done;
}

int example_picture_write_difference(const example_picture *p, const char *path)
{
    const double white = largest(p) / 3.0;
    float(*rgb)[3] = room((size_t)p->width * (size_t)p->height, sizeof(*rgb));
    for (int k = 0; k < p->width * p->height; k++) {
        const double d = 4.0 * (p->own[k] - p->sum[k]) / white, grey = 0.2;
        rgb[k][0] = (float)fmin(fmax(grey + d, 0.0), 1.0);
        rgb[k][1] = (float)fmax(grey - 0.5 * fabs(d), 0.0);
        rgb[k][2] = (float)fmin(fmax(grey - d, 0.0), 1.0);
    }
    const int done = write_colors(p, rgb, path);
    free(rgb);
    return done;
}

int example_picture_write_map(const example_picture *p, const char *path)
{
    const example *e = p->b->material.baked;
    const double texel = 1.0 / e->size;
    const int width = (int)fmin(p->width * p->pixel / texel, SAMPLES);
    const int height = (int)fmin(p->height * p->pixel / texel, SAMPLES);
    uint16_t *rgb = room((size_t)width * (size_t)height * 3, sizeof(*rgb));
    for (int k = 0; k < width * height; k++) {
        const double at[2] = { (k % width + 0.5) * texel, (double)(k / width) * texel + 0.5 * texel };
        double slope[2];
        seed_surface_slope(&p->b->material.options.example, p->instances, p->instance_count, at, slope);
        const double z = 1.0 / sqrt(1.0 + slope[0] * slope[0] + slope[1] * slope[1]);
        const double n[3] = { slope[0] * z, -slope[1] * z, z };
        for (int c = 0; c < 3; c++)
            rgb[3 * k + c] = (uint16_t)lrint((n[c] + 1.0) * 32767.5);
    }
    report r = { 0 };
    const int done = image_write_data_png(path, width, height, 16, rgb, &r);
    free(rgb);
    if (!done)
        fprintf(stderr, "example: %s\n", r.error);
    return done;
}
