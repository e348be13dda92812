/* Lights that suit any file, by name: what a photographer would put around the subject. */
#include <stdlib.h>
#include <string.h>

#include "preview/rig.h"
#include "preview/subject.h"

/* One light of a set. Angles as in rig_direction; lengths in radii of the subject. */
typedef struct set_light {
    scene_light_kind kind;
    double azimuth, elevation, distance;
    double width, height; /* of rectangles; the width of a bulb */
    float color[3];
    float irradiance; /* where the subject faces it, W/m^2; a white wall under pi shows radiance 1 */
} set_light;

typedef struct light_set {
    const char *name;
    const set_light *lights;
    int light_count;
    int ring_count; /* panels in a circle around the view */
    preview_sky sky;
} light_set;

/* Taste, all that follows. */

static const set_light three_point[] = {
    { SCENE_LIGHT_RECT, -0.80, 0.75, 3.2, 1.8, 1.8, { 1.0F, 0.96F, 0.90F }, 2.6F },
    { SCENE_LIGHT_RECT, 1.15, 0.30, 4.0, 3.0, 3.0, { 0.86F, 0.92F, 1.0F }, 0.5F },
    { SCENE_LIGHT_RECT, 2.55, 0.60, 3.0, 0.5, 2.4, { 1.0F, 1.0F, 1.0F }, 1.8F },
};

static const set_light sun[] = {
    { SCENE_LIGHT_DIRECTIONAL, -0.75, 0.70, 0.0, 0.0, 0.0, { 1.0F, 0.93F, 0.82F }, 3.6F },
};

static const set_light bulb[] = {
    { SCENE_LIGHT_POINT, -0.65, 0.85, 3.0, 0.06, 0.06, { 1.0F, 0.95F, 0.88F }, 5.0F },
};

#define COUNT(array) (int)(sizeof(array) / sizeof *(array))

static const light_set sets[] = {
    { "three-point",
      three_point,
      COUNT(three_point),
      0,
      { { 0.10F, 0.105F, 0.11F }, { 0.05F, 0.05F, 0.052F }, { 0.02F, 0.019F, 0.018F } } },
    { "sun-and-sky",
      sun,
      COUNT(sun),
      0,
      { { 0.16F, 0.27F, 0.52F }, { 0.62F, 0.68F, 0.76F }, { 0.17F, 0.15F, 0.13F } } },
    { "ring", NULL, 0, 12, { { 0.07F, 0.07F, 0.075F }, { 0.05F, 0.05F, 0.052F }, { 0.02F, 0.02F, 0.02F } } },
    { "point", bulb, COUNT(bulb), 0, { { 0.03F, 0.033F, 0.04F }, { 0.02F, 0.02F, 0.022F }, { 0.01F, 0.01F, 0.01F } } },
    { "none", NULL, 0, 0, { { 0 }, { 0 }, { 0 } } },
};

const char *preview_light_set_name(int set)
{
    return set >= 0 && set < COUNT(sets) ? sets[set].name : NULL;
}

/* The ring: of this radius and depth, in radii of the subject, in front of it on the camera's axis. */
#define RING_DISTANCE 3.0
#define RING_RADIUS 1.1
#define RING_WIDTH 0.3
#define RING_IRRADIANCE 3.0

static void place(scene_light *l, vec3 at, vec3 z, vec3 up)
{
    vec3 x = v3_cross(up, z);
    x = v3_dot(x, x) > 1e-12 ? v3_normalize(x) : v3_any_tangent(z);
    m4_from_axes(x, v3_cross(z, x), z, at, l->to_world);
}

static scene_light make_light(const set_light *from, const rig_axes *axes, const subject *about)
{
    const vec3 z = rig_direction(axes, from->azimuth, from->elevation);
    const double distance = from->distance * about->radius;
    scene_light l = { .kind = from->kind, .intensity = from->irradiance };
    memcpy(l.color, from->color, sizeof l.color);
    place(&l, v3_mad(about->middle, z, distance), z, axes->up);
    switch (from->kind) {
    case SCENE_LIGHT_RECT:
    case SCENE_LIGHT_DISK:
        /* L A / d^2, which falls short of the form factor by less than a tenth for these. */
        l.width_m = (float)(from->width * about->radius);
        l.height_m = (float)(from->height * about->radius);
        l.intensity *= (float)(from->distance * from->distance / (from->width * from->height));
        break;
    case SCENE_LIGHT_POINT:
    case SCENE_LIGHT_SPOT:
        l.radius_m = (float)(0.5 * from->width * about->radius);
        l.intensity *= (float)(distance * distance);
        break;
    case SCENE_LIGHT_DIRECTIONAL:
        l.angular_diameter_rad = 0.00929F; /* the sun's */
        break;
    }
    return l;
}

/* One of count panels that stand in a circle around the camera's axis and look at the subject. */
static scene_light make_panel(int index, int count, const scene_camera *view, const subject *about)
{
    double m[16];
    for (int i = 0; i < 16; ++i)
        m[i] = (double)view->to_world[i];
    const double angle = 2.0 * PREVIEW_PI * index / count;
    const vec3 outwards =
        v3_mad(v3_scale(v3_normalize(m4_column(m, 0)), cos(angle)), v3_normalize(m4_column(m, 1)), sin(angle));
    const vec3 offset = v3_mad(v3_scale(v3_normalize(m4_column(m, 2)), RING_DISTANCE), outwards, RING_RADIUS);
    const double long_side = 2.0 * tan(PREVIEW_PI / count) * RING_RADIUS;
    scene_light l = { .kind = SCENE_LIGHT_RECT,
                      .color = { 1.0F, 0.985F, 0.96F },
                      .width_m = (float)(long_side * about->radius),
                      .height_m = (float)(RING_WIDTH * about->radius) };
    l.intensity = (float)(RING_IRRADIANCE * v3_dot(offset, offset) / (count * long_side * RING_WIDTH));
    place(&l, v3_mad(about->middle, offset, about->radius), v3_normalize(offset), outwards);
    return l;
}

static void remove_lights(scene *s)
{
    for (int i = 0; i < s->light_count; ++i)
        free(s->lights[i].name);
    free(s->lights);
    s->lights = NULL;
    s->light_count = 0;
    s->environment.present = false;
}

bool preview_use_light_set(scene *s, int set, const scene_camera *view, preview_sky *sky, report *r)
{
    const light_set *const from = &sets[set];
    const int count = from->light_count + from->ring_count;
    const subject about = subject_of(s, view);
    const rig_axes axes = rig_axes_of(view);
    remove_lights(s);
    *sky = from->sky;
    s->lights = calloc((size_t)count + 1, sizeof *s->lights);
    if (s->lights == NULL)
        return report_error(r, "no memory for the light set \"%s\"", from->name);
    for (int i = 0; i < count; ++i) {
        s->lights[i] = i < from->light_count ? make_light(&from->lights[i], &axes, &about)
                                             : make_panel(i - from->light_count, from->ring_count, view, &about);
        s->lights[i].name = strdup(from->name);
        if (s->lights[i].name == NULL)
            return report_error(r, "no memory for the light set \"%s\"", from->name);
        ++s->light_count;
    }
    return true;
}
