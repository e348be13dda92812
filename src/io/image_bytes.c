/* Reads a file into memory and recognises PNG, JPEG and WebP by how they begin, the formats that glTF knows. */
#include "io/image_bytes.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The first bytes of a format; '?' stands for any. */
typedef struct signature {
    const char *bytes;
    size_t byte_count;
    const char *format; /* NULL: recognised in order to refuse it by name */
    const char *title;
} signature;

static const signature signatures[] = {
    { "\x89PNG\r\n\x1a\n", 8, "png", "PNG" },
    { "\xff\xd8\xff", 3, "jpeg", "JPEG" },
    { "RIFF????WEBP", 12, "webp", "WebP" },
    { "\xabKTX 20\xbb\r\n\x1a\n", 12, NULL, "KTX2 (KHR_texture_basisu)" },
    { "DDS ", 4, NULL, "DDS (MSFT_texture_dds)" },
    { "????ftypavif", 12, NULL, "AVIF (EXT_texture_avif)" },
    { "GIF8", 4, NULL, "GIF" },
    { "\x76\x2f\x31\x01", 4, NULL, "OpenEXR" },
    { "#?RADIANCE", 10, NULL, "Radiance HDR" },
};

static bool begins_with(const image_bytes *b, const signature *s)
{
    if (b->byte_count < s->byte_count)
        return false;
    for (size_t i = 0; i < s->byte_count; i++)
        if (s->bytes[i] != '?' && (uint8_t)s->bytes[i] != b->bytes[i])
            return false;
    return true;
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

static bool recognise(image_bytes *b, const char *name, report *r)
{
    if (b->byte_count == 0)
        return report_error(r, "%s: is empty, expected a PNG, JPEG or WebP image", name);
    for (size_t i = 0; i < sizeof signatures / sizeof *signatures; i++) {
        if (!begins_with(b, &signatures[i]))
            continue;
        b->format = signatures[i].format;
        return b->format || report_error(r, "%s: is %s, which is not supported, expected PNG, JPEG or WebP", name,
                                         signatures[i].title);
    }
    char found[3 * 8 + 1] = "";
    for (size_t i = 0; i < 8 && i < b->byte_count; i++)
        snprintf(found + 3 * i, 4, " %02x", b->bytes[i]);
    return report_error(r, "%s: begins with the bytes%s, expected a PNG, JPEG or WebP image", name, found);
}

static bool read_all(int file, size_t byte_count, image_bytes *out, const char *name, report *r)
{
    out->owned = malloc(byte_count ? byte_count : 1);
    if (!out->owned)
        return report_error(r, "%s: its %zu bytes do not fit into memory", name, byte_count);
    out->bytes = out->owned;
    while (out->byte_count < byte_count) {
        const ssize_t got = read(file, out->owned + out->byte_count, byte_count - out->byte_count);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return report_error(r, "%s: cannot be read: %s", name, strerror(errno));
        if (got == 0)
            return report_error(r, "%s: ends after %zu bytes, expected %zu", name, out->byte_count, byte_count);
        out->byte_count += (size_t)got;
    }
    return true;
}

static bool read_file(const scene_image *image, image_bytes *out, report *r)
{
    /* Without O_NONBLOCK a named pipe would wait for a writer that never comes. */
    const int file = open(image->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    struct stat status;
    if (file < 0 || fstat(file, &status) != 0) {
        report_error(r, "%s: cannot be read: %s", image->name, strerror(errno));
        if (file >= 0)
            close(file);
        return false;
    }
    bool done = false;
    if (!S_ISREG(status.st_mode))
        report_error(r, "%s: is not a file, expected a PNG, JPEG or WebP image", image->name);
    else if ((uint64_t)status.st_size > IMAGE_BYTES_MAX)
        report_error(r, "%s: has %lld bytes, expected at most %zu", image->name, (long long)status.st_size,
                     IMAGE_BYTES_MAX);
    else
        done = read_all(file, (size_t)status.st_size, out, image->name, r);
    close(file);
    return done;
}

bool image_bytes_load(const scene_image *image, image_bytes *out, report *r)
{
    *out = (image_bytes){ .bytes = image->bytes, .byte_count = image->path ? 0 : image->byte_count };
    if ((!image->path || read_file(image, out, r)) && recognise(out, image->name, r) &&
        (strcmp(out->format, "png") != 0 || png_is_whole(out, image->name, r)))
        return true;
    image_bytes_free(out);
    return false;
}

void image_bytes_free(image_bytes *b)
{
    free(b->owned);
    *b = (image_bytes){ 0 };
}
