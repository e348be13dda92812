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

/* For machines that have no instruction to choose with. */
static inline vint choose_bits(vmask m, vint a, vint b)
{
    return (a & m) | (b & ~m);
}

/* sum + x where m is set, else sum, which must not be -0. */
static inline vfloat add_where(vmask m, vfloat sum, vfloat x)
{
    return sum + (vfloat)((vint)x & m);
}

#endif
