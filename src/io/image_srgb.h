/* Pictures of linear light with multiplied alpha, to and from sRGB codes with straight alpha. */
#ifndef IO_IMAGE_SRGB_H
#define IO_IMAGE_SRGB_H

#include "io/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Codes in [0, 1] and straight alpha become linear light times alpha. alpha_channel: -1 where there is none. */
void image_from_srgb(image *i, int alpha_channel);

/* R, G, B and, where the picture has it, A as 3 or 4 bytes a pixel, after multiplication by 2^exposure_ev. Clips at
 * 255; NaN and negative light are 0. False when there is no R, G or B. */
bool image_to_srgb(const image *i, float exposure_ev, uint8_t *bytes);

#ifdef __cplusplus
}
#endif

#endif
