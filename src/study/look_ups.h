/* One realisation in place of the counting model's 36: the heaviest, which nobody draws. */
#ifndef STUDY_LOOK_UPS_H
#define STUDY_LOOK_UPS_H

#include "model/counting_kernel.h"

/* Same arguments and same meaning of the result as a kernel: the nearest grid, the nearest vertex, the nearest corner
 * in the lattice of half vectors, with all facets. */
counting_kernel look_up_nearest;

#endif
