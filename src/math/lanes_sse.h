/* Four lanes on SSE2, or SSE4.1 and AVX2 where the compiler may use them. */
#ifndef MATH_LANES_SSE_H
#define MATH_LANES_SSE_H

#include <immintrin.h>

#include "math/lanes_mask.h"

#if defined(__AVX2__)

static inline vfloat lookup_f(const float *table, vint index)
{
    const __m256i eight = _mm256_castsi128_si256((__m128i)index);
    return (vfloat)_mm256_castps256_ps128(_mm256_permutevar8x32_ps(_mm256_loadu_ps(table), eight));
}

static inline vuint pick_u(vuint from, vint lane)
{
    return (vuint)_mm_permutevar_ps((__m128)from, (__m128i)lane);
}

static inline vuint gather_u(const void *base, vint byte)
{
    return (vuint)_mm_i32gather_epi32(base, (__m128i)byte, 1);
}

#else
#include "math/lanes_gather.h"
#endif

static inline int any(vmask m)
{
    return _mm_movemask_ps((__m128)m) != 0;
}

#if defined(__SSE4_1__)

static inline vfloat choose(vmask m, vfloat a, vfloat b)
{
    return (vfloat)_mm_blendv_ps((__m128)b, (__m128)a, (__m128)m);
}

static inline vint choose_i(vmask m, vint a, vint b)
{
    return (vint)choose(m, (vfloat)a, (vfloat)b);
}

#else

static inline vint choose_i(vmask m, vint a, vint b)
{
    return choose_bits(m, a, b);
}

static inline vfloat choose(vmask m, vfloat a, vfloat b)
{
    return (vfloat)choose_bits(m, (vint)a, (vint)b);
}

#endif

static inline vfloat min_f(vfloat a, vfloat b)
{
    return (vfloat)_mm_min_ps((__m128)a, (__m128)b);
}

static inline vfloat max_f(vfloat a, vfloat b)
{
    return (vfloat)_mm_max_ps((__m128)a, (__m128)b);
}

static inline vint min_i(vint a, vint b)
{
#if defined(__SSE4_1__)
    return (vint)_mm_min_epi32((__m128i)a, (__m128i)b);
#else
    return choose_i(less_i(a, b), a, b);
#endif
}

static inline vfloat sqrt_f(vfloat x)
{
    return (vfloat)_mm_sqrt_ps((__m128)x);
}

#if defined(__SSE4_1__)

static inline vfloat floor_f(vfloat x)
{
    return (vfloat)_mm_floor_ps((__m128)x);
}

static inline vdouble floor_d(vdouble d)
{
    return (vdouble){ (half_double)_mm_floor_pd((__m128d)d.low), (half_double)_mm_floor_pd((__m128d)d.high) };
}

#else

/* Truncates and goes one down where that went up. From 2^23 on every float is whole. */
static inline vfloat floor_f(vfloat x)
{
    const vfloat whole = to_float(to_int(x));
    const vfloat down = whole - choose(less(x, whole), splat(1.0F), splat(0.0F));
    const vmask small = (vfloat)((vint)x & 0x7fffffff) < 8388608.0F;
    return choose(small, down, x);
}

static inline vdouble floor_d(vdouble d)
{
    for (int i = 0; i < GLINT_LANES / 2; i++) {
        d.low[i] = __builtin_floor(d.low[i]);
        d.high[i] = __builtin_floor(d.high[i]);
    }
    return d;
}

#endif

static inline vdouble widen(vfloat f)
{
    return (vdouble){ (half_double)_mm_cvtps_pd((__m128)f),
                      (half_double)_mm_cvtps_pd(_mm_movehl_ps((__m128)f, (__m128)f)) };
}

static inline vfloat narrow(vdouble d)
{
    return (vfloat)_mm_movelh_ps(_mm_cvtpd_ps((__m128d)d.low), _mm_cvtpd_ps((__m128d)d.high));
}

static inline vuint low_word(vdouble d)
{
    return (vuint)_mm_shuffle_ps((__m128)d.low, (__m128)d.high, 0x88);
}

#endif
