/* Pictures of a whole surrounding become one kind of map, and its texels light that there can be. */
#include "io/environment_map.h"

#include <math.h>
#include <stdlib.h>

#include "io/image.h"
#include "io/mipmap.h"
#include "io/srgb.h"

#define PI 3.14159265358979323846
#define LARGEST_WIDTH 8192
/* The largest half float: where infinities in pictures come from. */
#define LARGEST_HALF 65504.0F
/* What alpha of an RGBD texel is taken for at least: half an 8-bit step. */
#define LEAST_ALPHA (0.5 / 255.0)
/* Directions along a side of a texel that is made from a cube. */
#define CUBE_SAMPLES 3

void environment_map_direction(double u, double v, double direction[3])
{
    const double longitude = 2.0 * PI * (u - 0.5);
    const double sine = sin(PI * v);
    direction[0] = sine * cos(longitude);
    direction[1] = cos(PI * v);
    direction[2] = sine * sin(longitude);
}

void environment_map_place(const double direction[3], double *u, double *v)
{
    *u = 0.5 + atan2(direction[2], direction[0]) / (2.0 * PI);
    *v = atan2(hypot(direction[0], direction[2]), direction[1]) / PI;
}

void environment_map_free(environment_map *m)
{
    free(m->rgb);
    *m = (environment_map){ 0 };
}

static bool allocate(environment_map *out, int width, int height, const char *name, report *r)
{
    out->width = width;
    out->height = height;
    out->rgb = malloc((size_t)width * (size_t)height * 3 * sizeof *out->rgb);
    return out->rgb != NULL ||
           report_error(r, "%s: the map of %d x %d texels does not fit into memory", name, width, height);
}

/* ---- latitude-longitude files ---- */

static float mended(float value)
{
    if (!(value > 0.0F)) /* NaN too */
        return 0.0F;
    return isinf(value) ? LARGEST_HALF : value;
}

static void mend(environment_map *m, const char *path, report *r)
{
    const size_t count = (size_t)m->width * (size_t)m->height;
    size_t broken = 0, first = 0;
    for (size_t i = 0; i < count; i++) {
        float *const texel = &m->rgb[3 * i];
        bool whole = true;
        for (int c = 0; c < 3; c++) {
            const float good = mended(texel[c]);
            whole = whole && (good == texel[c]);
            texel[c] = good;
        }
        if (!whole && broken++ == 0)
            first = i;
    }
    if (broken > 0)
        report_warning(r,
                       "%s: %zu of its %zu texels hold light that cannot be, the first at (%zu, %zu): NaN and negative "
                       "light count as 0, infinite as %g",
                       path, broken, count, first % (size_t)m->width, first / (size_t)m->width, (double)LARGEST_HALF);
}

static bool copy_channels(const image *from, const char *path, environment_map *out, report *r)
{
    static const char *const names[3] = { "R", "G", "B" };
    int channels[3];
    for (int c = 0; c < 3; c++) {
        channels[c] = image_channel(from, names[c]);
        if (channels[c] < 0)
            return report_error(r, "%s: has no channel %s, expected R, G and B", path, names[c]);
    }
    if (from->width != 2 * from->height || from->width > LARGEST_WIDTH)
        return report_error(r,
                            "%s: has %d x %d pixels, expected a latitude-longitude map: twice as wide as high, and at "
                            "most %d wide",
                            path, from->width, from->height, LARGEST_WIDTH);
    if (!allocate(out, from->width, from->height, path, r))
        return false;
    const size_t count = (size_t)from->width * (size_t)from->height;
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++)
            out->rgb[3 * i + (size_t)c] = from->pixels[i * (size_t)from->channel_count + (size_t)channels[c]];
    mend(out, path, r);
    return true;
}

bool environment_map_read(const char *path, environment_map *out, report *r)
{
    *out = (environment_map){ 0 };
    image picture;
    if (!image_read(path, &picture, r))
        return false;
    const bool done = copy_channels(&picture, path, out, r);
    image_free(&picture);
    if (!done)
        environment_map_free(out);
    return done;
}

/* ---- cubes ---- */

typedef struct cube {
    int side;
    mipmap faces[6];
    float linear[65536]; /* of every code */
} cube;

