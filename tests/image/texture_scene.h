/* The textures of a scene that is nothing but one image, used as data and as colour. */
#ifndef TESTS_IMAGE_TEXTURE_SCENE_H
#define TESTS_IMAGE_TEXTURE_SCENE_H

#include "files.h"
#include "io/image.h"

/* The whole image once, repeated, as colour or as data. */
scene_texture texture_plain(bool srgb);

/* Opens an image whose bytes the scene holds, called images/0; NULL leaves the reason in r. */
textures *open_bytes(bytes encoded, report *r);
/* Opens an image in a file, called by its path. */
textures *open_file(const char *path, report *r);

/* A lookup without derivatives. */
void texture_at(const textures *t, const scene_texture *which, float s, float t_, float rgba[4]);

#endif
