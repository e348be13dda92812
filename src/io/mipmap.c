/* Mip levels by exact area means, so that whatever level a lookup reads, the picture has the same average. */
#include "io/mipmap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io/srgb.h"

static int halved(int side)
{
    return side > 1 ? side / 2 : 1;
}

static size_t level_size(const mipmap *m, const mipmap_level *level)
{
    return (size_t)level->width * (size_t)level->height * (size_t)m->channel_count;
}

bool mipmap_allocate(mipmap *out, int width, int height, int channel_count, const char *name, report *r)
{
    *out = (mipmap){ .channel_count = channel_count };
    if (width < 1 || height < 1 || width > MIPMAP_SIDE_MAX || height > MIPMAP_SIDE_MAX)
        return report_error(r, "%s: is %d x %d pixels, expected 1 to %d on a side", name, width, height,
                            MIPMAP_SIDE_MAX);
    const uint64_t pixel_count = (uint64_t)width * (uint64_t)height;
    if (pixel_count > MIPMAP_PIXELS_MAX)
        return report_error(r, "%s: has %d x %d = %llu pixels, expected at most %llu", name, width, height,
                            (unsigned long long)pixel_count, (unsigned long long)MIPMAP_PIXELS_MAX);
    size_t texel_count = 0;
    for (int w = width, h = height;; w = halved(w), h = halved(h)) {
        mipmap_level *level = &out->levels[out->level_count++];
        *level = (mipmap_level){ .width = w, .height = h };
        texel_count += level_size(out, level);
        if (w == 1 && h == 1)
            break;
    }
    uint16_t *texels = malloc(texel_count * sizeof *texels);
    if (!texels) {
        *out = (mipmap){ 0 };
        return report_error(r, "%s: %d x %d pixels do not fit into memory", name, width, height);
    }
    for (int i = 0; i < out->level_count; i++) {
        out->levels[i].texels = texels;
        texels += level_size(out, &out->levels[i]);
    }
    return true;
}

void mipmap_free(mipmap *m)
{
    free(m->levels[0].texels); /* all levels lie in one piece */
    *m = (mipmap){ 0 };
}

bool mipmap_copy(const scene_image *picture, mipmap *out, report *r)
{
    if (!mipmap_allocate(out, picture->width, picture->height, 4, picture->name, r))
        return false;
    memcpy(out->levels[0].texels, picture->texels, level_size(out, &out->levels[0]) * sizeof *picture->texels);
    return true;
}

/* A float's exponent is biased by 127 and a half's by 15: bits moved into place are the value divided by 2^112, and the
 * multiplication is exact, for halves without a leading one as well. */
static float half_value(uint16_t code)
{
    const uint32_t bits = (uint32_t)code << 13;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value * 0x1p112F;
}

/* The nearest half of a value in [0, 1]; of two, the even one. */
static uint16_t half_code(float value)
{
    if (value < 0x1p-14F) /* below the smallest half with a leading one the steps are even, 2^-24 each */
        return (uint16_t)lrintf(value * 0x1p24F);
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    bits -= 112U << 23;
    return (uint16_t)((bits + 0xFFFU + ((bits >> 13) & 1U)) >> 13);
}

/* What means are taken of. Evenly spaced codes need no scale: their mean is the code of the mean. */
static double texel_value(mipmap_coding coding, uint16_t code)
{
    return coding == MIPMAP_HALF ? (double)half_value(code) : (double)code;
}

static uint16_t texel_code(mipmap_coding coding, double value)
{
    return coding == MIPMAP_HALF ? half_code((float)value) : (uint16_t)lrint(value);
}

void mipmap_spread_grey(mipmap *m)
{
    const size_t count = level_size(m, &m->levels[0]);
    uint16_t *texels = m->levels[0].texels;
    for (size_t i = 0; i < count; i += 4) {
        texels[i + 3] = texels[i + 1];
        texels[i + 1] = texels[i + 2] = texels[i];
    }
}

bool mipmap_decode_srgb(mipmap *m)
{
    uint16_t *linear = malloc(65536 * sizeof *linear);
    if (!linear)
        return false;
    for (int code = 0; code < 65536; code++)
        linear[code] = half_code((float)srgb_decode(code / 65535.0));
    const size_t count = level_size(m, &m->levels[0]);
    uint16_t *texels = m->levels[0].texels;
    for (size_t i = 0; i < count; i++)
        texels[i] = m->channel_count == 4 && i % 4 == 3 ? half_code((float)(texels[i] / 65535.0)) : linear[texels[i]];
    free(linear);
    m->coding = MIPMAP_HALF;
    return true;
}

/* The source texels under one target texel along one axis. In units of 1/target of a source texel, source texel i
 * covers [i, i + 1) * target and target texel x covers [x, x + 1) * source: the overlaps are whole numbers and sum to
 * source. */
typedef struct coverage {
    int first, count;
    double weight[4]; /* target = source / 2, rounded down: at most 3 source texels wide, so at most 4 are touched */
} coverage;

static coverage cover(int x, int source, int target)
{
    const int64_t begin = (int64_t)x * source, end = begin + source;
    coverage c = { .first = (int)(begin / target) };
    for (int64_t i = c.first; i * target < end; i++) {
        const int64_t from = i * target > begin ? i * target : begin;
        const int64_t to = (i + 1) * target < end ? (i + 1) * target : end;
        c.weight[c.count++] = (double)(to - from) / source;
    }
    return c;
}

static void average_texel(const mipmap *m, const mipmap_level *from, const coverage *across, const coverage *down,
                          uint16_t *texel)
{
    double mean[4] = { 0.0 };
    for (int j = 0; j < down->count; j++) {
        const size_t row = (size_t)(down->first + j) * (size_t)from->width;
        for (int i = 0; i < across->count; i++) {
            const uint16_t *source = from->texels + (row + (size_t)(across->first + i)) * (size_t)m->channel_count;
            const double weight = across->weight[i] * down->weight[j];
            for (int c = 0; c < m->channel_count; c++)
                mean[c] += weight * texel_value(m->coding, source[c]);
        }
    }
    for (int c = 0; c < m->channel_count; c++)
        texel[c] = texel_code(m->coding, mean[c]);
}

void mipmap_build(mipmap *m)
{
    for (int i = 1; i < m->level_count; i++) {
        const mipmap_level *from = &m->levels[i - 1];
        const mipmap_level *to = &m->levels[i];
        uint16_t *texel = to->texels;
        for (int y = 0; y < to->height; y++) {
            const coverage down = cover(y, from->height, to->height);
            for (int x = 0; x < to->width; x++, texel += m->channel_count) {
                const coverage across = cover(x, from->width, to->width);
                average_texel(m, from, &across, &down, texel);
            }
        }
    }
}
