/* The smallest use of libglint: a strip of flakes under a lamp, seen as pixels, written as a picture (PGM).
 *
 *     hello_glint > strip.pgm
 */
#include <glint.h>
#include <math.h>
#include <stdio.h>

enum { WIDTH = 256, HEIGHT = 64 };

static const double pixel_m = 0.0005;          /* half a millimetre of surface per pixel */
static const float lamp_m[3] = { 0, 0, 0.4F }; /* above the middle of the strip */
static const float eye_m[3] = { 0, -0.3F, 0.5F };
static const float lamp_radius_m = 0.03F;

static float direction(const float to[3], double u, double v, float out[3])
{
    const float d[3] = { to[0] - (float)u, to[1] - (float)v, to[2] };
    const float length = sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int i = 0; i < 3; i++)
        out[i] = d[i] / length;
    return length;
}

int main(void)
{
    glint_material_options options = GLINT_MATERIAL_OPTIONS_INIT;
    options.surface.alpha_x = options.surface.alpha_y = 0.3F; /* how far the flakes tilt */
    options.surface.facets_per_m2 = 1e8F;                     /* 25 under each pixel */

    glint_material *material;
    char message[256];
    if (glint_material_create(&options, &material, message, sizeof message) != GLINT_OK) {
        fprintf(stderr, "hello_glint: %s\n", message);
        return 1;
    }

    printf("P2 %d %d 255\n", WIDTH, HEIGHT);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const double u = (x - 0.5 * WIDTH) * pixel_m, v = (0.5 * HEIGHT - y) * pixel_m;
            const glint_footprint footprint = { .u = u, .v = v, .dudx = (float)pixel_m, .dvdy = (float)-pixel_m };

            float wo[3], wi[3], rgb[3];
            direction(eye_m, u, v, wo);
            const float distance = direction(lamp_m, u, v, wi);
            const float solid_angle = 3.14159265F * lamp_radius_m * lamp_radius_m / (distance * distance);
            const glint_light lamp = { GLINT_LIGHT_CAP, solid_angle };

            glint_eval(material, NULL, &footprint, wo, wi, &lamp, rgb);
            printf("%d\n", (int)fminf(255.0F, 100.0F * rgb[0])); /* a lamp that gives 1 W/m^2, and an exposure of 100 */
        }
    }
    glint_material_destroy(material);
    return 0;
}
