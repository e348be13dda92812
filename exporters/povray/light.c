/* Lights with their sizes, in the units of glint.inc. */
#include <stdio.h>
#include <string.h>

#include "exporters/povray/povray.h"

#define PI 3.14159265358979323846
/* Below this angular radius a light has hard shadows: that of the sun. Taste. */
#define POINT_RADIUS_RAD 5e-3

static double panel_area(const scene_light *l)
{
    const double area = (double)l->width_m * (double)l->height_m;
    return l->kind == SCENE_LIGHT_DISK ? 0.25 * PI * area : area;
}

/* As seen from the middle of the scene. */
static double angular_radius(const povray *p, const scene_light *l)
{
    if (l->kind == SCENE_LIGHT_DIRECTIONAL)
        return 0.5 * (double)l->angular_diameter_rad;
    const double distance = vec_length(vec_sub(matrix_column(l->to_world, 3), p->centre));
    const bool panel = l->kind == SCENE_LIGHT_RECT || l->kind == SCENE_LIGHT_DISK;
    /* Of a panel: that of the disc of its area. */
    const double radius = panel ? sqrt(panel_area(l) / PI) : (double)l->radius_m;
    return radius / fmax(distance, 1e-9);
}

static bool is_point(const povray *p, const scene_light *l)
{
    return angular_radius(p, l) < POINT_RADIUS_RAD;
}

/* What arrives in the middle of the scene. */
static double weight(const povray *p, const scene_light *l)
{
    const double distance = vec_length(vec_sub(matrix_column(l->to_world, 3), p->centre));
    const double sum = (double)(l->color[0] + l->color[1] + l->color[2]) * (double)l->intensity;
    if (l->kind == SCENE_LIGHT_DIRECTIONAL)
        return sum;
    const bool panel = l->kind == SCENE_LIGHT_RECT || l->kind == SCENE_LIGHT_DISK;
    return (panel ? sum * panel_area(l) : sum) / fmax(distance * distance, 1e-18);
}

double lights_width2(const povray *p)
{
    double sum = 0.0, total = 0.0;
    for (int i = 0; i < p->light_count; ++i) {
        /* Half vectors turn half as far as the light: a disc of radius r / 2 has the mean square r^2 / 8, a Beckmann
         * lobe alpha^2. */
        const double r = angular_radius(p, &p->lights[i]), w = weight(p, &p->lights[i]);
        sum += w * r * r / 8.0;
        total += w;
    }
    return total > 0.0 ? sum / total : 0.0;
}

bool lights_single_point(const povray *p, vec *at)
{
    if (p->light_count != 1 || !is_point(p, &p->lights[0]))
        return false;
    const scene_light *l = &p->lights[0];
    if (l->kind == SCENE_LIGHT_DIRECTIONAL)
        *at = vec_add(p->centre, vec_scale(vec_unit(matrix_column(l->to_world, 2)), 1e6 * p->radius));
    else
        *at = matrix_column(l->to_world, 3);
    return l->kind == SCENE_LIGHT_DIRECTIONAL || l->kind == SCENE_LIGHT_POINT;
}

typedef struct studio_light {
    const char *name;
    double azimuth, elevation; /* to the right of the eye, above the ground; radians */
    float color[3], irradiance, diameter_rad;
} studio_light;

/* Taste: three-point lighting with a key that is small, so that flakes flash; as glint render lights such a file. */
static const studio_light studio[STUDIO_LIGHTS] = {
    { "key", -0.75, 0.80, { 1.0F, 0.97F, 0.92F }, 2.2F, 0.015F },
    { "fill", 1.10, 0.35, { 0.86F, 0.92F, 1.0F }, 0.4F, 0.12F },
    { "rim", 2.60, 0.55, { 1.0F, 1.0F, 1.0F }, 1.4F, 0.02F },
};

void studio_lights(const povray *p, scene_light lights[STUDIO_LIGHTS])
{
    vec back = vec_scale(p->eye.forward, -1.0);
    if (fabs(back.y) > 0.99)
        back = vec_scale(p->eye.up, back.y > 0.0 ? -1.0 : 1.0);
    back = vec_unit((vec){ back.x, 0.0, back.z });
    const vec up = { 0.0, 1.0, 0.0 }, right = vec_cross(up, back);
    for (int i = 0; i < STUDIO_LIGHTS; ++i) {
        const studio_light *from = &studio[i];
        const vec heading = vec_add(vec_scale(back, cos(from->azimuth)), vec_scale(right, sin(from->azimuth)));
        const vec z = vec_add(vec_scale(heading, cos(from->elevation)), vec_scale(up, sin(from->elevation)));
        lights[i] = (scene_light){ .kind = SCENE_LIGHT_DIRECTIONAL,
                                   .intensity = from->irradiance,
                                   .angular_diameter_rad = from->diameter_rad };
        memcpy(lights[i].color, from->color, sizeof lights[i].color);
        lights[i].to_world[8] = (float)z.x;
        lights[i].to_world[9] = (float)z.y;
        lights[i].to_world[10] = (float)z.z;
    }
}

