/* Formats are told by how they begin; glTF knows PNG, JPEG and WebP, and the pictures of a renderer come in more. */
#include "io/image_bytes.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { SIGNATURE_MAX = 12 };

static const char textures_expected[] = "PNG, JPEG or WebP";
static const char pictures_expected[] = "OpenEXR, Radiance HDR, TIFF, PNG, JPEG or WebP";

/* The first bytes of a format; '?' stands for any. */
typedef struct signature {
    const char *bytes;
    size_t byte_count;
    const char *title;
    const char *format; /* OpenImageIO's name; NULL: recognised in order to refuse it by name */
    bool texture;
} signature;

static const signature signatures[] = {
    { "\x89PNG\r\n\x1a\n", 8, "PNG", "png", true },
    { "\xff\xd8\xff", 3, "JPEG", "jpeg", true },
    { "RIFF????WEBP", 12, "WebP", "webp", true },
    { "\x76\x2f\x31\x01", 4, "OpenEXR", "openexr", false },
    { "#?RADIANCE", 10, "Radiance HDR", "hdr", false },
    { "#?RGBE", 6, "Radiance HDR", "hdr", false },
    { "II*\0", 4, "TIFF", "tiff", false },
    { "MM\0*", 4, "TIFF", "tiff", false },
    { "\xabKTX 20\xbb\r\n\x1a\n", 12, "KTX2 (KHR_texture_basisu)", NULL, false },
    { "DDS ", 4, "DDS (MSFT_texture_dds)", NULL, false },
    { "????ftypavif", 12, "AVIF (EXT_texture_avif)", NULL, false },
    { "GIF8", 4, "GIF", NULL, false },
};

static bool begins_with(const uint8_t *bytes, size_t byte_count, const signature *s)
{
    if (byte_count < s->byte_count)
        return false;
    for (size_t i = 0; i < s->byte_count; i++)
        if (s->bytes[i] != '?' && (uint8_t)s->bytes[i] != bytes[i])
            return false;
    return true;
}

static const char *recognise(const uint8_t *bytes, size_t byte_count, bool texture, const char *name, report *r)
{
    const char *expected = texture ? textures_expected : pictures_expected;
    if (byte_count == 0) {
        report_error(r, "%s: is empty, expected %s", name, expected);
        return NULL;
    }
    for (size_t i = 0; i < sizeof signatures / sizeof *signatures; i++) {
        const signature *s = &signatures[i];
        if (!begins_with(bytes, byte_count, s))
            continue;
        if (s->format && (s->texture || !texture))
            return s->format;
        report_error(r, "%s: is %s, which is not supported here, expected %s", name, s->title, expected);
        return NULL;
    }
    char found[3 * SIGNATURE_MAX + 1] = "";
    for (size_t i = 0; i < SIGNATURE_MAX && i < byte_count; i++)
        snprintf(found + 3 * i, 4, " %02x", bytes[i]);
    report_error(r, "%s: begins with the bytes%s, expected %s", name, found, expected);
    return NULL;
}

/* A descriptor, or -1 after an error. */
static int open_regular(const char *path, const char *name, size_t *byte_count, report *r)
{
    /* Without O_NONBLOCK a named pipe would wait for a writer that never comes. */
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    struct stat status;
    if (file >= 0 && fstat(file, &status) == 0) {
        *byte_count = (size_t)status.st_size;
        if (S_ISREG(status.st_mode))
            return file;
        report_error(r, "%s: is not a regular file, expected an image", name);
    } else {
        report_error(r, "%s: cannot be read: %s", name, strerror(errno));
    }
    if (file >= 0)
        close(file);
    return -1;
}

static bool read_bytes(int file, uint8_t *bytes, size_t byte_count, const char *name, report *r)
{
    for (size_t done = 0; done < byte_count;) {
        const ssize_t got = read(file, bytes + done, byte_count - done);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return report_error(r, "%s: cannot be read: %s", name, strerror(errno));
        if (got == 0)
            return report_error(r, "%s: ends after %zu bytes, expected %zu", name, done, byte_count);
        done += (size_t)got;
    }
    return true;
}

const char *image_file_format(const char *path, report *r)
{
    size_t byte_count;
    const int file = open_regular(path, path, &byte_count, r);
    if (file < 0)
        return NULL;
    uint8_t start[SIGNATURE_MAX];
    const size_t start_count = byte_count < sizeof start ? byte_count : sizeof start;
    const char *format = NULL;
    if (read_bytes(file, start, start_count, path, r))
        format = recognise(start, start_count, false, path, r);
    close(file);
    return format;
}

static bool read_file(const scene_image *image, image_bytes *out, report *r)
{
    size_t byte_count;
    const int file = open_regular(image->path, image->name, &byte_count, r);
    if (file < 0)
        return false;
    bool done = false;
    if (byte_count > IMAGE_BYTES_MAX) {
        report_error(r, "%s: has %zu bytes, expected at most %zu", image->name, byte_count, IMAGE_BYTES_MAX);
    } else {
        out->owned = malloc(byte_count ? byte_count : 1);
        out->bytes = out->owned;
        out->byte_count = byte_count;
        done = out->owned ? read_bytes(file, out->owned, byte_count, image->name, r)
                          : report_error(r, "%s: its %zu bytes do not fit into memory", image->name, byte_count);
    }
    close(file);
    return done;
}

static uint32_t big_endian_u32(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

/* Every chunk is a length, a type, that many bytes and a checksum; the last one is IEND. Checked here because the
 * decoder accepts a file that has lost its last chunk and leaks its own message about one that has lost more. */
static bool png_is_whole(const image_bytes *b, const char *name, report *r)
{
    size_t at = 8;
    while (b->byte_count - at >= 12) {
        const size_t length = big_endian_u32(b->bytes + at);
        if (length > b->byte_count - at - 12)
            break;
        if (memcmp(b->bytes + at + 4, "IEND", 4) == 0)
            return true;
        at += 12 + length;
    }
    return report_error(r, "%s: is broken: the PNG chunk at byte %zu runs past the end of its %zu bytes", name, at,
                        b->byte_count);
}

bool image_bytes_load(const scene_image *image, image_bytes *out, report *r)
{
    *out = (image_bytes){ .bytes = image->bytes, .byte_count = image->path ? 0 : image->byte_count };
    if (!image->path || read_file(image, out, r)) {
        out->format = recognise(out->bytes, out->byte_count, true, image->name, r);
        if (out->format && (strcmp(out->format, "png") != 0 || png_is_whole(out, image->name, r)))
            return true;
    }
    image_bytes_free(out);
    return false;
}

void image_bytes_free(image_bytes *b)
{
    free(b->owned);
    *b = (image_bytes){ 0 };
}
