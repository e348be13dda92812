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

/* Takes up to `most` samples (a power of 4 is used up to SURVEY_MOST_SAMPLES), and no more once they leave less than
 * `enough`. False: no memory. */
enum { SURVEY_MOST_SAMPLES = 64 };
bool survey_noise_measure(const world *w, const survey_place *places, int count, int most, double enough,
                          survey_noise *out, report *r);

#endif
