/* Colour of single facets: a tint from a small table or of a random hue, whose mean is white.
 *
 * Chermain et al. 2020, section 7.4 (Figure 11) and appendix A: a facet multiplies what it reflects by a colour picked
 * from a table by its hash. The paper's table darkens the surface by its mean; here a tint is a colour over the table's
 * mean, so that the surface keeps its base colour.
 */
#ifndef MODEL_TINT_H
#define MODEL_TINT_H

#include <stdint.h>

#include "glint.h"

/* What the options say, made ready once an evaluation or once a material. */
typedef struct tint_palette {
    float variation;
    float count;                      /* at least 1: one white colour stands for no table */
    float color[3][GLINT_MAX_COLORS]; /* channel by channel, over their mean */
} tint_palette;

/* Whether the options ask for facets of different colours. */
int tint_is_asked(const glint_material_options *options);

tint_palette tint_palette_of(const glint_material_options *options);

/* The mean tint of this many facets that share a hash, facets >= 1: white for all of them together, and as far from it
 * as the mean of that many independent colours. Not negative; its mean over hashes is white. */
void tint_of(const tint_palette *palette, uint32_t hash, float facets, float rgb[3]);

/* The tint of one facet for a uniform in [0, 1): the colour floor(uniform * count), and what is left is the hue in
 * turns. */
void tint_of_uniform(const tint_palette *palette, float uniform, float rgb[3]);

#endif
