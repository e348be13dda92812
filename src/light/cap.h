/* A round light seen as a cap of directions: point, spot and sun, when the distribution hardly changes across it. */
#ifndef LIGHT_CAP_H
#define LIGHT_CAP_H

/* Solid angle of half vectors that reflect some of the cap, sr: |Omega_i| / (4 h.wi), Kneiphof and Klein 2024, Eq. 20.
 * h.wi vanishes where both directions graze the surface opposite each other; the bound only keeps the quotient a float,
 * times the largest D too. */
static inline float cap_half_vector_solid_angle(float solid_angle_sr, float h_dot_wi)
{
    return solid_angle_sr / (4.0F * (h_dot_wi > 1e-30F ? h_dot_wi : 1e-30F));
}

#endif
