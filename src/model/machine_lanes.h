/* Which of the vector widths that kernels are compiled for this machine runs. */
#ifndef MODEL_MACHINE_LANES_H
#define MODEL_MACHINE_LANES_H

#include <stddef.h>

enum { MOST_LANES = 16 };

/* 1, 4, 8 or 16: the widest that is at most this many. */
size_t machine_lanes(size_t most);

#endif
