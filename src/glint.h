/* libglint: radiance factors of surfaces made of discrete microfacets.
 *
 * Conventions, for every function below:
 *  - Directions are unit vectors that point away from the surface, in the local frame: z is the shading normal, x the
 *    tangent. wo goes to the viewer, wi to the light.
 *  - Lengths are metres, angles radians, solid angles steradians, colours linear RGB. alpha is the microfacet roughness
 *    (the square of the roughness that artists dial). Densities count facets per square metre of surface.
 *  - Set-up may fail and says why. Evaluation may not: whatever bits come in, what goes out is finite and not negative;
 *    nonsense gives zero.
 *  - A material never changes once it is made; any number of threads may share it. Evaluation allocates nothing, locks
 *    nothing and has no state of its own.
 *  - The same input gives the same bits on every machine, whatever the vector width.
 */
#ifndef GLINT_H
#define GLINT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GLINT_VERSION_MAJOR 0
#define GLINT_VERSION_MINOR 1
#define GLINT_VERSION_PATCH 0

#if defined(__GNUC__)
#define GLINT_API __attribute__((visibility("default")))
#else
#define GLINT_API
#endif

/* "0.1.0": the version of the library that is loaded, which may be newer than this header. */
GLINT_API const char *glint_version(void);

/* ---- results ---- */

typedef enum glint_result {
    GLINT_OK = 0,
    GLINT_ERROR_ARGUMENT,    /* a pointer or a size that cannot be */
    GLINT_ERROR_RANGE,       /* a value outside its range; the message names it */
    GLINT_ERROR_UNSUPPORTED, /* the model does not do this; see glint_model_features */
    GLINT_ERROR_MEMORY       /* the allocator returned NULL */
} glint_result;

/* One sentence in English without a full stop; never NULL. */
GLINT_API const char *glint_result_text(glint_result result);

/* ---- models ---- */

typedef enum glint_model {
    GLINT_MODEL_SMOOTH = 0, /* infinitely many facets: Cook-Torrance */
    GLINT_MODEL_COUNTING,   /* a binomial count of the lit facets under the footprint */
    GLINT_MODEL_EXPLICIT,   /* every facet under the footprint, one by one: the truth, slow */
    GLINT_MODEL_DICTIONARY, /* a normalised distribution of hundreds of lobes for each patch; V-cavity masking */
    GLINT_MODEL_EXAMPLE,    /* a small normal map, repeated: scratches, brushed metal, leather (Xing et al. 2024) */
    GLINT_MODEL_LAYERED     /* a coat of any of these over a base of any of these (Xing et al. 2024, section 6.4) */
} glint_model;

/* What a model can do. A material of a model without a feature refuses options that ask for it. */
typedef enum glint_feature {
    GLINT_FEATURE_DISCRETE = 1 << 0, /* shows single facets */
    GLINT_FEATURE_GGX = 1 << 1,
    GLINT_FEATURE_BECKMANN = 1 << 2,
    GLINT_FEATURE_ANISOTROPIC = 1 << 3,          /* alpha_x != alpha_y */
    GLINT_FEATURE_SAMPLE = 1 << 4,               /* sample and pdf */
    GLINT_FEATURE_VARYING_SURFACE = 1 << 5,      /* a glint_surface may differ from point to point */
    GLINT_FEATURE_EQUAL_AREA = 1 << 6,           /* facets of equal area */
    GLINT_FEATURE_EQUAL_PROJECTED_AREA = 1 << 7, /* facets of equal projected area */
    GLINT_FEATURE_SAMPLE_FOOTPRINT = 1 << 8,     /* sample and pdf know the facets under a footprint */
    GLINT_FEATURE_COLOR = 1 << 9                 /* facets of different colours */
} glint_feature;

/* How many models there are; their numbers run from 0. */
GLINT_API uint32_t glint_model_count(void);
/* The name that files and commands use ("counting"), or NULL when there is no such model. */
GLINT_API const char *glint_model_name(glint_model model);
/* The model with this name; GLINT_ERROR_RANGE when there is none, and *model stays as it was. */
GLINT_API glint_result glint_model_find(const char *name, glint_model *model);
/* A bit set of glint_feature; 0 when there is no such model. For layered, what layers may do: see
 * glint_material_features. */
GLINT_API uint32_t glint_model_features(glint_model model);

/* ---- materials ---- */

typedef enum glint_distribution { GLINT_DISTRIBUTION_GGX = 0, GLINT_DISTRIBUTION_BECKMANN } glint_distribution;

