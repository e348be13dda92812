/* Vectors of GLINT_LANES floats, so that one source is compiled for every instruction set.
 *
 * Include it once per translation unit with GLINT_LANES defined as 1, 4, 8 or 16. With 1 the same names are plain
 * scalars. Only operations whose result IEEE 754 fixes are used (+ - * / sqrt, conversions, integers), never a fused
 * multiply-add, so every width gives the same bits. A mask is 0 or -1 in each lane.
 */
#ifndef MATH_LANES_H
#define MATH_LANES_H

#include <stdint.h>
#include <string.h>

#if !defined(GLINT_LANES)
#error "define GLINT_LANES as 1, 4, 8 or 16 before including math/lanes.h"
#endif

#if GLINT_LANES == 1

typedef float vfloat;
typedef double vdouble;
typedef int32_t vint;
typedef uint32_t vuint;
typedef int32_t vmask;
typedef uint64_t vulong;

#else

#if defined(__x86_64__)
#include <immintrin.h>
#endif

typedef float vfloat __attribute__((vector_size(4 * GLINT_LANES)));
typedef double vdouble __attribute__((vector_size(8 * GLINT_LANES)));
typedef int32_t vint __attribute__((vector_size(4 * GLINT_LANES)));
typedef uint32_t vuint __attribute__((vector_size(4 * GLINT_LANES)));
typedef vint vmask;
typedef uint64_t vulong __attribute__((vector_size(8 * GLINT_LANES)));

#endif

/* ---- memory; the pointer needs no alignment ---- */

static inline vfloat load_f(const float *p)
{
    vfloat v;
    memcpy(&v, p, sizeof(v));
    return v;
}

static inline vdouble load_d(const double *p)
{
    vdouble v;
    memcpy(&v, p, sizeof(v));
    return v;
}

static inline vuint load_u(const uint32_t *p)
{
    vuint v;
    memcpy(&v, p, sizeof(v));
    return v;
}

static inline void store_f(float *p, vfloat v)
{
    memcpy(p, &v, sizeof(v));
}

/* ---- bits ---- */

static inline vfloat float_from_bits(vuint u)
{
    vfloat f;
    memcpy(&f, &u, sizeof(f));
    return f;
}

static inline vuint bits_of(vfloat f)
{
    vuint u;
    memcpy(&u, &f, sizeof(u));
    return u;
}

static inline vulong bits_of_d(vdouble d)
{
    vulong u;
    memcpy(&u, &d, sizeof(u));
    return u;
}

#if GLINT_LANES == 1

static inline vfloat splat(float x)
{
    return x;
}

static inline vint splat_i(int32_t x)
{
    return x;
}

static inline vmask less(vfloat a, vfloat b)
{
    return -(a < b);
}

static inline vmask less_equal(vfloat a, vfloat b)
{
    return -(a <= b);
}

static inline vmask less_i(vint a, vint b)
{
    return -(a < b);
}

static inline vmask equal_i(vint a, vint b)
{
    return -(a == b);
}

static inline vmask less_d(vdouble a, vdouble b)
{
    return -(a < b);
}

static inline int any(vmask m)
{
    return m != 0;
}

static inline vfloat choose(vmask m, vfloat a, vfloat b)
{
    return m ? a : b;
}

static inline vfloat to_float(vint i)
{
    return (float)i;
}

/* Truncates; the argument must fit. */
static inline vint to_int(vfloat f)
{
    return (int32_t)f;
}

static inline vdouble widen(vfloat f)
{
    return (double)f;
}

static inline vfloat narrow(vdouble d)
{
    return (float)d;
}

static inline vuint low_word(vulong x)
{
    return (uint32_t)x;
}

static inline vfloat sqrt_f(vfloat x)
{
    return __builtin_sqrtf(x);
}

static inline vfloat floor_f(vfloat x)
{
    return __builtin_floorf(x);
}

/* table[index], a table of eight. */
static inline vfloat lookup_f(const float *table, vint index)
{
    return table[index];
}

#else

static inline vfloat splat(float x)
{
    return (vfloat){ 0 } + x;
}

static inline vint splat_i(int32_t x)
{
    return (vint){ 0 } + x;
}

static inline vmask less(vfloat a, vfloat b)
{
    return a < b;
}

static inline vmask less_equal(vfloat a, vfloat b)
{
    return a <= b;
}

static inline vmask less_i(vint a, vint b)
{
    return a < b;
}

static inline vmask equal_i(vint a, vint b)
{
    return a == b;
}

static inline vmask less_d(vdouble a, vdouble b)
{
    return __builtin_convertvector(a < b, vmask);
}

static inline vfloat choose(vmask m, vfloat a, vfloat b)
{
    return (vfloat)(((vint)a & m) | ((vint)b & ~m));
}

static inline vfloat to_float(vint i)
{
    return __builtin_convertvector(i, vfloat);
}

static inline vint to_int(vfloat f)
{
    return __builtin_convertvector(f, vint);
}

static inline vdouble widen(vfloat f)
{
    return __builtin_convertvector(f, vdouble);
}

static inline vfloat narrow(vdouble d)
{
    return __builtin_convertvector(d, vfloat);
}

