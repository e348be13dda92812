/* Materials that use one effect of the library each, so that it shows when a build has no such effect. */
#ifndef PLAN_LIBRARY_H
#define PLAN_LIBRARY_H

#include <stdint.h>

/* A hash of what a few points under a light come to. effect: by its name in math/effects.h. 0: there is none, or the
 * material cannot be made. */
uint32_t library_use(const char *effect);

/* FNV-1a. */
uint32_t library_hash(const void *bytes, size_t size, uint32_t hash);
enum { LIBRARY_FIRST_HASH = 0x811c9dc5 };

#endif
