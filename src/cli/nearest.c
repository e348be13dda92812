/* The known name that a mistyped one most likely meant. */
#include "cli/nearest.h"

#include "scene/edit_distance.h"

nearest nearest_begin(const char *wanted)
{
    return (nearest){ .wanted = wanted, .name = NULL, .distance = edit_distance_near(wanted) + 1 };
}

void nearest_consider(nearest *n, const char *candidate)
{
    const size_t distance = edit_distance(n->wanted, candidate);
    if (distance < n->distance) {
        n->name = candidate;
        n->distance = distance;
    }
}
