/* What is computed for many points side by side, once for every vector width; all widths give the same bits. */
#ifndef PREVIEW_KERNELS_H
#define PREVIEW_KERNELS_H

#include <stdint.h>

struct camera;
struct camera_batch;
struct hit_batch;
struct light;
struct light_batch;

typedef struct kernels {
    int lanes; /* doubles */
    /* sampler_draw.h */
    void (*draw)(const uint32_t *pixel, const uint32_t *reversed, uint32_t dimension, int count, double *u, double *v);
    void (*camera)(const struct camera *c, struct camera_batch *b); /* camera_kernel.h */
    void (*hit)(struct hit_batch *b, int count);                    /* hit_kernel.h */
    /* light_kernel.h */
    void (*light)(const struct light *l, uint32_t dimension, struct light_batch *b);
} kernels;

/* Those above 2 are there on x86-64 only. */
extern const kernels kernels_1, kernels_2, kernels_4, kernels_8;

enum { KERNELS_WIDEST = 8 };

/* The widest that this machine runs, of at most so many lanes. */
const kernels *kernels_of_machine(int most);

#endif
