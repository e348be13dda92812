// PNG (ISO/IEC 15948) with stored blocks (RFC 1951 section 3.2.4). No chunk speaks of colour: the values are data.
#include "exporters/gltf/png.hpp"

#include <algorithm>

namespace
{

void put(std::vector<uint8_t> &out, uint32_t value)
{
    for (int shift = 24; shift >= 0; shift -= 8)
        out.push_back(static_cast<uint8_t>(value >> shift));
}

// CRC-32 of annex D, bit by bit.
uint32_t crc(const uint8_t *data, size_t size)
{
    uint32_t c = 0xFFFFFFFFU;
    for (size_t i = 0; i < size; i++) {
        c ^= data[i];
        for (int bit = 0; bit < 8; bit++)
            c = (c & 1U) != 0 ? 0xEDB88320U ^ (c >> 1) : c >> 1;
    }
    return ~c;
}

uint32_t adler(const std::vector<uint8_t> &data)
{
    constexpr uint32_t prime = 65521;
    uint32_t a = 1, b = 0;
    for (const uint8_t byte : data) {
        a = (a + byte) % prime;
        b = (b + a) % prime;
    }
    return b << 16 | a;
}

void put_chunk(std::vector<uint8_t> &out, const char *type, const std::vector<uint8_t> &content)
{
    put(out, static_cast<uint32_t>(content.size()));
    const size_t start = out.size();
    out.insert(out.end(), type, type + 4);
    out.insert(out.end(), content.begin(), content.end());
    put(out, crc(&out[start], out.size() - start));
}

// zlib's header, stored blocks of at most 65535 bytes, and the checksum (RFC 1950).
std::vector<uint8_t> stored(const std::vector<uint8_t> &data)
{
    std::vector<uint8_t> out = { 0x78, 0x01 };
    for (size_t at = 0; at < data.size(); at += 65535) {
        const size_t size = std::min<size_t>(65535, data.size() - at);
        const uint8_t last = at + size == data.size() ? 1 : 0;
        const auto low = static_cast<uint8_t>(size), high = static_cast<uint8_t>(size >> 8);
        out.insert(out.end(), { last, low, high, static_cast<uint8_t>(~low), static_cast<uint8_t>(~high) });
        out.insert(out.end(), &data[at], &data[at] + size);
    }
    put(out, adler(data));
    return out;
}

} // namespace

std::vector<uint8_t> png_bytes(const uint8_t *rgb, uint32_t width, uint32_t height)
{
    std::vector<uint8_t> out = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n' };
    std::vector<uint8_t> header;
    put(header, width);
    put(header, height);
    header.insert(header.end(), { 8, 2, 0, 0, 0 }); // bits, RGB, deflate, filters, not interlaced
    put_chunk(out, "IHDR", header);
    std::vector<uint8_t> rows;
    const size_t row = size_t{ 3 } * width;
    for (uint32_t y = 0; y < height; y++) {
        rows.push_back(0); // no filter
        rows.insert(rows.end(), rgb + y * row, rgb + (y + 1) * row);
    }
    put_chunk(out, "IDAT", stored(rows));
    put_chunk(out, "IEND", {});
    return out;
}
