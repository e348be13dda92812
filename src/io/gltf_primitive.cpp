// Attributes, morph targets and topology of a primitive (glTF 2.0 section 3.7.2, KHR_mesh_quantization, Draco).
#include "io/gltf_primitive.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/gltf_accessor.hpp"
#include "io/gltf_draco.hpp"

namespace
{

constexpr unsigned normalized_bytes = GLTF_BYTE_NORMALIZED | GLTF_SHORT_NORMALIZED;
constexpr unsigned normalized_unsigned = GLTF_UNSIGNED_BYTE_NORMALIZED | GLTF_UNSIGNED_SHORT_NORMALIZED;
constexpr unsigned all_small =
    GLTF_BYTE | GLTF_UNSIGNED_BYTE | GLTF_SHORT | GLTF_UNSIGNED_SHORT | normalized_bytes | normalized_unsigned;

// What an attribute may be made of: without and with KHR_mesh_quantization.
struct attribute_rule {
    const char *name;
    int min_components, max_components;
    unsigned plain, quantized;
};

constexpr attribute_rule rules[] = {
    { "POSITION", 3, 3, GLTF_FLOAT, GLTF_FLOAT | all_small },
    { "NORMAL", 3, 3, GLTF_FLOAT, GLTF_FLOAT | normalized_bytes },
    { "TANGENT", 4, 4, GLTF_FLOAT, GLTF_FLOAT | normalized_bytes },
    { "TEXCOORD_0", 2, 2, GLTF_FLOAT | normalized_unsigned, GLTF_FLOAT | all_small },
    { "TEXCOORD_1", 2, 2, GLTF_FLOAT | normalized_unsigned, GLTF_FLOAT | all_small },
    { "COLOR_0", 3, 4, GLTF_FLOAT | normalized_unsigned, GLTF_FLOAT | normalized_unsigned },
};

// The attributes that we use, as floats, whether they come from accessors or from Draco.
class attributes
{
  public:
    attributes(gltf_file &file, const tinygltf::Primitive &primitive, std::string pointer)
        : file_(file), primitive_(primitive), pointer_(std::move(pointer))
    {
        const auto &used = file.model.extensionsUsed;
        quantized_ = std::find(used.begin(), used.end(), "KHR_mesh_quantization") != used.end();
        for (const attribute_rule &rule : rules)
            check(rule);
        if (const tinygltf::Value *draco = gltf_extension(primitive.extensions, "KHR_draco_mesh_compression"))
            decode_draco(*draco);
    }

    bool has(const char *name) const
    {
        return primitive_.attributes.count(name) > 0;
    }

    // Empty when the primitive has no such attribute.
    std::vector<float> read(const char *name)
    {
        const auto accessor = primitive_.attributes.find(name);
        if (accessor == primitive_.attributes.end())
            return {};
        if (draco_) {
            const auto decoded = draco_->attributes.find(name);
            if (decoded != draco_->attributes.end())
                return std::move(decoded->second);
        }
        return gltf_read_floats(file_, accessor->second);
    }

    int components(const char *name) const
    {
        return gltf_component_count(accessor_of(name));
    }

    size_t vertex_count() const
    {
        return draco_ ? draco_->vertex_count : accessor_of("POSITION").count;
    }

    // The indices that Draco brings along, if it does.
    std::optional<std::vector<uint32_t>> draco_indices()
    {
        if (!draco_)
            return std::nullopt;
        return std::move(draco_->indices);
    }

  private:
    const tinygltf::Accessor &accessor_of(const char *name) const
    {
        return file_.model.accessors[static_cast<size_t>(primitive_.attributes.at(name))];
    }

    void check(const attribute_rule &rule) const
    {
        const auto found = primitive_.attributes.find(rule.name);
        if (found == primitive_.attributes.end())
            return;
        const std::string user = std::string(rule.name) + (quantized_ ? "" : " without KHR_mesh_quantization");
        gltf_check_accessor(file_, found->second, rule.min_components, rule.max_components,
                            quantized_ ? rule.quantized : rule.plain, user);
        const size_t count = accessor_of(rule.name).count, expected = accessor_of("POSITION").count;
        if (count != expected)
            throw file_error(json_pointer(pointer_ + "/attributes", rule.name),
                             "found " + std::to_string(count) + " elements, expected the " + std::to_string(expected) +
                                 " of POSITION");
    }

