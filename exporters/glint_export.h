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

/* What every exporter tells its caller besides errors. */
typedef struct glint_export_listener {
    void (*warn)(const char *text, void *user); /* NULL: warnings are dropped */
    void *user;
} glint_export_listener;

/* ---- glTF ---- */

typedef struct glint_export_gltf_options {
    size_t size;       /* set by GLINT_EXPORT_GLTF_OPTIONS_INIT */
    const char *input; /* .gltf or .glb */
    /* NULL: nothing is written. The same kind of file as the input, which it may replace. */
    const char *output;
    glint_export_listener listener;
} glint_export_gltf_options;

#define GLINT_EXPORT_GLTF_OPTIONS_INIT                                                                                 \
    {                                                                                                                  \
        sizeof(glint_export_gltf_options), 0, 0,                                                                       \
        {                                                                                                              \
            0, 0                                                                                                       \
        }                                                                                                              \
    }

/* Checks a glTF 2.0 file and writes it, every byte as it was. */
GLINT_EXPORT_API glint_export_result glint_export_gltf(const glint_export_gltf_options *options, char *message,
                                                       size_t message_size);

#ifdef __cplusplus
}
#endif

#endif
