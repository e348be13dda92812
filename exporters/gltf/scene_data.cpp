// Bytes on multiples of four, accessors that fill their views, images as they are.
#include "exporters/gltf/scene_data.hpp"

#include <algorithm>

#include "exporters/gltf/data.hpp"
#include "exporters/gltf/scene_material.hpp"
#include "exporters/gltf/textures.hpp"
#include "io/file_error.hpp"

namespace
{

constexpr int vertex_target = 34962, index_target = 34963;
constexpr int type_float = 5126, type_uint32 = 5125;

int wrap_mode(scene_wrap mode)
{
    return mode == SCENE_WRAP_CLAMP ? 33071 : mode == SCENE_WRAP_MIRROR ? 33648 : 10497;
}

} // namespace

// ---- bytes ----

size_t buffer_writer::add_view(const void *data, size_t size, int target)
{
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    ordered_json view = { { "buffer", 0 }, { "byteOffset", bytes_.size() }, { "byteLength", size } };
    if (target != 0)
        view["target"] = target;
    const auto *first = static_cast<const uint8_t *>(data);
    bytes_.insert(bytes_.end(), first, first + size);
    views_.push_back(view);
    return views_.size() - 1;
}

size_t buffer_writer::add_floats(const float *values, size_t count, size_t width, const char *type)
{
    const size_t view = add_view(values, count * width * sizeof(float), vertex_target);
    accessors_.push_back(
        { { "bufferView", view }, { "componentType", type_float }, { "count", count }, { "type", type } });
    return accessors_.size() - 1;
}

size_t buffer_writer::add_positions(const float *xyz, size_t count)
{
    const size_t accessor = add_floats(xyz, count, 3, "VEC3");
    float low[3], high[3];
    std::copy_n(xyz, 3, low);
    std::copy_n(xyz, 3, high);
    for (size_t i = 0; i < 3 * count; i++) {
        low[i % 3] = std::min(low[i % 3], xyz[i]);
        high[i % 3] = std::max(high[i % 3], xyz[i]);
    }
    accessors_[accessor]["min"] = export_numbers(low, 3);
    accessors_[accessor]["max"] = export_numbers(high, 3);
    return accessor;
}

size_t buffer_writer::add_indices(const uint32_t *values, size_t count)
{
    const size_t view = add_view(values, count * sizeof *values, index_target);
    accessors_.push_back(
        { { "bufferView", view }, { "componentType", type_uint32 }, { "count", count }, { "type", "SCALAR" } });
    return accessors_.size() - 1;
}

void buffer_writer::finish(ordered_json &document, export_container &file)
{
    if (bytes_.empty())
        return;
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    ordered_json buffer = { { "byteLength", bytes_.size() } };
    if (!file.glb)
        buffer["uri"] = "data:application/octet-stream;base64," + export_base64(bytes_.data(), bytes_.size());
    if (!accessors_.empty())
        document["accessors"] = accessors_;
    document["bufferViews"] = views_;
    document["buffers"] = ordered_json::array({ buffer });
    file.has_bin = file.glb;
    if (file.glb)
        file.bin = std::move(bytes_);
}

// ---- images ----

size_t image_writer::image(int index)
{
    const auto [known, is_new] = known_images_.emplace(index, images_.size());
    if (!is_new)
        return known->second;
    const scene_image &from = scene_.images[index];
    const std::vector<uint8_t> bytes = export_image_bytes(from);
    const std::string type = export_image_type(bytes, from.name);
    images_.push_back({ { "mimeType", type }, { "bufferView", buffer_.add_view(bytes.data(), bytes.size(), 0) } });
    return known->second;
}

size_t image_writer::sampler(const scene_texture &t)
{
    const ordered_json wanted = { { "magFilter", t.nearest ? 9728 : 9729 },
                                  { "minFilter", t.nearest ? 9728 : 9987 },
                                  { "wrapS", wrap_mode(t.wrap_s) },
                                  { "wrapT", wrap_mode(t.wrap_t) } };
    const auto found = std::find(samplers_.begin(), samplers_.end(), wanted);
    const auto index = static_cast<size_t>(found - samplers_.begin());
    if (found == samplers_.end())
        samplers_.push_back(wanted);
    return index;
}

size_t image_writer::texture(const scene_texture &t)
{
    const std::array<int, 4> key = { t.image, t.wrap_s, t.wrap_t, t.nearest };
    const auto [known, is_new] = known_textures_.emplace(key, textures_.size());
    if (is_new) {
        const size_t source = image(t.image), used = sampler(t);
        textures_.push_back({ { "sampler", used }, { "source", source } });
    }
    return known->second;
}

void image_writer::finish(ordered_json &document) const
{
    if (!samplers_.empty())
        document["samplers"] = samplers_;
    if (!textures_.empty())
        document["textures"] = textures_;
    if (!images_.empty())
        document["images"] = images_;
}
