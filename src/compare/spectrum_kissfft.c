/* Power of a square of pixels by frequency, on KISS FFT.
 *
 * By its complex transform: version 131.1.0, which Debian 12 has, makes no plan for real ones of two dimensions.
 */
#include "compare/spectrum.h"

#include <kiss_fftnd.h>
#include <stdlib.h>

struct fourier {
    int side;
    kiss_fftnd_cfg plan;
    kiss_fft_cpx *pixels, *values;
};

fourier *fourier_make(int side)
{
    const int sides[2] = { side, side };
    const size_t count = (size_t)side * (size_t)side;
    fourier *f = malloc(sizeof *f);
    if (!f)
        return NULL;
    *f = (fourier){ side, kiss_fftnd_alloc(sides, 2, 0, NULL, NULL), malloc(count * sizeof *f->pixels),
                    malloc(count * sizeof *f->values) };
    if (f->plan && f->pixels && f->values)
        return f;
    fourier_free(f);
    return NULL;
}

void fourier_free(fourier *f)
{
    if (!f)
        return;
    kiss_fft_free(f->plan);
    free(f->pixels);
    free(f->values);
    free(f);
}

void fourier_power(fourier *f, const float *pixels, float *power)
{
    const int count = f->side * f->side;
    const float scale = 1.0F / (float)count;
    for (int i = 0; i < count; ++i)
        f->pixels[i] = (kiss_fft_cpx){ pixels[i], 0.0F };
    kiss_fftnd(f->plan, f->pixels, f->values);
    for (int i = 0; i < count; ++i)
        power[i] = (f->values[i].r * f->values[i].r + f->values[i].i * f->values[i].i) * scale;
}