typedef enum glint_fresnel {
    GLINT_FRESNEL_SCHLICK = 0, /* from f0 to f90 */
    GLINT_FRESNEL_DIELECTRIC,  /* exact, unpolarised, from ior */
    GLINT_FRESNEL_CONDUCTOR    /* exact, unpolarised, from eta and k */
} glint_fresnel;

/* What all facets have in common. */
typedef enum glint_weighting {
    GLINT_WEIGHTING_EQUAL_AREA = 0, /* their area: normals follow D / integral of D (Kneiphof and Klein 2024, Eq. 12) */
    GLINT_WEIGHTING_EQUAL_PROJECTED_AREA /* their area seen from above: normals follow D(h)(n.h), as a flat grid of
                                            flakes */
} glint_weighting;

/* Which facets there are, for the explicit model: those that another renderer draws with the same cells and seed. White
 * Noise knows seeds below 2^24 apart; footprints whose seed is larger have facets that no other renderer draws. */
typedef enum glint_facet_hash {
    GLINT_FACET_HASH_CYCLES = 0, /* Blender's White Noise texture */
    GLINT_FACET_HASH_POVRAY      /* the cube modulo 94906247 of POV-Ray's glint.inc */
} glint_facet_hash;

/* What textures say about one point of the surface; for layered, about the base. Evaluation clamps to the ranges. */
typedef struct glint_surface {
    float alpha_x, alpha_y; /* [1e-4, 1], along and across the tangent */
    float diffuse[3];       /* [0, 1], Lambertian albedo below the facets; it gets what the facets do not reflect */
    float f0[3], f90[3];    /* [0, 1], facet reflectance head-on and at grazing angles, for GLINT_FRESNEL_SCHLICK */
    float facets_per_m2;    /* >= 0; 0 gives the smooth limit */
    float discreteness; /* [0, 1], share of the facets' light that is counted; the rest is smooth, the mean is kept */
    const struct glint_coat *coat; /* layered model: the coat at this point; NULL: the material's own */
} glint_surface;

/* How facets are integrated over a light of real size. */
typedef enum glint_area_light_method {
    /* A few points of a light that is small beside the lobe; of others linearly transformed cosines, or, where alpha_x
     * and alpha_y differ, as exact. */
    GLINT_AREA_LIGHT_FAST = 0,
    GLINT_AREA_LIGHT_EXACT /* points where they leave about 1e-6, adaptive quadrature elsewhere, within 1 % of all but
                            * one light in ten thousand */
} glint_area_light_method;

/* The upper layer of a layered material at one point. */
typedef struct glint_coat {
    glint_surface surface;       /* its own coat is not looked at */
    float weight;                /* [0, 1], share of the surface that the coat covers */
    float normal[3], tangent[3]; /* unit, in the local frame, which is the base's; a tangent that is not at right angles
                                    to the normal is turned until it is */
    const struct glint_footprint *footprint; /* where the coat's facets are laid out otherwise; NULL: as the base's */
} glint_coat;

typedef enum glint_example_placement {
    GLINT_EXAMPLE_TILED = 0, /* side by side, all with the same transform */
    GLINT_EXAMPLE_SCATTERED  /* one at random in every square of side_m, over a flat ground; the nearest centre wins */
} glint_example_placement;

/* The microstructure of GLINT_MODEL_EXAMPLE: one small normal map and how it covers the surface.
 *
 * The map is stretched by M = rotation * (scale_x, shear_x; shear_y, scale_y), its slopes by the inverse transpose
 * (Eqs. 8 and 9 of Xing et al. 2024). A surface whose alpha differs from that of the options stretches the slopes by
 * the quotient; one whose facets_per_m2 differs shrinks the map, so that texels per area follow it. */
