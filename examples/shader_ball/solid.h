/* Triangles from profiles: turned on a lathe or drawn out to a sheet, with texture coordinates in metres. */
#ifndef SHADER_BALL_SOLID_H
#define SHADER_BALL_SOLID_H

#include <stdint.h>

#include "glb.h"
#include "profile.h"

/* Turns the profile around the upward axis (y); its outward axis is +z at the front. Tangents run around the axis, as
 * the lines do that a lathe leaves. u is metres around the axis, v metres along the profile. u is cut into charts,
 * rings in which the radius varies by a quarter at most, so that a metre of u is a metre of surface within 12 %. */
void solid_turn(glb_mesh *mesh, const profile *p, int segments);

/* Draws the profile out along x, from -half_width to half_width; its outward axis is +z. Tangents are +x. */
void solid_draw_out(glb_mesh *mesh, const profile *p, double half_width, int segments);

#endif
