/* Vectors of WIDE_LANES doubles, so that one source is compiled for every instruction set.
 *
 * Include it once per translation unit with WIDE_LANES defined as 1, 2, 4 or 8; with 1 the same names are plain
 * scalars. Only operations whose result IEEE 754 fixes are used, never a fused multiply-add, so every width gives the
 * same bits. What a mask is made of is the machine's affair; masks combine with & and |. */
#ifndef PREVIEW_WIDE_H
#define PREVIEW_WIDE_H

#include <stdint.h>
#include <string.h>

#include "preview/vector.h"

#if !defined(WIDE_LANES)
#error "define WIDE_LANES as 1, 2, 4 or 8 before including preview/wide.h"
#endif

#if WIDE_LANES == 1
typedef double wide;
typedef int64_t wide_mask;
#else
typedef double wide __attribute__((vector_size(8 * WIDE_LANES)));
typedef float wide_floats __attribute__((vector_size(4 * WIDE_LANES)));
typedef int64_t wide_bits __attribute__((vector_size(8 * WIDE_LANES)));
#if WIDE_LANES == 8 && defined(__AVX512F__)
#include <immintrin.h>
typedef __mmask8 wide_mask;
#else
typedef wide_bits wide_mask;
#if defined(__SSE2__)
#include <immintrin.h>
#endif
#endif
#endif

static inline wide wide_splat(double x)
{
#if WIDE_LANES == 1
    return x;
#else
    return x - (wide){ 0.0 };
#endif
}

/* ---- comparing ---- */

#if WIDE_LANES == 1

static inline wide_mask wide_less(wide a, wide b)
{
    return -(int64_t)(a < b);
}

static inline wide_mask wide_at_most(wide a, wide b)
{
    return -(int64_t)(a <= b);
}

/* Bit i for lane i. */
static inline unsigned wide_mask_bits(wide_mask m)
{
    return m != 0;
}

static inline wide wide_choose(wide_mask m, wide a, wide b)
{
    return m != 0 ? a : b;
}

#elif WIDE_LANES == 8 && defined(__AVX512F__)

static inline wide_mask wide_less(wide a, wide b)
{
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ);
}

static inline wide_mask wide_at_most(wide a, wide b)
{
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LE_OQ);
}

static inline unsigned wide_mask_bits(wide_mask m)
{
    return m;
}

static inline wide wide_choose(wide_mask m, wide a, wide b)
{
    return (wide)_mm512_mask_blend_pd(m, (__m512d)b, (__m512d)a);
}

#else

static inline wide_mask wide_less(wide a, wide b)
{
    return (wide_mask)(a < b);
}

static inline wide_mask wide_at_most(wide a, wide b)
{
    return (wide_mask)(a <= b);
}

static inline unsigned wide_mask_bits(wide_mask m)
{
#if WIDE_LANES == 4 && defined(__AVX2__)
    return (unsigned)_mm256_movemask_pd((__m256d)m);
#elif WIDE_LANES == 2 && defined(__SSE2__)
    return (unsigned)_mm_movemask_pd((__m128d)m);
#else
    unsigned bits = 0;
    for (int i = 0; i < WIDE_LANES; ++i)
        bits |= (unsigned)(m[i] & 1) << i;
    return bits;
#endif
}

static inline wide wide_choose(wide_mask m, wide a, wide b)
{
#if WIDE_LANES == 4 && defined(__AVX2__)
    return (wide)_mm256_blendv_pd((__m256d)b, (__m256d)a, (__m256d)m);
#else
    return (wide)(((wide_bits)a & m) | ((wide_bits)b & ~m));
#endif
}

#endif

static inline bool wide_any(wide_mask m)
{
    return wide_mask_bits(m) != 0;
}

static inline bool wide_all(wide_mask m)
{
    return wide_mask_bits(m) == (1U << WIDE_LANES) - 1U;
}

/* ---- what scalars have functions for ---- */

static inline wide wide_sqrt(wide a)
{
#if WIDE_LANES == 1
    return sqrt(a);
#elif WIDE_LANES == 8 && defined(__AVX512F__)
    return (wide)_mm512_sqrt_pd((__m512d)a);
#elif WIDE_LANES == 4 && defined(__AVX2__)
    return (wide)_mm256_sqrt_pd((__m256d)a);
#elif WIDE_LANES == 2 && defined(__SSE2__)
    return (wide)_mm_sqrt_pd((__m128d)a);
#else
    for (int i = 0; i < WIDE_LANES; ++i)
        a[i] = sqrt(a[i]);
    return a;
#endif
}

