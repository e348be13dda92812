/* glTF has v run down a picture and a normal's y up it; libglint has both along v. So rows stay and y turns round. */
#include "io/example_map.h"

#include <math.h>
#include <stdlib.h>

#include "io/image.h"
#include "io/mipmap.h"

/* What libglint takes; see glint_example. */
enum { LEAST_SIDE = 8, MOST_SIDE = 256 };
#define STEEPEST 8.0F

static bool check_size(const mipmap *texels, const char *name, report *r)
{
    const int width = texels->levels[0].width, height = texels->levels[0].height;
    if (texels->channel_count < 3)
        return report_error(r, "%s: is grey, expected a normal map with red, green and blue", name);
    /* Scaling would average normals and make the surface smoother: the one who made the map knows what to cut out. */
    if (width != height || width < LEAST_SIDE || width > MOST_SIDE || (width & (width - 1)) != 0)
        return report_error(r,
                            "%s: is %d x %d texels, expected a square of 8, 16, 32, 64, 128 or 256: the example is a "
                            "small piece of the surface, so cut one out of a larger normal map",
                            name, width, height);
    return true;
}

/* -1 to 1. */
static float decoded(uint16_t code)
{
    return (float)code * (2.0F / 65535.0F) - 1.0F;
}

static bool has_blue(const mipmap *texels)
{
    const size_t count = (size_t)texels->levels[0].width * (size_t)texels->levels[0].height;
    for (size_t i = 0; i < count; i++)
        if (texels->levels[0].texels[i * (size_t)texels->channel_count + 2] != 0)
            return true;
    return false;
}

/* Three numbers for each texel. A map without any blue leaves z to be worked out, as compressed textures do. */
static bool decode_normals(const mipmap *texels, float *normals, const char *name, report *r)
{
    const int side = texels->levels[0].width;
    const bool whole = has_blue(texels);
    for (int i = 0; i < side * side; i++) {
        const uint16_t *code = &texels->levels[0].texels[(size_t)i * (size_t)texels->channel_count];
        const float x = decoded(code[0]), y = -decoded(code[1]);
        const float z = whole ? decoded(code[2]) : sqrtf(fmaxf(1.0F - x * x - y * y, 0.0F));
        if (!(z > 0.0F && x * x + y * y <= STEEPEST * STEEPEST * z * z))
            return report_error(r,
                                "%s: texel (%d, %d) holds the normal (%.3g, %.3g, %.3g), expected one that leans by at "
                                "most 82 degrees: z above 0",
                                name, i % side, i / side, (double)x, (double)-y, (double)z);
        normals[3 * i] = x;
        normals[3 * i + 1] = y;
        normals[3 * i + 2] = z;
    }
    return true;
}

/* KHR_texture_transform takes u, v to R S (u, v), R = (c, s; -s, c); the map is spread by the inverse, M = S^-1 R^-1.
 * The mean scale only says how large the map is; the rest stretches it and its slopes (Xing et al. 2024, Eq. 9), as
 * rotation(angle) * A. */
static bool place(const scene_texture *t, glint_example *e, const char *name, report *r)
{
    if (!(t->scale[0] > 0.0F && t->scale[1] > 0.0F))
        return report_error(r, "%s: KHR_texture_transform scales it by %g, %g, expected numbers above 0", name,
                            (double)t->scale[0], (double)t->scale[1]);
    const float mean = sqrtf(t->scale[0]) * sqrtf(t->scale[1]);
    e->side_m /= mean;
    const float c = cosf(t->rotation), s = sinf(t->rotation);
    const float x = mean / t->scale[0], y = mean / t->scale[1];
    e->rotation_rad = atan2f(s, c);
    e->scale[0] = c * c * x + s * s * y;
    e->scale[1] = s * s * x + c * c * y;
    e->shear[0] = e->shear[1] = c * s * (y - x);
    return true;
}

static bool set_options(const scene_glint *g, glint_example *e, const char *name, report *r)
{
    const bool scattered = g->example_placement == SCENE_PLACEMENT_SCATTERED;
    e->components = 3;
    e->side_m = g->example_size;
    e->placement = scattered ? GLINT_EXAMPLE_SCATTERED : GLINT_EXAMPLE_TILED;
    e->flat = g->example_texture.nearest;
    e->mirror = scattered;
    e->rotation_variation_rad = g->example_rotation_variation;
    e->scale_variation = g->example_scale_variation;
    e->jitter = 1.0F;
    e->sigma_r = 1e-3F; /* the least: glintFacetRoughness comes on top */
    return place(&g->example_texture, e, name, r);
}

bool example_map_open(const scene *s, const scene_glint *g, glint_material_options *o, float **normals, report *r)
{
    *normals = NULL;
    if (g->structure != SCENE_STRUCTURE_EXAMPLE || g->example_texture.image == SCENE_NONE)
        return true;
    const scene_image *picture = &s->images[g->example_texture.image];
    mipmap texels = { 0 };
    bool done = mipmap_decode(picture, &texels, r) && check_size(&texels, picture->name, r);
    const size_t count = done ? (size_t)texels.levels[0].width * (size_t)texels.levels[0].width : 0;
    if (done && !(*normals = malloc(count * 3 * sizeof **normals)))
        done = report_error(r, "%s: does not fit into memory", picture->name);
    done = done && decode_normals(&texels, *normals, picture->name, r) && set_options(g, &o->example, picture->name, r);
    o->example.normals = *normals;
    o->example.size = done ? (uint32_t)texels.levels[0].width : 0;
    mipmap_free(&texels);
    if (!done) {
        free(*normals);
        o->example.normals = *normals = NULL;
    }
    return done;
}

static uint16_t encoded(float x)
{
    return (uint16_t)lrintf((x + 1.0F) * 32767.5F);
}

bool example_map_write_png(const char *path, const float *normals, int size, int bits, report *r)
{
    const size_t count = (size_t)size * (size_t)size;
    uint16_t *rgb = malloc(count * 3 * sizeof *rgb);
    if (!rgb)
        return report_error(r, "%s: %d x %d texels do not fit into memory", path, size, size);
    for (size_t i = 0; i < count; i++) {
        rgb[3 * i] = encoded(normals[3 * i]);
        rgb[3 * i + 1] = encoded(-normals[3 * i + 1]);
        rgb[3 * i + 2] = encoded(normals[3 * i + 2]);
    }
    const bool done = image_write_data_png(path, size, size, bits, rgb, r);
    free(rgb);
    return done;
}
