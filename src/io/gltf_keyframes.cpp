// A value between its keyframes (glTF 2.0 section 3.11 and appendix C), in double.
#include "io/gltf_keyframes.hpp"

#include <algorithm>
#include <cmath>

namespace
{

// What a cubic spline keeps for a key, in this order.
enum class part : size_t { in_tangent, value, out_tangent };

const float *at(const gltf_keyframes &keys, size_t key, part which)
{
    if (keys.interpolation == gltf_interpolation::cubic_spline)
        return &(*keys.values)[(3 * key + static_cast<size_t>(which)) * keys.components];
    return &(*keys.values)[key * keys.components];
}

void copy_key(const gltf_keyframes &keys, size_t key, double *out)
{
    std::copy_n(at(keys, key, part::value), keys.components, out);
}

double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

void copy_rotation(const float *from, double *out)
{
    std::copy_n(from, 4, out);
    const double length = std::sqrt(dot(out, out));
    for (size_t i = 0; i < 4; i++)
        out[i] /= length;
}

// Appendix C.4, the shorter way round: weights sin(a (1 - t)) / sin a and sin(a t) / sin a for the angle a between.
void slerp(const float *from, const float *to, double t, double *out)
{
    double a[4], b[4];
    copy_rotation(from, a);
    copy_rotation(to, b);
    const double cosine = dot(a, b), side = cosine < 0.0 ? -1.0 : 1.0;
    const double angle = std::acos(std::min(std::abs(cosine), 1.0)), sine = std::sin(angle);
    const bool apart = sine > 1e-8; // below, the weights are 1 - t and t to the last bit of a double
    const double u = apart ? std::sin(angle * (1.0 - t)) / sine : 1.0 - t, v = apart ? std::sin(angle * t) / sine : t;
    for (size_t i = 0; i < 4; i++)
        out[i] = u * a[i] + side * v * b[i];
}

void linear(const gltf_keyframes &keys, size_t key, double t, double *out)
{
    const float *a = at(keys, key, part::value), *b = at(keys, key + 1, part::value);
    if (keys.components == 4)
        return slerp(a, b, t, out);
    for (size_t i = 0; i < keys.components; i++)
        out[i] = (1.0 - t) * static_cast<double>(a[i]) + t * static_cast<double>(b[i]);
}

// Appendix C.5. step is the time from key to key, by which the tangents are multiplied.
void cubic_spline(const gltf_keyframes &keys, size_t key, double t, double step, double *out)
{
    const float *a = at(keys, key, part::value), *leaving = at(keys, key, part::out_tangent),
                *b = at(keys, key + 1, part::value), *arriving = at(keys, key + 1, part::in_tangent);
    const double t2 = t * t, t3 = t2 * t;
    double length = 0.0;
    for (size_t i = 0; i < keys.components; i++) {
        out[i] = (2.0 * t3 - 3.0 * t2 + 1.0) * static_cast<double>(a[i]) +
                 step * (t3 - 2.0 * t2 + t) * static_cast<double>(leaving[i]) +
                 (3.0 * t2 - 2.0 * t3) * static_cast<double>(b[i]) +
                 step * (t3 - t2) * static_cast<double>(arriving[i]);
        length = std::hypot(length, out[i]);
    }
    // A spline of quaternions may pass through zero, which turns nowhere.
    if (keys.components == 4 && !(length > 0.0))
        copy_key(keys, key, out);
}

} // namespace

void gltf_value_at(const gltf_keyframes &keys, double time_s, double *out)
{
    const std::vector<float> &times = *keys.times;
    const auto next = std::upper_bound(times.begin(), times.end(), time_s,
                                       [](double t, float key) { return t < static_cast<double>(key); });
    if (next == times.begin())
        return copy_key(keys, 0, out);
    const size_t key = static_cast<size_t>(next - times.begin()) - 1;
    if (next == times.end() || keys.interpolation == gltf_interpolation::step)
        return copy_key(keys, key, out);
    const double start = static_cast<double>(times[key]), step = static_cast<double>(*next) - start;
    const double t = (time_s - start) / step;
    if (keys.interpolation == gltf_interpolation::linear)
        linear(keys, key, t, out);
    else
        cubic_spline(keys, key, t, step, out);
}
