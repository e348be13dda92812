/* Transfer and reflection of ray differentials: H. Igehy, "Tracing Ray Differentials", SIGGRAPH 1999. */
#include "preview/differential.h"

/* Below this cosine the plane is edge-on at any pixel size; it keeps steps finite. Taste. */
#define SMALLEST_COSINE 1e-6

differential differential_scale(const differential *d, double s)
{
    return (differential){ v3_scale(d->origin_dx, s), v3_scale(d->origin_dy, s), v3_scale(d->direction_dx, s),
                           v3_scale(d->direction_dy, s) };
}

static vec3 transfer_step(vec3 origin_step, vec3 direction_step, vec3 direction, double distance, vec3 normal)
{
    const vec3 step = v3_mad(origin_step, direction_step, distance);
    const double cosine = v3_dot(direction, normal);
    const double safe = copysign(larger_of(fabs(cosine), SMALLEST_COSINE), cosine);
    return v3_mad(step, direction, -v3_dot(step, normal) / safe);
}

surface_step differential_transfer(const differential *d, vec3 direction, double distance, vec3 normal)
{
    return (surface_step){ transfer_step(d->origin_dx, d->direction_dx, direction, distance, normal),
                           transfer_step(d->origin_dy, d->direction_dy, direction, distance, normal) };
}

/* d/dx of D - 2 (D.N) N */
static vec3 reflect_step(vec3 direction_step, vec3 direction, vec3 normal, vec3 normal_step)
{
    const double cosine = v3_dot(direction, normal);
    const double cosine_step = v3_dot(direction_step, normal) + v3_dot(direction, normal_step);
    return v3_mad(v3_mad(direction_step, normal_step, -2.0 * cosine), normal, -2.0 * cosine_step);
}

differential differential_reflect(const differential *d, vec3 direction, vec3 normal, const surface_step *point,
                                  const surface_step *normal_step)
{
    return (differential){ point->dx, point->dy, reflect_step(d->direction_dx, direction, normal, normal_step->dx),
                           reflect_step(d->direction_dy, direction, normal, normal_step->dy) };
}

void differential_widen(differential *d, vec3 direction, double solid_angle_sr)
{
    /* The parallelogram of the two steps is the solid angle that d stands for. */
    const double carried = v3_length(v3_cross(d->direction_dx, d->direction_dy));
    if (!(solid_angle_sr > carried))
        return;
    const double side = sqrt(solid_angle_sr);
    const vec3 tangent = v3_any_tangent(direction);
    d->direction_dx = v3_scale(tangent, side);
    d->direction_dy = v3_scale(v3_cross(direction, tangent), side);
}

double differential_half_vector_variance(const differential *d, const surface_step *normal_step)
{
    /* A box of width w has the variance w^2 / 12; the mean of the two axes. */
    const vec3 dx = v3_mad(normal_step->dx, d->direction_dx, 0.5);
    const vec3 dy = v3_mad(normal_step->dy, d->direction_dy, 0.5);
    return (v3_dot(dx, dx) + v3_dot(dy, dy)) / 24.0;
}
