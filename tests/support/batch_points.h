/* Points side by side, as glint_eval_batch takes them, and what comes of them. */
#ifndef TESTS_BATCH_POINTS_H
#define TESTS_BATCH_POINTS_H

#include <stdint.h>

#include "glint.h"

/* 4096, and a cache line: arrays a power of two apart would fight for the same places of the cache. */
enum { BATCH_POINTS = 4096 + 16 };

/* Surfaces, lights with a shape, and values are the caller's. */
typedef struct batch_points {
    double u[BATCH_POINTS], v[BATCH_POINTS];
    float step[4][BATCH_POINTS]; /* of the footprint: dudx, dudy, dvdx, dvdy */
    float wo[3][BATCH_POINTS], wi[3][BATCH_POINTS], solid_angle_sr[BATCH_POINTS];
    uint32_t seed[BATCH_POINTS], draw[BATCH_POINTS];
    float rgb[3][BATCH_POINTS]; /* out */
} batch_points;

static inline void batch_points_place(batch_points *p, int i, const glint_footprint *f)
{
    const float step[4] = { f->dudx, f->dudy, f->dvdx, f->dvdy };
    p->u[i] = f->u;
    p->v[i] = f->v;
    for (int k = 0; k < 4; k++)
        p->step[k][i] = step[k];
    p->seed[i] = f->seed;
    p->draw[i] = f->draw;
}

/* Under the light of a cap around wi. */
static inline void batch_points_light(batch_points *p, int i, const float wo[3], const float wi[3],
                                      float solid_angle_sr)
{
    for (int k = 0; k < 3; k++) {
        p->wo[k][i] = wo[k];
        p->wi[k][i] = wi[k];
    }
    p->solid_angle_sr[i] = solid_angle_sr;
}

static inline glint_footprint batch_points_footprint(const batch_points *p, int i)
{
    return (glint_footprint){ p->u[i],       p->v[i],       p->step[0][i], p->step[1][i],
                              p->step[2][i], p->step[3][i], p->seed[i],    p->draw[i] };
}

/* The first of them. */
static inline glint_batch batch_points_of(batch_points *p, int count)
{
    glint_batch b = GLINT_BATCH_INIT;
    b.count = (size_t)count;
    b.u = p->u;
    b.v = p->v;
    b.dudx = p->step[0];
    b.dudy = p->step[1];
    b.dvdx = p->step[2];
    b.dvdy = p->step[3];
    b.seed = p->seed;
    b.draw = p->draw;
    b.solid_angle_sr = p->solid_angle_sr;
    for (int k = 0; k < 3; k++) {
        b.wo[k] = p->wo[k];
        b.wi[k] = p->wi[k];
        b.rgb[k] = p->rgb[k];
    }
    return b;
}

#endif
