/* How a frame is called, and when it is. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/render.h"

char *render_frame_name(const char *output, int64_t frame)
{
    const char *slash = strrchr(output, '/'), *name = slash ? slash + 1 : output;
    const char *end = strrchr(name, '#');
    int digits = 4;
    const char *start = NULL, *rest = NULL, *dot = "";
    if (end) {
        start = end;
        while (start > name && start[-1] == '#')
            --start;
        rest = end + 1;
        digits = (int)(rest - start);
    } else {
        start = rest = strrchr(name, '.');
        dot = ".";
    }
    const size_t size = strlen(output) + (size_t)digits + 24;
    char *made = malloc(size);
    if (made)
        snprintf(made, size, "%.*s%s%0*" PRId64 "%s", (int)(start - output), output, dot, digits, frame, rest);
    return made;
}

double render_frame_time_s(const render_values *v, int64_t frame)
{
    return (double)(float)((double)frame / render_number_or(v->fps, RENDER_FPS));
}
