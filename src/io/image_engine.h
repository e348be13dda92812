/* What OpenImageIO does for us, as a table. It brings 260 libraries, a fifth of a second and 115 MiB along, so it is a
 * module of its own that is loaded when a picture is read or a texture opened; writing goes without. */
#ifndef IO_IMAGE_ENGINE_H
#define IO_IMAGE_ENGINE_H

#include "io/image.h"
#include "io/mipmap.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct engine_textures engine_textures;

/* The functions of image.h and mipmap.h with nearly these names. */
typedef struct image_engine {
    size_t size; /* of this table: a module of another version is not called */
    bool (*read)(const char *path, image *out, report *r);
    bool (*decode)(const scene_image *picture, mipmap *out, report *r);
    bool (*textures_open)(const scene *s, engine_textures **out, report *r);
    void (*textures_close)(engine_textures *t);
    /* Of a texture with an image. */
    void (*texture_lookup)(const engine_textures *t, const scene_texture *which, float s, float t_, float dsdx,
                           float dtdx, float dsdy, float dtdy, float rgba[4]);
} image_engine;

/* The only name that the module shows. */
#define IMAGE_ENGINE_SYMBOL "glint_image_engine"
__attribute__((visibility("default"))) const image_engine *glint_image_engine(void);

#ifdef __cplusplus
}
#endif

#endif
