// Eight-bit RGB as PNG, without compression: noise has nothing to compress, and the same pixels give the same bytes.
#ifndef EXPORTERS_GLTF_PNG_HPP
#define EXPORTERS_GLTF_PNG_HPP

#include <cstdint>
#include <vector>

std::vector<uint8_t> png_bytes(const uint8_t *rgb, uint32_t width, uint32_t height);

#endif
