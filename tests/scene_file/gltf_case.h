/* A folder for one test, glTF files written into it, and what the reader said about them. */
#ifndef SCENE_FILE_GLTF_CASE_H
#define SCENE_FILE_GLTF_CASE_H

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <setjmp.h>

#include <cmocka.h>

#include "io/scene_file.h"

typedef struct gltf_case {
    char folder[64];
    char path[512]; /* of the file written last */
    char warnings[16384];
    report said;
    scene scene;
} gltf_case;

/* cmocka set-up and tear-down: *state is a gltf_case in an empty folder. */
int gltf_case_begin(void **state);
int gltf_case_end(void **state);

/* Writes a file of the folder; name may have folders that exist. */
void gltf_case_write(gltf_case *c, const char *name, const void *bytes, size_t size);

/* Writes scene.gltf: a JSON object with "asset" whose other members are the formatted text. Single quotes become double
 * ones. */
void gltf_case_json(gltf_case *c, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The same with "buffers": one buffer, in data.bin. */
void gltf_case_json_with_buffer(gltf_case *c, const void *bytes, size_t size, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Writes scene.glb from JSON text and a BIN chunk, both padded as the text asks. */
void gltf_case_glb(gltf_case *c, const char *json, const void *bin, size_t bin_size);

/* Reads the file written last. */
bool gltf_case_read(gltf_case *c);
bool gltf_case_read_variant(gltf_case *c, const char *variant);

/* Reads it and fails the test unless the error names the file and holds every further text, up to a NULL. */
void gltf_case_refused(gltf_case *c, ...) __attribute__((sentinel));
/* Reads it and fails the test, with the error, when it is refused. */
void gltf_case_accepted(gltf_case *c);
/* Fails unless a warning holds the text. */
void gltf_case_warned(const gltf_case *c, const char *text);

#endif
