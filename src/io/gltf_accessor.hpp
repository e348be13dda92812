// Reads accessors: every byte inside its view, integers normalised, sparse elements in place, NaN and infinity refused.
#ifndef IO_GLTF_ACCESSOR_HPP
#define IO_GLTF_ACCESSOR_HPP

#include <cstdint>
#include <vector>

#include "io/gltf_file.hpp"

// Bits for the component types that a use of an accessor allows.
enum gltf_components : unsigned {
    GLTF_FLOAT = 1 << 0,
    GLTF_BYTE = 1 << 1,
    GLTF_UNSIGNED_BYTE = 1 << 2,
    GLTF_SHORT = 1 << 3,
    GLTF_UNSIGNED_SHORT = 1 << 4,
    GLTF_UNSIGNED_INT = 1 << 5,
    GLTF_BYTE_NORMALIZED = 1 << 6,
    GLTF_UNSIGNED_BYTE_NORMALIZED = 1 << 7,
    GLTF_SHORT_NORMALIZED = 1 << 8,
    GLTF_UNSIGNED_SHORT_NORMALIZED = 1 << 9
};

// How many components an element has: 1 to 4, 16 for a 4x4 matrix, 0 for smaller ones, which no use asks for.
int gltf_component_count(const tinygltf::Accessor &accessor);

// Throws unless the accessor has min to max components of one of the allowed types; user says what for.
void gltf_check_accessor(const gltf_file &file, int index, int min_components, int max_components, unsigned allowed,
                         const std::string &user);

// All elements, component by component. Integers become numbers, normalised ones lie in [0, 1] or [-1, 1].
std::vector<float> gltf_read_floats(gltf_file &file, int index);
// All elements of an accessor of unsigned integer scalars.
std::vector<uint32_t> gltf_read_integers(gltf_file &file, int index);

// What an integer of this component type is divided by when it is normalised (glTF 2.0 section 3.6.2.2); 1 for others.
float gltf_normalisation(int component_type);

#endif
