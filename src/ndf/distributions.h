/* What ggx.c and beckmann.c provide to ndf.c; see ndf.h for what each function means. */
#ifndef NDF_DISTRIBUTIONS_H
#define NDF_DISTRIBUTIONS_H

#include "math/vec3.h"

float ggx_density(float alpha_x, float alpha_y, vec3 h);
float ggx_masked(float alpha_x, float alpha_y, vec3 v);
/* Of the area beyond slope r, w = sqrt(1 + alpha^2 r^2): what exceeds w times the projected area there (Beckmann: over
 * it). */
float ggx_tail_area(float alpha, float w);
vec3 ggx_sample_visible(float alpha_x, float alpha_y, vec3 wo, float u1, float u2);

float beckmann_density(float alpha_x, float alpha_y, vec3 h);
float beckmann_masked(float alpha_x, float alpha_y, vec3 v);
float beckmann_tail_area(float alpha, float w);
vec3 beckmann_sample_visible(float alpha_x, float alpha_y, vec3 wo, float u1, float u2);

#endif
