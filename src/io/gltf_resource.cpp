// Bytes from outside the JSON text: data URIs, files beside the glTF file, the BIN chunk. No path leaves the folder.
#include "io/gltf_file.hpp"

#include <array>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "io/scene_memory.hpp"

namespace
{

// Our choice: more than any scene that fits a workstation.
constexpr uint64_t max_buffer_bytes = uint64_t{ 1 } << 34;
// A file may share data between primitives, and Draco packs a vertex into less than a byte. Past this it is not a scene
// but a bomb.
constexpr uint64_t elements_per_byte = 64, free_elements = uint64_t{ 1 } << 20;

struct released {
    void operator()(char *text) const
    {
        std::free(text);
    }
};

int base64_value(char c)
{
    if (c >= 'A' && c <= 'Z')
        return c - 'A';
    if (c >= 'a' && c <= 'z')
        return c - 'a' + 26;
    if (c >= '0' && c <= '9')
        return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

// RFC 4648 section 4, padding required.
std::vector<uint8_t> base64_decode(std::string_view text, const std::string &pointer)
{
    if (text.size() % 4 != 0)
        throw file_error(pointer,
                         "found base64 of " + std::to_string(text.size()) + " characters, expected a multiple of 4");
    const size_t end = text.find_last_not_of('=');
    const size_t length = end == text.npos ? 0 : end + 1;
    if (text.size() - length > 2)
        throw file_error(pointer, "found base64 with more than two \"=\" at its end");
    std::vector<uint8_t> bytes;
    bytes.reserve(length * 3 / 4);
    uint32_t bits = 0;
    for (size_t i = 0; i < length; i++) {
        const int value = base64_value(text[i]);
        if (value < 0)
            throw file_error(pointer,
                             "found a character that is not base64 at place " + std::to_string(i) + " of the data");
        bits = bits << 6 | static_cast<uint32_t>(value);
        if (i % 4 != 0)
            bytes.push_back(static_cast<uint8_t>(bits >> (6 - 2 * (i % 4))));
    }
    return bytes;
}

bool is_data_uri(const std::string &uri)
{
    return uri.compare(0, 5, "data:") == 0;
}

std::vector<uint8_t> data_uri_bytes(const std::string &uri, const std::string &pointer)
{
    const size_t comma = uri.find(',');
    constexpr std::string_view marker = ";base64";
    if (comma == uri.npos || comma < marker.size() ||
        std::string_view(uri).substr(comma - marker.size(), marker.size()) != marker)
        throw file_error(pointer, "found a data URI without \";base64,\"");
    return base64_decode(std::string_view(uri).substr(comma + 1), pointer);
}

int hexadecimal_value(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

// A percent sign that starts no escape stands for itself: exporters forget to encode it.
std::string percent_decode(const std::string &uri)
{
    std::string text;
    for (size_t i = 0; i < uri.size(); i++) {
        const int high = i + 2 < uri.size() && uri[i] == '%' ? hexadecimal_value(uri[i + 1]) : -1;
        const int low = high >= 0 ? hexadecimal_value(uri[i + 2]) : -1;
        if (low < 0) {
            text += uri[i];
        } else {
            text += static_cast<char>(high * 16 + low);
            i += 2;
        }
    }
    return text;
}

// RFC 3986 section 3.1: letters, digits, + - . up to a colon.
bool has_scheme(const std::string &uri)
{
    const size_t end = uri.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-.");
    return end != uri.npos && end > 0 && uri[end] == ':';
}

bool climbs(const std::string &path)
{
    for (size_t start = 0; start <= path.size();) {
        const size_t end = std::min(path.find('/', start), path.size());
        if (path.compare(start, end - start, "..") == 0)
            return true;
        start = end + 1;
    }
    return false;
}

// A symbolic link may lead out where the text of the path does not.
bool leads_out(const std::string &folder, const std::string &path)
{
    const std::unique_ptr<char, released> inside(realpath(folder.c_str(), nullptr)),
        target(realpath(path.c_str(), nullptr));
    if (!inside || !target)
        return false;
    const std::string prefix = std::string(inside.get()) + (std::strcmp(inside.get(), "/") == 0 ? "" : "/");
    return std::string(target.get()).compare(0, prefix.size(), prefix) != 0;
}

std::vector<uint8_t> buffer_from_uri(const gltf_file &file, const std::string &uri, const std::string &pointer)
{
    if (is_data_uri(uri))
        return data_uri_bytes(uri, pointer);
    try {
        return file_bytes(gltf_path_of_uri(file, uri, pointer), max_buffer_bytes);
    } catch (const file_error &e) {
        throw file_error(pointer, e.place.empty() ? uri + " " + e.text : e.text);
    }
}

void check_length(size_t found, size_t expected, const std::string &pointer)
{
    if (found < expected)
        throw file_error(pointer, "found " + std::to_string(found) + " bytes of data, expected the " +
                                      std::to_string(expected) + " that byteLength says");
}

char *image_name(const std::string &path, const std::string &pointer)
{
    return scene_string(path.empty() ? pointer : path);
}

void read_image(const gltf_file &file, const json &image, const std::string &pointer, uint64_t &budget, scene *s)
{
    const bool has_uri = image.contains("uri"), has_view = image.contains("bufferView");
    if (has_uri == has_view)
        throw file_error(pointer, std::string("found ") + (has_uri ? "both" : "neither") +
                                      " \"uri\" and \"bufferView\", expected one of them");
    scene_image *out = scene_append(&s->images, &s->image_count);
    const std::string uri = has_uri ? image["uri"].get<std::string>() : "";
    if (has_uri && !is_data_uri(uri)) {
        const std::string path = gltf_path_of_uri(file, uri, json_pointer(pointer, "uri"));
        out->path = scene_string(path);
        out->name = image_name(path, pointer);
        return;
    }
    std::vector<uint8_t> decoded;
    byte_view bytes;
    if (has_uri) {
        decoded = data_uri_bytes(uri, json_pointer(pointer, "uri"));
        bytes = { decoded.data(), decoded.size() };
    } else {
        bytes = gltf_buffer_view(file, image["bufferView"].get<size_t>());
        if (bytes.size > budget)
            throw file_error(pointer, "found images that share one buffer view more than four times over");
        budget -= bytes.size;
    }
    out->name = image_name("", file.path + ": " + pointer);
    out->bytes = scene_array(bytes.data, bytes.size);
    out->byte_count = bytes.size;
}

} // namespace

std::string gltf_path_of_uri(const gltf_file &file, const std::string &uri, const std::string &pointer)
{
    const std::string quoted = json_excerpt(json(uri));
    if (has_scheme(uri))
        throw file_error(pointer,
                         "found the absolute URI " + quoted + ", expected a path relative to the file's folder");
    const std::string relative = percent_decode(uri);
    if (relative.empty() || relative[0] == '/' || relative.find('\0') != relative.npos)
        throw file_error(pointer, "found the URI " + quoted + ", expected a path relative to the file's folder");
    std::string path = file.folder + "/" + relative;
    if (climbs(relative) || leads_out(file.folder, path))
        throw file_error(pointer, "found the URI " + quoted + ", which leaves the file's folder");
    return path;
}

void gltf_load_buffers(gltf_file &file, const json &root, byte_view bin, bool has_bin)
{
    const auto buffers = root.find("buffers");
    const size_t count = buffers == root.end() ? 0 : buffers->size();
    uint64_t total = 0;
    for (size_t i = 0; i < count; i++) {
        const json &buffer = (*buffers)[i];
        const std::string pointer = json_pointer("/buffers", i);
        const size_t length = buffer["byteLength"].get<size_t>();
        byte_view bytes = bin;
        if (buffer.contains("uri")) {
            file.storage.push_back(
                buffer_from_uri(file, buffer["uri"].get<std::string>(), json_pointer(pointer, "uri")));
            bytes = { file.storage.back().data(), file.storage.back().size() };
        } else if (i != 0 || !has_bin) {
            throw file_error(pointer,
                             "found no \"uri\", expected one: only the first buffer of a .glb may use its BIN chunk");
        }
        check_length(bytes.size, length, pointer);
        file.buffers.push_back({ bytes.data, length });
        total += bytes.size;
        if (total > max_buffer_bytes)
            throw file_error(pointer, "found more than " + std::to_string(max_buffer_bytes) +
                                          " bytes of buffers, the most that is read");
    }
    file.elements_left = free_elements + elements_per_byte * total;
}

void gltf_read_images(const gltf_file &file, const json &images, scene *s)
{
    uint64_t budget = 0;
    for (const byte_view &buffer : file.buffers)
        budget += 4 * buffer.size;
    for (size_t i = 0; i < images.size(); i++)
        read_image(file, images[i], json_pointer("/images", i), budget, s);
}

byte_view gltf_buffer_view(const gltf_file &file, size_t index)
{
    const tinygltf::BufferView &view = file.model.bufferViews[index];
    const byte_view buffer = file.buffers[static_cast<size_t>(view.buffer)];
    if (view.byteOffset > buffer.size || view.byteLength > buffer.size - view.byteOffset)
        throw file_error(json_pointer("/bufferViews", index),
                         "found bytes " + std::to_string(view.byteOffset) + " to " +
                             std::to_string(view.byteOffset + view.byteLength) + ", expected them inside buffer " +
                             std::to_string(view.buffer) + " of " + std::to_string(buffer.size) + " bytes");
    return { buffer.data + view.byteOffset, view.byteLength };
}