static inline vuint low_word(vulong x)
{
    return __builtin_convertvector(x, vuint);
}

#if GLINT_LANES == 16 && defined(__AVX512F__)

static inline int any(vmask m)
{
    return _mm512_test_epi32_mask((__m512i)m, (__m512i)m) != 0;
}

static inline vfloat sqrt_f(vfloat x)
{
    return (vfloat)_mm512_sqrt_ps((__m512)x);
}

static inline vfloat floor_f(vfloat x)
{
    return (vfloat)_mm512_roundscale_ps((__m512)x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
}

static inline vfloat lookup_f(const float *table, vint index)
{
    return (vfloat)_mm512_permutexvar_ps((__m512i)index, _mm512_castps256_ps512(_mm256_loadu_ps(table)));
}

#elif GLINT_LANES == 8 && defined(__AVX2__)

static inline int any(vmask m)
{
    return _mm256_movemask_ps((__m256)m) != 0;
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

#elif GLINT_LANES == 4 && defined(__SSE4_1__)

static inline int any(vmask m)
{
    return _mm_movemask_ps((__m128)m) != 0;
}

static inline vfloat sqrt_f(vfloat x)
{
    return (vfloat)_mm_sqrt_ps((__m128)x);
}

static inline vfloat floor_f(vfloat x)
{
    return (vfloat)_mm_floor_ps((__m128)x);
}

#elif GLINT_LANES == 4 && defined(__SSE2__)

static inline int any(vmask m)
{
    return _mm_movemask_ps((__m128)m) != 0;
}

static inline vfloat sqrt_f(vfloat x)
{
    return (vfloat)_mm_sqrt_ps((__m128)x);
}

/* Truncates and goes one down where that went up. From 2^23 on every float is whole. */
static inline vfloat floor_f(vfloat x)
{
    const vfloat whole = to_float(to_int(x));
    const vfloat down = whole - choose(less(x, whole), splat(1.0F), splat(0.0F));
    const vmask small = float_from_bits(bits_of(x) & 0x7fffffffU) < 8388608.0F;
    return choose(small, down, x);
}

#else

static inline int any(vmask m)
{
    int32_t bits = 0;
    for (int i = 0; i < GLINT_LANES; i++)
        bits |= m[i];
    return bits != 0;
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

#endif

#if !(GLINT_LANES == 16 && defined(__AVX512F__)) && !(GLINT_LANES == 8 && defined(__AVX2__))

static inline vfloat lookup_f(const float *table, vint index)
{
    vfloat v = { 0 };
    for (int i = 0; i < GLINT_LANES; i++)
        v[i] = table[index[i]];
    return v;
}

#endif
#endif

static inline vint choose_i(vmask m, vint a, vint b)
{
    return (a & m) | (b & ~m);
}

static inline vuint choose_u(vmask m, vuint a, vuint b)
{
    return (vuint)choose_i(m, (vint)a, (vint)b);
}

/* The second of two numbers that are equal or not ordered, as the instructions have it. */
#if GLINT_LANES == 16 && defined(__AVX512F__)

static inline vfloat min_f(vfloat a, vfloat b)
{
    return (vfloat)_mm512_min_ps((__m512)a, (__m512)b);
}

static inline vfloat max_f(vfloat a, vfloat b)
{
    return (vfloat)_mm512_max_ps((__m512)a, (__m512)b);
}

#elif GLINT_LANES == 8 && defined(__AVX2__)

static inline vfloat min_f(vfloat a, vfloat b)
{
    return (vfloat)_mm256_min_ps((__m256)a, (__m256)b);
}

static inline vfloat max_f(vfloat a, vfloat b)
{
    return (vfloat)_mm256_max_ps((__m256)a, (__m256)b);
}

#elif GLINT_LANES == 4 && defined(__SSE2__)

static inline vfloat min_f(vfloat a, vfloat b)
{
    return (vfloat)_mm_min_ps((__m128)a, (__m128)b);
}

static inline vfloat max_f(vfloat a, vfloat b)
{
    return (vfloat)_mm_max_ps((__m128)a, (__m128)b);
}

#else

static inline vfloat min_f(vfloat a, vfloat b)
{
    return choose(less(a, b), a, b);
}

static inline vfloat max_f(vfloat a, vfloat b)
{
    return choose(less(b, a), a, b);
}

#endif

static inline vint min_i(vint a, vint b)
{
    return choose_i(less_i(a, b), a, b);
}

static inline vfloat abs_f(vfloat x)
{
    return float_from_bits(bits_of(x) & 0x7fffffffU);
}

/* 2^e for integers e in [-126, 127]. */
static inline vfloat exp2_i(vint e)
{
    return float_from_bits((vuint)(e + 127) << 23);
}

/* x = 2^e * m with m in [1, 2), for normal x > 0. */
static inline vint exponent_of(vfloat x)
{
    return (vint)(bits_of(x) >> 23) - 127;
}

static inline vfloat mantissa_of(vfloat x)
{
    return float_from_bits((bits_of(x) & 0x007fffffU) | 0x3f800000U);
}

#endif
