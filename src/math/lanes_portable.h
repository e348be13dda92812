/* Any number of lanes on any machine, NEON among them: what the compiler makes of it. */
#ifndef MATH_LANES_PORTABLE_H
#define MATH_LANES_PORTABLE_H

#include "math/lanes_gather.h"
#include "math/lanes_mask.h"

typedef float half_float __attribute__((vector_size(2 * GLINT_LANES)));
typedef uint32_t half_uint __attribute__((vector_size(2 * GLINT_LANES)));
typedef uint64_t half_ulong __attribute__((vector_size(4 * GLINT_LANES)));

static inline int any(vmask m)
{
    int32_t bits = 0;
    for (int i = 0; i < GLINT_LANES; i++)
        bits |= m[i];
    return bits != 0;
}

static inline vint choose_i(vmask m, vint a, vint b)
{
    return choose_bits(m, a, b);
}

static inline vfloat choose(vmask m, vfloat a, vfloat b)
{
    return (vfloat)choose_bits(m, (vint)a, (vint)b);
}

static inline vfloat min_f(vfloat a, vfloat b)
{
    return choose(less(a, b), a, b);
}

static inline vfloat max_f(vfloat a, vfloat b)
{
    return choose(less(b, a), a, b);
}

static inline vint min_i(vint a, vint b)
{
    return choose_i(less_i(a, b), a, b);
}

static inline vfloat sqrt_f(vfloat x)
{
    for (int i = 0; i < GLINT_LANES; i++)
        x[i] = __builtin_sqrtf(x[i]);
    return x;
}

static inline vfloat floor_f(vfloat x)
{
    for (int i = 0; i < GLINT_LANES; i++)
        x[i] = __builtin_floorf(x[i]);
    return x;
}

static inline vdouble widen(vfloat f)
{
    half_float half[2];
    memcpy(half, &f, sizeof(f));
    return (vdouble){ __builtin_convertvector(half[0], half_double), __builtin_convertvector(half[1], half_double) };
}

static inline vfloat narrow(vdouble d)
{
    const half_float half[2] = { __builtin_convertvector(d.low, half_float),
                                 __builtin_convertvector(d.high, half_float) };
    vfloat f;
    memcpy(&f, half, sizeof(f));
    return f;
}

static inline vdouble floor_d(vdouble d)
{
    for (int i = 0; i < GLINT_LANES / 2; i++) {
        d.low[i] = __builtin_floor(d.low[i]);
        d.high[i] = __builtin_floor(d.high[i]);
    }
    return d;
}

static inline vuint low_word(vdouble d)
{
    const half_uint half[2] = { __builtin_convertvector((half_ulong)d.low, half_uint),
                                __builtin_convertvector((half_ulong)d.high, half_uint) };
    vuint x;
    memcpy(&x, half, sizeof(x));
    return x;
}

#endif
