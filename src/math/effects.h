/* The library's effects, a switch each, and all of them on: as preview/effects.h has those of the renderer.
 *
 * tests/plan builds the library again with one of them off, and compares what a picture costs that does not use it.
 */
#ifndef MATH_EFFECTS_H
#define MATH_EFFECTS_H

enum {
    LIBRARY_COUNTING = 1, /* models: without it the smooth one, without the others this */
    LIBRARY_EXPLICIT = 1,
    LIBRARY_DICTIONARY = 1,
    LIBRARY_EXAMPLE = 1,
    LIBRARY_LAYERS = 1,
    LIBRARY_AREA_LIGHTS = 1,
    LIBRARY_SURFACES = 1, /* that differ from point to point, as textures make them */
    LIBRARY_BECKMANN = 1, /* beside GGX: its density, its masking, its area */
    LIBRARY_ANISOTROPY = 1,
    LIBRARY_FRESNEL_TERMS = 1, /* beside Schlick's */
    LIBRARY_WEIGHTINGS = 1,    /* facets of equal projected area */
    LIBRARY_ROUGH_FACETS = 1,
    LIBRARY_ELONGATION = 1,
    LIBRARY_DISCRETENESS = 1, /* between smooth and all of the facets */
    LIBRARY_TINTS = 1,
    LIBRARY_FADING = 1,
    LIBRARY_DRAWS = 1 /* of single realisations */
};

#endif
