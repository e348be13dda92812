/* The same code with other arithmetic. */
#ifndef STUDY_ARITHMETIC_H
#define STUDY_ARITHMETIC_H

#include "model/counting_kernel.h"

/* The counting kernel in eight lanes with fused multiply-add; where ARITHMETIC_FUSED is not defined there is none. */
counting_kernel fused_kernel_8;

/* D G2 / (4 cos_o) times cos_i, GGX of round roughness, by the library's formulas in double. */
double arithmetic_lobe(double alpha, const double wo[3], const double wi[3]);

#endif
