/* What the processor can do at most, with vectors of each width. */
#ifndef BENCH_ROOFLINE_PEAK_H
#define BENCH_ROOFLINE_PEAK_H

/* Operations of one lane that one call does. */
enum { ROOFLINE_OPERATIONS_PER_LANE = 2 * 12 * 15000 };

/* Each returns a number that depends on all of its work. */
typedef unsigned roofline_loop(void);
roofline_loop roofline_integer_4, roofline_integer_8, roofline_integer_16; /* exclusive or, addition */
roofline_loop roofline_float_4, roofline_float_8, roofline_float_16; /* product, sum: two instructions, as the library
                                                                        has them, whose bits a fused one would change */

#endif
