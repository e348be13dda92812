/* A round light seen as a cap of directions: point, spot and sun, when the distribution hardly changes across it. In
 * lanes. */
#ifndef LIGHT_CAP_H
#define LIGHT_CAP_H

#include "math/lanes.h"

/* Solid angle of half vectors that reflect some of the cap, sr: |Omega_i| / (4 h.wi), Kneiphof and Klein 2024, Eq. 20.
 * h.wi vanishes where both directions graze the surface opposite each other; the bound only keeps the quotient a float,
 * times the largest D too. */
static inline vfloat cap_half_vector_solid_angle(vfloat solid_angle_sr, vfloat h_dot_wi)
{
    return solid_angle_sr / (4.0F * max_f(h_dot_wi, splat(1e-30F)));
}

#endif
