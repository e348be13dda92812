/* The metadata of a picture, whichever of our two kinds of file it is in. */
#include "io/image_metadata.h"

#include <string.h>

#include "io/image_bytes.h"

bool image_read_metadata(const char *path, void (*visit)(const image_text *text, void *user), void *user, report *r)
{
    const char *format = image_file_format(path, r);
    if (!format)
        return false;
    if (strcmp(format, "openexr") == 0)
        return image_exr_metadata(path, visit, user, r);
    if (strcmp(format, "png") == 0)
        return image_png_metadata(path, visit, user, r);
    return report_error(r, "%s: found a picture of the format %s, expected OpenEXR or PNG", path, format);
}
