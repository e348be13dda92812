/* Renders small scenes with Debian's POV-Ray, in a folder of the test's own. */
#ifndef TESTS_POVRAY_RUN_H
#define TESTS_POVRAY_RUN_H

#include "io/image.h"

/* Writes FILE.pov with this text, and glint.inc beside it, renders it without antialiasing, one sample at the centre of
 * each pixel, and reads the picture. Fails the test with what POV-Ray said unless it ends with 0 and warns of nothing.
 */
image povray_render(const char *file, const char *scene_text, int width, int height);

/* The same for a scene that is in the folder already; ini as `povray NAME.ini`, with these further options. */
image povray_render_ini(const char *folder, const char *name, const char *options);

const float *pixel_at(const image *i, int x, int y);

#endif