typedef struct glint_example {
    /* size * size normals, row by row from v = 0 up, copied; x along u, which is the frame's x, and y along v; z > 0
     * and slopes up to 8. NULL: flat facets that follow distribution, alpha_x and alpha_y. */
    const float *normals;
    uint32_t components; /* of a normal: 2 (x and y of a unit vector) or 3 (x, y, z, any length) */
    uint32_t size;       /* texels along a side: 8, 16, 32, 64, 128 or 256 */
    float side_m;        /* of a map before it is scaled, 1e-7 to 1e3 m; 0: one texel for each of facets_per_m2 */
    glint_example_placement placement;
    uint32_t flat;                /* 1: texels are flat facets; 0: normals vary between texels, as in a bump map */
    float scale[2], shear[2];     /* [.25, 4] and [-1, 1] */
    float rotation_rad;           /* [-pi, pi], counter-clockwise */
    float scale_variation;        /* [0, .5], relative; this and the next two for scattered maps only */
    float shear_variation;        /* [0, .5], either way */
    float rotation_variation_rad; /* [0, pi], either way */
    uint32_t mirror;              /* 1: every map is mirrored at random along u, along v, both or not */
    float jitter;                 /* [0, 1], how far a scattered map may lie from the middle of its square */
    float sigma_h; /* [.3, 1], texels: standard deviation of the Gaussian that stands for one texel's position */
    float sigma_r; /* [1e-3, .5], slope: roughness of the surface within a texel; at least 1/160 of the range of slopes.
                      0: a sixth of the root mean square slope */
} glint_example;

typedef struct glint_allocator {
    void *(*allocate)(size_t byte_count, void *user); /* aligned to 64 bytes; NULL when there is none */
    void (*release)(void *memory, void *user);
    void *user;
} glint_allocator;

typedef enum glint_layer { GLINT_LAYER_BASE = 0, GLINT_LAYER_COAT } glint_layer;

/* What GLINT_MODEL_LAYERED is made of. Each layer is a material of its own, with its own normal, density, seed and
 * colours; where both count facets, give them different seeds, or they have the same facets in the same places.
 * Nothing is read from the other options of a layered material but its model and its allocator. */
typedef struct glint_layers {
    const struct glint_material_options *base, *coat; /* read by glint_material_create only; not layered themselves */
    float coat_weight;                                /* these three as in glint_coat */
    float coat_normal[3], coat_tangent[3];
} glint_layers;

enum { GLINT_MAX_COLORS = 8 };

typedef struct glint_material_options {
    size_t size; /* set by GLINT_MATERIAL_OPTIONS_INIT */
    glint_model model;
    glint_distribution distribution;
    glint_fresnel fresnel;
    glint_weighting weighting;
    glint_surface surface;     /* where a call brings no surface of its own */
    float ior;                 /* (1, 10], for GLINT_FRESNEL_DIELECTRIC */
    float eta[3], k[3];        /* complex refractive index per channel, (0, 20], [0, 20], for GLINT_FRESNEL_CONDUCTOR */
    float facet_alpha;         /* [0, 1], roughness of one facet: how far its own reflection spreads */
    float coverage;            /* [0, 1], share of the surface that carries facets; elsewhere their lobe is absent */
    float elongation;          /* [1, 1e4], length over width of a facet, along the tangent */
    uint32_t seed;             /* which facets there are */
    glint_allocator allocator; /* all NULL: malloc and free */
    glint_facet_hash facet_hash; /* explicit model */
    uint32_t facet_limit;        /* explicit model: cells that one footprint may touch, at most 1e8; beyond it
                                           glint_value.over_limit is set: a client that wants the truth must look */
    float density_variation;     /* [0, 8], standard deviation over cells of log4 of the density; dictionary only */
    float max_anisotropy;        /* [1, 16], a footprint longer than so many widths is widened; dictionary only */
    float color_variation;       /* [0, 1], how far the hue of a facet strays from the base colour */
    uint32_t color_count;        /* [0, GLINT_MAX_COLORS], how many of the colors there are */
    float colors[GLINT_MAX_COLORS][3]; /* [0, 1], what facets are tinted with, relative to their mean: each facet takes
                                          one, and the surface keeps its base colour */
    glint_example example;             /* for GLINT_MODEL_EXAMPLE */
    glint_layers layers;               /* for GLINT_MODEL_LAYERED */
    glint_area_light_method area_light_method;
    /* What need not be counted. Relative standard deviations of one evaluation, [0, 1e6]; 0: count all.
     *
     * smooth_deviation  Counting, explicit, dictionary. Where the facets under the footprint vary by less than about
     *                   this, 1 / sqrt(N p), the smooth value stands for them. From there up to twice as much they are
     *                   blended in, and what is left out never varies by more than this. The mean stays. Sampling keeps
     *                   all facets.
     * draw_deviation    Counting. Where one of the model's 36 realisations varies by less than this, 3 / sqrt(N p), one
     *                   stands for all; glint_footprint.draw chooses, and the mean over draws is the sum of all. Not of
     *                   facets of different colours. */
    float smooth_deviation, draw_deviation;
} glint_material_options;

