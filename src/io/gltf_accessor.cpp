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

size_t element_size_of(const tinygltf::Accessor &accessor)
{
    return component_size(accessor.componentType) * static_cast<size_t>(gltf_component_count(accessor));
}

// All elements where they lie in their buffer; without data, where they are zero.
element_view viewed_elements(gltf_file &file, int index)
{
    const tinygltf::Accessor &accessor = accessor_at(file, index);
    const std::string pointer = pointer_of(index);
    if (accessor.count > file.elements_left)
        throw file_error(pointer, "found " + std::to_string(accessor.count) +
                                      " elements, which makes the geometry too large for the bytes of the file");
    file.elements_left -= accessor.count;
    if (accessor.bufferView < 0)
        return { nullptr, 0 };
    return elements_of(file, accessor.bufferView, accessor.byteOffset, element_size_of(accessor), accessor.count, true,
                       pointer);
}

// The bytes of all elements, tightly packed.
std::vector<uint8_t> packed_elements(const tinygltf::Accessor &accessor, const element_view &elements)
{
    const size_t size = element_size_of(accessor);
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

// The elements of an accessor with sparse ones in their places: a view into its buffer, or into packed where there is
// none, or where something is substituted.
element_view complete_elements(gltf_file &file, int index, std::vector<uint8_t> &packed)
{
    const tinygltf::Accessor &accessor = accessor_at(file, index);
    const element_view elements = viewed_elements(file, index);
    if (elements.data && !accessor.sparse.isSparse)
        return elements;
    packed = packed_elements(accessor, elements);
    substitute_sparse(file, index, packed);
    return { packed.data(), element_size_of(accessor) };
}

template <class T> void convert(const element_view &elements, size_t components, float divisor, std::vector<float> &out)
{
    const uint8_t *element = elements.data;
    for (size_t first = 0; first < out.size(); first += components, element += elements.stride)
        for (size_t k = 0; k < components; k++) {
            T value;
            std::memcpy(&value, element + k * sizeof(T), sizeof(T));
            // -128 / 127 and -32768 / 32767 lie below -1.
            out[first + k] =
                divisor > 1.0F ? std::max(static_cast<float>(value) / divisor, -1.0F) : static_cast<float>(value);
        }
}

// Numbers of four bytes as they are. What lies side by side is copied as a whole, and a size that the compiler knows
// takes no call.
template <class T> void copy(const element_view &elements, size_t components, std::vector<T> &out)
{
    const uint8_t *element = elements.data;
    if (elements.stride == components * sizeof(T))
        std::memcpy(out.data(), element, out.size() * sizeof(T));
    else if (components == 3)
        for (size_t first = 0; first < out.size(); first += 3, element += elements.stride)
            std::memcpy(&out[first], element, 3 * sizeof(T));
    else
        for (size_t first = 0; first < out.size(); first += components, element += elements.stride)
            std::memcpy(&out[first], element, components * sizeof(T));
}

// Counts first, without a branch, and looks for the place only where there is one.
void check_finite(const std::vector<float> &numbers, size_t components, const std::string &pointer)
{
    uint32_t wrong = 0;
    for (const float x : numbers)
        wrong += std::isfinite(x) ? 0U : 1U;
    for (size_t i = 0; wrong > 0 && i < numbers.size(); i++)
        if (!std::isfinite(numbers[i]))
            throw file_error(
                pointer,
                std::string("found ") + (std::isnan(numbers[i]) ? "NaN" : "infinity") +
                    // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): the schema leaves no type without components
                    " in element " + std::to_string(i / components) + ", expected finite numbers");
}

template <class T> void widen(const element_view &elements, std::vector<uint32_t> &out)
{
    for (size_t i = 0; i < out.size(); i++) {
        T value;
        std::memcpy(&value, elements.data + i * elements.stride, sizeof(T));
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
    std::vector<uint8_t> packed;
    const element_view elements = complete_elements(file, index, packed);
    const tinygltf::Accessor &accessor = accessor_at(file, index);
    const size_t components = static_cast<size_t>(gltf_component_count(accessor));
    std::vector<float> out(accessor.count * components);
    const float divisor = accessor.normalized ? gltf_normalisation(accessor.componentType) : 1.0F;
    switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        convert<int8_t>(elements, components, divisor, out);
        break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        convert<uint8_t>(elements, components, divisor, out);
        break;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        convert<int16_t>(elements, components, divisor, out);
        break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        convert<uint16_t>(elements, components, divisor, out);
        break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        convert<uint32_t>(elements, components, divisor, out);
        break;
    default:
        copy(elements, components, out);
    }
    check_finite(out, components, pointer_of(index));
    return out;
}

std::vector<uint32_t> gltf_read_integers(gltf_file &file, int index)
{
    std::vector<uint8_t> packed;
    const element_view elements = complete_elements(file, index, packed);
    const int type = accessor_at(file, index).componentType;
    std::vector<uint32_t> out(accessor_at(file, index).count);
    if (component_size(type) == 1)
        widen<uint8_t>(elements, out);
    else if (component_size(type) == 2)
        widen<uint16_t>(elements, out);
    else
        copy(elements, 1, out);
    return out;
}
