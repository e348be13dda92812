// One buffer for everything that is added. The bytes that were there keep their places.
#include "exporters/gltf/data.hpp"

namespace
{

size_t aligned(size_t size)
{
    return (size + 3) / 4 * 4;
}

// The first buffer of a .glb without a URI is its BIN chunk (glTF 2.0 section 4.4.3.3).
bool can_have_chunk(const json_text &text, bool glb)
{
    const uint32_t first = text.find("/buffers/0");
    return glb && (first == json_text::none || text.member(first, "uri") == json_text::none);
}

} // namespace

std::string export_base64(const uint8_t *data, size_t size)
{
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((size + 2) / 3 * 4);
    for (size_t i = 0; i < size; i += 3) {
        const size_t left = size - i;
        const uint32_t bits = static_cast<uint32_t>(data[i]) << 16 |
                              static_cast<uint32_t>(left > 1 ? data[i + 1] : 0) << 8 | (left > 2 ? data[i + 2] : 0U);
        text += digits[bits >> 18];
        text += digits[bits >> 12 & 63];
        text += left > 1 ? digits[bits >> 6 & 63] : '=';
        text += left > 2 ? digits[bits & 63] : '=';
    }
    return text;
}

export_data::export_data(patch &p, const export_container &file)
    : patch_(p), chunk_(can_have_chunk(p.text(), file.glb)), old_size_(chunk_ ? aligned(file.bin.size()) : 0),
      buffer_(chunk_ ? 0 : p.count("buffers"))
{
}

size_t export_data::add_view(const void *data, size_t size, int target)
{
    bytes_.resize(aligned(bytes_.size()));
    ordered_json view = { { "buffer", buffer_ }, { "byteOffset", old_size_ + bytes_.size() }, { "byteLength", size } };
    if (target != 0)
        view["target"] = target;
    const auto *first = static_cast<const uint8_t *>(data);
    bytes_.insert(bytes_.end(), first, first + size);
    return patch_.add_element("bufferViews", view.dump());
}

void export_data::finish(export_container &file)
{
    if (bytes_.empty())
        return;
    const size_t length = old_size_ + bytes_.size();
    if (!chunk_) {
        const std::string uri = "data:application/octet-stream;base64," + export_base64(bytes_.data(), bytes_.size());
        patch_.add_element("buffers", ordered_json({ { "byteLength", length }, { "uri", uri } }).dump());
        return;
    }
    const uint32_t old = patch_.text().find("/buffers/0/byteLength");
    if (old == json_text::none)
        patch_.add_element("buffers", ordered_json({ { "byteLength", length } }).dump());
    else
        patch_.replace(old, std::to_string(length));
    if (!patch_.record().bin_bytes)
        patch_.record().bin_bytes = file.has_bin ? file.bin.size() : 0;
    file.has_bin = true;
    file.bin.resize(old_size_);
    file.bin.insert(file.bin.end(), bytes_.begin(), bytes_.end());
}
