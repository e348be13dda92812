/* Transfer and reflection of ray differentials: H. Igehy, "Tracing Ray Differentials", SIGGRAPH 1999. */
#include "preview/differential.h"

differential differential_scale(const differential *d, double s)
{
    return (differential){ v3_scale(d->origin_dx, s), v3_scale(d->origin_dy, s), v3_scale(d->direction_dx, s),
                           v3_scale(d->direction_dy, s) };
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
