// What is there already is used again: this keeps files small and makes a second export change nothing.
#include "exporters/gltf/textures.hpp"

#include "io/file_error.hpp"

std::vector<uint8_t> export_image_bytes(const scene_image &image)
{
    if (!image.path)
        return { image.bytes, image.bytes + image.byte_count };
    try {
        return file_bytes(image.path, export_max_image_bytes);
    } catch (const file_error &e) {
        throw file_error("", std::string(image.path) + ": " + e.text);
    }
}

std::string export_image_type(const std::vector<uint8_t> &bytes, const std::string &place)
{
    constexpr uint8_t png[] = { 0x89, 'P', 'N', 'G' }, jpeg[] = { 0xFF, 0xD8, 0xFF };
    if (bytes.size() > 4 && std::equal(png, png + 4, bytes.begin()))
        return "image/png";
    if (bytes.size() > 3 && std::equal(jpeg, jpeg + 3, bytes.begin()))
        return "image/jpeg";
    throw file_error("", place + ": found an image that is neither PNG nor JPEG, the two that glTF has");
}

void texture_packer::read_old_images()
{
    if (read_)
        return;
    read_ = true;
    for (int i = 0; i < images_.image_count; i++) {
        const scene_image &old = images_.images[i];
        std::vector<uint8_t> bytes;
        try {
            bytes = old.path ? file_bytes(old.path, export_max_image_bytes)
                             : std::vector<uint8_t>(old.bytes, old.bytes + old.byte_count);
        } catch (const file_error &) {
            continue; // an image that is not there is like no other
        }
        known_images_.emplace(std::move(bytes), static_cast<size_t>(i));
    }
}

size_t texture_packer::image_index(const std::vector<uint8_t> &bytes, const std::string &place)
{
    read_old_images();
    const auto known = known_images_.find(bytes);
    if (known != known_images_.end())
        return known->second;
    const std::string type = export_image_type(bytes, place);
    ordered_json out;
    if (data_.has_chunk())
        out = { { "mimeType", type }, { "bufferView", data_.add_view(bytes.data(), bytes.size(), 0) } };
    else
        out = { { "uri", "data:" + type + ";base64," + export_base64(bytes.data(), bytes.size()) } };
    added_++;
    return known_images_[bytes] = patch_.add_element("images", out.dump());
}

size_t texture_packer::entry(const std::string &array, const ordered_json &wanted)
{
    std::vector<json> &known = known_[array];
    const uint32_t old = patch_.text().member(json_text::root, array);
    if (known.empty() && old != json_text::none)
        known = json::parse(patch_.text().value(old)).get<std::vector<json>>();
    const json unordered = json::parse(wanted.dump());
    for (size_t i = 0; i < known.size(); i++)
        if (known[i] == unordered)
            return i;
    known.push_back(unordered);
    return patch_.add_element(array, wanted.dump());
}

size_t texture_packer::texture(const export_preset &preset, size_t index)
{
    const json &extras = preset.material["extras"];
    ordered_json out = ordered_json::parse(extras["textures"][index].dump());
    if (out.contains("sampler"))
        out["sampler"] =
            entry("samplers", ordered_json::parse(extras["samplers"][out["sampler"].get<size_t>()].dump()));
    if (out.contains("source")) {
        const size_t source = out["source"].get<size_t>();
        out["source"] = image_index(preset.images[source], preset.path + ": /extras/images/" + std::to_string(source));
    }
    return entry("textures", out);
}

size_t texture_packer::texture(const std::vector<uint8_t> &image, const ordered_json &sampler)
{
    const size_t sampler_index = entry("samplers", sampler);
    return entry("textures", { { "sampler", sampler_index }, { "source", image_index(image, "the image") } });
}
