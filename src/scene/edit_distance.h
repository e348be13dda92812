/* How far a mistyped name is from one that exists, for messages that say what may have been meant. */
#ifndef SCENE_EDIT_DISTANCE_H
#define SCENE_EDIT_DISTANCE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Letters to add, drop, replace or swap with their neighbour until a is b. Names of more than 64 bytes, which nobody
 * types and a hostile file may bring, are either equal or further apart than that. */
size_t edit_distance(const char *a, const char *b);

/* The distance up to which a name is near: a third of the wanted one's letters, and at least 2. */
size_t edit_distance_near(const char *wanted);

#ifdef __cplusplus
}
#endif

#endif
