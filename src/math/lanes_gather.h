/* Numbers from a table, one lane after another: for machines that have no instruction for it. */
#ifndef MATH_LANES_GATHER_H
#define MATH_LANES_GATHER_H

static inline vfloat lookup_f(const float *table, vint index)
{
    vfloat v = { 0 };
    for (int i = 0; i < GLINT_LANES; i++)
        v[i] = table[index[i]];
    return v;
}

static inline vuint pick_u(vuint from, vint lane)
{
    vuint v = { 0 };
    for (int i = 0; i < GLINT_LANES; i++)
        v[i] = from[lane[i] & (GLINT_LANES - 1)];
    return v;
}

static inline vuint gather_u(const void *base, vint byte)
{
    vuint v = { 0 };
    for (int i = 0; i < GLINT_LANES; i++) {
        uint32_t x;
        memcpy(&x, (const char *)base + byte[i], sizeof(x));
        v[i] = x;
    }
    return v;
}

#endif
