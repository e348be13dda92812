/* Images of the scene as files beside the exported scene: the bytes as they are, where POV-Ray reads their format. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "exporters/povray/povray.h"

enum { SIGNATURE_BYTES = 8 };

static const char *ending_of(const uint8_t *bytes, size_t count)
{
    static const uint8_t png[SIGNATURE_BYTES] = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n' };
    if (count >= sizeof png && memcmp(bytes, png, sizeof png) == 0)
        return "png";
    if (count >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff)
        return "jpg";
    return NULL;
}

static size_t first_bytes(const scene_image *i, uint8_t bytes[SIGNATURE_BYTES])
{
    if (i->bytes) {
        const size_t count = i->byte_count < SIGNATURE_BYTES ? i->byte_count : SIGNATURE_BYTES;
        memcpy(bytes, i->bytes, count);
        return count;
    }
    FILE *file = fopen(i->path, "rb");
    if (!file)
        return 0;
    const size_t count = fread(bytes, 1, SIGNATURE_BYTES, file);
    fclose(file);
    return count;
}

const char *texture_file(const povray *p, int index, char out[2 * NAME_LENGTH])
{
    uint8_t bytes[SIGNATURE_BYTES];
    const size_t count = first_bytes(&p->scene->images[index], bytes);
    const char *ending = ending_of(bytes, count);
    if (!ending)
        return NULL;
    snprintf(out, 2 * NAME_LENGTH, "%s_texture%d.%s", p->file, index, ending);
    return out;
}

static bool copy_file(folder *f, const char *name, const char *path, report *r)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return report_error(r, "%s: cannot be read: %s", path, strerror(errno));
    text bytes = { 0 };
    char part[65536];
    for (size_t count; (count = fread(part, 1, sizeof part, file)) > 0;)
        text_add(&bytes, part, count);
    const bool whole = !ferror(file) && !bytes.failed;
    fclose(file);
    const bool done =
        whole ? folder_write(f, name, bytes.bytes, bytes.length, r) : report_error(r, "%s: cannot be read", path);
    text_free(&bytes);
    return done;
}

bool textures_write(const povray *p, folder *f)
{
    for (int i = 0; i < p->scene->image_count; ++i) {
        const scene_image *from = &p->scene->images[i];
        char name[2 * NAME_LENGTH];
        if (!p->image_used[i] || !texture_file(p, i, name))
            continue;
        const bool done = from->bytes ? folder_write(f, name, from->bytes, from->byte_count, p->report)
                                      : copy_file(f, name, from->path, p->report);
        if (!done)
            return false;
        if (p->options->wrote)
            p->options->wrote(name, p->options->listener.user);
    }
    return true;
}
