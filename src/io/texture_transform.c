/* KHR_texture_transform in double precision: (s, t) = offset + rotation * scale * (u, v). */
#include "io/texture_transform.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/* 2^15 images from the origin on an image of 2^14 texels still counts texels in 31 bits, filter included. */
static const double limit = 32768.0;

/* By bits, since a mesh may hold any: converting a signalling NaN would raise an exception. */
static double number_or(float x, float other)
{
    uint32_t bits, instead;
    memcpy(&bits, &x, sizeof bits);
    memcpy(&instead, &other, sizeof instead);
    bits = (bits & 0x7f800000U) == 0x7f800000U ? instead : bits;
    memcpy(&x, &bits, sizeof x);
    return (double)x;
}

typedef struct matrix2 {
    double ss, st, ts, tt; /* ds = ss du + st dv, dt = ts du + tt dv */
} matrix2;

/* v points down, so the rotation that looks counter-clockwise takes (1, 0) to (cos, -sin): the extension's text says
 * counter-clockwise, and its example (a quarter turn, scale 1/2 and offset (0, 1) show the lower left quarter) holds
 * only so; the sign of the matrix in its first draft was a mistake (KhronosGroup/glTF issue 1563). */
static matrix2 rotation_times_scale(const scene_texture *which)
{
    const double u = number_or(which->scale[0], 1.0F), v = number_or(which->scale[1], 1.0F);
    const double turn = number_or(which->rotation, 0.0F);
    if (turn == 0.0)
        return (matrix2){ u, 0.0, 0.0, v };
    const double c = cos(turn), s = sin(turn);
    return (matrix2){ c * u, s * v, -s * u, c * v };
}

static float wrap(double x, scene_wrap mode)
{
    if (mode == SCENE_WRAP_CLAMP)
        return (float)fmin(fmax(x, -limit), limit);
    const double period = mode == SCENE_WRAP_MIRROR ? 2.0 : 1.0;
    /* A point just below the end rounds to the end, which is the start of the next period. */
    return fminf((float)(x - period * floor(x / period)), nextafterf((float)period, 0.0F));
}

static float bounded(double derivative)
{
    return (float)fmax(fmin(derivative, limit), -limit);
}

texture_point texture_transform(const scene_texture *which, const texture_point *uv)
{
    const matrix2 m = rotation_times_scale(which);
    const double u = number_or(uv->s, 0.0F), v = number_or(uv->t, 0.0F);
    const double dudx = number_or(uv->dsdx, FLT_MAX), dvdx = number_or(uv->dtdx, FLT_MAX);
    const double dudy = number_or(uv->dsdy, FLT_MAX), dvdy = number_or(uv->dtdy, FLT_MAX);
    return (texture_point){
        .s = wrap(m.ss * u + m.st * v + number_or(which->offset[0], 0.0F), which->wrap_s),
        .t = wrap(m.ts * u + m.tt * v + number_or(which->offset[1], 0.0F), which->wrap_t),
        .dsdx = bounded(m.ss * dudx + m.st * dvdx),
        .dtdx = bounded(m.ts * dudx + m.tt * dvdx),
        .dsdy = bounded(m.ss * dudy + m.st * dvdy),
        .dtdy = bounded(m.ts * dudy + m.tt * dvdy),
    };
}
