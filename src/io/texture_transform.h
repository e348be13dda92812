/* From the texture coordinates of a mesh to those of an image: KHR_texture_transform and the wrap modes. */
#ifndef IO_TEXTURE_TRANSFORM_H
#define IO_TEXTURE_TRANSFORM_H

#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A point on a texture, (0, 0) in the upper left corner and (1, 1) in the lower right one, and its change per pixel
 * step. */
typedef struct texture_point {
    float s, t;
    float dsdx, dtdx, dsdy, dtdy;
} texture_point;

/* Applies the transform of which to the point and its derivatives, in double, and moves a repeated or mirrored point
 * into the first period, where a float has texels to spare. All that comes out is finite and at most 2^15 large: a
 * coordinate that is NaN or infinite becomes 0, such a derivative the greatest one, which sees the mean of the image.
 */
texture_point texture_transform(const scene_texture *which, const texture_point *uv);

#ifdef __cplusplus
}
#endif

#endif