    void decode_draco(const tinygltf::Value &extension)
    {
        const std::string pointer = pointer_ + "/extensions/KHR_draco_mesh_compression";
        std::map<std::string, draco_request> requests;
        const tinygltf::Value *ids = gltf_member(extension, "attributes");
        for (const attribute_rule &rule : rules) {
            const int id = ids ? gltf_integer(*ids, rule.name, -1) : -1;
            if (id < 0 || !has(rule.name))
                continue;
            const tinygltf::Accessor &accessor = accessor_of(rule.name);
            requests[rule.name] = { static_cast<uint32_t>(id), gltf_component_count(accessor),
                                    accessor.normalized ? gltf_normalisation(accessor.componentType) : 1.0F };
        }
        const byte_view bytes = gltf_buffer_view(file_, static_cast<size_t>(gltf_integer(extension, "bufferView", 0)));
        draco_ = draco_decode(bytes, requests, file_.elements_left, pointer);
        file_.elements_left -= draco_->vertex_count;
        if (draco_->vertex_count != accessor_of("POSITION").count)
            throw file_error(pointer, "found " + std::to_string(draco_->vertex_count) +
                                          " vertices in the Draco mesh, expected the " +
                                          std::to_string(accessor_of("POSITION").count) + " of POSITION");
    }

    gltf_file &file_;
    const tinygltf::Primitive &primitive_;
    std::string pointer_;
    bool quantized_ = false;
    std::optional<draco_geometry> draco_;
};

// ---- morph targets ----

void add_weighted(std::vector<float> &values, size_t stride, const std::vector<float> &deltas, float weight)
{
    for (size_t i = 0; i < deltas.size(); i++)
        values[i / 3 * stride + i % 3] += weight * deltas[i];
}

// Adds weight times the deltas of one morph target to what the primitive has of it.
void apply_target(gltf_file &file, const std::map<std::string, int> &target, float weight, const std::string &pointer,
                  geometry &g)
{
    const struct {
        const char *name;
        std::vector<float> &values;
        size_t stride;
    } parts[] = { { "POSITION", g.position, 3 }, { "NORMAL", g.normal, 3 }, { "TANGENT", g.tangent, 4 } };
    for (const auto &part : parts) {
        const auto accessor = target.find(part.name);
        if (accessor == target.end() || part.values.empty())
            continue;
        gltf_check_accessor(file, accessor->second, 3, 3, GLTF_FLOAT | all_small,
                            std::string("a morph target's ") + part.name);
        const std::vector<float> deltas = gltf_read_floats(file, accessor->second);
        if (deltas.size() != g.vertex_count * size_t{ 3 })
            throw file_error(json_pointer(pointer, part.name),
                             "found " + std::to_string(deltas.size() / 3) + " elements, expected " +
                                 std::to_string(g.vertex_count) + " as in the primitive");
        add_weighted(part.values, part.stride, deltas, weight);
    }
}

void apply_targets(gltf_file &file, const tinygltf::Mesh &mesh, const tinygltf::Primitive &primitive,
                   const std::string &pointer, geometry &g)
{
    if (primitive.targets.empty())
        return;
    file.warn(pointer + "/targets", "morph targets stand still, at the weights of the mesh");
    for (size_t i = 0; i < primitive.targets.size() && i < mesh.weights.size(); i++)
        if (mesh.weights[i] != 0.0)
            apply_target(file, primitive.targets[i], static_cast<float>(mesh.weights[i]),
                         json_pointer(pointer + "/targets", i), g);
    for (const std::vector<float> *values : { &g.position, &g.normal, &g.tangent })
        if (!std::all_of(values->begin(), values->end(), [](float value) { return std::isfinite(value); }))
            throw file_error(pointer + "/targets", "found weights that move a vertex to infinity");
}

// ---- topology ----

std::vector<uint32_t> read_corners(gltf_file &file, const tinygltf::Primitive &primitive, size_t vertex_count,
                                   const std::string &pointer)
{
    std::vector<uint32_t> corners;
    const int accessor = gltf_primitive_indices(primitive);
    if (accessor < 0) {
        corners.resize(vertex_count);
        for (size_t i = 0; i < vertex_count; i++)
            corners[i] = static_cast<uint32_t>(i);
        return corners;
    }
    gltf_check_accessor(file, accessor, 1, 1, GLTF_UNSIGNED_BYTE | GLTF_UNSIGNED_SHORT | GLTF_UNSIGNED_INT, "indices");
    corners = gltf_read_integers(file, accessor);
    for (size_t i = 0; i < corners.size(); i++)
        if (corners[i] >= vertex_count)
            throw file_error(pointer + "/indices", "found vertex " + std::to_string(corners[i]) + " at place " +
                                                       std::to_string(i) + ", expected less than the " +
                                                       std::to_string(vertex_count) + " vertices of the primitive");
    return corners;
}

// glTF 2.0 section 3.7.2.1: strips (i, i + (1 + i % 2), i + (2 - i % 2)), fans (i + 1, i + 2, 0).
std::vector<uint32_t> triangles_of(std::vector<uint32_t> corners, int mode)
{
    if (mode == TINYGLTF_MODE_TRIANGLES)
        return corners;
    std::vector<uint32_t> index;
    index.reserve(3 * (corners.size() - 2));
    for (size_t i = 0; i + 2 < corners.size(); i++) {
        const size_t odd = i % 2;
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
            index.insert(index.end(), { corners[i], corners[i + 1 + odd], corners[i + 2 - odd] });
        else
            index.insert(index.end(), { corners[i + 1], corners[i + 2], corners[0] });
    }
    return index;
}

void check_corner_count(size_t count, int mode, const std::string &pointer)
{
    const bool whole = mode == TINYGLTF_MODE_TRIANGLES ? count % 3 == 0 : count >= 3;
    if (!whole)
        throw file_error(pointer, "found " + std::to_string(count) + " corners, expected " +
                                      (mode == TINYGLTF_MODE_TRIANGLES ? "3 for each triangle" : "at least 3"));
    // Corners are numbered by 32 bits, and a strip makes three of each.
    constexpr size_t max_corners = UINT32_MAX / 3;
    if (count > max_corners)
        throw file_error(pointer, "found " + std::to_string(count) + " corners, expected at most " +
                                      std::to_string(max_corners));
}

// RGB becomes RGBA, and all lie in [0, 1] (glTF 2.0 section 3.7.2.1).
std::vector<float> colors_with_alpha(std::vector<float> colors, int components)
{
    for (float &value : colors)
        value = std::clamp(value, 0.0F, 1.0F);
    if (components == 4)
        return colors;
    std::vector<float> rgba(colors.size() / 3 * 4, 1.0F);
    for (size_t i = 0; i < colors.size(); i++)
        rgba[i / 3 * 4 + i % 3] = colors[i];
    return rgba;
}

} // namespace

