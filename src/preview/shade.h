/* A hit made ready for light: its layers with their frames, and how they scatter. */
#ifndef PREVIEW_SHADE_H
#define PREVIEW_SHADE_H

#include "io/image.h"
#include "preview/hit.h"
#include "preview/materials.h"

typedef struct shade_layer {
    const glint_material *material;
    glint_surface surface;
    vec3 x, y, z; /* the local frame in world space: tangent, bitangent, shading normal */
    float wo[3];  /* to the viewer, in that frame */
    float weight; /* what the layers above leave of it, or how much of the surface the coat covers */
    bool counts;  /* wants the footprint */
    bool mapped;  /* shows a normal map: x lies along u and y along v, so that the frame may be left-handed */
} shade_layer;

typedef struct shade_point {
    shade_layer layers[2]; /* the base, then the coat */
    int layer_count;       /* 0: unlit */
    glint_footprint footprint;
    float emission[3];
    float occlusion; /* of diffuse light from all around: occlusionTexture */
    float opacity;
    float albedo[3]; /* base colour, for the picture of that name */
} shade_point;

typedef struct shader {
    const scene *scene;
    const materials *materials;
    const textures *textures;
} shader;

/* wo: world, unit, to the viewer. choice: uniform in [0, 1), see place_footprint. */
void shade_prepare(const shader *s, const hit *h, const hit_step *step, vec3 wo, float choice, shade_point *out);

/* Makes every layer as rough as it looks to a ray that stands for a whole cone: what a wide bounce sees of a highlight
 * is its mean, and no spark. slope_variance: of the half vector over the cone. With more samples the cones shrink, and
 * the picture tends to that of the true roughness. Tokuyoshi and Kaplanyan 2019, Eq. 5. */
void shade_widen(shade_point *p, double slope_variance);

/* Sum of the layers' f |cos theta_i| for light from wi (world, unit); facet_count and lit_probability are those of the
 * layer that counts. f = f_base (1 - c F) + c f_coat, F the Schlick term of the coat and c its weight
 * (KHR_materials_clearcoat). */
void shade_eval(const shade_point *p, vec3 wi, float solid_angle_sr, glint_value *value);

/* Whether light from wi can reach the viewer by any layer. */
bool shade_faces(const shade_point *p, vec3 wi);

typedef struct shade_direction {
    vec3 wi;         /* world, unit */
    float weight[3]; /* f |cos theta_i| / pdf of the layer that was chosen */
    float pdf;       /* per steradian, the choice of the layer included */
} shade_direction;

/* Draws a direction for indirect light from uniforms in [0, 1). False: the path ends here. */
bool shade_sample(const shade_point *p, float choose_layer, const float random[3], shade_direction *out);

/* Opacity of a point for rays that only want to know whether they pass; textures are not filtered. */
float shade_opacity(const shader *s, const geometry *g, const trace_hit *at);

#endif
