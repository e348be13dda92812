/* libglint_preview: pictures with glints of a scene that another program holds in memory.
 *
 * Conventions, for every function below:
 *  - Structs have their own size as their first member, set by an _INIT macro, so that they can grow. What a macro
 * leaves at 0 is absent. Arrays stay the caller's: they are copied, and may go when the function returns.
 *  - y is up. Matrices are column-major; a camera looks along its -z, a light shines along its -z. Lengths are metres,
 *    angles radians, colours linear RGB, light radiometric. Texture coordinates have (0, 0) in the upper left corner.
 *  - A function returns GLINT_PREVIEW_OK or says why not: message, where it is not NULL, then holds at most
 * message_size bytes (terminator included) that name the thing, the place in it, what was found and what was expected.
 *  - Nothing is kept but what a handle holds. A scene changes only by glint_preview_scene_change: any number of
 * pictures, each used by one thread at a time, may be rendered of it at once.
 *  - The bits of a picture do not depend on the number of threads, nor on the passes in which its samples came.
 */
#ifndef GLINT_PREVIEW_H
#define GLINT_PREVIEW_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define GLINT_PREVIEW_API __attribute__((visibility("default")))
#else
#define GLINT_PREVIEW_API
#endif

/* Rises when an older caller would misread this header. */
#define GLINT_PREVIEW_ABI 1

/* GLINT_PREVIEW_ABI of the library that is loaded. */
GLINT_PREVIEW_API uint32_t glint_preview_abi(void);
/* "0.1.0": the version of that library. */
GLINT_PREVIEW_API const char *glint_preview_version(void);
/* Size of a struct by its name ("glint_preview_mesh") as that library knows it; 0 for an unknown name. For callers in
 * other languages, which write the structs down again. */
GLINT_PREVIEW_API size_t glint_preview_size_of(const char *name);

typedef enum glint_preview_result {
    GLINT_PREVIEW_OK = 0,
    GLINT_PREVIEW_BAD_INPUT = 1,   /* what cannot be rendered; the message says why */
    GLINT_PREVIEW_CANCELLED = 2,   /* see glint_preview_picture_cancel */
    GLINT_PREVIEW_OTHER_MESHES = 3 /* see glint_preview_scene_change */
} glint_preview_result;

/* ---- scenes ---- */

/* A picture for textures, given in one of three ways. */
typedef struct glint_preview_image {
    size_t size;
    const char *name;     /* for messages; NULL: "images/N" */
    const char *path;     /* a PNG, JPEG or WebP file, UTF-8 */
    const uint8_t *bytes; /* of such a file */
    size_t byte_count;
    const float *pixels; /* RGBA, straight alpha, row 0 on top: what a file would hold, in [0, 1], sRGB where that is */
    int32_t width, height; /* of the pixels */
} glint_preview_image;

#define GLINT_PREVIEW_IMAGE_INIT                                                                                       \
    {                                                                                                                  \
        sizeof(glint_preview_image), 0, 0, 0, 0, 0, 0, 0                                                               \
    }

/* Triangles, counter-clockwise seen from their front. */
typedef struct glint_preview_mesh {
    size_t size;
    const char *name; /* for messages; NULL: "meshes/N" */
    uint32_t vertex_count, triangle_count;
    const float *positions;    /* 3 a vertex */
    const float *normals;      /* 3 a vertex, of any length; NULL: flat */
    const float *tangents;     /* 4 a vertex; NULL: MikkTSpace, where the material needs them */
    const float *texcoords[2]; /* 2 a vertex; NULL: none */
    const float *colors;       /* 4 a vertex, linear, multiplied with the base colour; NULL: none */
    const uint32_t *indices;   /* 3 a triangle */
    const int32_t *materials;  /* 1 a triangle; NULL: all have material 0 */
} glint_preview_mesh;