/* GGX, alpha .25, a white mirror on every facet, 1e8 facets per m^2, counting. */
#define GLINT_SURFACE_INIT                                                                                             \
    {                                                                                                                  \
        0.25F, 0.25F, { 0.0F, 0.0F, 0.0F }, { 1.0F, 1.0F, 1.0F }, { 1.0F, 1.0F, 1.0F }, 1e8F, 1.0F, 0                  \
    }
/* 16 x 16 flat facets that follow the roughness, tiled, mirrored at random. */
#define GLINT_EXAMPLE_INIT                                                                                             \
    {                                                                                                                  \
        0, 3U, 16U, 0.0F, GLINT_EXAMPLE_TILED, 0U, { 1.0F, 1.0F }, { 0.0F, 0.0F }, 0.0F, 0.0F, 0.0F, 0.0F, 1U, 0.5F,   \
            0.42466090F, 0.0F                                                                                          \
    }
/* The whole surface, with the normal and the tangent of the base. */
#define GLINT_COAT_INIT                                                                                                \
    {                                                                                                                  \
        GLINT_SURFACE_INIT, 1.0F, { 0.0F, 0.0F, 1.0F }, { 1.0F, 0.0F, 0.0F }, 0                                        \
    }
#define GLINT_LAYERS_INIT                                                                                              \
    {                                                                                                                  \
        0, 0, 1.0F, { 0.0F, 0.0F, 1.0F },                                                                              \
        {                                                                                                              \
            1.0F, 0.0F, 0.0F                                                                                           \
        }                                                                                                              \
    }
#define GLINT_MATERIAL_OPTIONS_INIT                                                                                    \
    {                                                                                                                  \
        sizeof(glint_material_options), GLINT_MODEL_COUNTING, GLINT_DISTRIBUTION_GGX, GLINT_FRESNEL_SCHLICK,           \
            GLINT_WEIGHTING_EQUAL_AREA, GLINT_SURFACE_INIT, 1.5F, { 0.2F, 0.92F, 1.1F }, { 3.9F, 2.45F, 2.14F }, 0.0F, \
            1.0F, 1.0F, 0U, { 0, 0, 0 }, GLINT_FACET_HASH_CYCLES, 1000000U, 0.0F, 4.0F, 0.0F, 0U,                      \
            { { 0.0F, 0.0F, 0.0F } }, GLINT_EXAMPLE_INIT, GLINT_LAYERS_INIT, GLINT_AREA_LIGHT_FAST, 0.0F, 0.0F         \
    }

typedef struct glint_material glint_material;

/* Checks the options, bakes and freezes. On failure *material is NULL and, where message is not NULL, it holds at most
 * message_size bytes (terminator included) that name the option, its value and its range. */
GLINT_API glint_result glint_material_create(const glint_material_options *options, glint_material **material,
                                             char *message, size_t message_size);
/* NULL is allowed. */
GLINT_API void glint_material_destroy(glint_material *material);
GLINT_API glint_model glint_material_model(const glint_material *material);
/* A bit set of glint_feature. Of a layered material: GLINT_FEATURE_DISCRETE and GLINT_FEATURE_COLOR where either layer
 * has them, GLINT_FEATURE_SAMPLE_FOOTPRINT where no layer shows facets that its sampling does not know, the others
 * where both have them. */
GLINT_API uint32_t glint_material_features(const glint_material *material);
/* A layer of a layered material, which it belongs to; NULL of other materials. */
GLINT_API const glint_material *glint_material_layer(const glint_material *material, glint_layer layer);
/* The surface that a call without one uses; start from it to change a part. Its coat belongs to the material. */
GLINT_API glint_surface glint_material_surface(const glint_material *material);

/* ---- built-in examples ---- */

typedef enum glint_example_kind {
    GLINT_EXAMPLE_SCRATCHES = 0,    /* straight grooves in every direction on a flat ground */
    GLINT_EXAMPLE_BRUSHED,          /* long grooves along u */
    GLINT_EXAMPLE_LEATHER,          /* cushions between creases */
    GLINT_EXAMPLE_STRUCTURE,        /* a regular weave of bumps */
    GLINT_EXAMPLE_ISOTROPIC_NOISE,  /* bumps of every direction */
    GLINT_EXAMPLE_ANISOTROPIC_NOISE /* bumps that are longer along u */
} glint_example_kind;

typedef struct glint_example_shape {
    float slope;          /* (0, 2], root mean square over the map */
    float feature_texels; /* [1, 64], width of a groove, side of a cushion or of a bump */
    float aspect;         /* [1, 64], length over width: of anisotropic noise and of brushed grooves */
    uint32_t count;       /* [1, 64], grooves of GLINT_EXAMPLE_SCRATCHES */
} glint_example_shape;