/* The face that a direction meets, and where: (0, 0) is its upper left corner as seen from the middle. The extension
 * flips the faces of OpenGL's cube maps about their vertical axis, so that they look right from within in our
 * right-handed frame. */
static int cube_place(const double d[3], double *s, double *t)
{
    const double x = fabs(d[0]), y = fabs(d[1]), z = fabs(d[2]);
    double right, down, depth;
    int face;
    if (x >= y && x >= z) {
        face = d[0] > 0.0 ? 0 : 1;
        depth = x;
        right = d[0] > 0.0 ? d[2] : -d[2];
        down = -d[1];
    } else if (y >= z) {
        face = d[1] > 0.0 ? 2 : 3;
        depth = y;
        right = -d[0];
        down = d[1] > 0.0 ? d[2] : -d[2];
    } else {
        face = d[2] > 0.0 ? 4 : 5;
        depth = z;
        right = d[2] > 0.0 ? -d[0] : d[0];
        down = -d[1];
    }
    *s = 0.5 * (right / depth + 1.0);
    *t = 0.5 * (down / depth + 1.0);
    return face;
}

static int texel_at(double place, int side)
{
    const int i = (int)(place * side);
    return i < 0 ? 0 : i < side ? i : side - 1;
}

/* Adds the light of one direction. */
static void add_texel(const cube *from, const double direction[3], double sum[3])
{
    double s, t;
    const mipmap *const m = &from->faces[cube_place(direction, &s, &t)];
    const size_t column = (size_t)texel_at(s, from->side), row = (size_t)texel_at(t, from->side);
    const uint16_t *const texel = &m->levels[0].texels[(row * (size_t)from->side + column) * (size_t)m->channel_count];
    const double alpha = m->channel_count == 4 ? fmax(texel[3] / 65535.0, LEAST_ALPHA) : 1.0;
    for (int c = 0; c < 3; c++)
        sum[c] += (double)from->linear[texel[m->channel_count == 1 ? 0 : c]] / alpha;
}

static bool load_faces(const scene *s, cube *out, report *r)
{
    for (int i = 0; i < 6; i++) {
        const scene_image *const picture = &s->images[s->environment.faces[i]];
        if (!mipmap_decode(picture, &out->faces[i], r))
            return false;
        const mipmap_level *const level = &out->faces[i].levels[0];
        if (i == 0)
            out->side = level->width;
        if (level->width != out->side || level->height != out->side || 4 * out->side > LARGEST_WIDTH)
            return report_error(r, "%s: has %d x %d pixels, expected the face of a cube: %d x %d, and at most %d",
                                picture->name, level->width, level->height, out->side, out->side, LARGEST_WIDTH / 4);
    }
    return true;
}

/* Every texel is the mean over a grid of directions, so that none of the cube is left out. */
static void spread(const cube *from, environment_map *out)
{
    float *to = out->rgb;
    for (int y = 0; y < out->height; y++) {
        for (int x = 0; x < out->width; x++, to += 3) {
            double sum[3] = { 0.0, 0.0, 0.0 };
            for (int k = 0; k < CUBE_SAMPLES * CUBE_SAMPLES; k++) {
                const int right = k % CUBE_SAMPLES, down = k / CUBE_SAMPLES;
                double direction[3];
                environment_map_direction((x + (right + 0.5) / CUBE_SAMPLES) / out->width,
                                          (y + (down + 0.5) / CUBE_SAMPLES) / out->height, direction);
                add_texel(from, direction, sum);
            }
            for (int c = 0; c < 3; c++)
                to[c] = (float)(sum[c] / (CUBE_SAMPLES * CUBE_SAMPLES));
        }
    }
}

bool environment_map_from_cube(const scene *s, environment_map *out, report *r)
{
    *out = (environment_map){ 0 };
    cube *const faces = calloc(1, sizeof *faces);
    if (faces == NULL)
        return report_error(r, "the cube of lights does not fit into memory");
    for (int code = 0; code < 65536; code++)
        faces->linear[code] = (float)srgb_decode(code / 65535.0);
    const bool done =
        load_faces(s, faces, r) && allocate(out, 4 * faces->side, 2 * faces->side, "the cube of lights", r);
    if (done)
        spread(faces, out);
    for (int i = 0; i < 6; i++)
        mipmap_free(&faces->faces[i]);
    free(faces);
    return done;
}
