/* What tests of hard cases share: traps for floating-point exceptions, and numbers of any bits. */
#ifndef TESTS_TRAPS_H
#define TESTS_TRAPS_H

#include "../contract/configurations.h"

#include <fenv.h>
#include <string.h>

/* A trap ends the process with SIGFPE, so a test that returns has raised nothing. */
static inline int with_traps(void **state)
{
    (void)state;
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    return 0;
}

static inline int without_traps(void **state)
{
    (void)state;
    fedisableexcept(FE_ALL_EXCEPT);
    return 0;
}

/* By bits: the comparison itself must not raise what it looks for. */
static inline void assert_sane(const glint_value *v)
{
    const float all[] = { v->rgb[0],    v->rgb[1],    v->rgb[2],      v->smooth[0],
                          v->smooth[1], v->smooth[2], v->facet_count, v->lit_probability };
    for (int i = 0; i < 8; i++) {
        uint32_t u;
        memcpy(&u, &all[i], sizeof(u));
        if ((u & 0x7f800000U) == 0x7f800000U || (u >> 31 && u != 0x80000000U))
            fail_msg("value %d has the bits %08x", i, u);
    }
}

static inline float float_of(uint32_t bits)
{
    float f;
    memcpy(&f, &bits, sizeof(f));
    return f;
}

/* Any bits, or an ordinary number with one chance in two, so that some queries get through all the checks. */
static inline float hostile(uint64_t *random, float ordinary)
{
    const uint64_t r = random_bits(random);
    return r & 1 ? ordinary : float_of((uint32_t)(r >> 32));
}

#endif
