/* A surface that POV-Ray renders with glint.inc and that libglint says the radiance of, pixel by pixel. */
#include "surface.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "povray_run.h"

static const double eye_distance = 1e6;
const float surface_f0[3] = { 0.9F, 0.5F, 0.2F };

void surface_direction(double degrees, double sign, double out[3])
{
    const double a = degrees * PI / 180.0;
    out[0] = 0.0;
    out[1] = sign * sin(a);
    out[2] = cos(a);
}

static void print_tints(const surface_setting *s, char *out, size_t size)
{
    int length = snprintf(out, size, "#declare Glint_Hues = %.9g;\n", s->hues);
    if (s->color_count == 0)
        return;
    length += snprintf(out + length, size - (size_t)length, "#declare Glint_Tints = array[%u] {", s->color_count);
    for (unsigned i = 0; i < s->color_count; ++i)
        length += snprintf(out + length, size - (size_t)length, "%s <%.9g, %.9g, %.9g>", i ? "," : "",
                           (double)s->colors[i][0], (double)s->colors[i][1], (double)s->colors[i][2]);
    snprintf(out + length, size - (size_t)length, " }\n");
}

image surface_render(const surface_setting *s, const char *name)
{
    double v[3], l[3];
    char eye[128], light[128], texture[256], tints[512], source[2048];
    surface_direction(s->view_deg, -1.0, v);
    surface_direction(s->light_deg, 1.0, l);
    snprintf(eye, sizeof eye, "<0, %.12g, %.12g>", v[1] * eye_distance, v[2] * eye_distance);
    snprintf(light, sizeof light, "<0, %.12g, %.12g>", l[1] * s->light_distance, l[2] * s->light_distance);
    snprintf(texture, sizeof texture, s->texture, eye, light);
    print_tints(s, tints, sizeof tints);
    const bool mesh = strstr(s->texture, "Mirror") != NULL; /* a mesh of flakes in the place of a plane */
    /* The picture's y axis is foreshortened: up is perpendicular to the view. */
    snprintf(source, sizeof source,
             "#version 3.7;\n#include \"glint.inc\"\nglobal_settings { assumed_gamma 1.0 }\n"
             "camera { orthographic location <0, %.17g, %.17g> right <2, 0, 0> up <0, %.17g, %.17g>\n"
             "  direction <0, %.17g, %.17g> }\n"
             "Glint_Point_Light(%s, %.12g, 0)\n"
             "#declare Glint_Ndf = %s;\n#declare Glint_Alpha = %.9g;\n#declare Glint_Lobe = %.9g;\n"
             "#declare Glint_Size = %.9g;\n#declare Glint_Seed = %u;\n%s"
             "#declare Glint_F0 = <0.9, 0.5, 0.2>;\n#declare Glint_Base = pigment { color rgb %s }\n"
             "#declare Texture = %s\n%s\n",
             10.0 * v[1], 10.0 * v[2], 2.0 * v[2], -2.0 * v[1], -v[1], -v[2], light,
             SURFACE_IRRADIANCE * s->light_distance * s->light_distance, s->ndf, s->alpha, s->lobe, s->size, s->seed,
             tints, s->matt ? "<0.1, 0.2, 0.4>" : "0", texture,
             mesh ? "object { Glint_Flake_Mesh(2.4, 2.4) translate <-1.2, -1.2, 0> texture { Texture } }"
                  : "plane { z, 0 texture { Texture } }");
    return povray_render(name, source, SURFACE_SIDE, SURFACE_SIDE);
}

glint_material *surface_material(const surface_setting *s, glint_model model)
{
    glint_material_options o = GLINT_MATERIAL_OPTIONS_INIT;
    o.model = model;
    o.distribution = s->distribution;
    o.facet_hash = GLINT_FACET_HASH_POVRAY;
    o.facet_alpha = (float)s->lobe;
    o.seed = s->seed;
    o.color_variation = (float)s->hues;
    o.color_count = s->color_count;
    memcpy(o.colors, s->colors, sizeof s->colors);
    o.surface = (glint_surface){ .alpha_x = (float)s->alpha,
                                 .alpha_y = (float)s->alpha,
                                 .diffuse = { s->matt ? 0.1F : 0.0F, s->matt ? 0.2F : 0.0F, s->matt ? 0.4F : 0.0F },
                                 .f0 = { surface_f0[0], surface_f0[1], surface_f0[2] },
                                 .f90 = { 1.0F, 1.0F, 1.0F },
                                 .facets_per_m2 = (float)(1.0 / (s->size * s->size)),
                                 .discreteness = 1.0F };
    glint_material *m;
    char message[256];
    if (glint_material_create(&o, &m, message, sizeof message) != GLINT_OK)
        fail_msg("%s", message);
    return m;
}

void surface_expect(const surface_setting *s, const glint_material *m, int px, int py, double rgb[3])
{
    double v[3], l[3], to[3];
    surface_direction(s->view_deg, -1.0, v);
    surface_direction(s->light_deg, 1.0, l);
    const double x = 2.0 * (px + 0.5) / SURFACE_SIDE - 1.0;
    const double y = (1.0 - 2.0 * (py + 0.5) / SURFACE_SIDE) / v[2];
    to[0] = l[0] * s->light_distance - x;
    to[1] = l[1] * s->light_distance - y;
    to[2] = l[2] * s->light_distance;
    const double d = sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
    const float wo[3] = { (float)v[0], (float)v[1], (float)v[2] };
    const float wi[3] = { (float)(to[0] / d), (float)(to[1] / d), (float)(to[2] / d) };
    /* A pixel that is a point within one flake. */
    const float step = (float)(1e-4 * s->size);
    const glint_footprint f = { .u = x, .v = y, .dudx = step, .dvdy = -step };
    const glint_light light = { GLINT_LIGHT_CAP, 1e-7F };
    const double e = SURFACE_IRRADIANCE * s->light_distance * s->light_distance / (d * d);
    float out[3];
    glint_eval(m, NULL, &f, wo, wi, &light, out);
    for (int c = 0; c < 3; ++c)
        rgb[c] = (double)out[c] * e;
}
