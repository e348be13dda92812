/* Sixteen lanes on AVX-512, whose masks have registers of their own. */
#ifndef MATH_LANES_AVX512_H
#define MATH_LANES_AVX512_H

#include <immintrin.h>

typedef __mmask16 vmask;

static inline vmask less(vfloat a, vfloat b)
{
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OS);
}

static inline vmask less_equal(vfloat a, vfloat b)
{
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LE_OS);
}

static inline vmask less_i(vint a, vint b)
{
    return _mm512_cmpgt_epi32_mask((__m512i)b, (__m512i)a); /* may read a from memory */
}

static inline vmask equal_i(vint a, vint b)
{
    return _mm512_cmpeq_epi32_mask((__m512i)a, (__m512i)b);
}

static inline int any(vmask m)
{
    return m != 0;
}

static inline vmask mask_none(void)
{
    return 0;
}

static inline vint mask_bits(vmask m)
{
    return (vint)_mm512_movm_epi32(m);
}

static inline vfloat choose(vmask m, vfloat a, vfloat b)
{
    return (vfloat)_mm512_mask_blend_ps(m, (__m512)b, (__m512)a);
}

static inline vint choose_i(vmask m, vint a, vint b)
{
    return (vint)_mm512_mask_blend_epi32(m, (__m512i)b, (__m512i)a);
}

static inline vfloat add_where(vmask m, vfloat sum, vfloat x)
{
    return (vfloat)_mm512_mask_add_ps((__m512)sum, m, (__m512)sum, (__m512)x);
}

static inline vfloat min_f(vfloat a, vfloat b)
{
    return (vfloat)_mm512_min_ps((__m512)a, (__m512)b);
}

static inline vfloat max_f(vfloat a, vfloat b)
{
    return (vfloat)_mm512_max_ps((__m512)a, (__m512)b);
}

static inline vint min_i(vint a, vint b)
{
    return (vint)_mm512_min_epi32((__m512i)a, (__m512i)b);
}

static inline vfloat sqrt_f(vfloat x)
{
    return (vfloat)_mm512_sqrt_ps((__m512)x);
}

static inline vfloat floor_f(vfloat x)
{
    return (vfloat)_mm512_roundscale_ps((__m512)x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
}

#define LANES_TAKE_FLOATS_APART

static inline vfloat exponent_f(vfloat x)
{
    return (vfloat)_mm512_getexp_ps((__m512)x);
}

static inline vfloat mantissa_of(vfloat x)
{
    return (vfloat)_mm512_getmant_ps((__m512)x, _MM_MANT_NORM_1_2, _MM_MANT_SIGN_src);
}

static inline vfloat lookup_f(const float *table, vint index)
{
    return (vfloat)_mm512_permutexvar_ps((__m512i)index, _mm512_castps256_ps512(_mm256_loadu_ps(table)));
}

static inline vuint pick_u(vuint from, vint lane)
{
    return (vuint)_mm512_permutexvar_epi32((__m512i)lane, (__m512i)from);
}

static inline vuint gather_u(const void *base, vint byte)
{
    return (vuint)_mm512_i32gather_epi32((__m512i)byte, base, 1);
}

static inline vdouble widen(vfloat f)
{
    return (vdouble){ (half_double)_mm512_cvtps_pd(_mm512_castps512_ps256((__m512)f)),
                      (half_double)_mm512_cvtps_pd(_mm512_extractf32x8_ps((__m512)f, 1)) };
}

static inline vfloat narrow(vdouble d)
{
    const __m512 low = _mm512_castps256_ps512(_mm512_cvtpd_ps((__m512d)d.low));
    return (vfloat)_mm512_insertf32x8(low, _mm512_cvtpd_ps((__m512d)d.high), 1);
}

static inline vdouble floor_d(vdouble d)
{
    return (vdouble){ (half_double)_mm512_roundscale_pd((__m512d)d.low, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC),
                      (half_double)_mm512_roundscale_pd((__m512d)d.high, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC) };
}

static inline vuint low_word(vdouble d)
{
    const vint even = { 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30 };
    return (vuint)_mm512_permutex2var_epi32((__m512i)d.low, (__m512i)even, (__m512i)d.high);
}

#endif
