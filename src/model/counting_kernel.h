/* The counting model's inner loop, compiled once for each vector width; counting.c chooses. */
#ifndef MODEL_COUNTING_KERNEL_H
#define MODEL_COUNTING_KERNEL_H

#include <stddef.h>
#include <stdint.h>

#include "model/tint.h"

/* Points and their lights as a structure of arrays. All values are finite; density, cap and p are >= 0. */
typedef struct counting_points {
    const double *u, *v;                    /* metres, below 1e15 in size */
    const float *dudx, *dudy, *dvdx, *dvdy; /* metres per pixel, below 1e9 in size */
    const float *density;                   /* facets per m^2 */
    const uint32_t *seed;                   /* a full hash */
    const float *hx, *hy;                   /* half vector, along and across the tangent */
    const float *cap;                       /* area of the lit cap, seen from above: its solid angle times h.z */
    const float *p;                         /* lit probability, at most 1 */
    /* NULL: light i is at point i. Else it is at point place[i]; place begins with 0 and each is as the one before or
     * one more, so that what is looked up for a point is looked up once for its lights. Arrays of points then go on to
     * a multiple of the width. */
    const uint32_t *place;
} counting_points;

/* factor = b(N', p) / (N' p), blended over grids and cells, 1 in the smooth limit; facets = N. N' is N for a pixel of
 * many facets, and one half for a pixel within one. count, of lights, is a multiple of the width. Every width gives
 * the same bits. */
typedef void counting_kernel(const counting_points *points, size_t count, float *factor, float *facets);

counting_kernel counting_kernel_1, counting_kernel_4, counting_kernel_8, counting_kernel_16;
/* One point at a time, its four grids in four lanes: for machines that run counting_kernel_4, or counting_kernel_8. */
counting_kernel counting_alone, counting_alone_avx2;

/* The same for facets of different colours, with a factor for each channel. A palette of one white colour gives the
 * bits of counting_kernel. */
typedef void counting_tinted(const counting_points *points, size_t count, const tint_palette *palette,
                             float *const factor[3], float *facets);

counting_tinted counting_tinted_1, counting_tinted_4, counting_tinted_8, counting_tinted_16;
counting_tinted counting_tinted_alone;

/* counting_kernel with one realisation for all, and without places: draw, uniform in 32 bits, chooses. The mean over
 * draws is the factor of counting_kernel, but for 2^-24 of chance. */
typedef void counting_drawn(const counting_points *points, const uint32_t *draw, size_t count, float *factor,
                            float *facets);

counting_drawn counting_drawn_1, counting_drawn_4, counting_drawn_8, counting_drawn_16;

typedef struct counting_width {
    size_t lanes;
    counting_kernel *kernel;
    counting_tinted *tinted;
    counting_drawn *drawn;
} counting_width;

/* The widest kernel that this machine runs, at most max_lanes wide. */
counting_width counting_widest(size_t max_lanes);
/* The fastest for one point, on a machine that has no vectors wider than this. */
counting_width counting_narrowest(size_t max_lanes);

#endif
