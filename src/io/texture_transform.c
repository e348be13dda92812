/* KHR_texture_transform in double precision: (s, t) = offset + rotation * scale * (u, v). */
#include "io/texture_transform.h"

#include <math.h>

/* 2^15 images from the origin on an image of 2^14 texels still counts texels in 31 bits, filter included. */
static const double limit = 32768.0;

typedef struct matrix2 {
    double ss, st, ts, tt; /* ds = ss du + st dv, dt = ts du + tt dv */
} matrix2;

/* v points down, so the rotation that looks counter-clockwise takes (1, 0) to (cos, -sin): the extension's text says
 * counter-clockwise, and its example (a quarter turn, scale 1/2 and offset (0, 1) show the lower left quarter) holds
 * only so; the sign of the matrix in its first draft was a mistake (KhronosGroup/glTF issue 1563). */
static matrix2 rotation_times_scale(const scene_texture *which)
{
    const double u = (double)which->scale[0], v = (double)which->scale[1];
    if (which->rotation == 0.0F)
        return (matrix2){ u, 0.0, 0.0, v };
    const double c = cos((double)which->rotation), s = sin((double)which->rotation);
    return (matrix2){ c * u, s * v, -s * u, c * v };
}

static float wrap(double x, scene_wrap mode)
{
    if (!isfinite(x))
        return 0.0F;
    if (mode == SCENE_WRAP_CLAMP)
        return (float)fmin(fmax(x, -limit), limit);
    const double period = mode == SCENE_WRAP_MIRROR ? 2.0 : 1.0;
    /* A point just below the end rounds to the end, which is the start of the next period. */
    return fminf((float)(x - period * floor(x / period)), nextafterf((float)period, 0.0F));
}

/* fmin and fmax prefer a number to NaN. */
static float bounded(double derivative)
{
    return (float)fmax(fmin(derivative, limit), -limit);
}

texture_point texture_transform(const scene_texture *which, const texture_point *uv)
{
    const matrix2 m = rotation_times_scale(which);
    const double u = (double)uv->s, v = (double)uv->t;
    const double dudx = (double)uv->dsdx, dvdx = (double)uv->dtdx;
    const double dudy = (double)uv->dsdy, dvdy = (double)uv->dtdy;
    return (texture_point){
        .s = wrap(m.ss * u + m.st * v + (double)which->offset[0], which->wrap_s),
        .t = wrap(m.ts * u + m.tt * v + (double)which->offset[1], which->wrap_t),
        .dsdx = bounded(m.ss * dudx + m.st * dvdx),
        .dtdx = bounded(m.ts * dudx + m.tt * dvdx),
        .dsdy = bounded(m.ss * dudy + m.st * dvdy),
        .dtdy = bounded(m.ts * dudy + m.tt * dvdy),
    };
}
