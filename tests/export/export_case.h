/* One export of glint materials into a glTF file in a test's folder, whether it was accepted, and the bytes that came
 * of it. */
#ifndef TESTS_EXPORT_CASE_H
#define TESTS_EXPORT_CASE_H

#include <stddef.h>

#include "gltf_case.h"

/* Debian's assimp-testmodels: files that others made. */
#define MODELS "/usr/share/assimp/models/glTF2/"

/* ---- files ---- */

typedef struct bytes {
    char *data; /* with a terminating zero */
    size_t size;
} bytes;

bytes read_bytes(const char *path); /* the caller frees data */
void assert_same_files(const char *a, const char *b);
/* The path of a file of the test's folder; good until eight more were asked for. */
char *in_folder(const gltf_case *c, const char *name);

/* ---- exports ---- */

typedef struct request {
    const char *material, *preset, *pointer, *value;
    int strip;
} request;

/* Fails the test unless the export is done. */
void exported(const char *input, const char *output, const request *q);
/* Fails the test unless it is refused as bad input, with a message that holds the reason. */
void refused(const char *input, const char *output, const request *q, const char *reason);
/* Reads what was written; the file's own warnings do not matter here. */
const scene *read_output(gltf_case *c, const char *path);

#endif
