// Accessors (glTF 2.0 section 3.6.2): typed views of buffers, with strides, sparse substitution and normalised
// integers.
#include "io/gltf_accessor.hpp"

#include <cmath>
#include <cstring>

namespace
{

std::string pointer_of(int index)
{
    return json_pointer("/accessors", static_cast<size_t>(index));
}

const tinygltf::Accessor &accessor_at(const gltf_file &file, int index)
{
    return file.model.accessors[static_cast<size_t>(index)];
}

size_t component_size(int component_type)
{
    switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    default:
        return 4;
    }
}

unsigned component_bit(const tinygltf::Accessor &accessor)
{
    switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return accessor.normalized ? GLTF_BYTE_NORMALIZED : GLTF_BYTE;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return accessor.normalized ? GLTF_UNSIGNED_BYTE_NORMALIZED : GLTF_UNSIGNED_BYTE;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return accessor.normalized ? GLTF_SHORT_NORMALIZED : GLTF_SHORT;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return accessor.normalized ? GLTF_UNSIGNED_SHORT_NORMALIZED : GLTF_UNSIGNED_SHORT;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return GLTF_UNSIGNED_INT;
    default:
        return GLTF_FLOAT;
    }
}

std::string component_text(const tinygltf::Accessor &accessor)
{
    static const char *const names[] = { "byte", "unsigned byte", "short", "unsigned short",
                                         "int",  "unsigned int",  "float" };
    return std::string(accessor.normalized ? "normalized " : "") +
           names[accessor.componentType - TINYGLTF_COMPONENT_TYPE_BYTE];
}

// A run of elements in memory.
struct element_view {
    const uint8_t *data;
    size_t stride;
};

// Elements of a buffer view from offset on; all of them lie inside.
element_view elements_of(const gltf_file &file, int view_index, size_t offset, size_t element_size, size_t count,
                         bool may_stride, const std::string &pointer)
{
    const tinygltf::BufferView &view = file.model.bufferViews[static_cast<size_t>(view_index)];
    const byte_view bytes = gltf_buffer_view(file, static_cast<size_t>(view_index));
    const size_t stride = view.byteStride > 0 && may_stride ? view.byteStride : element_size;
    if (stride < element_size)
        throw file_error(json_pointer("/bufferViews", static_cast<size_t>(view_index)) + "/byteStride",
                         "found " + std::to_string(stride) + ", expected at least the " + std::to_string(element_size) +
                             " bytes of an element of " + pointer);
    if (offset > bytes.size || bytes.size - offset < element_size ||
        // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): the schema leaves no type without components
        (bytes.size - offset - element_size) / stride < count - 1)
        throw file_error(pointer, "found " + std::to_string(count) + " elements of " + std::to_string(element_size) +
                                      " bytes from byte " + std::to_string(offset) +
                                      " on, expected them inside buffer view " + std::to_string(view_index) + " of " +
                                      std::to_string(bytes.size) + " bytes");
    return { bytes.data + offset, stride };
}

// The bytes of all elements, tightly packed, sparse ones substituted.
std::vector<uint8_t> packed_elements(gltf_file &file, int index)
{
    const tinygltf::Accessor &accessor = accessor_at(file, index);
    const std::string pointer = pointer_of(index);
    const size_t size = component_size(accessor.componentType) * static_cast<size_t>(gltf_component_count(accessor));
    if (accessor.count > file.elements_left)
        throw file_error(pointer, "found " + std::to_string(accessor.count) +
                                      " elements, which makes the geometry too large for the bytes of the file");
    file.elements_left -= accessor.count;
    element_view elements = { nullptr, 0 };
    if (accessor.bufferView >= 0)
        elements = elements_of(file, accessor.bufferView, accessor.byteOffset, size, accessor.count, true, pointer);
    if (elements.data && elements.stride == size)
        return std::vector<uint8_t>(elements.data, elements.data + accessor.count * size);
    std::vector<uint8_t> packed(accessor.count * size, 0);
    for (size_t i = 0; i < accessor.count && elements.data; i++)
        std::memcpy(&packed[i * size], elements.data + i * elements.stride, size);
    return packed;
}

uint32_t integer_at(const uint8_t *bytes, int component_type)
{
    uint32_t value = 0;
    std::memcpy(&value, bytes, component_size(component_type)); // little endian, as glTF is and as our machines are
    return value;
}

