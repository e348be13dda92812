/* A program that uses libglint_preview.so: a square under a sun, and calls that must not fail. */
#ifndef CALLER_H
#define CALLER_H

#include <stddef.h>
#include <stdint.h>

#include "preview/glint_preview.h"

/* A square of 2 m in the plane y = 0, facing up, (s, t) from (0, 0) at (-1, -1) to (1, 1); two triangles. */
extern const float SQUARE_POSITIONS[12];
extern const float IDENTITY[16];

/* Diffuse and nothing else: f = color / pi. */
#define MATTE(color, more)                                                                                             \
    "{\"pbrMetallicRoughness\": {\"baseColorFactor\": [" color ", 1], \"metallicFactor\": 0" more                      \
    "}, \"extensions\": {\"KHR_materials_specular\": {\"specularFactor\": 0}}}"

/* Flakes of a density a square unit of (s, t); without the first brace, so that more can stand before. */
#define NAMELESS_FLAKES(density)                                                                                       \
    "\"pbrMetallicRoughness\": {\"roughnessFactor\": 0.5}, \"extensions\": {\"GLINT_materials_glint\": "               \
    "{\"glintFactor\": 1, \"glintDensity\": " density ", \"glintFacetRoughness\": 0.05}}}"
#define FLAKES(density) "{" NAMELESS_FLAKES(density)
#define GLITTER "{\"materials\": [" FLAKES("2500") "]}"

/* Everything that a scene of one square needs, with a sun straight above. */
typedef struct square_scene {
    glint_preview_mesh mesh;
    glint_preview_light sun;
    glint_preview_scene_options options; /* points to the others: a square_scene may not be copied */
} square_scene;

void make_square(square_scene *s);

/* Orthographic, 4 m above, looking down; sees a square of 2 half_size; x to the right, z downwards. */
glint_preview_camera from_above(float half_size);
/* 8 x 8 pixels of 4 samples, one thread. */
glint_preview_picture_options small(const glint_preview_camera *camera);

glint_preview_scene *create(const glint_preview_scene_options *o);
glint_preview_picture *begin(const glint_preview_scene *s, const glint_preview_picture_options *o);
void refine(glint_preview_picture *p, int32_t samples);
void get(const glint_preview_picture *p, int32_t pass, float *values, size_t count);

/* The call fails, and its message has these words and says what was expected. */
void refuse(const glint_preview_scene_options *o, const char *named);

#endif