#define GLINT_EXAMPLE_SHAPE_INIT                                                                                       \
    {                                                                                                                  \
        0.2F, 4.0F, 8.0F, 6U                                                                                           \
    }

/* Fills normals with size * size unit vectors (x, y, z) of a map that tiles without a seam. size as in glint_example.
 * GLINT_ERROR_RANGE when a number is outside its range; nothing is written then. */
GLINT_API glint_result glint_example_generate(glint_example_kind kind, uint32_t size, const glint_example_shape *shape,
                                              uint32_t seed, float *normals);

/* ---- evaluation ---- */

/* What a pixel sees of the surface: where it is and how far a step of one pixel moves on it. */
typedef struct glint_footprint {
    double u, v;      /* metres on the surface */
    float dudx, dudy; /* metres per pixel, to the right (x) and downwards (y) */
    float dvdx, dvdy;
    uint32_t seed; /* which object this is: added to the material's seed; 0 is fine */
    uint32_t draw; /* for draw_deviation: even over all 32-bit numbers, another one for every sample of a pixel */
} glint_footprint;

typedef enum glint_light_kind {
    GLINT_LIGHT_CAP = 0 /* a round light around wi, small enough that D hardly changes across it */
} glint_light_kind;

typedef struct glint_light {
    glint_light_kind kind;
    float solid_angle_sr; /* > 0, at most 2 pi */
} glint_light;

typedef enum glint_area_kind {
    GLINT_AREA_SUN = 0,   /* round, at infinity, of any solid angle */
    GLINT_AREA_SPHERE,    /* shines outwards; from within there is nothing to see */
    GLINT_AREA_RECTANGLE, /* center + x half_x + y half_y, |x| and |y| up to 1: a parallelogram */
    GLINT_AREA_DISK,      /* center + x half_x + y half_y, x^2 + y^2 up to 1: an ellipse */
    GLINT_AREA_POLYGON    /* flat and convex */
} glint_area_kind;

enum { GLINT_MAX_CORNERS = 8 };

/* A light of real size, the same radiance from every point of it in every direction. It lies in the local frame of the
 * shaded point, which is the origin: z the normal, x the tangent. Metres. Only what its kind names is read. */
typedef struct glint_area_light {
    glint_area_kind kind;
    uint32_t two_sided; /* rectangle, disk, polygon. 0: it shines to the side of half_x x half_y, or to that from which
                           the corners run counter-clockwise. 1: to both */
    float hidden;       /* [0, 1], share of the light that something stands in front of: so much less light, and so
                           many fewer facets that are lit */
    float solid_angle_sr;                /* sun, (0, 2 pi] */
    float radius;                        /* sphere */
    float center[3];                     /* sun: direction to its middle, of any length */
    float half_x[3], half_y[3];          /* rectangle, disk */
    uint32_t corner_count;               /* polygon, 3 to GLINT_MAX_CORNERS */
    float corners[GLINT_MAX_CORNERS][3]; /* polygon */
} glint_area_light;

/* All that evaluation knows about one point and one light. */
typedef struct glint_value {
    float rgb[3];          /* f(wo, wi) * |cos theta_i|, discrete; of an area light: see glint_eval_area */
    float smooth[3];       /* the same without discreteness: the expectation of rgb over seeds */
    float facet_count;     /* N, facets under the footprint; of both layers together */
    float lit_probability; /* p, that one facet reflects the light to the viewer; of a facet of either layer */
    int over_limit;        /* 1: the footprint touches more cells than facet_limit, and rgb is the smooth value */
} glint_value;

/* Radiance factor f(wo, wi) * |cos theta_i|, averaged over the footprint: a light of radiance L and solid angle w adds
 * L * w * rgb to the pixel.
 *
 * surface    NULL: the material's own
 * footprint  NULL or degenerate: the smooth limit
 * light      NULL or with a solid angle that is not positive: the smooth limit
 *
 * Returns linear RGB, zero where wo or wi is below the horizon; of a layered material, below that of both layers.
 * counting: L_smooth * b(N, p) / (N p), b a binomial count (Kneiphof and Klein 2024, Eq. 21).
 * dictionary: F D G2 / (4 cos_o), D the distribution of the patch (Chermain et al. 2020, Eq. 14).
 * layered: base (1 - w (1 - T)) + w coat, w the coat's weight and T(wo, wi) what it lets through (Xing et al. 2024,
 * Eq. 10); |cos theta_i| is each layer's own.
 */
