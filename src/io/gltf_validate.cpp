// Rules for GLINT_materials_glint that its JSON alone decides: names, seeds, textures, layers, densities, animation.
#include "io/gltf_validate.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "io/gltf_schema.hpp"
#include "io/near_names.hpp"

namespace
{

constexpr const char *extension_name = "GLINT_materials_glint";
// Half a wavelength of blue light, 4.5e-7 m: facets below that diffract and do not reflect as mirrors.
constexpr double smallest_facet_m = 2.25e-7;

std::string text_of(double value)
{
    return json(value).dump();
}

const gltf::schema &glint_schema()
{
    for (const gltf::extension &e : gltf::material_extensions())
        if (e.name == std::string(extension_name))
            return *e.schema;
    throw std::logic_error("the schema of the extension is gone");
}

bool is_known(const std::string &name)
{
    const auto &all = glint_schema().properties;
    return name == "extras" || name == "extensions" ||
           std::any_of(all.begin(), all.end(), [&](const gltf::property &p) { return p.name == name; });
}

std::string nearest_names(const std::string &name)
{
    std::vector<std::string> names;
    for (const gltf::property &p : glint_schema().properties)
        names.emplace_back(p.name);
    return near_names(name, names);
}

void check_names(const json &glint, const std::string &pointer, issue_list &issues)
{
    for (const auto &item : glint.items())
        if (!is_known(item.key()))
            issues.add(VALIDATE_WARNING, "UNKNOWN_PROPERTY", json_pointer(pointer, item.key()),
                       json(item.key()).dump() + ", which has no effect", nearest_names(item.key()));
}

struct roughness_of_layer {
    const char *name;
    double value;
};

// Of the layer that the facets are in: the coat's where its extension holds them or glintLayer names it.
roughness_of_layer roughness_of(const json &glint, const json &material, const std::string &pointer)
{
    const json coat = material.value("/extensions/KHR_materials_clearcoat"_json_pointer, json::object());
    if (glint.value("glintLayer", "base") == "clearcoat" || pointer.find("KHR_materials_clearcoat") != pointer.npos)
        return { "clearcoatRoughnessFactor", coat.value("clearcoatRoughnessFactor", 0.0) };
    const json pbr = material.value("pbrMetallicRoughness", json::object());
    return { "roughnessFactor", pbr.value("roughnessFactor", 1.0) };
}

void check_values(const json &glint, const json &material, const std::string &pointer, issue_list &issues)
{
    const uint32_t seed = glint.value("glintSeed", 0U);
    if (static_cast<double>(static_cast<float>(seed)) != static_cast<double>(seed))
        issues.add(VALIDATE_WARNING, "SEED_NOT_FLOAT", pointer + "/glintSeed", std::to_string(seed),
                   "a seed that single precision holds (all up to 16777216), for shaders that have no integers");
    const double density = glint.value("glintDensity", 1e8);
    if (density > 1.0 / (smallest_facet_m * smallest_facet_m))
        issues.add(VALIDATE_WARNING, "DENSITY_UNRESOLVED", pointer + "/glintDensity", text_of(density),
                   "at most 2e13 facets per m^2: smaller ones are below half a wavelength of light, and no picture "
                   "shows one");
    const roughness_of_layer layer = roughness_of(glint, material, pointer);
    const double facet = glint.value("glintFacetRoughness", 0.05);
    // A normal map may lean one way only: grooves are as rough along them as within a texel.
    const bool is_mapped = glint.value("glintStructure", "flakes") == "example";
    if (facet >= layer.value && facet > 0.0 && !is_mapped)
        issues.add(VALIDATE_WARNING, "FACET_ROUGHNESS", pointer + "/glintFacetRoughness", text_of(facet),
                   std::string("less than the ") + layer.name + " of " + text_of(layer.value) +
                       ": facets that are rougher than the surface show no glints");
    if (!glint.contains("glintFactor") || glint["glintFactor"] == 0)
        issues.add(VALIDATE_INFO, "OFF", pointer + "/glintFactor", glint.contains("glintFactor") ? "0" : "none, so 0",
                   "a factor above 0, without which there are no glints");
}

void check_parts(const json &glint, const json &material, const std::string &pointer, issue_list &issues)
{
    const bool example = glint.value("glintStructure", "flakes") == "example";
    for (const char *name : { "glintExampleTexture", "glintExamplePlacement", "glintExampleSize" })
        if (!example && glint.contains(name))
            issues.add(VALIDATE_WARNING, "UNUSED_PROPERTY", json_pointer(pointer, name),
                       "it with glintStructure \"flakes\"", "\"example\", which alone uses it");
    const json extensions = material.value("extensions", json::object());
    const json coat = extensions.value("KHR_materials_clearcoat", json::object());
    if (glint.value("glintLayer", "base") == "clearcoat" && !(coat.value("clearcoatFactor", 0.0) > 0.0))
        issues.add(VALIDATE_WARNING, "NO_COAT", pointer + "/glintLayer",
                   "\"clearcoat\" without a clearcoatFactor above 0",
                   "KHR_materials_clearcoat, whose facets these are");
}

// ---- textures: an image is either colour (sRGB) or data (linear) ----

enum class use { color, data };

struct first_use {
    use as;
    std::string pointer;
};

// By the texts of glTF 2.0 and the extensions: these alone are colours.
use use_of(const std::string &name)
{
    for (const char *color : { "baseColorTexture", "emissiveTexture", "specularColorTexture", "sheenColorTexture",
                               "diffuseTexture", "specularGlossinessTexture", "glintColorTexture" })
        if (name == color)
            return use::color;
    return use::data;
}

bool ends_with_texture(const std::string &name)
{
    constexpr size_t length = 7;
    return name.size() > length && name.compare(name.size() - length, length, "Texture") == 0;
}

class texture_checker
{
  public:
    texture_checker(const json &root, issue_list &issues) : root_(root), issues_(issues)
    {
    }

