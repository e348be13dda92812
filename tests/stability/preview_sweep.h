/* What the previewer computes before it asks the library: cameras and their differentials, lights, the surroundings,
 * samples, textures, and the surface that a material describes; swept for tests of what can go wrong with numbers. */
#ifndef TESTS_PREVIEW_SWEEP_H
#define TESTS_PREVIEW_SWEEP_H

#include <stddef.h>
#include <stdint.h>

/* Called with every batch of numbers that come out. */
typedef void preview_sink(void *user, const char *what, const double *numbers, size_t count);

/* count queries of each part. any_bits: arguments that a scene, a texture or a ray may make anything of have any bits,
 * one in so many; 0: none has, and operations that IEEE 754 fixes make all of them. */
void preview_sweep(int count, int any_bits, preview_sink *sink, void *user);

#endif
