/* One piece of surface, seen by the example model and by the full sum of its seeds. */
#ifndef STUDY_EXAMPLE_PICTURE_H
#define STUDY_EXAMPLE_PICTURE_H

#include "seed_race.h"

typedef struct example_picture {
    const bench *b;
    int width, height;
    double pixel;      /* lattice units along a side */
    double steepest;   /* slopes go from minus this to this */
    double *own, *sum; /* densities of slopes, row by row from the top; width * height */
    double own_s, sum_s;
    double truth_mib; /* of the exported seeds, 40 bytes each: place, slope, Jacobian, area, in single precision */
    seed_instance *instances;
    size_t instance_count;
} example_picture;

/* sigma_texels: deviation of a pixel's Gaussian. Ends the program when there is no memory. */
void example_picture_make(example_picture *p, const bench *b, int width, int height, double sigma_texels);
void example_picture_free(example_picture *p);

typedef struct example_difference {
    double rms;   /* over the mean of the sum */
    double worst; /* over its largest value */
} example_difference;

example_difference example_picture_compare(const example_picture *p);

/* False, with a message: it cannot be written. White is a third of the largest sum. */
int example_picture_write(const example_picture *p, const double *values, const char *path);
/* Grey where both agree, red where the model is brighter, blue where it is darker; four times as strong. */
int example_picture_write_difference(const example_picture *p, const char *path);
/* The normal map that the seeds stand for, over the upper left quarter of the picture at most, as a normal map. */
int example_picture_write_map(const example_picture *p, const char *path);

#endif