GLINT_API void glint_eval(const glint_material *material, const glint_surface *surface,
                          const glint_footprint *footprint, const float wo[3], const float wi[3],
                          const glint_light *light, float rgb[3]);

/* The same with everything that it knows. */
GLINT_API void glint_eval_value(const glint_material *material, const glint_surface *surface,
                                const glint_footprint *footprint, const float wo[3], const float wi[3],
                                const glint_light *light, glint_value *value);

/* The integral of f(wo, wi) * cos theta_i over the directions in which the light is seen above the horizon, averaged
 * over the footprint: a light of radiance L adds L * rgb to the pixel. There is no wi and no solid angle to multiply
 * with, and what is below the horizon or turned away adds nothing.
 *
 * surface    NULL: the material's own
 * footprint  NULL or degenerate: the smooth limit
 * light      NULL, not finite, edge-on, behind the surface, of no area: zero
 *
 * counting: smooth * b(N, p) / (N p), p the integral of D over the half vectors that lie in the light (Kneiphof and
 *           Klein 2024, Eqs. 12 to 16).
 * explicit: every facet against the true shape; a rough facet by the part of its lobe that the shape takes in.
 * dictionary, example: points of the light and directions of the material, weighted by multiple importance.
 * docs/lights.md has the equations and the errors.
 */
GLINT_API void glint_eval_area(const glint_material *material, const glint_surface *surface,
                               const glint_footprint *footprint, const float wo[3], const glint_area_light *light,
                               glint_value *value);

/* What the coat of a layered material leaves of the base: 1 - w (1 - T(wo, wi)), linear RGB in [0, 1]. For clients that
 * evaluate the layers one by one, and for light that comes from below them.
 *
 * coat    NULL: the material's own
 * wo, wi  in the frame of coat->normal, whatever it is
 * wi      NULL: light from below, such as emission, which passes once: 1 - w (1 - t(wo))
 *
 * 1 for other materials; 0 where wo or wi is no direction.
 */
GLINT_API void glint_transmittance(const glint_material *material, const glint_coat *coat, const float wo[3],
                                   const float *wi, float rgb[3]);

typedef struct glint_sample {
    float wi[3];
    float pdf;       /* per steradian */
    float weight[3]; /* f(wo, wi) * |cos theta_i| / pdf, f as described at glint_sample_direction */
} glint_sample;

/* Draws wi from a density close to the reflection (visible normals of the facets, cosine for the diffuse part).
 *
 * footprint  A model with GLINT_FEATURE_SAMPLE_FOOTPRINT draws from the facets under it, and f in the weight is what
 *            glint_eval gives for that footprint. For other models, and where it is NULL or degenerate, density and f
 *            are the smooth ones: the mean over seeds.
 * random     three uniforms in [0, 1): the lobe and the direction
 *
 * Returns 1, or 0 when there is no light that way (then *sample is all zero). Heitz 2018; Dupuy and Benyoub 2023; Heitz
 * and d'Eon 2014.
 */
GLINT_API int glint_sample_direction(const glint_material *material, const glint_surface *surface,
                                     const glint_footprint *footprint, const float wo[3], const float random[3],
                                     glint_sample *sample);

/* Density with which glint_sample_direction draws wi, per steradian. */
GLINT_API float glint_pdf(const glint_material *material, const glint_surface *surface,
                          const glint_footprint *footprint, const float wo[3], const float wi[3]);

/* Many points under one light each, as a structure of arrays of count entries. */
typedef struct glint_batch {
    size_t size; /* set by GLINT_BATCH_INIT */
    size_t count;
    const double *u, *v;
    const float *dudx, *dudy, *dvdx, *dvdy;
    const uint32_t *seed;       /* NULL: 0 everywhere */
    const float *wo[3], *wi[3]; /* x, y and z apart */
    const float *solid_angle_sr;
    const glint_surface *surfaces;       /* NULL: the material's own everywhere */
    float *rgb[3];                       /* out; may be NULL where values is not */
    const glint_area_light *area_lights; /* NULL: caps. Else wi and solid_angle_sr are not read, and may be NULL */
    const uint32_t *draw;                /* NULL: 0 everywhere */
    glint_value *values;                 /* out: all that glint_eval_value knows. NULL: not asked for */
} glint_batch;

#define GLINT_BATCH_INIT                                                                                               \
    {                                                                                                                  \
        sizeof(glint_batch), 0, 0, 0, 0, 0, 0, 0, 0, { 0, 0, 0 }, { 0, 0, 0 }, 0, 0, { 0, 0, 0 }, 0, 0, 0              \
    }

