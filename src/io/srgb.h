/* The sRGB transfer function (IEC 61966-2-1), between what a byte stores and what light adds up. */
#ifndef IO_SRGB_H
#define IO_SRGB_H

#ifdef __cplusplus
extern "C" {
#endif

/* Both map [0, 1] to [0, 1]. */
double srgb_decode(double encoded);
double srgb_encode(double linear);

#ifdef __cplusplus
}
#endif

#endif
