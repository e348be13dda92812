/* Files and folders that the tests of pictures make. */
#ifndef TESTS_IMAGE_FILES_H
#define TESTS_IMAGE_FILES_H

#include "png_file.h"

bytes file_read(const char *path);
void file_write(const char *path, const void *data, size_t size);

/* A new empty folder; folder_remove takes its files with it. */
char *folder_make(void);
void folder_remove(char *folder);
int folder_count(const char *folder);
/* "folder/name" in one of a few static buffers. */
const char *folder_path(const char *folder, const char *name);

#endif
