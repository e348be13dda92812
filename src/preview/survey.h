/* A few hundred pixels, looked at before the render: what the plan needs to know of a view. */
#ifndef PREVIEW_SURVEY_H
#define PREVIEW_SURVEY_H

#include "preview/integrator.h"

/* Of a pixel, that tell what bounces bring. */
enum { SURVEY_SAMPLES = 4 };

/* The mean of its channels. */
static inline double survey_level(const float rgb[3])
{
    return ((double)rgb[0] + (double)rgb[1] + (double)rgb[2]) / 3.0;
}

typedef struct survey_name {
    char text[56];
} survey_name;

/* Sum over the pixels of light^2 / (N p); last: see glint_plan_shape. */
typedef struct survey_sparks {
    double whole, last;
} survey_sparks;

typedef struct survey {
    glint_plan_summary summary;      /* points to the others */
    glint_material_options *options; /* base and coat of every material */
    glint_plan_material *materials;
    glint_plan_light *lights; /* those of the world, then surroundings where there are any */
    glint_plan_pair *pairs;
    survey_sparks *sparks; /* of each pair's shapes */
    uint32_t *pair_of;     /* of a material and a light: the number of their pair, from 1 on; 0: not seen */
    survey_name *light_names;
} survey;

/* w leaves nothing out. sights: what is proven of its lights. The same for every number of threads and for every
 * tile of a picture. with_noise false: where the number of samples is given and no one asks what they leave. */
bool survey_make(const world *w, const uint8_t *sights, const preview_options *o, bool with_noise, survey *out,
                 report *r);
void survey_free(survey *s);

/* survey_scene.c: materials and lights, and room for as many pairs of them as can be seen. On failure *out is zeroed.
 */
bool survey_begin(survey *out, const world *w, const preview_options *o, int light_count, size_t most_pairs, report *r);
bool survey_has_surroundings(const world *w);

#endif
