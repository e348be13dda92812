/* One lane: plain scalars under the names of math/lanes.h. */
#ifndef MATH_LANES_SCALAR_H
#define MATH_LANES_SCALAR_H

typedef float vfloat;
typedef int32_t vint;
typedef uint32_t vuint;
typedef int32_t vmask;
typedef double vdouble;

static inline vfloat splat(float x)
{
    return x;
}

static inline vint splat_i(int32_t x)
{
    return x;
}

/* ---- masks: 0 or -1 ---- */

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
    return m;
}

static inline vfloat choose(vmask m, vfloat a, vfloat b)
{
    return m ? a : b;
}

static inline vint choose_i(vmask m, vint a, vint b)
{
    return m ? a : b;
}

/* sum + x where m is set, else sum, which must not be -0. */
static inline vfloat add_where(vmask m, vfloat sum, vfloat x)
{
    return sum + (m ? x : 0.0F);
}

/* ---- arithmetic ---- */

static inline vfloat min_f(vfloat a, vfloat b)
{
    return a < b ? a : b;
}

static inline vfloat max_f(vfloat a, vfloat b)
{
    return b < a ? a : b;
}

static inline vint min_i(vint a, vint b)
{
    return a < b ? a : b;
}

static inline vfloat sqrt_f(vfloat x)
{
    return __builtin_sqrtf(x);
}

static inline vfloat floor_f(vfloat x)
{
    return __builtin_floorf(x);
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

/* table[index], a table of eight. */
static inline vfloat lookup_f(const float *table, vint index)
{
    return table[index];
}

/* In every lane what `from` has in that lane, modulo their number. */
static inline vuint pick_u(vuint from, vint lane)
{
    (void)lane;
    return from;
}

/* The 32 bits so many bytes after base. */
static inline vuint gather_u(const void *base, vint byte)
{
    uint32_t x;
    memcpy(&x, (const char *)base + byte, sizeof(x));
    return x;
}

/* ---- doubles ---- */

static inline vdouble load_d(const double *p)
{
    return *p;
}

static inline vdouble splat_d(double x)
{
    return x;
}

static inline vdouble add_d(vdouble a, vdouble b)
{
    return a + b;
}

static inline vdouble subtract_d(vdouble a, vdouble b)
{
    return a - b;
}

static inline vdouble multiply_d(vdouble a, vdouble b)
{
    return a * b;
}

static inline vdouble widen(vfloat f)
{
    return (double)f;
}

static inline vfloat narrow(vdouble d)
{
    return (float)d;
}

static inline vdouble floor_d(vdouble d)
{
    return __builtin_floor(d);
}

/* The low 32 bits of the double as it stands in memory. */
static inline vuint low_word(vdouble d)
{
    uint64_t bits;
    memcpy(&bits, &d, sizeof(bits));
    return (uint32_t)bits;
}

#endif
