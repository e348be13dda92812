/* Masks that are vectors, 0 or -1 in each lane: on all machines without registers for masks. */
#ifndef MATH_LANES_MASK_H
#define MATH_LANES_MASK_H

typedef vint vmask;

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

static inline vmask mask_none(void)
{
    return (vmask){ 0 };
}

static inline vint mask_bits(vmask m)
{
    return m;
}

static inline vint choose_i(vmask m, vint a, vint b)
{
    return (a & m) | (b & ~m);
}

static inline vfloat choose(vmask m, vfloat a, vfloat b)
{
    return (vfloat)choose_i(m, (vint)a, (vint)b);
}

/* sum + x where m is set, else sum, which must not be -0. */
static inline vfloat add_where(vmask m, vfloat sum, vfloat x)
{
    return sum + (vfloat)((vint)x & m);
}

#endif
