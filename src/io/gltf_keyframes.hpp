// A value between its keyframes (glTF 2.0 section 3.11 and appendix C).
#ifndef IO_GLTF_KEYFRAMES_HPP
#define IO_GLTF_KEYFRAMES_HPP

#include <cstddef>
#include <vector>

enum class gltf_interpolation { step, linear, cubic_spline };

// components values a key, three times as many for cubic splines: its tangent before, itself, its tangent behind.
struct gltf_keyframes {
    const std::vector<float> *times, *values; // times increase; seconds
    gltf_interpolation interpolation;
    size_t components; // 3, or 4: a rotation, whose keys have a length
};

// The value at a time: that of the first key before it, that of the last one behind it. A rotation may have any length
// but zero.
void gltf_value_at(const gltf_keyframes &keys, double time_s, double *out);

#endif
