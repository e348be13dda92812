/* Power of a square of pixels by frequency. spectrum_kissfft.c alone includes KISS FFT. */
#ifndef COMPARE_SPECTRUM_H
#define COMPARE_SPECTRUM_H

#include <stdbool.h>

typedef struct fourier fourier;

/* For squares of side x side pixels, side a power of two. NULL without memory. */
fourier *fourier_make(int side);
void fourier_free(fourier *f);
/* |F|^2 / side^2 of the real pixels, side rows of side values; F is the sum of pixels * exp(-2 pi i k.x / side). */
void fourier_power(fourier *f, const float *pixels, float *power);

#endif