#define GLINT_PREVIEW_MESH_INIT                                                                                        \
    {                                                                                                                  \
        sizeof(glint_preview_mesh), 0, 0, 0, 0, 0, 0, { 0, 0 }, 0, 0, 0                                                \
    }

typedef enum glint_preview_light_kind {
    GLINT_PREVIEW_LIGHT_SUN = 0, /* intensity: irradiance, W/m^2 */
    GLINT_PREVIEW_LIGHT_POINT,   /* W/sr */
    GLINT_PREVIEW_LIGHT_SPOT,    /* W/sr */
    GLINT_PREVIEW_LIGHT_RECT,    /* radiance, W/(m^2 sr); in the plane of x and y, shines to one side */
    GLINT_PREVIEW_LIGHT_DISK     /* likewise; ellipses too */
} glint_preview_light_kind;

typedef struct glint_preview_light {
    size_t size;
    int32_t kind; /* a glint_preview_light_kind */
    float color[3], intensity;
    float range_m;                        /* point, spot: falls to 0 there; 0: unlimited */
    float inner_cone_rad, outer_cone_rad; /* spot: [0, pi / 2], inner below outer, from the axis */
    float angular_diameter_rad;           /* sun */
    float radius_m;                       /* point, spot */
    float width_m, height_m;              /* rectangle, disk; to_world scales them no more */
    float to_world[16];
} glint_preview_light;

#define GLINT_PREVIEW_LIGHT_INIT                                                                                       \
    {                                                                                                                  \
        sizeof(glint_preview_light), GLINT_PREVIEW_LIGHT_SUN, { 1, 1, 1 }, 1, 0, 0, 0.785398f, 0.00929f, 0.01f, 1, 1,  \
        {                                                                                                              \
            1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1                                                             \
        }                                                                                                              \
    }

/* What surrounds the scene. */
typedef struct glint_preview_world {
    size_t size;
    float color[3]; /* radiance from all around, where there is no map */
    /* Latitude-longitude, RGB, radiance, row 0 around the zenith, twice as wide as high; NULL: none. The middle is +x,
     * and to its right lies +z. */
    const float *map;
    int32_t map_width, map_height;
    float map_rotation[4]; /* a unit quaternion x y z w that turns the map */
    float map_scale;       /* radiance of a texel of 1 */
} glint_preview_world;

#define GLINT_PREVIEW_WORLD_INIT                                                                                       \
    {                                                                                                                  \
        sizeof(glint_preview_world), { 0, 0, 0 }, 0, 0, 0, { 0, 0, 0, 1 }, 1                                           \
    }

typedef struct glint_preview_scene_options {
    size_t size;
    const glint_preview_image *images;
    size_t image_count;
    /* A glTF 2.0 document, UTF-8, of which "materials", "textures" and "samplers" count, with the extensions that
     * `glint render` knows (GLINT_materials_glint among them). The source of a texture is an index into images. */
    const char *materials;
    const glint_preview_mesh *meshes;
    size_t mesh_count;
    size_t instance_count;
    const float *instance_to_world; /* 16 an instance */
    const int32_t *instance_mesh;   /* 1 an instance: an index into meshes */
    const int32_t *instance_object; /* 1 an instance: which facets it has, those of one number the same; NULL: 0 */
    const glint_preview_light *lights;
    size_t light_count;
    glint_preview_world world;
    int32_t model; /* a glint_model of glint.h for every material; -1: for each the one that shows what it asks for */
    int32_t exact_lights; /* of pictures of accuracy 0: 1: they integrate over lights with a shape; 0: they take a fit,
                             which is off by a hundredth and three times as fast */
} glint_preview_scene_options;

#define GLINT_PREVIEW_SCENE_OPTIONS_INIT                                                                               \
    {                                                                                                                  \
        sizeof(glint_preview_scene_options), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, GLINT_PREVIEW_WORLD_INIT, -1, 0          \
    }

typedef struct glint_preview_scene glint_preview_scene;

