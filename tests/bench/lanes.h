/* Holds a counting material to fewer lanes than the machine has. */
#ifndef BENCH_LANES_H
#define BENCH_LANES_H

#include "glint.h"

/* Other materials, and NULL, stay as they are. */
void lanes_hold(const glint_material *m, size_t lanes);

#endif
