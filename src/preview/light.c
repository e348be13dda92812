/* Lights have a size: it makes soft shadows and decides how many facets are lit. */
#define WIDE_LANES 1
#include "preview/light_lanes.h"

double light_cap_sr(double angular_radius_rad)
{
    const double half = sin(0.5 * angular_radius_rad);
    return 4.0 * PREVIEW_PI * half * half;
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
    l.sine = shape_sine(l.cosine > 0.0 ? sqrt(fmax(1.0 - l.cosine * l.cosine, 0.0)) : 1.0);
    l.solid_angle_sr = (float)clamp_cap(light_cap_sr(angle));

    /* KHR_lights_punctual, "Inner and Outer Cone Angles". */
    const double inner = cos((double)from->inner_cone_rad);
    const double outer = cos((double)from->outer_cone_rad);
    l.cone_scale = 1.0 / fmax(0.001, inner - outer);
    l.cone_offset = -outer * l.cone_scale;
    return l;
}

static bool set_irradiance(const light *l, double factor, light_view *out)
{
    bool is_any = false;
    for (int c = 0; c < 3; ++c) {
        out->irradiance[c] = (float)smaller_of((double)l->intensity[c] * factor, LIGHT_MOST_IRRADIANCE);
        is_any = is_any || out->irradiance[c] > 0.0F;
    }
    return is_any;
}

bool light_see(const light *l, vec3 position, light_view *out)
{
    wide_view v;
    light_see_wide(l, w3_splat(position), &v);
    out->wi = v3(v.wi.x, v.wi.y, v.wi.z);
    out->distance = v.distance;
    out->sine = v.sine;
    out->solid_angle_sr = (float)v.solid_angle_sr;
    return wide_any(v.is_seen) && set_irradiance(l, v.factor, out);
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
        const double r = sqrt(u[0]);
        turn_sine_cosine(u[1], &y, &x);
        x *= r;
        y *= r;
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
    const wide_view v = { .wi = { view->wi.x, view->wi.y, view->wi.z }, .distance = view->distance };
    wide3 towards;
    light_pick_wide(l, &v, w3_splat(position), u, &towards, distance);
    *direction = v3(towards.x, towards.y, towards.z);
}
