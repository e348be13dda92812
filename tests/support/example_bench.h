/* A baked example without the library's front: what the unit tests of the example model share. */
#ifndef TESTS_EXAMPLE_BENCH_H
#define TESTS_EXAMPLE_BENCH_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <cmocka.h>

#include "model/example_density.h"
#include "statistics.h"

static inline void *bench_allocate(size_t byte_count, void *user)
{
    size_t *bytes = user;
    if (bytes)
        *bytes += byte_count;
    return aligned_alloc(64, (byte_count + 63) / 64 * 64);
}

static inline void bench_release(void *memory, void *user)
{
    (void)user;
    free(memory);
}

/* A material of built-in normals, which the caller frees. */
typedef struct bench {
    struct glint_material material;
    float *normals;
    size_t bytes; /* asked for, working memory included */
} bench;

static inline void bench_make(bench *b, glint_example_kind kind, const glint_example *options)
{
    const glint_example_shape shape = GLINT_EXAMPLE_SHAPE_INIT;
    *b = (bench){ .material = { &example_model, GLINT_MATERIAL_OPTIONS_INIT, 1.0F, NULL } };
    b->normals = malloc((size_t)options->size * options->size * 3 * sizeof(float));
    assert_int_equal(glint_example_generate(kind, options->size, &shape, 3U, b->normals), GLINT_OK);
    b->material.options.example = *options;
    b->material.options.example.normals = b->normals;
    b->material.options.allocator = (glint_allocator){ bench_allocate, bench_release, &b->bytes };
    assert_int_equal(example_model.setup(&b->material), GLINT_OK);
    b->material.options.example.normals = b->normals; /* setup forgets them; the truth needs them */
}

static inline void bench_free(bench *b)
{
    example_model.free(&b->material);
    free(b->normals);
}

/* Seconds of processor time. */
static inline double bench_seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

#endif
