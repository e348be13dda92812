// Puts the textures of a preset into a file: image, sampler and texture, each only where the file has none like it.
#ifndef EXPORTERS_GLTF_TEXTURES_HPP
#define EXPORTERS_GLTF_TEXTURES_HPP

#include "exporters/gltf/data.hpp"
#include "exporters/gltf/preset.hpp"
#include "scene/scene.h"

// As they are in their file. Throws a file_error that names it.
std::vector<uint8_t> export_image_bytes(const scene_image &image);

// image/png or image/jpeg: only these two are in glTF 2.0 itself (section 3.8.3). Throws a file_error for others.
std::string export_image_type(const std::vector<uint8_t> &bytes, const std::string &place);

class texture_packer
{
  public:
    // images: those of the file, in the order of its JSON.
    texture_packer(patch &p, export_data &data, const scene &images) : patch_(p), data_(data), images_(images)
    {
    }

    // The index that the preset's texture has in the file.
    size_t texture(const export_preset &preset, size_t index);
    // The index of a texture with this image and sampler.
    size_t texture(const std::vector<uint8_t> &image, const ordered_json &sampler);
    size_t added() const
    {
        return added_;
    }

  private:
    size_t image_index(const std::vector<uint8_t> &bytes, const std::string &place);
    size_t entry(const std::string &array, const ordered_json &wanted);
    void read_old_images();

    patch &patch_;
    export_data &data_;
    const scene &images_;
    bool read_ = false;
    std::map<std::vector<uint8_t>, size_t> known_images_;
    std::map<std::string, std::vector<json>> known_; // samplers and textures: the file's own, then new ones
    size_t added_ = 0;
};

#endif
