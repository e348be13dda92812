/* Small pictures of test scenes and their pixels. */
#ifndef PICTURES_H
#define PICTURES_H

#include "preview/preview.h"

/* 16 x 16, 4 samples, no bounces, one thread, black sky, all channels. */
preview_options pictures_options(const scene_camera *camera);

/* Fails the test when there is no picture. Free it with image_free. */
image pictures_render(const scene *s, const preview_options *o);

/* A channel by name ("R", "glints.N"), of one pixel and its mean over the picture. */
double pictures_at(const image *i, const char *channel, int x, int y);
double pictures_mean(const image *i, const char *channel);

/* Renders the scene with so many seeds of the facets of its first material, and takes the red light of 8 x 8 blocks of
 * the picture: the mean over blocks of the variance that it has over seeds, and of its mean. */
void pictures_block_statistics(scene *s, const preview_options *o, int seeds, double *variance, double *mean);

/* An orthographic camera straight above the origin that sees a square of 2 half_size metres; x to the right, z
 * downwards. */
scene_camera pictures_from_above(float half_size);

/* Fails with both values when they differ by more than bound, relative to the expected one. */
void pictures_assert_relative(double value, double expected, double bound);

extern const preview_sky pictures_black;

#endif
