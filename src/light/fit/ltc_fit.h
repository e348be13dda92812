/* The fit of a linearly transformed cosine to a microfacet lobe, for one roughness and one view: what light/ltc_table.c
 * holds. A program of the house, not a part of the library. */
#ifndef LIGHT_FIT_LTC_FIT_H
#define LIGHT_FIT_LTC_FIT_H

enum { LTC_FIT_GGX = 0, LTC_FIT_BECKMANN };

enum { LTC_FIT_SIDE = 32 };

/* along = p0 (cos^2 + alpha^2) / (2 alpha cos), shift = p1 alpha / (2 cos), across = p2 / (2 alpha): the numbers p are
 * near one for every roughness and view, so that what is between the grid's points is near their straight line. */
typedef struct ltc_fit {
    double p[3];
    double albedo;   /* directional albedo with F = 1 */
    double schlick;  /* the same with F = (1 - h.wi)^5 */
    double facets;   /* D_PR of Kneiphof and Klein 2024, Eq. 19 */
    double residual; /* half of the integral of |lobe / albedo - fit|: the share that lies elsewhere */
} ltc_fit;

/* Points of the grid, 0 to LTC_FIT_SIDE - 1: the table is looked up at exactly those that it was made for. */
double ltc_fit_alpha(int i);
double ltc_fit_cosine(int j);

/* The row for one roughness, from the view along the normal to a grazing one; each fit starts from the one before. */
void ltc_fit_row(int distribution, double alpha, ltc_fit row[LTC_FIT_SIDE]);

#endif
