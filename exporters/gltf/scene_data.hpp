// The bytes of a new glTF document, and the lists that lead to them: views, accessors, images, samplers, textures.
#ifndef EXPORTERS_GLTF_SCENE_DATA_HPP
#define EXPORTERS_GLTF_SCENE_DATA_HPP

#include <array>
#include <map>

#include "exporters/gltf/container.hpp"
#include "io/json.hpp"
#include "scene/scene.h"

class buffer_writer
{
  public:
    // All return the index of what they add. target: as in bufferView.target, 0 for none.
    size_t add_view(const void *data, size_t size, int target);
    size_t add_floats(const float *values, size_t count, size_t width, const char *type);
    size_t add_positions(const float *xyz, size_t count);
    size_t add_indices(const uint32_t *values, size_t count);
    // Into the BIN chunk of a .glb, or a data URI.
    void finish(ordered_json &document, export_container &file);

  private:
    std::vector<uint8_t> bytes_;
    ordered_json views_ = ordered_json::array(), accessors_ = ordered_json::array();
};

// Images of a scene as they are, each once.
class image_writer
{
  public:
    image_writer(const scene &s, buffer_writer &buffer) : scene_(s), buffer_(buffer)
    {
    }

    size_t image(int index);
    size_t texture(const scene_texture &t);
    void finish(ordered_json &document) const;

  private:
    size_t sampler(const scene_texture &t);

    const scene &scene_;
    buffer_writer &buffer_;
    std::map<int, size_t> known_images_;
    std::map<std::array<int, 4>, size_t> known_textures_; // image, wrap modes, filter
    ordered_json images_ = ordered_json::array(), textures_ = ordered_json::array(), samplers_ = ordered_json::array();
};

#endif
