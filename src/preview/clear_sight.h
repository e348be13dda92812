/* Lights that nothing can stand before, as a material sees them: proven from the geometry, before any ray. */
#ifndef PREVIEW_CLEAR_SIGHT_H
#define PREVIEW_CLEAR_SIGHT_H

#include "preview/hit.h"
#include "preview/light.h"

typedef enum clear_sight {
    CLEAR_UNKNOWN = 0, /* nothing is proven */
    CLEAR_IN_FRONT,    /* of the side where normals point: of convex bodies */
    CLEAR_BOTH_SIDES   /* of flat surfaces */
} clear_sight;

/* table: for each material of the scene, one after the other, what it sees of each light. Scenes of so many parts that
 * the proof would take long prove nothing. False: no memory. */
bool clear_sight_find(const geometry *g, const light *lights, int light_count, uint8_t *table, report *r);

/* Whether the proof holds at a point: nothing that lies above the plane of its triangle is in the way. view: of a light
 * that is round; a flat one lies about the point as `area` says. */
bool clear_sight_of_round(clear_sight sight, const hit *h, const light *l, const light_view *view);
bool clear_sight_of_flat(clear_sight sight, const hit *h, const light *l);

#endif