/* Copies, checks and makes ready for rays. On failure *out is NULL. */
GLINT_PREVIEW_API glint_preview_result glint_preview_scene_create(const glint_preview_scene_options *options,
                                                                  glint_preview_scene **out, char *message,
                                                                  size_t message_size);

/* What of a scene can change without its meshes and its tree being made anew; added up. */
typedef enum glint_preview_part {
    GLINT_PREVIEW_MATERIALS = 1, /* materials, as many as there are, model and exact_lights */
    GLINT_PREVIEW_IMAGES = 2,    /* images; only with the materials */
    GLINT_PREVIEW_LIGHTS = 4,
    GLINT_PREVIEW_WORLD = 8
} glint_preview_part;

/* Puts what the options say of some parts in the place of what the scene has, and looks at nothing else of them. The
 * scene then is, bit for bit, the one that all of its options together would make. Its pictures must be gone.
 *
 * GLINT_PREVIEW_OTHER_MESHES: these materials ask something else of the meshes (their number, tangents, what rays pass:
 * sides and alpha), so that it takes a new scene. After any failure the scene is what it was. */
GLINT_PREVIEW_API glint_preview_result glint_preview_scene_change(glint_preview_scene *s, int32_t parts,
                                                                  const glint_preview_scene_options *options,
                                                                  char *message, size_t message_size);
/* What is left out or mended, a line each, "" for nothing; the scene's own. After a change: what concerns meshes, and
 * what the change found. */
GLINT_PREVIEW_API const char *glint_preview_scene_warnings(const glint_preview_scene *s);
/* Its pictures must be gone. NULL is allowed. */
GLINT_PREVIEW_API void glint_preview_scene_destroy(glint_preview_scene *s);

/* ---- pictures ---- */

typedef enum glint_preview_projection {
    GLINT_PREVIEW_PERSPECTIVE = 0,
    GLINT_PREVIEW_ORTHOGRAPHIC
} glint_preview_projection;

typedef struct glint_preview_camera {
    size_t size;
    int32_t projection; /* a glint_preview_projection */
    /* The part of the plane that fills the picture, seen from the camera: at 1 m in front of a perspective one, in
     * metres of an orthographic one. A lens shift moves it. */
    float left, right, bottom, top;
    float near_m, far_m; /* along the viewing direction; far_m 0: unlimited */
    float to_world[16];
} glint_preview_camera;

#define GLINT_PREVIEW_CAMERA_INIT                                                                                      \
    {                                                                                                                  \
        sizeof(glint_preview_camera), GLINT_PREVIEW_PERSPECTIVE, -0.5f, 0.5f, -0.5f, 0.5f, 0.01f, 0,                   \
        {                                                                                                              \
            1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1                                                             \
        }                                                                                                              \
    }

typedef struct glint_preview_picture_options {
    size_t size;
    const glint_preview_camera *camera;
    int32_t width, height; /* of the whole picture, pixels, [1, 65536] */
    /* The part that is rendered, from the upper left corner; part_width 0: all. */
    int32_t part_left, part_top, part_width, part_height;
    int32_t samples;     /* a pixel, in the end, [1, 65536]; powers of 4 are spread best. 0: as many as the accuracy,
                            above 0, takes: see glint_preview_picture_samples */
    int32_t bounces;     /* of indirect light, [0, 64] */
    int32_t threads;     /* 0: one a core */
    uint32_t seed;       /* of the sampling noise */
    int32_t passes;      /* 1: all passes; 0: only GLINT_PREVIEW_COMBINED, which takes a third of the memory */
    int32_t transparent; /* 1: the camera does not see the world, alpha is 0 there */
    float accuracy;      /* [0, 1]: the error that a picture may have for speed; docs/plan.md. 0: leaves nothing out */
} glint_preview_picture_options;

#define GLINT_PREVIEW_PICTURE_OPTIONS_INIT                                                                             \
    {                                                                                                                  \
        sizeof(glint_preview_picture_options), 0, 640, 360, 0, 0, 0, 0, 16, 1, 0, 0, 1, 0, 0                           \
    }

