/* Lights have a size: it makes soft shadows and decides how many facets are lit. */
#include "preview/light.h"

/* The cap may not cover the hemisphere: a hair less than 2 pi, so that single precision stays below it too. */
#define LARGEST_CAP (2.0 * PREVIEW_PI * (1.0 - 1e-6))
/* A light without size would light no facet: an angular radius of 1e-5 rad, a 50th of a planet's disc. Taste. */
#define SMALLEST_ANGLE 1e-5
#define SMALLEST_CAP (PREVIEW_PI * SMALLEST_ANGLE * SMALLEST_ANGLE)

double light_cap_sr(double angular_radius_rad)
{
    const double half = sin(0.5 * angular_radius_rad);
    return 4.0 * PREVIEW_PI * half * half;
}

static double clamp_cap(double solid_angle)
{
    return smaller_of(larger_of(solid_angle, SMALLEST_CAP), LARGEST_CAP);
}

/* The same as light_cap_sr(asin(sine)): 1 - sqrt(1 - s^2) = s^2 / (1 + sqrt(1 - s^2)). */
static double cap_of_sine(double sine)
{
    const double square = sine * sine;
    return 2.0 * PREVIEW_PI * square / (1.0 + sqrt(1.0 - square));
}

/* EXT_lights_area: upright in the plane of the node's x and y, shining along -z. */
static void set_shape(light *l, const scene_light *from, const double m[16])
{
    const vec3 along = v3_reject(m4_column(m, 0), l->axis);
    const vec3 x = v3_dot(along, along) > 0.0 ? v3_normalize(along) : v3_any_tangent(l->axis);
    l->half_x = v3_scale(x, 0.5 * (double)from->width_m);
    l->half_y = v3_scale(v3_cross(x, l->axis), 0.5 * (double)from->height_m);
}

light light_make(const scene_light *from)
{
    double m[16];
    for (int i = 0; i < 16; ++i)
        m[i] = (double)from->to_world[i];
    light l = { .kind = from->kind, .position = m4_column(m, 3), .axis = v3_normalize(m4_column(m, 2)) };
    for (int c = 0; c < 3; ++c)
        l.intensity[c] = from->color[c] * from->intensity;
    l.range = from->range > 0.0F ? (double)from->range : (double)INFINITY;
    l.radius = (double)from->radius_m;
    set_shape(&l, from, m);

    const double angle = 0.5 * fmin((double)from->angular_diameter_rad, PREVIEW_PI);
    l.cosine = cos(angle);
    l.solid_angle_sr = (float)clamp_cap(light_cap_sr(angle));

    /* KHR_lights_punctual, "Inner and Outer Cone Angles". */
    const double inner = cos((double)from->inner_cone_rad);
    const double outer = cos((double)from->outer_cone_rad);
    l.cone_scale = 1.0 / fmax(0.001, inner - outer);
    l.cone_offset = -outer * l.cone_scale;
    return l;
}

/* What a light that is seen as a shape may be: neither a point nor half of all directions. */
static double shape_sine(double sine)
{
    return sine > SMALLEST_ANGLE && sine < 1.0 ? sine : 0.0;
}

static double spot_factor(const light *l, vec3 wi)
{
    const double t = smaller_of(larger_of(v3_dot(l->axis, wi) * l->cone_scale + l->cone_offset, 0.0), 1.0);
    return t * t;
}

/* max(min(1 - (d / range)^4, 1), 0): KHR_lights_punctual, "Range Property". */
static double range_factor(double distance, double range)
{
    const double ratio = distance / range;
    const double square = ratio * ratio;
    return larger_of(1.0 - square * square, 0.0);
}

/* On a point that all but lies in the light: what is added up of it is still a number. */
static const double MOST_IRRADIANCE = 1e30;

static bool set_irradiance(const light *l, double factor, light_view *out)
{
    bool is_any = false;
    for (int c = 0; c < 3; ++c) {
        out->irradiance[c] = (float)smaller_of((double)l->intensity[c] * factor, MOST_IRRADIANCE);
        is_any = is_any || out->irradiance[c] > 0.0F;
    }
    return is_any;
}

