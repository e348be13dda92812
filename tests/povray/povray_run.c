/* Renders small scenes with Debian's POV-Ray, in a folder of the test's own. */
#include "povray_run.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "workplace.h"

/* The parse of a large mesh and a few seconds of rendering, on a machine that does other things, too. */
#define TIME_LIMIT_S 300

static void run(const char *command, const char *warnings, const char *said)
{
    const int status = system(command);
    size_t size;
    char *text = file_read(said, &size);
    if (status != 0)
        fail_msg("%s: status %d: %s", command, status, text + (size > 1500 ? size - 1500 : 0));
    free(text);
    struct stat there;
    if (stat(warnings, &there) != 0 || there.st_size == 0)
        return;
    text = file_read(warnings, &size);
    fail_msg("%s: warns: %s", command, text);
}

static image picture_of(const char *path)
{
    report r = { 0 };
    image i;
    if (!image_read(path, &i, &r))
        fail_msg("%s", r.error);
    return i;
}

image povray_render(const char *file, const char *scene_text, int width, int height)
{
    char path[256], command[1024];
    snprintf(path, sizeof path, "%s.pov", file);
    file_write_text(path, scene_text);
    size_t size;
    char *include = file_read(GLINT_INC, &size);
    file_write("glint.inc", include, size);
    free(include);
    snprintf(command, sizeof command,
             "timeout %d povray +I%s.pov +O%s.exr +FE +W%d +H%d -A -D -V +GW%s.warnings >%s.said 2>&1", TIME_LIMIT_S,
             file, file, width, height, file, file);
    char warnings[256], said[256], picture[256];
    snprintf(warnings, sizeof warnings, "%s.warnings", file);
    snprintf(said, sizeof said, "%s.said", file);
    snprintf(picture, sizeof picture, "%s.exr", file);
    run(command, warnings, said);
    return picture_of(picture);
}

image povray_render_ini(const char *folder, const char *name, const char *options)
{
    char command[1024], warnings[512], said[512], picture[512];
    snprintf(warnings, sizeof warnings, "%s/%s.warnings", folder, name);
    snprintf(said, sizeof said, "%s/%s.said", folder, name);
    snprintf(picture, sizeof picture, "%s/%s.exr", folder, name);
    snprintf(command, sizeof command, "cd '%s' && timeout %d povray %s.ini %s +GW%s.warnings >%s.said 2>&1", folder,
             TIME_LIMIT_S, name, options, name, name);
    run(command, warnings, said);
    return picture_of(picture);
}

const float *pixel_at(const image *i, int x, int y)
{
    return &i->pixels[((size_t)y * (size_t)i->width + (size_t)x) * (size_t)i->channel_count];
}
