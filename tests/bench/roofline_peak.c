/* Twelve chains of two operations side by side, which is enough to keep every port busy and leaves registers for what
 * they are fed with. Compiled once for each width. */
#include "roofline_peak.h"

#include <stdint.h>

#define PASTE(a, b) a##b
#define NAME(stem, lanes) PASTE(stem, lanes)

typedef uint32_t vuint __attribute__((vector_size(4 * ROOFLINE_LANES)));
typedef float vreal __attribute__((vector_size(4 * ROOFLINE_LANES)));

enum { CHAINS = 12, STEPS = ROOFLINE_OPERATIONS_PER_LANE / (2 * CHAINS) };

/* The compiler cannot see through a register that an empty instruction may have changed. */
#define KEEP(x) __asm__ volatile("" : "+x"(x))

unsigned NAME(roofline_integer_, ROOFLINE_LANES)(void)
{
    vuint x[CHAINS], flip = (vuint){ 0 } + 0x9E3779B9U, add = (vuint){ 0 } + 0x846ca68bU;
    unsigned sum = 0;
#pragma GCC unroll 12
    for (int k = 0; k < CHAINS; ++k)
        x[k] = (vuint){ 0 } + (uint32_t)k;
    KEEP(flip);
    KEEP(add);
    for (int i = 0; i < STEPS; ++i) {
#pragma GCC unroll 12
        for (int k = 0; k < CHAINS; ++k) {
            x[k] = (x[k] ^ flip) + add;
            KEEP(x[k]);
        }
    }
#pragma GCC unroll 12
    for (int k = 0; k < CHAINS; ++k)
        sum += x[k][0];
    return sum;
}

unsigned NAME(roofline_float_, ROOFLINE_LANES)(void)
{
    vreal x[CHAINS], scale = (vreal){ 0 } + 0.999F, add = (vreal){ 0 } + 0.001F;
    float sum = 0.0F;
#pragma GCC unroll 12
    for (int k = 0; k < CHAINS; ++k)
        x[k] = (vreal){ 0 } + (float)k;
    KEEP(scale);
    KEEP(add);
    for (int i = 0; i < STEPS; ++i) {
#pragma GCC unroll 12
        for (int k = 0; k < CHAINS; ++k) {
            x[k] = x[k] * scale + add;
            KEEP(x[k]);
        }
    }
#pragma GCC unroll 12
    for (int k = 0; k < CHAINS; ++k)
        sum += x[k][0];
    return (unsigned)sum;
}
