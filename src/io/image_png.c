/* PNG files out, by libpng: the only file that includes it. */
#include <png.h>
#include <stdlib.h>

#include "io/image.h"
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

/* False after a jump out of libpng. */
static bool encode(png_structp png, png_infop info, const png_picture *p)
{
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    png_set_IHDR(png, info, (png_uint_32)p->width, (png_uint_32)p->height, p->bits, p->color_type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (p->srgb)
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
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
    const bool alpha = image_channel(i, "A") >= 0;
    const size_t row_size = (size_t)i->width * (alpha ? 4U : 3U);
    uint8_t *samples = malloc(row_size * (size_t)i->height);
    if (!samples)
        return report_error(r, "%s: does not fit into memory", path);
    const png_picture p = { i->width, i->height, alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, 8, true,
                            samples,  row_size };
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
    png_picture p = { width, height, PNG_COLOR_TYPE_RGB, bits, false, (const uint8_t *)rgb, 6 * (size_t)width };
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
