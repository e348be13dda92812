/* The effects, a switch each, and all of them on.
 *
 * A scene shall not pay for what it does not use: tests/plan builds the renderer again and again with one of these off,
 * puts a scene without that effect through both, and compares the instructions.
 */
#ifndef PREVIEW_EFFECTS_H
#define PREVIEW_EFFECTS_H

enum {
    EFFECT_TEXTURES = 1,
    EFFECT_NORMAL_MAPS = 1,
    EFFECT_EXAMPLES = 1, /* facets from a normal map, whose layers have frames of their own */
    EFFECT_COATS = 1,
    EFFECT_ALPHA = 1,
    EFFECT_EMISSION = 1,
    EFFECT_EMITTERS = 1, /* what glows as a light */
    EFFECT_ENVIRONMENT = 1,
    EFFECT_BOUNCES = 1,      /* of the sky's light as well */
    EFFECT_FLAT_LIGHTS = 1,  /* rectangles and disks */
    EFFECT_ROUND_SHAPES = 1, /* points, spots and suns that show their shape */
    EFFECT_MANY_LIGHTS = 1,
    EFFECT_FACETS = 1,       /* single ones */
    EFFECT_FACET_LIMIT = 1,  /* of the explicit model */
    EFFECT_FACET_PLANES = 1, /* facets in the object's space */
    EFFECT_FACETS_OF_OTHERS = 1,
    EFFECT_DRAWS = 1,
    EFFECT_DESCRIPTION = 1 /* pictures beside that of the light */
};

#endif
