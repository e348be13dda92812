/* THE CONTRACT of a model: what it must do so that glint.c, and every client, can use it without knowing it.
 *
 * A model is one file that ends in `const struct model NAME_model` and one row in glint.c. What it is called with has
 * been checked: directions are unit and above the horizon, the surface is finite and in range. What it returns is
 * checked by nobody. The layered model alone has two horizons, checks them itself, and calls the models of its layers
 * by this contract.
 */
#ifndef MODEL_MODEL_H
#define MODEL_MODEL_H

#include "glint.h"
#include "math/vec3.h"

/* A frozen material. */
struct glint_material {
    const struct model *model;
    glint_material_options options;
    float total_area;                   /* D_H of the material's own surface */
    void *baked;                        /* the model's own, from setup */
    uint32_t features;                  /* the model's, or what setup leaves of them */
    struct glint_material *base, *coat; /* of the layered model, made before its setup; NULL for others */
};

/* Where and how one evaluation happens. */
typedef struct model_query {
    const glint_material *material;
    const glint_surface *surface;
    float total_area;                 /* D_H of this surface; 0: not known yet */
    const glint_footprint *footprint; /* NULL: the smooth limit */
    float solid_angle_sr;             /* of the light; 0: the smooth limit. Sampling and its density have no light */
    vec3 wo, wi;
    /* NULL: a cap of solid_angle_sr around wi. Else wi and solid_angle_sr are not set, and eval integrates over the
     * light as glint_eval_area says; its numbers have not been checked, and area_see in model/area.h does. */
    const glint_area_light *area_light;
} model_query;

struct model {
    const char *name;
    uint32_t features; /* glint_feature bits */

    /* Bakes what the options call for into material->baked. NULL: there is nothing to bake. Memory comes from
     * options.allocator. On failure nothing stays allocated. */
    glint_result (*setup)(struct glint_material *material);
    void (*free)(struct glint_material *material);

    /* With GLINT_FEATURE_SAMPLE_FOOTPRINT the solid angle says only whether there is a light: any above 0 gives the f
     * of sample. */
    void (*eval)(const model_query *q, glint_value *value);
    /* eval for count queries of one material, bit for bit: all of them under an area light, or none. */
    void (*eval_many)(const model_query *q, size_t count, glint_value *value);
    /* As glint_sample_direction and glint_pdf. */
    int (*sample)(const model_query *q, const float random[3], glint_sample *sample);
    float (*pdf)(const model_query *q);
    /* As glint_transmittance; from_below: there is no wi. NULL: there is no coat. */
    void (*transmittance)(const model_query *q, int from_below, float rgb[3]);
};

extern const struct model smooth_model;
extern const struct model counting_model;
extern const struct model explicit_model;
extern const struct model dictionary_model;
extern const struct model example_model;
extern const struct model layered_model;

#endif
