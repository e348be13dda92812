/* Uses libglint from outside, as C and as C++: exits with 0 when the library that is loaded gives a number that is
 * known. */
#include <glint.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

int main(void)
{
    char header_version[32];
    snprintf(header_version, sizeof header_version, "%d.%d.%d", GLINT_VERSION_MAJOR, GLINT_VERSION_MINOR,
             GLINT_VERSION_PATCH);
    if (strcmp(glint_version(), header_version) != 0) {
        fprintf(stderr, "the library says %s, its header %s\n", glint_version(), header_version);
        return 1;
    }

    glint_material_options options = GLINT_MATERIAL_OPTIONS_INIT;
    options.model = GLINT_MODEL_SMOOTH;
    options.surface.alpha_x = options.surface.alpha_y = 0.5F;
    glint_material *material = NULL;
    char message[256];
    if (glint_material_create(&options, &material, message, sizeof message) != GLINT_OK) {
        fprintf(stderr, "%s\n", message);
        return 1;
    }

    /* Looking and lighting straight down, F = G = 1: f = D(z) / 4 = 1 / (4 pi alpha^2). */
    const float up[3] = { 0.0F, 0.0F, 1.0F };
    float rgb[3];
    glint_eval(material, NULL, NULL, up, up, NULL, rgb);
    glint_material_destroy(material);
    const double expected = 1.0 / (4.0 * 3.14159265358979323846 * 0.25);
    if (!(fabs(rgb[1] - expected) < 1e-5 * expected)) {
        fprintf(stderr, "found %.9g, expected %.9g\n", (double)rgb[1], expected);
        return 1;
    }
    return 0;
}