/* glint_eval, or glint_eval_area, for every entry, bit for bit, and faster. GLINT_ERROR_ARGUMENT when an array is
 * missing. */
GLINT_API glint_result glint_eval_batch(const glint_material *material, const glint_batch *batch);

/* ---- the plan: what a picture may leave out ----
 *
 * Before a render a client looks at a few hundred pixels, says what it saw in a summary, and gets a plan: for each
 * material and light what has to be done so that the picture stays within an error, with a reason, a cost and an error
 * for each decision. docs/plan.md has the variances behind it. All errors are relative to the light of a pixel and root
 * mean squares over the pixels. */

enum { GLINT_PLAN_BINS = 48 };

/* In which bin a pixel with so many lit facets, N p, belongs: powers of two from 2^-16 on; the last holds all above. */
GLINT_API uint32_t glint_plan_bin(float lit_facets);

typedef struct glint_plan_range {
    float least, most;
} glint_plan_range;

/* A material over the picture, textures multiplied in. */
typedef struct glint_plan_material {
    const char *name;                   /* NULL: none */
    const glint_material_options *base; /* as the scene asks for it */
    const glint_material_options *coat; /* NULL: there is none */
    float seen;                         /* [0, 1], samples that see it first */
    uint32_t texture_count;             /* but for normal maps */
    uint32_t normal_map_count;
    uint32_t is_cut_out;            /* its alpha masks or blends */
    glint_plan_range alpha;         /* alpha_x and alpha_y; these three are read where it is seen */
    glint_plan_range facets_per_m2; /* 0: no facets are counted */
    glint_plan_range footprint_m2;  /* of a pixel on the surface */
} glint_plan_material;

typedef enum glint_plan_light_kind {
    GLINT_PLAN_LIGHT_CAP = 0,     /* evaluated around one direction */
    GLINT_PLAN_LIGHT_SHAPE,       /* evaluated as a shape: glint_area_light */
    GLINT_PLAN_LIGHT_SURROUNDINGS /* sampled: an environment, glowing surfaces */
} glint_plan_light_kind;

typedef struct glint_plan_light {
    const char *name; /* NULL: none */
    glint_plan_light_kind kind;
    uint32_t patch_count; /* surroundings: patches of even light; 0: not known */
    uint32_t shadow_rays, blocked_rays;
} glint_plan_light;

/* Evaluations of a light as a shape. */
typedef struct glint_plan_shape {
    float seen;   /* per sample */
    float part;   /* mean over all pixels of the square of this light's part of the pixel */
    float sparks; /* and of the variance of its lit facets, light^2 / (N p), over the mean square of the picture's
                     light, facets and all; 0 where no facets are counted */
    float cap;    /* and of the square of what caps in place of the shape are off, of the pixel */
    /* cap and sparks where no further entry becomes caps: then few are taken of those that are off by nearly as much as
     * this entry holds, and all of those that are off by half of that. */
    float last_cap, last_sparks;
} glint_plan_shape;

/* Sorted by what a cap in place of the shape would be off: entry k by no more than .01 2^k, the last by more than all.
 */
enum { GLINT_PLAN_SHAPES = 6 };

/* One light on one material, over the picture. */
typedef struct glint_plan_pair {
    uint32_t material, light;
    float seen;        /* evaluations per sample */
    float shadow_rays; /* per sample */
    uint32_t is_clear; /* proven, not seen: nothing can come between the material, wherever it is, and the light */
    glint_plan_shape shapes[GLINT_PLAN_SHAPES];
    float share[GLINT_PLAN_BINS]; /* of the pixels that show these lit facets: mean over all pixels of the square of
                                     this light's part of the pixel; 0 where no facets are counted */
    float rate[GLINT_PLAN_BINS];  /* and how many evaluations per sample there are */
} glint_plan_pair;

