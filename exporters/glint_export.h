/* libglint_export: scenes and materials written for other programs.
 *
 * Conventions, for every function below:
 *  - Options are structs whose first member is their size, set by an _INIT macro, so that they can grow.
 *  - Paths and texts are UTF-8. A preset is the name of one that is installed, or a path with a slash or that ends in
 *    .json.
 *  - A function returns GLINT_EXPORT_OK or says why not: message, where it is not NULL, then holds at most message_size
 *    bytes (terminator included) that name the file, the place in it or the option, what was found and what was
 *    expected.
 *  - Files are written beside their names and renamed into place: after a failure the old ones are there, whole.
 *  - Nothing is kept between calls; any number of threads may call at once.
 */
#ifndef GLINT_EXPORT_H
#define GLINT_EXPORT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define GLINT_EXPORT_API __attribute__((visibility("default")))
#else
#define GLINT_EXPORT_API
#endif

typedef enum glint_export_result {
    GLINT_EXPORT_OK = 0,
    GLINT_EXPORT_BAD_INPUT = 1,  /* a file that cannot be read, understood or written */
    GLINT_EXPORT_WRONG_USAGE = 2 /* options that cannot be */
} glint_export_result;

/* NAME=VALUE, as on the command line. */
typedef struct glint_export_assignment {
    const char *name, *value;
} glint_export_assignment;

/* What every exporter tells its caller besides errors. */
typedef struct glint_export_listener {
    void (*warn)(const char *text, void *user); /* NULL: warnings are dropped */
    void *user;
} glint_export_listener;

/* Frees a text that one of these functions handed out; NULL is allowed. */
GLINT_EXPORT_API void glint_export_free(char *text);

/* ---- glTF ---- */

typedef struct glint_export_gltf_options {
    size_t size;       /* set by GLINT_EXPORT_GLTF_OPTIONS_INIT */
    const char *input; /* .gltf or .glb */
    /* The same kind of file as the input, which it may replace. In another folder, the files that a .gltf points to are
     * copied there too. NULL: everything is checked and nothing written. */
    const char *output;
    /* A material (its name, "materials/N" where it has none, "default" for that of primitives without one, "*" for all)
     * = a preset. The last that fits counts. */
    const glint_export_assignment *materials;
    size_t material_count;
    /* A JSON pointer = a JSON value, or a string without its quotes. "/glintDensity" means that property of every
     * material above or, without any above, of every material with the extension; "/materials/3/extensions/
     * GLINT_materials_glint/glintDensity" means one. */
    const glint_export_assignment *values;
    size_t value_count;
    int strip; /* 1: first takes back all that earlier exports changed; without a record of them, the extension */
    /* 1: writes OUT.fallback.glb or .gltf too: glints as a normal map, for viewers that do not know the extension */
    int bake_fallback;
    glint_export_listener listener;
    char **summary; /* not NULL: gets a JSON document of what was done; see docs/command.md */
} glint_export_gltf_options;

#define GLINT_EXPORT_GLTF_OPTIONS_INIT                                                                                 \
    {                                                                                                                  \
        sizeof(glint_export_gltf_options), 0, 0, 0, 0, 0, 0, 0, 0, { 0, 0 }, 0                                         \
    }

/* Puts presets on materials of a glTF 2.0 file and leaves every other byte of its JSON and its buffers as it is. */
GLINT_EXPORT_API glint_export_result glint_export_gltf(const glint_export_gltf_options *options, char *message,
                                                       size_t message_size);

typedef struct glint_export_gltf_scene_options {
    size_t size;         /* set by GLINT_EXPORT_GLTF_SCENE_OPTIONS_INIT */
    const char *input;   /* .gltf or .glb */
    const char *output;  /* .gltf, with all bytes in data URIs, or .glb; NULL: nothing is written */
    const char *variant; /* of KHR_materials_variants; NULL: the file's own materials */
    const glint_export_assignment *materials; /* a material's name, or "*" for all = a preset; in order */
    size_t material_count;
    glint_export_listener listener;
    char **summary; /* not NULL: gets a JSON document of what was done; see docs/command.md */
} glint_export_gltf_scene_options;

#define GLINT_EXPORT_GLTF_SCENE_OPTIONS_INIT                                                                           \
    {                                                                                                                  \
        sizeof(glint_export_gltf_scene_options), 0, 0, 0, 0, 0, { 0, 0 }, 0                                            \
    }

/* Writes a new glTF 2.0 file of what a renderer sees of another one: triangles, materials, cameras, lights and the
 * environment, in one piece. Animations, skins, morph targets, compression and extensions that glint does not know are
 * gone; nodes keep their numbers, on which facets hang, and glint renders the same picture. */
GLINT_EXPORT_API glint_export_result glint_export_gltf_scene(const glint_export_gltf_scene_options *options,
                                                             char *message, size_t message_size);

/* ---- POV-Ray ---- */

/* How flakes are written. AUTO takes for each object the one that claims most: exact for flat objects, portable for
 * others. The forms are described in docs/povray.md. */
typedef enum glint_export_povray_form {
    GLINT_EXPORT_POVRAY_AUTO = 0,
    GLINT_EXPORT_POVRAY_PORTABLE, /* POV-Ray's own facets, on any shape */
    GLINT_EXPORT_POVRAY_EXACT,    /* the flakes of the explicit model, on flat objects */
    GLINT_EXPORT_POVRAY_ANALYTIC, /* the smooth model, on flat objects under one light */
    GLINT_EXPORT_POVRAY_MESH      /* one polygon a flake */
} glint_export_povray_form;

typedef struct glint_export_povray_options {
    size_t size;        /* set by GLINT_EXPORT_POVRAY_OPTIONS_INIT */
    const char *input;  /* .gltf or .glb */
    const char *output; /* a folder; made where there is none. Its files are written all or not at all. */
    glint_export_povray_form form;
    const char *camera; /* its name in the file, or its number from 0; NULL: the first, or one that frames the scene */
    int width, height;  /* of the picture, [1, 65536] */
    const glint_export_assignment *materials; /* a material's name, or "*" for all = a preset; in order */
    size_t material_count;
    glint_export_listener listener;
    /* Called with the listener's user for every file, by its name in the folder, and for every object with the form
     * that it got. NULL: not called. */
    void (*wrote)(const char *file, void *user);
    void (*object)(const char *name, const char *material, const char *form, void *user);
} glint_export_povray_options;

#define GLINT_EXPORT_POVRAY_OPTIONS_INIT                                                                               \
    {                                                                                                                  \
        sizeof(glint_export_povray_options), 0, 0, GLINT_EXPORT_POVRAY_AUTO, 0, 1280, 720, 0, 0, { 0, 0 }, 0, 0        \
    }

/* Writes glint.inc, NAME_materials.inc, NAME.pov, NAME.ini and textures, NAME after the input. */
GLINT_EXPORT_API glint_export_result glint_export_povray(const glint_export_povray_options *options, char *message,
                                                         size_t message_size);

#ifdef __cplusplus
}
#endif

#endif
