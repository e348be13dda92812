/* Affine transforms: from axes to a matrix, and a matrix inverted by cofactors. */
#include "preview/vector.h"

bool m4_invert_affine(const double m[16], double inverse[16])
{
    const vec3 a = m4_column(m, 0);
    const vec3 b = m4_column(m, 1);
    const vec3 c = m4_column(m, 2);
    const vec3 rows[3] = { v3_cross(b, c), v3_cross(c, a), v3_cross(a, b) };
    const double determinant = v3_dot(a, rows[0]);

    /* Relative to the volume of a box with the same edges: a tiny object is no flat one. The entries are floats, so a
     * volume below their rounding carries no information. */
    const double box = v3_length(a) * v3_length(b) * v3_length(c);
    if (!isfinite(determinant) || !(fabs(determinant) > 1e-9 * box))
        return false;

    for (int row = 0; row < 3; ++row) {
        const vec3 r = v3_scale(rows[row], 1.0 / determinant);
        inverse[row] = r.x;
        inverse[4 + row] = r.y;
        inverse[8 + row] = r.z;
        inverse[12 + row] = -v3_dot(r, m4_column(m, 3));
        inverse[4 * row + 3] = 0.0;
    }
    inverse[15] = 1.0;
    return true;
}

void m4_from_axes(vec3 x, vec3 y, vec3 z, vec3 origin, float m[16])
{
    const vec3 columns[4] = { x, y, z, origin };
    for (size_t c = 0; c < 4; ++c) {
        m[4 * c] = (float)columns[c].x;
        m[4 * c + 1] = (float)columns[c].y;
        m[4 * c + 2] = (float)columns[c].z;
        m[4 * c + 3] = c == 3 ? 1.0F : 0.0F;
    }
}