static void write_studio(text *out)
{
    text_print(out, "// The studio's sky: a gradient from the ground to the zenith.\n"
                    "sky_sphere {\n  pigment {\n    function { min(0.9999, max(0, 0.5 + 0.5*y)) }\n    color_map {\n"
                    "      [0.00 color rgb <0.060, 0.057, 0.054>]\n      [0.48 color rgb <0.190, 0.195, 0.205>]\n"
                    "      [0.52 color rgb <0.215, 0.220, 0.230>]\n      [1.00 color rgb <0.420, 0.460, 0.530>]\n"
                    "    }\n  }\n}\n\n");
}

/* A rectangle, or a disc as the square of its area. */
static void write_panel(const povray *p, const scene_light *l, const char *name, text *out)
{
    const double round = l->kind == SCENE_LIGHT_DISK ? sqrt(0.25 * PI) : 1.0;
    text_print(out, "// light \"%s\": %s\nGlint_Panel_Light(", name,
               l->kind == SCENE_LIGHT_DISK ? "a disc, as a square of its area" : "a rectangle");
    text_vector(out, vec_scale(matrix_column(l->to_world, 3), p->unit));
    text_print(out, ", ");
    text_vector(out, vec_scale(vec_unit(matrix_column(l->to_world, 0)), (double)l->width_m * round * p->unit));
    text_print(out, ", ");
    text_vector(out, vec_scale(vec_unit(matrix_column(l->to_world, 1)), (double)l->height_m * round * p->unit));
    text_print(out, ", ");
    text_vector(out, vec_scale(vec_of(l->color), (double)l->intensity));
    text_print(out, ")\n");
}

static const char *macro_of(const scene_light *l)
{
    switch (l->kind) {
    case SCENE_LIGHT_DIRECTIONAL:
        return "Glint_Sun";
    case SCENE_LIGHT_SPOT:
        return "Glint_Spot_Light";
    case SCENE_LIGHT_POINT:
    case SCENE_LIGHT_RECT:
    case SCENE_LIGHT_DISK:
        break;
    }
    return "Glint_Point_Light";
}

static void write_punctual(const povray *p, const scene_light *l, const char *name, text *out)
{
    const bool point = is_point(p, l), sun = l->kind == SCENE_LIGHT_DIRECTIONAL;
    const vec towards = vec_unit(matrix_column(l->to_world, 2));
    text_print(out, "// light \"%s\"%s\n%s(", name, point ? ", so small that its shadows are hard" : "", macro_of(l));
    text_vector(out, sun ? towards : vec_scale(matrix_column(l->to_world, 3), p->unit));
    text_print(out, ", ");
    if (l->kind == SCENE_LIGHT_SPOT) {
        text_vector(out, vec_scale(towards, -1.0));
        text_print(out, ", ");
    }
    /* W/sr over the square of a distance in POV-Ray's units. */
    text_vector(out, vec_scale(vec_of(l->color), (double)l->intensity * (sun ? 1.0 : p->unit * p->unit)));
    text_print(out, ", %.9g", point ? 0.0 : sun ? (double)l->angular_diameter_rad : (double)l->radius_m * p->unit);
    if (l->kind == SCENE_LIGHT_SPOT)
        text_print(out, ", %.9g, %.9g", (double)l->inner_cone_rad, (double)l->outer_cone_rad);
    text_print(out, ")\n");
}

static void note_light(const povray *p, const char *light, const char *what)
{
    char place[NAME_LENGTH + 16];
    snprintf(place, sizeof place, "light \"%s\"", light);
    notes_add(p->notes, place, what);
}

static void write_light(const povray *p, int index, text *out)
{
    const scene_light *l = &p->lights[index];
    char name[NAME_LENGTH];
    name_comment(name, p->studio ? studio[index].name : l->name);
    if (!(l->intensity > 0.0F) || !(l->color[0] + l->color[1] + l->color[2] > 0.0F))
        return;
    if (l->kind == SCENE_LIGHT_RECT || l->kind == SCENE_LIGHT_DISK) {
        write_panel(p, l, name, out);
        note_light(p, name,
                   "POV-Ray's area light shines to all sides alike; that it shines to one side, with the cosine, is "
                   "left out");
        if (l->kind == SCENE_LIGHT_DISK)
            note_light(p, name, "a disc is exported as a square of its area");
    } else {
        write_punctual(p, l, name, out);
    }
    if (l->range > 0.0F)
        note_light(p, name, "its range is left out: POV-Ray's light never ends");
    if (l->kind == SCENE_LIGHT_SPOT)
        note_light(p, name, "the edge of its cone is POV-Ray's, which fades a little otherwise between the two angles");
}

void lights_write(const povray *p, text *out)
{
    if (p->studio)
        write_studio(out);
    for (int i = 0; i < p->light_count; ++i)
        write_light(p, i, out);
    text_print(out, "\n");
    if (p->scene->environment.present)
        notes_add(p->notes, NULL, "the environment (EXT_lights_image_based) is left out");
}
