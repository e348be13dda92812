/* Writes a latitude-longitude map for `glint render --environment`: a small studio, or a clear sky with its sun.
 *
 *     make_environment studio|sunny|white OUT.hdr
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#define PI 3.14159265358979323846

enum { HEIGHT = 512, WIDTH = 2 * HEIGHT };

typedef struct rgb {
    double r, g, b;
} rgb;

static rgb scaled(rgb c, double s)
{
    return (rgb){ c.r * s, c.g * s, c.b * s };
}

static rgb mixed(rgb a, rgb b, double t)
{
    return (rgb){ a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t };
}

/* 1 inside an interval around middle, 0 outside, with a ramp at its ends. */
static double box(double x, double middle, double half, double ramp)
{
    return fmin(fmax((half + ramp - fabs(x - middle)) / ramp, 0.0), 1.0);
}

/* Degrees: azimuth 0 is the middle of the map (+x), growing to its right; elevation. */
typedef struct panel {
    double azimuth, elevation, half_width, half_height;
    rgb radiance;
} panel;

/* A dark room with a large soft key, a cool fill, a strip for the edge and a dim ceiling. */
static rgb studio(double azimuth, double elevation)
{
    static const panel panels[] = {
        { 140.0, 42.0, 20.0, 16.0, { 14.0, 13.2, 12.2 } },
        { 25.0, 18.0, 16.0, 22.0, { 2.2, 2.8, 3.4 } },
        { -62.0, 30.0, 5.0, 30.0, { 9.0, 9.0, 9.2 } },
        { -130.0, 22.0, 3.0, 26.0, { 5.0, 4.6, 4.2 } },
    };
    rgb sum = mixed((rgb){ 0.05, 0.045, 0.04 }, (rgb){ 0.22, 0.23, 0.25 }, box(elevation, 90.0, 70.0, 40.0));
    for (size_t i = 0; i < sizeof panels / sizeof panels[0]; ++i) {
        const panel *const p = &panels[i];
        const double share =
            box(azimuth, p->azimuth, p->half_width, 1.5) * box(elevation, p->elevation, p->half_height, 1.5);
        sum = mixed(sum, p->radiance, share);
    }
    return sum;
}

/* The sun has its true size, half a degree and a little, and gives three times as much light as the sky on a surface
 * that faces it. */
static rgb sunny(double azimuth, double elevation)
{
    const double sun_azimuth = 120.0 * PI / 180.0, sun_elevation = 38.0 * PI / 180.0;
    const double a = azimuth * PI / 180.0, e = elevation * PI / 180.0;
    const double cosine = cos(e) * cos(sun_elevation) * cos(a - sun_azimuth) + sin(e) * sin(sun_elevation);
    const double away = acos(fmin(fmax(cosine, -1.0), 1.0)) * 180.0 / PI;
    if (away < 0.4)
        return (rgb){ 34000.0, 31000.0, 26500.0 };
    if (elevation < 0.0)
        return mixed((rgb){ 0.34, 0.32, 0.28 }, (rgb){ 0.14, 0.125, 0.105 }, fmin(-elevation / 20.0, 1.0));
    const rgb sky = mixed((rgb){ 0.92, 0.94, 0.96 }, (rgb){ 0.20, 0.36, 0.72 }, pow(elevation / 90.0, 0.4));
    return mixed(sky, (rgb){ 3.0, 2.8, 2.4 }, exp(-away / 6.0));
}

static rgb white(double azimuth, double elevation)
{
    (void)azimuth;
    (void)elevation;
    return (rgb){ 1.0, 1.0, 1.0 };
}

/* G. Ward's shared exponent: three mantissas of eight bits. */
static void encode(rgb c, unsigned char out[4])
{
    int exponent;
    const double largest = fmax(c.r, fmax(c.g, c.b));
    const double scale = frexp(largest, &exponent) * 256.0 / largest;
    const rgb m = scaled(c, scale);
    out[0] = (unsigned char)m.r;
    out[1] = (unsigned char)m.g;
    out[2] = (unsigned char)m.b;
    out[3] = (unsigned char)(exponent + 128);
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        rgb (*at)(double azimuth, double elevation);
    } kinds[] = { { "studio", studio }, { "sunny", sunny }, { "white", white } };
    rgb (*at)(double, double) = NULL;
    for (size_t i = 0; argc == 3 && i < sizeof kinds / sizeof kinds[0]; ++i)
        if (strcmp(argv[1], kinds[i].name) == 0)
            at = kinds[i].at;
    if (at == NULL) {
        fputs("usage: make_environment studio|sunny|white OUT.hdr\n", stderr);
        return 2;
    }
    FILE *const out = fopen(argv[2], "wb");
    if (out == NULL) {
        perror(argv[2]);
        return 1;
    }
    fprintf(out, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", HEIGHT, WIDTH);
    for (int y = 0; y < HEIGHT; ++y) {
        for (int x = 0; x < WIDTH; ++x) {
            unsigned char texel[4];
            encode(at(360.0 * ((x + 0.5) / WIDTH - 0.5), 180.0 * (0.5 - (y + 0.5) / HEIGHT)), texel);
            fwrite(texel, 1, 4, out);
        }
    }
    if (ferror(out) || fclose(out) != 0) {
        perror(argv[2]);
        return 1;
    }
    return 0;
}
