/* A surface that POV-Ray renders with glint.inc and that libglint says the radiance of, pixel by pixel. */
#ifndef TESTS_POVRAY_SURFACE_H
#define TESTS_POVRAY_SURFACE_H

#include <stdbool.h>

#include "glint.h"
#include "io/image.h"

/* A square from -1 to 1 of z = 0, seen by an orthographic camera that is tilted along y, under a point light: both far
 * enough that directions hardly change over it, near enough that they do. */
enum { SURFACE_SIDE = 160 };
#define PI 3.14159265358979
/* W/m^2 at the origin. */
#define SURFACE_IRRADIANCE PI

typedef struct surface_setting {
    const char *ndf, *texture; /* the macro's call; %s of it is the eye, the next one the light */
    glint_distribution distribution;
    double alpha, lobe, size;
    unsigned seed;
    double view_deg, light_deg; /* tilts towards -y and +y */
    double light_distance;
    bool matt; /* a coloured base below the flakes; black otherwise */
    double hues;
    unsigned color_count;
    float colors[3][3];
} surface_setting;

/* Reflectance head-on. */
extern const float surface_f0[3];

/* Towards +y or -y. */
void surface_direction(double degrees, double sign, double out[3]);

/* One sample at the middle of each pixel. */
image surface_render(const surface_setting *s, const char *name);

glint_material *surface_material(const surface_setting *s, glint_model model);

/* What libglint says about the middle of a pixel. */
void surface_expect(const surface_setting *s, const glint_material *m, int px, int py, double rgb[3]);

#endif
