/* A hit made ready for light: its layers with their frames, and how they scatter. */
#ifndef PREVIEW_SHADE_H
#define PREVIEW_SHADE_H

#include "io/image.h"
#include "preview/effects.h"
#include "preview/hit.h"
#include "preview/materials.h"

typedef struct shade_layer {
    const glint_material *material;
    glint_surface surface;
    vec3 x, y, z; /* the local frame in world space: tangent, bitangent, shading normal */
    float wo[3];  /* to the viewer, in that frame */
    float weight; /* of the coat: how much of the surface it covers. Of the base: about what the coat leaves of it */
    bool is_own;  /* the surface is the material's own, as it was made */
    bool counts;  /* wants the footprint */
    bool mapped;  /* shows a normal map: x lies along u and y along v, so that the frame may be left-handed */
    glint_footprint footprint;
} shade_layer;

typedef struct shade_point {
    shade_layer layers[2];       /* the base, then the coat */
    int layer_count;             /* 0: unlit */
    bool counts, draws;          /* of any layer: see material_layers */
    const glint_material *whole; /* both layers, of which they are part */
    float emission[3];
    float occlusion; /* of diffuse light from all around: occlusionTexture */
    float opacity;
    float albedo[3]; /* base colour, for the picture of that name */
} shade_point;

static inline int shade_layers(const shade_point *p)
{
    return EFFECT_COATS ? p->layer_count : p->layer_count > 0;
}

typedef struct shader {
    const scene *scene;
    const materials *materials;
    const textures *textures;
    struct shade_constant *constants; /* of every material: what it is everywhere, and how a hit is made ready */
} shader;

/* Finds out, once, what of each material has to be looked up at a hit. */
bool shader_open(shader *s, report *r);
void shader_close(shader *s);

typedef void shade_preparer(const shader *s, const hit *h, const hit_step *step, vec3 wo, float choice,
                            shade_point *out);

/* wo: world, unit, to the viewer. choice: uniform in [0, 1), see place_footprint; read where shade_wants_choice. */
shade_preparer shade_prepare;
bool shade_wants_choice(const shader *s, const hit *h);

/* Makes every layer as rough as it looks to a ray that stands for a whole cone: what a wide bounce sees of a highlight
 * is its mean, and no spark. slope_variance: of the half vector over the cone. With more samples the cones shrink, and
 * the picture tends to that of the true roughness. Tokuyoshi and Kaplanyan 2019, Eq. 5. */
void shade_widen(shade_point *p, double slope_variance);

/* Sum of the layers' f |cos theta_i| for light from wi (world, unit): the numbers of libglint's layered model, which
 * has the formula. The layers are evaluated one by one because a hit has more to say of each than a glint_coat does: a
 * frame of either handedness, and whether it counts for this ray. */
void shade_eval(const shade_point *p, vec3 wi, float solid_angle_sr, glint_value *value);

/* What the coat leaves of the base for light from wi (world, unit), or of light from below where wi is NULL: see
 * glint_transmittance. There is a coat. */
void shade_below_coat(const shade_point *p, const vec3 *wi, float rgb[3]);

/* Whether light from wi can reach the viewer by any layer. */
bool shade_faces(const shade_point *p, vec3 wi);

/* A light as a shape as the point sees it, in world axes: sun, sphere, rectangle or disk. */
typedef struct shade_area {
    glint_area_kind kind;
    vec3 center, half_x, half_y; /* center: from the point; it shines to the side of half_x x half_y */
    double radius;               /* sphere; sun: sine of its angular radius */
    float solid_angle_sr;        /* sun */
    float hidden;                /* share that something stands in front of */
} shade_area;

/* The same three for it: value per radiance, as glint_eval_area. */
void shade_eval_area(const shade_point *p, const shade_area *area, glint_value *value);
bool shade_faces_area(const shade_point *p, const shade_area *area);
/* About how much a round light around wi (world, unit), taken as if all of it came from its middle, is off: relative;
 * infinite where it stands astride a layer's horizon. sine: of its angular radius. */
double shade_cap_error(const shade_point *p, vec3 wi, double sine);
/* From which on a light of some size has to be seen as a shape, as has one that stands astride a layer's horizon. */
#define SHADE_CAP_ERROR 0.01
/* A light of either kind at a point. */
typedef struct shade_query {
    const shade_point *point;
    vec3 wi; /* a cap: as shade_eval; these two are not read of an area */
    float solid_angle_sr;
    bool is_area;
    shade_area area;
    const glint_value *value; /* out */
} shade_query;

static inline bool shade_is_area(const shade_query *q)
{
    return (EFFECT_FLAT_LIGHTS || EFFECT_ROUND_SHAPES) && q->is_area;
}

enum { SHADE_MOST_QUERIES = 256 };

/* shade_eval or shade_eval_area for every query, bit for bit: sorted by material, and evaluated in batches. At most
 * SHADE_MOST_QUERIES. The points are as shade_prepare left them, and none is unlit. values: room for what they
 * point to afterwards. evaluated: added to it is how many layers did not count facets, and how many did. */
void shade_eval_many(shade_query *const *queries, int count, glint_value values[2 * SHADE_MOST_QUERIES],
                     uint64_t evaluated[2]);

/* Mean over the channels of f |cos theta_i| without single facets, for one of its directions. */
float shade_level(const shade_point *p, vec3 wi);
/* Density with which shade_sample draws wi, per steradian. */
float shade_pdf(const shade_point *p, vec3 wi);

typedef struct shade_direction {
    int layer;       /* which was chosen */
    vec3 wi;         /* world, unit */
    float weight[3]; /* f |cos theta_i| / pdf of the layer that was chosen */
    float pdf;       /* per steradian, the choice of the layer included */
} shade_direction;

/* Draws a direction for indirect light from uniforms in [0, 1). False: the path ends here. */
bool shade_sample(const shade_point *p, float choose_layer, const float random[3], shade_direction *out);

/* A direction that can be found in two ways: by the light's own distribution, and by shade_sample. */
typedef struct shade_surroundings {
    vec3 wi;
    float light_pdf;      /* per steradian, of the first way */
    float solid_angle_sr; /* of the patch of even light around wi; 0: it reaches all facets, count none */
    float most_samples;   /* of a pixel: a footprint may grow so many times, and then covers the pixel */
} shade_surroundings;

/* What a direction that was found in the first way adds, per radiance: the sum over layers of f |cos theta_i| /
 * (light_pdf
 * + the layer's own density), which is the balance heuristic. Occlusion darkens the diffuse part.
 *
 * Few samples look into a patch, so each stands for more of the pixel than its own footprint: for 1 / P of it, with P
 * samples expected there. It counts the facets of that area. */
void shade_eval_surroundings(const shade_point *p, const shade_surroundings *s, glint_value *value);
/* The same for at most 64 of them, bit for bit, in batches. */
void shade_eval_surroundings_many(const shade_point *const *points, const shade_surroundings *const *from, int count,
                                  glint_value *values);
/* The same for one that shade_sample found: its layer's part. */
void shade_eval_found(const shade_point *p, const shade_surroundings *s, const shade_direction *found,
                      glint_value *value);

/* Opacity of a point for rays that only want to know whether they pass; textures are not filtered. */
float shade_opacity(const shader *s, const geometry *g, const trace_hit *at);
/* What a point without a coat emits, likewise. */
void shade_emission(const shader *s, const geometry *g, const trace_hit *at, float rgb[3]);

#endif