// glTF 2.0 section 3.6.2.3: indices increase strictly.
void substitute_sparse(const gltf_file &file, int index, std::vector<uint8_t> &packed)
{
    const tinygltf::Accessor &accessor = accessor_at(file, index);
    if (!accessor.sparse.isSparse)
        return;
    const std::string pointer = pointer_of(index) + "/sparse";
    const size_t count = static_cast<size_t>(accessor.sparse.count), size = packed.size() / accessor.count;
    if (count > accessor.count)
        throw file_error(pointer + "/count", "found " + std::to_string(count) +
                                                 ", expected at most the accessor's count of " +
                                                 std::to_string(accessor.count));
    const int index_type = accessor.sparse.indices.componentType;
    const element_view places =
        elements_of(file, accessor.sparse.indices.bufferView, static_cast<size_t>(accessor.sparse.indices.byteOffset),
                    component_size(index_type), count, false, pointer + "/indices");
    const element_view values =
        elements_of(file, accessor.sparse.values.bufferView, static_cast<size_t>(accessor.sparse.values.byteOffset),
                    size, count, false, pointer + "/values");
    int64_t previous = -1;
    for (size_t i = 0; i < count; i++) {
        const int64_t place = integer_at(places.data + i * places.stride, index_type);
        if (place <= previous || static_cast<size_t>(place) >= accessor.count)
            throw file_error(pointer + "/indices", "found " + std::to_string(place) + " at " + std::to_string(i) +
                                                       ", expected indices that increase and stay below " +
                                                       std::to_string(accessor.count));
        std::memcpy(&packed[static_cast<size_t>(place) * size], values.data + i * values.stride, size);
        previous = place;
    }
}

template <class T> void convert(const std::vector<uint8_t> &packed, float divisor, std::vector<float> &out)
{
    for (size_t i = 0; i < out.size(); i++) {
        T value;
        std::memcpy(&value, &packed[i * sizeof(T)], sizeof(T));
        // -128 / 127 and -32768 / 32767 lie below -1.
        out[i] = divisor > 1.0F ? std::max(static_cast<float>(value) / divisor, -1.0F) : static_cast<float>(value);
    }
}

template <class T> void widen(const std::vector<uint8_t> &packed, std::vector<uint32_t> &out)
{
    for (size_t i = 0; i < out.size(); i++) {
        T value;
        std::memcpy(&value, &packed[i * sizeof(T)], sizeof(T));
        out[i] = value;
    }
}

} // namespace

int gltf_component_count(const tinygltf::Accessor &accessor)
{
    switch (accessor.type) {
    case TINYGLTF_TYPE_SCALAR:
        return 1;
    case TINYGLTF_TYPE_VEC2:
    case TINYGLTF_TYPE_VEC3:
    case TINYGLTF_TYPE_VEC4:
        return accessor.type;
    case TINYGLTF_TYPE_MAT4:
        return 16;
    default:
        return 0;
    }
}

float gltf_normalisation(int component_type)
{
    switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return 127.0F;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 255.0F;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return 32767.0F;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 65535.0F;
    default:
        return 1.0F;
    }
}

void gltf_check_accessor(const gltf_file &file, int index, int min_components, int max_components, unsigned allowed,
                         const std::string &user)
{
    const tinygltf::Accessor &accessor = accessor_at(file, index);
    const int count = gltf_component_count(accessor);
    if (count < min_components || count > max_components)
        throw file_error(pointer_of(index),
                         "found elements of " + (count > 0 ? std::to_string(count) + " components" : "small matrices") +
                             ", expected " + std::to_string(min_components) +
                             (max_components > min_components ? " or " + std::to_string(max_components) : "") +
                             " for " + user);
    if ((component_bit(accessor) & allowed) == 0)
        throw file_error(pointer_of(index),
                         "found components of type " + component_text(accessor) + ", which " + user + " may not have");
}

std::vector<float> gltf_read_floats(gltf_file &file, int index)
{
    std::vector<uint8_t> packed = packed_elements(file, index);
    substitute_sparse(file, index, packed);
    const tinygltf::Accessor &accessor = accessor_at(file, index);
    std::vector<float> out(packed.size() / component_size(accessor.componentType));
    const float divisor = accessor.normalized ? gltf_normalisation(accessor.componentType) : 1.0F;
    switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        convert<int8_t>(packed, divisor, out);
        break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        convert<uint8_t>(packed, divisor, out);
        break;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        convert<int16_t>(packed, divisor, out);
        break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        convert<uint16_t>(packed, divisor, out);
        break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        convert<uint32_t>(packed, divisor, out);
        break;
    default:
        std::memcpy(out.data(), packed.data(), packed.size());
    }
    for (size_t i = 0; i < out.size(); i++)
        if (!std::isfinite(out[i]))
            throw file_error(pointer_of(index),
                             std::string("found ") + (std::isnan(out[i]) ? "NaN" : "infinity") + " in element " +
                                 // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): as above
                                 std::to_string(i / static_cast<size_t>(gltf_component_count(accessor))) +
                                 ", expected finite numbers");
    return out;
}

std::vector<uint32_t> gltf_read_integers(gltf_file &file, int index)
{
    std::vector<uint8_t> packed = packed_elements(file, index);
    substitute_sparse(file, index, packed);
    const int type = accessor_at(file, index).componentType;
    std::vector<uint32_t> out(packed.size() / component_size(type));
    if (component_size(type) == 1)
        widen<uint8_t>(packed, out);
    else if (component_size(type) == 2)
        widen<uint16_t>(packed, out);
    else
        std::memcpy(out.data(), packed.data(), packed.size());
    return out;
}
