/* PNG files out, and their metadata in, by libpng: the only file that includes it. */
#include <errno.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/image_metadata.h"
#include "io/image_srgb.h"
#include "io/output_file.h"

/* zlib's own. Of a picture full of glints it makes 7 % less than Z_FILTERED, which libpng takes. */
enum { ZLIB_DEFAULT_STRATEGY = 0 };

/* Rows of samples, those of 16 bits in this machine's order. */
typedef struct png_picture {
    int width, height, color_type, bits;
    bool srgb; /* what the codes mean; if not, nothing is said about it */
    const uint8_t *samples;
    size_t row_size;
    const image_text *metadata;
    size_t metadata_count;
} png_picture;

typedef struct png_target {
    const char *path;
    output_file *file;
    report *r;
} png_target;

static void refuse(png_structp png, png_const_charp text)
{
    const png_target *to = png_get_error_ptr(png);
    report_error(to->r, "%s: cannot be encoded: %s", to->path, text);
    png_longjmp(png, 1);
}

static void warn(png_structp png, png_const_charp text)
{
    const png_target *to = png_get_error_ptr(png);
    report_warning(to->r, "%s: %s", to->path, text);
}

/* A failure of the disk is left to the commit, which knows the system's reason. */
static void put(png_structp png, png_bytep data, size_t byte_count)
{
    output_file_write(png_get_io_ptr(png), data, byte_count);
}

static void flush(png_structp png)
{
    (void)png;
}

/* International text: values are UTF-8, as scenes are. */
static void set_texts(png_structp png, png_infop info, const png_picture *p)
{
    for (size_t i = 0; i < p->metadata_count; i++) {
        png_text text = { .compression = PNG_ITXT_COMPRESSION_NONE,
                          .key = (char *)p->metadata[i].key,
                          .text = (char *)p->metadata[i].value };
        png_set_text(png, info, &text, 1);
    }
}

/* False after a jump out of libpng. */
static bool encode(png_structp png, png_infop info, const png_picture *p)
{
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    png_set_IHDR(png, info, (png_uint_32)p->width, (png_uint_32)p->height, p->bits, p->color_type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (p->srgb)
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
    set_texts(png, info, p);
    png_set_compression_strategy(png, ZLIB_DEFAULT_STRATEGY);
    png_write_info(png, info);
    if (p->bits == 16 && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__)
        png_set_swap(png);
    for (int y = 0; y < p->height; y++)
        png_write_row(png, p->samples + (size_t)y * p->row_size);
    png_write_end(png, info);
    return true;
}

static bool write_picture(const char *path, const png_picture *p, report *r)
{
    output_file *file = output_file_open(path, r);
    if (!file)
        return false;
    png_target to = { path, file, r };
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &to, refuse, warn);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (info)
        png_set_write_fn(png, file, put, flush);
    const bool done = info ? encode(png, info, p) : report_error(r, "%s: does not fit into memory", path);
    png_destroy_write_struct(&png, &info);
    if (done)
        return output_file_commit(file, r);
    output_file_abort(file);
    return false;
}

bool image_write_png(const char *path, const image *i, float exposure_ev, report *r)
{
    return image_write_png_with_metadata(path, i, exposure_ev, NULL, 0, r);
}

bool image_write_png_with_metadata(const char *path, const image *i, float exposure_ev, const image_text *metadata,
                                   size_t metadata_count, report *r)
{
    const bool alpha = image_channel(i, "A") >= 0;
    const size_t row_size = (size_t)i->width * (alpha ? 4U : 3U);
    uint8_t *samples = malloc(row_size * (size_t)i->height);
    if (!samples)
        return report_error(r, "%s: does not fit into memory", path);
    const png_picture p = { .width = i->width,
                            .height = i->height,
                            .color_type = alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                            .bits = 8,
                            .srgb = true,
                            .samples = samples,
                            .row_size = row_size,
                            .metadata = metadata,
                            .metadata_count = metadata_count };
    const bool done = image_to_srgb(i, exposure_ev, samples)
                          ? write_picture(path, &p, r)
                          : report_error(r, "%s: the picture has no channels R, G and B", path);
    free(samples);
    return done;
}

/* Codes of 16 bits as the nearest of 8. */
static uint8_t *narrowed(const uint16_t *codes, size_t count)
{
    uint8_t *bytes = malloc(count);
    for (size_t i = 0; bytes && i < count; i++)
        bytes[i] = (uint8_t)((codes[i] + 128U) / 257U);
    return bytes;
}

bool image_write_data_png(const char *path, int width, int height, int bits, const uint16_t *rgb, report *r)
{
    png_picture p = { .width = width,
                      .height = height,
                      .color_type = PNG_COLOR_TYPE_RGB,
                      .bits = bits,
                      .samples = (const uint8_t *)rgb,
                      .row_size = 6 * (size_t)width };
    if (bits == 16)
        return write_picture(path, &p, r);
    uint8_t *bytes = narrowed(rgb, 3 * (size_t)width * (size_t)height);
    if (!bytes)
        return report_error(r, "%s: does not fit into memory", path);
    p.samples = bytes;
    p.row_size = 3 * (size_t)width;
    const bool done = write_picture(path, &p, r);
    free(bytes);
    return done;
}

/* ---- metadata in ---- */

static void refuse_file(png_structp png, png_const_charp text)
{
    const png_target *from = png_get_error_ptr(png);
    report_error(from->r, "%s: is broken: %s", from->path, text);
    png_longjmp(png, 1);
}

static void ignore(png_structp png, png_const_charp text)
{
    (void)png;
    (void)text;
}

/* Those in front of the pixels, where ours are. */
static bool decode_texts(png_structp png, png_infop info, FILE *in, png_textp *texts, int *count)
{
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    png_init_io(png, in);
    png_read_info(png, info);
    png_get_text(png, info, texts, count);
    return true;
}

/* Every PNG ends in the same chunk. */
static bool has_end(FILE *in)
{
    static const unsigned char last[] = { 0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xAE, 0x42, 0x60, 0x82 };
    unsigned char bytes[sizeof last];
    const bool read = fseek(in, -(long)sizeof last, SEEK_END) == 0 && fread(bytes, 1, sizeof bytes, in) == sizeof bytes;
    rewind(in);
    return read && memcmp(bytes, last, sizeof last) == 0;
}

bool image_png_metadata(const char *path, void (*visit)(const image_text *text, void *user), void *user, report *r)
{
    FILE *in = fopen(path, "rb");
    if (!in)
        return report_error(r, "%s: cannot be read: %s", path, strerror(errno));
    png_target from = { path, NULL, r };
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &from, refuse_file, ignore);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    png_textp texts = NULL;
    int count = 0;
    const bool whole = has_end(in) || report_error(r, "%s: is broken: its end is missing", path);
    const bool done = whole && (info ? decode_texts(png, info, in, &texts, &count)
                                     : report_error(r, "%s: does not fit into memory", path));
    for (int i = 0; done && i < count; i++) {
        const image_text found = { texts[i].key, texts[i].text };
        visit(&found, user);
    }
    png_destroy_read_struct(&png, &info, NULL);
    fclose(in);
    return done;
}
