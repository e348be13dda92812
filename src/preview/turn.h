/* Sine and cosine of a turn, in lanes: of an angle given as a share of the whole circle. */
#ifndef PREVIEW_TURN_H
#define PREVIEW_TURN_H

#include "preview/wide.h"

/* For |a| <= pi / 4: the polynomials of FreeBSD's msun, k_sin.c and k_cos.c, off by less than an ulp of 1. */
static inline wide sine_near_zero(wide a)
{
    const wide z = a * a;
    const wide tail =
        ((((1.58969099521155010221e-10 * z - 2.50507602534068634195e-08) * z + 2.75573137070700676789e-06) * z -
          1.98412698298579493134e-04) *
             z +
         8.33333333332248946124e-03) *
            z -
        1.66666666666666324348e-01;
    return a + a * z * tail;
}

static inline wide cosine_near_zero(wide a)
{
    const wide z = a * a;
    const wide tail =
        ((((-1.13596475577881948265e-11 * z + 2.08757232129817482790e-09) * z - 2.75573143513906633035e-07) * z +
          2.48015872894767294178e-05) *
             z -
         1.38888888888741095749e-03) *
            z +
        4.16666666666666019037e-02;
    return 1.0 - 0.5 * z + z * z * tail;
}

/* turn in [0, 1]. */
static inline void turn_sine_cosine(wide turn, wide *sine, wide *cosine)
{
    /* Adding it rounds to an integer: the quarter turn that is nearest, 0 to 4. */
    const double rounds = 0x1.8p52;
    const wide quarter = (4.0 * turn + rounds) - rounds;
    const wide a = (2.0 * PREVIEW_PI) * (turn - 0.25 * quarter);
    const wide s = sine_near_zero(a), c = cosine_near_zero(a);
    /* 1 where the quarter is odd. */
    const wide two = wide_splat(2.0);
    const wide odd = 1.0 - wide_abs(1.0 - wide_abs(two - quarter));
    const wide_mask is_odd = wide_less(wide_splat(0.5), odd);
    const wide_mask lower = wide_less(wide_splat(1.5), quarter) & wide_less(quarter, wide_splat(3.5));
    const wide_mask left = wide_less(wide_splat(0.5), quarter) & wide_less(quarter, wide_splat(2.5));
    const wide upright = wide_choose(is_odd, c, s), level = wide_choose(is_odd, s, c);
    *sine = wide_choose(lower, -upright, upright);
    *cosine = wide_choose(left, -level, level);
}

#endif
