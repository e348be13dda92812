/* A round light seen as a cap of directions: point, spot and sun, when the distribution hardly changes across it. */
#ifndef LIGHT_CAP_H
#define LIGHT_CAP_H

/* Solid angle of half vectors that reflect some of the cap, sr: |Omega_i| / (4 h.wi), Kneiphof and Klein 2024, Eq. 20.
 * A half vector is at most 45 degrees from wi, up to rounding at opposite directions, where nothing is lit anyway. */
static inline float cap_half_vector_solid_angle(float solid_angle_sr, float h_dot_wi)
{
    return solid_angle_sr / (4.0F * (h_dot_wi > 1e-4F ? h_dot_wi : 1e-4F));
}

#endif
