/* The baseline of the benchmarks: the counting method as it was published, in plain scalar C. */
#ifndef BENCH_PUBLISHED_COUNT_H
#define BENCH_PUBLISHED_COUNT_H

#include "model/counting_kernel.h"

/* Same arguments and same meaning of the result as a kernel of ours. */
counting_kernel published_count;

#endif
