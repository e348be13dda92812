// Bytes that an export adds to a file: behind those of the BIN chunk, or in a data URI where there is no such chunk.
#ifndef EXPORTERS_GLTF_DATA_HPP
#define EXPORTERS_GLTF_DATA_HPP

#include "exporters/gltf/container.hpp"
#include "exporters/gltf/patch.hpp"

std::string export_base64(const uint8_t *data, size_t size);

class export_data
{
  public:
    export_data(patch &p, const export_container &file);

    // Whether bytes go to the BIN chunk. A .glb whose first buffer has a URI cannot have one.
    bool has_chunk() const
    {
        return chunk_;
    }
    // Adds a buffer view; returns its index. target: 34962 for vertices, 0 for none.
    size_t add_view(const void *data, size_t size, int target);
    // Writes the buffer; call once, before patch::result.
    void finish(export_container &file);

  private:
    patch &patch_;
    bool chunk_;
    size_t old_size_ = 0; // of the buffer, up to where new bytes start
    size_t buffer_ = 0;
    std::vector<uint8_t> bytes_;
};

#endif