typedef struct glint_plan_summary {
    size_t size; /* set by GLINT_PLAN_SUMMARY_INIT */
    const glint_plan_material *materials;
    const glint_plan_light *lights;
    const glint_plan_pair *pairs;
    uint32_t material_count, light_count, pair_count;
    uint32_t samples_per_pixel; /* >= 1; the fewest, where the plan chooses */
    uint32_t most_samples;      /* the plan chooses a power of two up to this; 0: samples_per_pixel are taken */
    uint32_t tiles_per_pixel;   /* >= 1: a pixel's facets are counted in so many footprints side by side */
    uint32_t pixel_count;       /* that were looked at */
    uint32_t bounces;           /* of indirect light that are asked for */
    float bounce_rays;          /* per sample */
    float sky_rays;             /* per sample: without bounces, for what surrounds the scene */
    float bounced;              /* what they bring to a pixel, relative */
    float noise;                /* relative standard deviation of a pixel of noise_samples samples */
    uint32_t noise_samples;     /* >= 1 */
    float noise_fall;           /* noise^2 falls as samples^-noise_fall: [1, 3], 1 where samples are independent */
    float noise_spread;         /* standard error of noise^2, relative; kept clear of where the plan chooses */
    float contrast;     /* >= 1: mean square of the picture's light, facets and all, over the square of its mean */
    float error_budget; /* (0, 1]; 0: nothing may be left out */
    glint_allocator allocator; /* all NULL: malloc and free */
} glint_plan_summary;

#define GLINT_PLAN_SUMMARY_INIT                                                                                        \
    {                                                                                                                  \
        sizeof(glint_plan_summary), 0, 0, 0, 0, 0, 0, 16, 0, 16, 0, 0, 0.0F, 0.0F, 0.0F, 0.0F, 1, 1.0F, 0.0F, 1.0F,    \
            0.02F,                                                                                                     \
        {                                                                                                              \
            0, 0, 0                                                                                                    \
        }                                                                                                              \
    }

typedef enum glint_effect {
    GLINT_EFFECT_SURFACES = 0, /* rays of the camera, and what they hit */
    GLINT_EFFECT_FACETS,       /* single facets of a material under a light */
    GLINT_EFFECT_LOOKUPS,
    GLINT_EFFECT_COLORS,
    GLINT_EFFECT_LAYERS,
    GLINT_EFFECT_ANISOTROPY,
    GLINT_EFFECT_TEXTURES,
    GLINT_EFFECT_NORMAL_MAPS,
    GLINT_EFFECT_ALPHA,
    GLINT_EFFECT_LIGHT, /* how the smooth reflection of a light is found */
    GLINT_EFFECT_SHADOWS,
    GLINT_EFFECT_BOUNCES,
    GLINT_EFFECT_SAMPLES /* the noise that the samples of a pixel leave */
} glint_effect;

/* "facets"; NULL when there is no such effect. */
GLINT_API const char *glint_effect_name(glint_effect effect);

typedef struct glint_decision {
    glint_effect effect;
    int32_t material, light; /* indices of the summary; -1: of the whole picture */
    uint32_t is_on;
    char choice[24];     /* "counted", "LTC" */
    char reason[168];    /* with its number, without a full stop */
    float ns_per_sample; /* by src/plan/cost_table.c; 0 where it is off */
    float time_share;    /* [0, 1] of the whole picture */
    float error;         /* that it adds */
} glint_decision;

typedef struct glint_plan glint_plan;

/* On failure *plan is NULL, and the message names what was found and expected, as for glint_material_create. */
GLINT_API glint_result glint_plan_create(const glint_plan_summary *summary, glint_plan **plan, char *message,
                                         size_t message_size);
/* NULL is allowed. */
GLINT_API void glint_plan_destroy(glint_plan *plan);

GLINT_API uint32_t glint_plan_decision_count(const glint_plan *plan);
/* NULL behind the last. They belong to the plan. */
GLINT_API const glint_decision *glint_plan_decision(const glint_plan *plan, uint32_t index);

/* The whole of it. */
typedef struct glint_plan_outcome {
    float error;             /* of what is left out; facets that flip over the picture's root mean square, */
    float error_of_mean;     /* and over its mean, which of a few sparks on black is far less */
    float noise;             /* of the samples */
    float ns_per_sample;     /* of one core, by the table */
    uint32_t is_met;         /* error and noise together are within the budget */
    float cap_error;         /* where a cap for a shape is off by no more it may stand for it; 0: nowhere */
    uint32_t bounces;        /* to be traced */
    uint32_t samples;        /* per pixel, to be taken */
    uint32_t enough_samples; /* per pixel, for the noise to be within what the error leaves; 0: no number is */
} glint_plan_outcome;

GLINT_API glint_plan_outcome glint_plan_result(const glint_plan *plan);
/* Takes out of the options of a layer of a material what the plan leaves out: model, deviations, area_light_method. */
GLINT_API void glint_plan_cut(const glint_plan *plan, uint32_t material, glint_material_options *options);

#ifdef __cplusplus
}
#endif

#endif
