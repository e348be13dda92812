/* What a coat lets through: t = 1 - R, R at least what the coat reflects of light from one direction. */
#ifndef MODEL_LAYERED_COAT_H
#define MODEL_LAYERED_COAT_H

#include "model/model.h"

/* How far the facets of a coat bring a direction towards their horizon: the coat reflects no more of light from a
 * cosine c than one facet does at slant * c. In (0, 1]; 1: a mirror.
 *
 * measured  coat_measured_slant of the material
 */
float coat_slant(const struct glint_material *coat, float measured, const glint_surface *s);

/* The slant of a material whose normals come from a map and not from alpha; 0 for others. Takes milliseconds. */
float coat_measured_slant(const struct glint_material *coat);

/* t per channel for light from this cosine with the coat's normal, taken as 0 below the horizon. */
void coat_transmit(const model_query *coat, float slant, float cosine, float t[3]);

#endif
