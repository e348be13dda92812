/* Pixels for a web page: half floats, deflated, in base64. page_pixels_zlib.c alone includes zlib. */
#ifndef COMPARE_PAGE_PIXELS_H
#define COMPARE_PAGE_PIXELS_H

#include "compare/pair.h"

/* All low bytes of R, then of G and B, then all high bytes: bytes of a kind pack better side by side. Row 0 on top. The
 * caller frees; NULL without memory. */
char *page_pixels(const image *i, const pair_colors *colors);

#endif
