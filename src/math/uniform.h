/* Uniforms that are used twice: for a choice first, then for what was chosen. */
#ifndef MATH_UNIFORM_H
#define MATH_UNIFORM_H

/* Takes the share `from` to `to` of the uniform's range: what is left of it is uniform in [0, 1) again. */
static inline float uniform_within(float u, float from, float to)
{
    const float rest = (u - from) / (to - from);
    return rest < 0.0F ? 0.0F : rest < 0.99999994F ? rest : 0.99999994F;
}

#endif
