// Header, JSON chunk, BIN chunk, other chunks (glTF 2.0 section 4.4), in that order and no other.
#include "exporters/gltf/container.hpp"

#include "io/file_error.hpp"

namespace
{

constexpr uint32_t glb_magic = 0x46546C67, chunk_json = 0x4E4F534A, chunk_bin = 0x004E4942;

void put(std::vector<uint8_t> &out, size_t value)
{
    if (value > UINT32_MAX)
        throw file_error("", "found " + std::to_string(value) + " bytes to write, more than a .glb can hold");
    for (unsigned shift = 0; shift < 32; shift += 8)
        out.push_back(static_cast<uint8_t>(value >> shift));
}

void put_chunk(std::vector<uint8_t> &out, uint32_t type, const uint8_t *data, size_t size, uint8_t filler)
{
    const size_t filled = (4 - size % 4) % 4;
    put(out, size + filled);
    put(out, type);
    out.insert(out.end(), data, data + size);
    out.insert(out.end(), filled, filler);
}

} // namespace

export_container export_take_apart(const std::vector<uint8_t> &bytes)
{
    const gltf_container parts = gltf_open(bytes);
    export_container c;
    c.text = parts.text;
    const uint8_t *text_begin = reinterpret_cast<const uint8_t *>(parts.text.data());
    c.glb = text_begin != bytes.data();
    if (!c.glb)
        return c;
    while (!c.text.empty() && c.text.back() == ' ') {
        c.text.pop_back();
        c.padding++;
    }
    c.has_bin = parts.has_bin;
    c.bin.assign(parts.bin.data, parts.bin.data + parts.bin.size);
    const uint8_t *end = c.has_bin ? parts.bin.data + parts.bin.size : text_begin + parts.text.size();
    c.rest.assign(end, bytes.data() + bytes.size());
    return c;
}

size_t export_padding(const export_container &c)
{
    return (4 - c.text.size() % 4) % 4;
}

std::vector<uint8_t> export_put_together(const export_container &c)
{
    if (!c.glb)
        return { c.text.begin(), c.text.end() };
    const std::string text = c.text + std::string(c.padding, ' ');
    std::vector<uint8_t> out;
    put(out, glb_magic);
    put(out, 2);
    put(out, 0);
    put(out, text.size());
    put(out, chunk_json);
    out.insert(out.end(), text.begin(), text.end());
    if (c.has_bin)
        put_chunk(out, chunk_bin, c.bin.data(), c.bin.size(), 0);
    out.insert(out.end(), c.rest.begin(), c.rest.end());
    std::vector<uint8_t> length;
    put(length, out.size());
    std::copy(length.begin(), length.end(), out.begin() + 8);
    return out;
}
