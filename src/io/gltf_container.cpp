// Reads whole files and takes .glb apart: header, JSON chunk, BIN chunk (glTF 2.0 section 4.4).
#include "io/gltf_container.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <sys/stat.h>

#include "io/file_error.hpp"

namespace
{

constexpr uint32_t glb_magic = 0x46546C67; // "glTF"
constexpr uint32_t chunk_json = 0x4E4F534A;
constexpr uint32_t chunk_bin = 0x004E4942;
constexpr size_t header_size = 12, chunk_header_size = 8;
// Our choice: embedded buffers make text long, but past this a .glb is the right container.
constexpr size_t max_json_bytes = size_t{ 1 } << 29;

uint32_t little_endian(const uint8_t *bytes)
{
    return static_cast<uint32_t>(bytes[0]) | static_cast<uint32_t>(bytes[1]) << 8 |
           static_cast<uint32_t>(bytes[2]) << 16 | static_cast<uint32_t>(bytes[3]) << 24;
}

std::string at_byte(size_t offset)
{
    return "byte " + std::to_string(offset);
}

std::string system_error_text()
{
    return std::strerror(errno);
}

struct closer {
    void operator()(FILE *file) const
    {
        std::fclose(file);
    }
};

struct chunk {
    uint32_t type;
    byte_view content;
};

// The chunk at offset, which is moved behind it.
chunk next_chunk(const std::vector<uint8_t> &bytes, size_t &offset)
{
    if (bytes.size() - offset < chunk_header_size)
        throw file_error(at_byte(offset), "found " + std::to_string(bytes.size() - offset) +
                                              " bytes, expected a chunk header of 8 bytes; the file may be truncated");
    const size_t length = little_endian(&bytes[offset]);
    const uint32_t type = little_endian(&bytes[offset + 4]);
    const size_t content = offset + chunk_header_size;
    if (length > bytes.size() - content)
        throw file_error(at_byte(offset), "found a chunk of " + std::to_string(length) + " bytes where only " +
                                              std::to_string(bytes.size() - content) +
                                              " are left; the file may be truncated");
    offset = content + length;
    return { type, { bytes.data() + content, length } };
}

bool starts_like_json(const std::vector<uint8_t> &bytes)
{
    const std::string_view text(reinterpret_cast<const char *>(bytes.data()), bytes.size());
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    const size_t start = text.substr(0, byte_order_mark.size()) == byte_order_mark ? byte_order_mark.size() : 0;
    const size_t first = text.find_first_not_of(" \t\r\n", start);
    return first != text.npos && text[first] == '{';
}

void check_header(const std::vector<uint8_t> &bytes)
{
    if (bytes.size() < header_size)
        throw file_error(at_byte(0), "found a .glb of " + std::to_string(bytes.size()) +
                                         " bytes, expected a header of 12; the file may be truncated");
    const uint32_t version = little_endian(&bytes[4]), length = little_endian(&bytes[8]);
    if (version != 2)
        throw file_error(at_byte(4), "found .glb version " + std::to_string(version) + ", expected 2");
    if (length != bytes.size())
        throw file_error(at_byte(8), "found a header that says " + std::to_string(length) + " bytes in a file of " +
                                         std::to_string(bytes.size()) + "; the file may be truncated");
}

gltf_container open_glb(const std::vector<uint8_t> &bytes)
{
    check_header(bytes);
    size_t offset = header_size;
    const chunk first = next_chunk(bytes, offset);
    if (first.type != chunk_json)
        throw file_error(at_byte(header_size + 4), "found a first chunk that is not JSON");
    gltf_container parts;
    parts.text = { reinterpret_cast<const char *>(first.content.data), first.content.size };
    // Chunks of unknown types are skipped, as the text asks; BIN may only be the second.
    for (size_t number = 1; offset < bytes.size(); number++) {
        const chunk next = next_chunk(bytes, offset);
        if (number == 1 && next.type == chunk_bin) {
            parts.bin = next.content;
            parts.has_bin = true;
        }
    }
    return parts;
}

} // namespace

std::vector<uint8_t> file_bytes(const std::string &path, uint64_t limit)
{
    // Asked before opening: to open a pipe would wait for its writer.
    struct stat status;
    if (stat(path.c_str(), &status) != 0)
        throw file_error("", "cannot be opened: " + system_error_text());
    if (!S_ISREG(status.st_mode))
        throw file_error("", S_ISDIR(status.st_mode) ? "found a folder, expected a file"
                                                     : "found something that is not a regular file");
    const std::unique_ptr<FILE, closer> file(std::fopen(path.c_str(), "rb"));
    if (!file)
        throw file_error("", "cannot be opened: " + system_error_text());
    const uint64_t size = static_cast<uint64_t>(status.st_size);
    if (size > limit)
        throw file_error("", "found a file of " + std::to_string(size) + " bytes, expected at most " +
                                 std::to_string(limit));
    std::vector<uint8_t> bytes(size);
    if (size > 0 && std::fread(bytes.data(), 1, size, file.get()) != size)
        throw file_error("", "cannot be read to its end: " + system_error_text());
    return bytes;
}

gltf_container gltf_open(const std::vector<uint8_t> &bytes)
{
    gltf_container parts;
    if (bytes.size() >= 4 && little_endian(bytes.data()) == glb_magic)
        parts = open_glb(bytes);
    else if (!starts_like_json(bytes))
        throw file_error(at_byte(0), "found neither the magic \"glTF\" of a .glb nor a JSON object");
    else
        parts.text = { reinterpret_cast<const char *>(bytes.data()), bytes.size() };
    if (parts.text.size() > max_json_bytes)
        throw file_error("", "found " + std::to_string(parts.text.size()) + " bytes of JSON, expected at most " +
                                 std::to_string(max_json_bytes));
    return parts;
}