bool gltf_read_primitive(gltf_file &file, const tinygltf::Mesh &mesh, const tinygltf::Primitive &primitive,
                         const std::string &pointer, geometry &out)
{
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        file.warn(pointer, primitive.mode == TINYGLTF_MODE_POINTS ? "points are left out" : "lines are left out");
        return false;
    }
    if (primitive.attributes.count("POSITION") == 0) {
        file.warn(pointer, "a primitive without POSITION is left out");
        return false;
    }
    attributes a(file, primitive, pointer);
    out.vertex_count = static_cast<uint32_t>(std::min<size_t>(a.vertex_count(), UINT32_MAX));
    // First of all: that the file holds the vertices bounds what follows.
    out.position = a.read("POSITION");
    std::optional<std::vector<uint32_t>> decoded = a.draco_indices();
    const int mode = decoded ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    std::vector<uint32_t> corners =
        decoded ? std::move(*decoded) : read_corners(file, primitive, a.vertex_count(), pointer);
    check_corner_count(corners.size(), mode, pointer);
    out.index = triangles_of(std::move(corners), mode);
    out.normal = a.read("NORMAL");
    out.tangent = a.read("TANGENT");
    out.texcoord[0] = a.read("TEXCOORD_0");
    out.texcoord[1] = a.read("TEXCOORD_1");
    if (a.has("COLOR_0"))
        out.color = colors_with_alpha(a.read("COLOR_0"), a.components("COLOR_0"));
    apply_targets(file, mesh, primitive, pointer, out);
    return true;
}
