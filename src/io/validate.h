/* Looks for what is wrong with the glint materials of a file, all of it and not the first alone. */
#ifndef IO_VALIDATE_H
#define IO_VALIDATE_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum validate_severity {
    VALIDATE_ERROR,   /* the file breaks a rule; readers may refuse it */
    VALIDATE_WARNING, /* allowed, but hardly what was meant */
    VALIDATE_INFO     /* worth knowing */
} validate_severity;

typedef struct validate_issue {
    const char *code; /* stable; docs/command.md lists them */
    validate_severity severity;
    const char *pointer; /* JSON pointer; a place such as "byte 12" where the file is no JSON; "" for the whole file */
    const char *found, *expected; /* expected may be empty */
} validate_issue;

typedef void (*validate_visitor)(const validate_issue *issue, void *user);

/* Visits every issue of a .gltf, a .glb or a preset (a name that ends in .json), in a fixed order. Returns whether none
 * of them is an error. */
bool validate_file(const char *path, validate_visitor visit, void *user);

#ifdef __cplusplus
}
#endif

#endif
