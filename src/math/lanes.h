/* Vectors of GLINT_LANES floats, so that one source is compiled for every instruction set.
 *
 * Include it once per translation unit with GLINT_LANES defined as 1, 4, 8 or 16. With 1 the same names are plain
 * scalars. Only operations whose result IEEE 754 fixes are used (+ - * / sqrt, conversions, integers), never a fused
 * multiply-add, so every width gives the same bits. Masks combine with & | ~; what they are made of is the machine's
 * affair.
 *
 * vdouble holds as many doubles: places on the surface, where a float would lose the cell.
 */
#ifndef MATH_LANES_H
#define MATH_LANES_H

#include <stdint.h>
#include <string.h>

#if !defined(GLINT_LANES)
#error "define GLINT_LANES as 1, 4, 8 or 16 before including math/lanes.h"
#endif

/* What each machine does in its own way: masks and what they choose, min and max, roots, and conversions. */
#if GLINT_LANES == 1
#include "math/lanes_scalar.h"
#else
#include "math/lanes_vector.h"
#if GLINT_LANES == 16 && defined(__AVX512F__)
#include "math/lanes_avx512.h"
#elif GLINT_LANES == 8 && defined(__AVX2__)
#include "math/lanes_avx2.h"
#elif GLINT_LANES == 4 && defined(__SSE2__)
#include "math/lanes_sse.h"
#else
#include "math/lanes_portable.h"
#endif
#endif

/* ---- memory; the pointer needs no alignment ---- */

static inline vfloat load_f(const float *p)
{
    vfloat v;
    memcpy(&v, p, sizeof(v));
    return v;
}

static inline vuint load_u(const uint32_t *p)
{
    vuint v;
    memcpy(&v, p, sizeof(v));
    return v;
}

static inline vint load_i(const int32_t *p)
{
    vint v;
    memcpy(&v, p, sizeof(v));
    return v;
}

static inline void store_u(uint32_t *p, vuint v)
{
    memcpy(p, &v, sizeof(v));
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

static inline vuint choose_u(vmask m, vuint a, vuint b)
{
    return (vuint)choose_i(m, (vint)a, (vint)b);
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

#if !defined(LANES_TAKE_FLOATS_APART)

static inline vfloat exponent_f(vfloat x)
{
    return to_float(exponent_of(x));
}

static inline vfloat mantissa_of(vfloat x)
{
    return float_from_bits((bits_of(x) & 0x007fffffU) | 0x3f800000U);
}

#endif

#endif
