/* Eight lanes on AVX2. Compilers go over memory between halves and wholes, so the instructions are named. */
#ifndef MATH_LANES_AVX2_H
#define MATH_LANES_AVX2_H

#include <immintrin.h>

#include "math/lanes_mask.h"

static inline int any(vmask m)
{
    return _mm256_movemask_ps((__m256)m) != 0;
}

static inline vfloat choose(vmask m, vfloat a, vfloat b)
{
    return (vfloat)_mm256_blendv_ps((__m256)b, (__m256)a, (__m256)m);
}

static inline vint choose_i(vmask m, vint a, vint b)
{
    return (vint)choose(m, (vfloat)a, (vfloat)b);
}

static inline vfloat min_f(vfloat a, vfloat b)
{
    return (vfloat)_mm256_min_ps((__m256)a, (__m256)b);
}

static inline vfloat max_f(vfloat a, vfloat b)
{
    return (vfloat)_mm256_max_ps((__m256)a, (__m256)b);
}

static inline vint min_i(vint a, vint b)
{
    return (vint)_mm256_min_epi32((__m256i)a, (__m256i)b);
}

static inline vfloat sqrt_f(vfloat x)
{
    return (vfloat)_mm256_sqrt_ps((__m256)x);
}

static inline vfloat floor_f(vfloat x)
{
    return (vfloat)_mm256_floor_ps((__m256)x);
}

static inline vfloat lookup_f(const float *table, vint index)
{
    return (vfloat)_mm256_permutevar8x32_ps(_mm256_loadu_ps(table), (__m256i)index);
}

static inline vuint pick_u(vuint from, vint lane)
{
    return (vuint)_mm256_permutevar8x32_epi32((__m256i)from, (__m256i)lane);
}

static inline vuint gather_u(const void *base, vint byte)
{
    return (vuint)_mm256_i32gather_epi32(base, (__m256i)byte, 1);
}

static inline vdouble widen(vfloat f)
{
    return (vdouble){ (half_double)_mm256_cvtps_pd(_mm256_castps256_ps128((__m256)f)),
                      (half_double)_mm256_cvtps_pd(_mm256_extractf128_ps((__m256)f, 1)) };
}

static inline vfloat narrow(vdouble d)
{
    return (vfloat)_mm256_set_m128(_mm256_cvtpd_ps((__m256d)d.high), _mm256_cvtpd_ps((__m256d)d.low));
}

static inline vdouble floor_d(vdouble d)
{
    return (vdouble){ (half_double)_mm256_floor_pd((__m256d)d.low), (half_double)_mm256_floor_pd((__m256d)d.high) };
}

static inline vuint low_word(vdouble d)
{
    const __m256 even = _mm256_shuffle_ps((__m256)d.low, (__m256)d.high, 0x88);
    return (vuint)_mm256_permute4x64_epi64(_mm256_castps_si256(even), 0xd8);
}

#endif
