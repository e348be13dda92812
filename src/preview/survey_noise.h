/* How much pixels differ when other samples are taken of them. */
#ifndef PREVIEW_SURVEY_NOISE_H
#define PREVIEW_SURVEY_NOISE_H

#include "preview/integrator.h"

typedef struct survey_place {
    int x, y;
} survey_place;

typedef struct survey_noise {
    double deviation; /* relative, of a pixel of so many samples */
    uint32_t samples;
    double fall;   /* the variance falls as samples^-fall */
    double spread; /* standard error of the variance, relative */
} survey_noise;

enum { SURVEY_MOST_SAMPLES = 64 };

typedef struct survey_noise_limits {
    int samples;   /* at most so many are taken: a power of 4, up to SURVEY_MOST_SAMPLES */
    double enough; /* no more once they leave less */
    int threads;   /* 0: one a core */
} survey_noise_limits;

/* False: no memory. */
bool survey_noise_measure(const world *w, const survey_place *places, int count, const survey_noise_limits *limits,
                          survey_noise *out, report *r);

#endif