/* What a picture with these options would do, what it would leave out, and what each costs: lines whose fields tabs set
 * apart. The first line: nanoseconds of one core a sample, error of what is left out, noise of the samples (both
 * relative), "met" or "missed" (the accuracy), samples that would meet it (0: no number would), samples that are
 * taken. Then a line a decision:
 * name of its material (empty: of the whole picture), effect, "on" or "off", choice, share of the time, error, reason.
 * docs/plan.md. A text_size that is too small is an error that says how large it must be. */
GLINT_PREVIEW_API glint_preview_result glint_preview_plan(const glint_preview_scene *s,
                                                          const glint_preview_picture_options *options, char *text,
                                                          size_t text_size, char *message, size_t message_size);

typedef struct glint_preview_picture glint_preview_picture;

/* Nothing is rendered yet. On failure *out is NULL. */
GLINT_PREVIEW_API glint_preview_result glint_preview_picture_create(const glint_preview_scene *s,
                                                                    const glint_preview_picture_options *options,
                                                                    glint_preview_picture **out, char *message,
                                                                    size_t message_size);

/* Of a pixel in the end: those of the options, or as many as the plan has chosen. 0 for NULL. */
GLINT_PREVIEW_API int32_t glint_preview_picture_samples(const glint_preview_picture *picture);

/* Adds samples to every pixel until it has as many as are asked for, and returns then. A picture is the same, bit for
 * bit, in whatever steps it came. After GLINT_PREVIEW_CANCELLED each pixel is the mean of the samples that it has, and
 * a further call goes on. GLINT_PREVIEW_BAD_INPUT: samples out of [1, glint_preview_picture_samples], or more facets
 * than the explicit model visits; the picture is good but dark there. */
GLINT_PREVIEW_API glint_preview_result glint_preview_picture_refine(glint_preview_picture *picture, int32_t samples,
                                                                    char *message, size_t message_size);

/* From any thread, at any time: 1 makes the refining under way and those to come return GLINT_PREVIEW_CANCELLED within
 * the time that a pixel takes; 0 lets them work again. */
GLINT_PREVIEW_API void glint_preview_picture_cancel(glint_preview_picture *picture, int32_t cancel);

/* From any thread: how much of the last refining is done, [0, 1]; renewed ten times a second. */
GLINT_PREVIEW_API double glint_preview_picture_progress(const glint_preview_picture *picture);

typedef enum glint_preview_pass {
    GLINT_PREVIEW_COMBINED = 0,      /* RGBA, RGB multiplied by A */
    GLINT_PREVIEW_SMOOTH,            /* RGB: the same picture without single facets */
    GLINT_PREVIEW_GLINT_COUNT,       /* 1: facets under the pixel */
    GLINT_PREVIEW_GLINT_PROBABILITY, /* 1: that one of them reflects the brightest light to the camera */
    GLINT_PREVIEW_NORMAL,            /* 3: world space, towards the camera */
    GLINT_PREVIEW_ALBEDO,            /* RGB: base colour */
    GLINT_PREVIEW_DEPTH              /* 1: metres along the viewing direction; 0: nothing was hit */
} glint_preview_pass;

/* Writes a pass, not while the picture is refined: interleaved floats, value_count of them, which must be the channels
 * of the pass times the pixels of the part. bottom_up: 1: row 0 is the lowest; 0: the uppermost. */
GLINT_PREVIEW_API glint_preview_result glint_preview_picture_read(const glint_preview_picture *picture, int32_t pass,
                                                                  int32_t bottom_up, float *values, size_t value_count,
                                                                  char *message, size_t message_size);

/* Not while it is refined. NULL is allowed. */
GLINT_PREVIEW_API void glint_preview_picture_destroy(glint_preview_picture *picture);

#ifdef __cplusplus
}
#endif

#endif
