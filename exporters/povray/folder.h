/* All files of a folder, or none: they are written beside their names first and renamed when the last one is whole. */
#ifndef EXPORTERS_POVRAY_FOLDER_H
#define EXPORTERS_POVRAY_FOLDER_H

#include <stdbool.h>
#include <stddef.h>

#include "io/output_file.h"

typedef struct folder_file {
    char *path;
    output_file *file;
} folder_file;

typedef struct folder {
    const char *path;
    bool made; /* by us: it goes again when nothing comes into it */
    folder_file *files;
    int count;
} folder;

/* Makes the folder where there is none; its parent must be there. */
bool folder_open(folder *f, const char *path, report *r);
/* A new file, with all its bytes. */
bool folder_write(folder *f, const char *name, const void *bytes, size_t count, report *r);
/* Puts all files under their names. */
bool folder_commit(folder *f, report *r);
/* Removes what is not under its name yet, and frees. For a folder that was committed, too. */
void folder_close(folder *f);

#endif