    void walk(const json &value, const std::string &pointer)
    {
        if (!value.is_object())
            return;
        for (const auto &item : value.items()) {
            const std::string here = json_pointer(pointer, item.key());
            if (item.key() != "extras" && ends_with_texture(item.key()) && item.value().is_object())
                check(item.key(), item.value(), here);
            if (item.key() != "extras")
                walk(item.value(), here);
        }
    }

  private:
    void check(const std::string &name, const json &info, const std::string &pointer)
    {
        const json index = info.value("index", json());
        if (!index.is_number())
            return;
        const json &texture = root_["textures"][index.get<size_t>()];
        if (!texture.contains("source")) {
            if (name.compare(0, 5, "glint") == 0)
                issues_.add(VALIDATE_WARNING, "TEXTURE_IMAGE", pointer, "a texture without a source",
                            "one with a PNG or JPEG image, which every reader can read");
            return;
        }
        const size_t image = texture["source"].get<size_t>();
        const auto known = uses_.emplace(image, first_use{ use_of(name), pointer });
        const first_use &first = known.first->second;
        if (first.as != use_of(name) &&
            (name.compare(0, 5, "glint") == 0 || first.pointer.find("/glint") != first.pointer.npos))
            issues_.add(VALIDATE_WARNING, "TEXTURE_KIND", pointer,
                        "image " + std::to_string(image) + " as " + kind_of(use_of(name)) + ", but at " +
                            first.pointer + " as " + kind_of(first.as),
                        "an image for each, since colours are decoded from sRGB and data are not");
    }

    static const char *kind_of(use u)
    {
        return u == use::color ? "colour" : "data";
    }

    const json &root_;
    issue_list &issues_;
    std::map<size_t, first_use> uses_;
};

// ---- the file around the materials ----

// Calls visit for the extension on each material and, with its own pointer, in its clear coat.
void each_glint(const json &root,
                const std::function<void(const json &glint, const json &material, const std::string &pointer)> &visit)
{
    const json materials = root.value("materials", json::array());
    for (size_t i = 0; i < materials.size(); i++)
        for (const char *where : { "", "/extensions/KHR_materials_clearcoat" }) {
            const json::json_pointer place(std::string(where) + "/extensions/" + extension_name);
            if (materials[i].contains(place) && materials[i].at(place).is_object())
                visit(materials[i].at(place), materials[i], json_pointer("/materials", i) + place.to_string());
        }
}

bool lists(const json &root, const char *list)
{
    const json names = root.value(list, json::array());
    return std::find(names.begin(), names.end(), extension_name) != names.end();
}

void check_declaration(const json &root, issue_list &issues)
{
    std::string first;
    each_glint(root, [&](const json &, const json &, const std::string &pointer) {
        if (first.empty())
            first = pointer;
    });
    const bool preset = !root.contains("extensionsUsed") && !root.contains("meshes") && !root.contains("scenes");
    if (!first.empty() && !lists(root, "extensionsUsed") && !preset)
        issues.add(VALIDATE_ERROR, "UNDECLARED", first, "the extension without its name in extensionsUsed",
                   "that name there");
    if (lists(root, "extensionsRequired"))
        issues.add(VALIDATE_WARNING, "REQUIRED_EXTENSION", "/extensionsRequired", extension_name,
                   "it in extensionsUsed only: the base material is what other viewers show");
}

// A property that may be animated is a number or an array of them; whole numbers and names are not.
bool is_animatable(const std::string &name)
{
    for (const gltf::property &p : glint_schema().properties)
        if (p.name == name)
            return p.kind == gltf::kind::number || p.kind == gltf::kind::numbers;
    return false;
}

void check_animation(const json &root, issue_list &issues)
{
    const json animations = root.value("animations", json::array());
    const json::json_pointer where("/target/extensions/KHR_animation_pointer/pointer");
    for (size_t i = 0; i < animations.size(); i++) {
        const json channels =
            animations[i].is_object() ? animations[i].value("channels", json::array()) : json::array();
        for (size_t k = 0; k < channels.size(); k++) {
            if (!channels[k].is_object() || !channels[k].contains(where) || !channels[k].at(where).is_string())
                continue;
            const std::string target = channels[k].at(where).get<std::string>();
            const std::string marker = std::string("/extensions/") + extension_name + "/";
            const size_t at = target.find(marker);
            if (at == target.npos || target.compare(0, 11, "/materials/") != 0)
                continue;
            const std::string name = target.substr(at + marker.size());
            // Below a texture it is KHR_texture_transform that says what moves.
            if (name.find('/') == name.npos && !is_animatable(name))
                issues.add(VALIDATE_ERROR, "ANIMATION_POINTER",
                           json_pointer(json_pointer("/animations", i) + "/channels", k) + where.to_string(),
                           json(target).dump(), "a property that is a number: the others do not change in time");
        }
    }
}

} // namespace

void validate_extension(const json &root, issue_list &issues)
{
    check_declaration(root, issues);
    each_glint(root, [&](const json &glint, const json &material, const std::string &pointer) {
        check_names(glint, pointer, issues);
        check_values(glint, material, pointer, issues);
        check_parts(glint, material, pointer, issues);
    });
    texture_checker textures(root, issues);
    const json materials = root.value("materials", json::array());
    for (size_t i = 0; i < materials.size(); i++)
        textures.walk(materials[i], json_pointer("/materials", i));
    check_animation(root, issues);
}
