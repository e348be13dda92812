/* A folder of its own for each test, with a small scene in it. */
#ifndef TESTS_WORKPLACE_H
#define TESTS_WORKPLACE_H

#include <stdbool.h>
#include <stddef.h>

/* cmocka's set-up and tear-down: make an empty folder and go there; go back and remove it with all that is in it. The
 * state is the folder's path. */
int workplace_enter(void **state);
int workplace_leave(void **state);

void file_write(const char *path, const void *content, size_t size);
void file_write_text(const char *path, const char *text);
/* The whole file and a terminating zero; the test frees it. */
char *file_read(const char *path, size_t *size);
void assert_file_holds(const char *path, const char *text);
void assert_same_files(const char *a, const char *b);
/* How many entries the folder has, hidden ones too. */
int folder_count(const char *path);

/* A square metre in the plane y = 0 with the material "panel" under a directional light, seen from above by the cameras
 * "Main" and "Close", with the variants "day" and "night": BASE.gltf, and plane.bin beside it. */
void scene_write(const char *base);
/* workplace_enter, and the scene as plane.gltf there. */
int workplace_enter_plane(void **state);

#endif