bool light_see(const light *l, vec3 position, light_view *out)
{
    if (l->kind == SCENE_LIGHT_DIRECTIONAL) {
        out->wi = l->axis;
        out->distance = (double)INFINITY;
        out->sine = shape_sine(l->cosine > 0.0 ? sqrt(fmax(1.0 - l->cosine * l->cosine, 0.0)) : 1.0);
        out->solid_angle_sr = l->solid_angle_sr;
        return set_irradiance(l, 1.0, out);
    }
    const vec3 towards = v3_sub(l->position, position);
    const double distance = v3_length(towards);
    if (!(distance > 0.0))
        return false;
    out->wi = v3_scale(towards, 1.0 / distance);
    out->distance = distance;
    if (light_is_area(l)) {
        out->solid_angle_sr = 0.0F;
        out->sine = 0.0;
        return v3_dot(towards, l->axis) > 0.0 && set_irradiance(l, 1.0, out);
    }
    /* A sphere of radius r: sin of its angular radius is r / d. Inside it, the cap is held below a hemisphere. */
    const double sine = smaller_of(l->radius / distance, 1.0);
    out->sine = shape_sine(sine);
    out->solid_angle_sr = (float)clamp_cap(cap_of_sine(sine));
    const double cone = l->kind == SCENE_LIGHT_SPOT ? spot_factor(l, out->wi) : 1.0;
    return set_irradiance(l, cone * range_factor(distance, l->range) / (distance * distance), out);
}

bool light_see_round(const light *l, vec3 position, light_view *out)
{
    const vec3 towards = v3_sub(l->position, position);
    const double distance = v3_length(towards), x = v3_length(l->half_x), y = v3_length(l->half_y);
    const double reach = l->kind == SCENE_LIGHT_DISK ? larger_of(x, y) : sqrt(x * x + y * y);
    if (!(distance > reach))
        return false;
    out->wi = v3_scale(towards, 1.0 / distance);
    out->distance = distance;
    out->sine = reach / distance;
    const double cosine = v3_dot(out->wi, l->axis), solid_angle = light_area_m2(l) * cosine / (distance * distance);
    if (!(cosine > 0.0))
        return false;
    out->solid_angle_sr = (float)clamp_cap(solid_angle);
    return set_irradiance(l, solid_angle, out);
}

/* Over a disk of the sine s the mean of z / d^3 differs by s^2 (1.875 sin^2 - .75) of its middle, and the receiver's
 * cosine adds as much again. */
double light_round_error(const light *l, const light_view *view)
{
    return light_is_area(l) ? 2.0 * view->sine * view->sine : 0.0;
}

double light_radiance_per_irradiance(const light_view *view)
{
    /* The cosine's integral over a cap around the normal is pi sin^2. */
    return 1.0 / (PREVIEW_PI * view->sine * view->sine);
}

vec3 light_point(const light *l, const double u[2])
{
    double x = 2.0 * u[0] - 1.0, y = 2.0 * u[1] - 1.0;
    if (l->kind == SCENE_LIGHT_DISK) {
        const double r = sqrt(u[0]), angle = 2.0 * PREVIEW_PI * u[1];
        x = r * cos(angle);
        y = r * sin(angle);
    }
    return v3_mad(v3_mad(l->position, l->half_x, x), l->half_y, y);
}

double light_area_m2(const light *l)
{
    const double square = 4.0 * v3_length(l->half_x) * v3_length(l->half_y);
    return l->kind == SCENE_LIGHT_DISK ? 0.25 * PREVIEW_PI * square : square;
}

void light_pick(const light *l, const light_view *view, vec3 position, const double u[2], vec3 *direction,
                double *distance)
{
    const bool is_far = l->kind == SCENE_LIGHT_DIRECTIONAL;
    if (!light_is_soft(l)) {
        const vec3 towards = is_far ? l->axis : v3_sub(l->position, position);
        *distance = is_far ? (double)INFINITY : v3_length(towards);
        *direction = is_far ? towards : v3_scale(towards, 1.0 / *distance);
        return;
    }
    const vec3 tangent = v3_any_tangent(view->wi);
    const vec3 bitangent = v3_cross(view->wi, tangent);
    const double angle = 2.0 * PREVIEW_PI * u[1];
    if (is_far) {
        const double cosine = 1.0 - u[0] * (1.0 - l->cosine); /* even over the cap */
        const double sine = sqrt(larger_of(1.0 - cosine * cosine, 0.0));
        const vec3 side = v3_mad(v3_scale(tangent, cos(angle) * sine), bitangent, sin(angle) * sine);
        *direction = v3_normalize(v3_mad(side, view->wi, cosine));
        *distance = (double)INFINITY;
        return;
    }
    /* Even over the disc that faces the point; from within the sphere, its centre. */
    const double r = l->radius < view->distance ? l->radius * sqrt(u[0]) : 0.0;
    const vec3 side = v3_mad(v3_scale(tangent, cos(angle) * r), bitangent, sin(angle) * r);
    const vec3 towards = v3_sub(v3_add(l->position, side), position);
    *distance = v3_length(towards);
    *direction = v3_scale(towards, 1.0 / *distance);
}