/* Of two numbers; b where one of them is none: as larger_of and smaller_of. */
static inline wide wide_larger(wide a, wide b)
{
    return wide_choose(wide_less(b, a), a, b);
}

static inline wide wide_smaller(wide a, wide b)
{
    return wide_choose(wide_less(a, b), a, b);
}

static inline wide wide_abs(wide a)
{
#if WIDE_LANES == 1
    return fabs(a);
#else
    return (wide)((wide_bits)a & INT64_MAX);
#endif
}

/* 1 with the sign of a, that of a zero as well. */
static inline wide wide_sign(wide a)
{
#if WIDE_LANES == 1
    return copysign(1.0, a);
#else
    return (wide)(((wide_bits)a & INT64_MIN) | (wide_bits)wide_splat(1.0));
#endif
}

static inline wide_mask wide_is_finite(wide a)
{
    return wide_less(wide_abs(a), wide_splat((double)INFINITY));
}

/* To single precision and back. */
static inline wide wide_rounded(wide a)
{
#if WIDE_LANES == 1
    return (double)(float)a;
#else
    return __builtin_convertvector(__builtin_convertvector(a, wide_floats), wide);
#endif
}

/* ---- memory; the pointer needs no alignment ---- */

static inline wide wide_load(const double *from)
{
    wide a;
    memcpy(&a, from, sizeof a);
    return a;
}

static inline void wide_store(double *to, wide a)
{
    memcpy(to, &a, sizeof a);
}

static inline wide wide_from_floats(const float *from)
{
#if WIDE_LANES == 1
    return (double)from[0];
#else
    wide_floats f;
    memcpy(&f, from, sizeof f);
    return __builtin_convertvector(f, wide);
#endif
}

static inline void wide_store_floats(float *to, wide a)
{
#if WIDE_LANES == 1
    *to = (float)a;
#else
    const wide_floats f = __builtin_convertvector(a, wide_floats);
    memcpy(to, &f, sizeof f);
#endif
}

/* ---- three of them ---- */

/* The operations of vec3, in the same order. */
typedef struct wide3 {
    wide x, y, z;
} wide3;

static inline wide3 w3_splat(vec3 a)
{
    return (wide3){ wide_splat(a.x), wide_splat(a.y), wide_splat(a.z) };
}

static inline wide3 w3_add(wide3 a, wide3 b)
{
    return (wide3){ a.x + b.x, a.y + b.y, a.z + b.z };
}

static inline wide3 w3_sub(wide3 a, wide3 b)
{
    return (wide3){ a.x - b.x, a.y - b.y, a.z - b.z };
}

static inline wide3 w3_scale(wide3 a, wide s)
{
    return (wide3){ a.x * s, a.y * s, a.z * s };
}

/* a + b s */
static inline wide3 w3_mad(wide3 a, wide3 b, wide s)
{
    return (wide3){ a.x + b.x * s, a.y + b.y * s, a.z + b.z * s };
}

static inline wide w3_dot(wide3 a, wide3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline wide3 w3_cross(wide3 a, wide3 b)
{
    return (wide3){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static inline wide w3_length(wide3 a)
{
    return wide_sqrt(w3_dot(a, a));
}

static inline wide3 w3_choose(wide_mask m, wide3 a, wide3 b)
{
    return (wide3){ wide_choose(m, a.x, b.x), wide_choose(m, a.y, b.y), wide_choose(m, a.z, b.z) };
}

/* The zero vector stays zero. */
static inline wide3 w3_normalize(wide3 a)
{
    const wide length = w3_length(a), zero = wide_splat(0.0);
    return w3_choose(wide_less(zero, length), w3_scale(a, 1.0 / length), (wide3){ zero, zero, zero });
}

static inline wide3 w3_reject(wide3 a, wide3 n)
{
    return w3_mad(a, n, -w3_dot(a, n));
}

static inline wide w3_max_abs(wide3 a)
{
    return wide_larger(wide_abs(a.x), wide_larger(wide_abs(a.y), wide_abs(a.z)));
}

/* See v3_any_tangent. */
static inline wide3 w3_any_tangent(wide3 n)
{
    const wide sign = wide_sign(n.z);
    const wide a = -1.0 / (sign + n.z);
    return (wide3){ 1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x };
}

#endif
