/* What all vectors have in common, on the compilers' vector extensions. Doubles are two vectors of the same width. */
#ifndef MATH_LANES_VECTOR_H
#define MATH_LANES_VECTOR_H

typedef float vfloat __attribute__((vector_size(4 * GLINT_LANES)));
typedef int32_t vint __attribute__((vector_size(4 * GLINT_LANES)));
typedef uint32_t vuint __attribute__((vector_size(4 * GLINT_LANES)));
typedef double half_double __attribute__((vector_size(4 * GLINT_LANES)));

typedef struct vdouble {
    half_double low, high;
} vdouble;

static inline vfloat splat(float x)
{
    return (vfloat){ 0 } + x;
}

static inline vint splat_i(int32_t x)
{
    return (vint){ 0 } + x;
}

static inline vfloat to_float(vint i)
{
    return __builtin_convertvector(i, vfloat);
}

static inline vint to_int(vfloat f)
{
    return __builtin_convertvector(f, vint);
}

static inline vdouble load_d(const double *p)
{
    vdouble d;
    memcpy(&d.low, p, sizeof(d.low));
    memcpy(&d.high, p + GLINT_LANES / 2, sizeof(d.high));
    return d;
}

static inline vdouble splat_d(double x)
{
    return (vdouble){ (half_double){ 0 } + x, (half_double){ 0 } + x };
}

static inline vdouble add_d(vdouble a, vdouble b)
{
    return (vdouble){ a.low + b.low, a.high + b.high };
}

static inline vdouble subtract_d(vdouble a, vdouble b)
{
    return (vdouble){ a.low - b.low, a.high - b.high };
}

static inline vdouble multiply_d(vdouble a, vdouble b)
{
    return (vdouble){ a.low * b.low, a.high * b.high };
}

#endif
