/* Loads the module around OpenImageIO for the first picture that needs it, and never unloads it. */
#include "io/image_engine.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* Looked for where the program or the library that this file is in has its RUNPATH: beside libglint.so. */
#define MODULE "libglint_image.so"

struct textures {
    const image_engine *engine;
    engine_textures *opened;
};

static const image_engine *load(const char *name, report *r)
{
    void *module = dlopen(MODULE, RTLD_LAZY | RTLD_LOCAL);
    void *symbol = module ? dlsym(module, IMAGE_ENGINE_SYMBOL) : NULL;
    if (!symbol) {
        report_error(r, "%s: cannot be read: the module for pictures does not load: %s", name, dlerror());
        return NULL;
    }
    const image_engine *(*get)(void);
    memcpy(&get, &symbol, sizeof get); /* POSIX promises that a function fits; ISO C knows no such cast */
    const image_engine *const engine = get();
    if (engine->size == sizeof *engine)
        return engine;
    report_error(r, "%s: cannot be read: " MODULE " is of another version of libglint", name);
    return NULL;
}

/* NULL after an error that names the picture; the next call tries again. */
static const image_engine *engine_for(const char *name, report *r)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    static const image_engine *engine;
    pthread_mutex_lock(&lock);
    if (!engine)
        engine = load(name, r);
    const image_engine *const found = engine;
    pthread_mutex_unlock(&lock);
    return found;
}

bool image_read(const char *path, image *out, report *r)
{
    *out = (image){ 0 };
    const image_engine *const engine = engine_for(path, r);
    return engine && engine->read(path, out, r);
}

bool mipmap_decode(const scene_image *picture, mipmap *out, report *r)
{
    *out = (mipmap){ 0 };
    const image_engine *const engine = engine_for(picture->name, r);
    return engine && engine->decode(picture, out, r);
}

/* The first image that a material uses, or SCENE_NONE. */
static int first_image(const scene *s)
{
    for (int m = 0; m < s->material_count; m++) {
        const scene_texture *uses[SCENE_MATERIAL_TEXTURES];
        scene_material_textures(&s->materials[m], uses);
        for (int k = 0; k < SCENE_MATERIAL_TEXTURES; k++)
            if (uses[k]->image != SCENE_NONE)
                return uses[k]->image;
    }
    return SCENE_NONE;
}

bool textures_open(const scene *s, textures **out, report *r)
{
    *out = NULL;
    textures *t = calloc(1, sizeof *t);
    if (!t)
        return report_error(r, "textures: do not fit into memory");
    const int first = first_image(s);
    if (first != SCENE_NONE) {
        t->engine = engine_for(s->images[first].name, r);
        if (!t->engine || !t->engine->textures_open(s, &t->opened, r)) {
            free(t);
            return false;
        }
    }
    *out = t;
    return true;
}

void textures_close(textures *t)
{
    if (t && t->engine)
        t->engine->textures_close(t->opened);
    free(t);
}

void texture_lookup(const textures *t, const scene_texture *which, float s, float t_, float dsdx, float dtdx,
                    float dsdy, float dtdy, float rgba[4])
{
    if (which->image == SCENE_NONE)
        rgba[0] = rgba[1] = rgba[2] = rgba[3] = 1.0F;
    else
        t->engine->texture_lookup(t->opened, which, s, t_, dsdx, dtdx, dsdy, dtdy, rgba);
}
