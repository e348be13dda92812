// Rules for GLINT_materials_glint that need the meshes: what attributes a material uses, and how many facets fit.
#include <cmath>
#include <cstdio>
#include <set>
#include <vector>

#include "io/gltf_validate.hpp"
#include "io/scene_bounds.h"

namespace
{

// The picture that a density is judged by: the whole scene across the width of 4K.
constexpr double picture_width = 3840.0;
// One step of eight bits.
constexpr double least_contrast = 1.0 / 255.0;
constexpr double sun_sr = 6.8e-5; // solid angle of the sun

std::string text_of(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

const json &attributes_of(const json &root, const std::string &mesh)
{
    return root.at(json::json_pointer("/" + mesh)).at("attributes");
}

// The glints of one layer and where they stand in the file.
struct layer {
    const scene_glint &glint;
    std::string pointer;
};

std::vector<layer> layers_of(const scene &s, int material)
{
    const scene_material &m = s.materials[material];
    const std::string start = "/materials/" + std::to_string(material), end = "/extensions/GLINT_materials_glint";
    std::vector<layer> all;
    if (m.glint.present && m.glint.factor > 0.0F)
        all.push_back({ m.glint, start + end });
    if (m.coat_glint.present && m.coat_glint.factor > 0.0F)
        all.push_back({ m.coat_glint, start + "/extensions/KHR_materials_clearcoat" + end });
    return all;
}

// ---- attributes ----

void check_texcoords(const json &root, const layer &l, const scene_mesh &mesh, issue_list &issues)
{
    const scene_glint &g = l.glint;
    const json &attributes = attributes_of(root, mesh.name);
    const struct {
        const scene_texture &texture;
        const char *name;
    } uses[] = { { g.texture, "glintTexture" },
                 { g.density_texture, "glintDensityTexture" },
                 { g.color_texture, "glintColorTexture" } };
    for (const auto &use : uses) {
        const std::string set = "TEXCOORD_" + std::to_string(use.texture.texcoord);
        if (use.texture.image != SCENE_NONE && !attributes.contains(set))
            issues.add(VALIDATE_ERROR, "NO_TEXCOORD", "/" + std::string(mesh.name) + "/attributes", "no " + set,
                       "it, for " + l.pointer + "/" + use.name);
    }
    const std::string set = "TEXCOORD_" + std::to_string(g.texcoord);
    if (g.space == SCENE_SPACE_UV && !attributes.contains(set))
        issues.add(VALIDATE_WARNING, "NO_TEXCOORD", "/" + std::string(mesh.name) + "/attributes",
                   "no " + set + ", so that glints lie in the object's space",
                   "it, for glintSpace \"uv\" of " + l.pointer);
}

void check_tangents(const json &root, const layer &l, const scene_material &m, const scene_mesh &mesh,
                    issue_list &issues)
{
    const scene_glint &g = l.glint;
    const bool directed = g.elongation > 1.0F || g.structure == SCENE_STRUCTURE_EXAMPLE || m.anisotropy > 0.0F ||
                          m.normal_texture.image != SCENE_NONE;
    if (g.space == SCENE_SPACE_UV && directed && !attributes_of(root, mesh.name).contains("TANGENT"))
        issues.add(VALIDATE_WARNING, "NO_TANGENT", "/" + std::string(mesh.name) + "/attributes", "no TANGENT",
                   "it, for " + l.pointer + ": viewers compute tangents, but not all compute the same");
}

// ---- densities ----

double area_of_material(const scene &s, int material)
{
    double area = 0.0;
    for (int i = 0; i < s.instance_count; i++) {
        const scene_mesh &mesh = s.meshes[s.instances[i].mesh];
        for (uint32_t t = 0; mesh.material == material && t < mesh.triangle_count; t++)
            area += scene_triangle_area(&s, &s.instances[i], t);
    }
    return area;
}

double scene_size(const scene &s)
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        const double side = static_cast<double>(s.bounds_max[k]) - static_cast<double>(s.bounds_min[k]);
        sum += side > 0.0 ? side * side : 0.0;
    }
    return std::sqrt(sum);
}

void check_density(const scene &s, int material, const layer &l, issue_list &issues)
{
    const scene_material &m = s.materials[material];
    const double density = static_cast<double>(l.glint.density), area = area_of_material(s, material);
    const std::string pointer = l.pointer + "/glintDensity";
    if (!(area > 0.0))
        return;
    if (density * area * static_cast<double>(l.glint.coverage) < 1.0)
        issues.add(VALIDATE_WARNING, "DENSITY_EMPTY", pointer, text_of(density),
                   "at least " + text_of(1.0 / area) + ", one facet on the " + text_of(area) +
                       " m^2 that have the material");
    // N facets a pixel, each lit with p, vary by sqrt((1 - p) / (N p)) around their mean.
    const double pixel = scene_size(s) / picture_width,
                 roughness =
                     static_cast<double>(l.glint.layer == SCENE_LAYER_BASE ? m.roughness : m.clearcoat_roughness);
    const double alpha = roughness * roughness;
    const double lit = std::min(1.0, sun_sr / (4.0 * 3.14159265358979323846 * alpha * alpha + 1e-12));
    const double contrast = std::sqrt((1.0 - lit) / (density * pixel * pixel * lit));
    if (contrast < least_contrast)
        issues.add(VALIDATE_WARNING, "DENSITY_UNRESOLVED", pointer, text_of(density),
                   "fewer: where the scene fills a picture of 3840 pixels under the sun, pixels differ by " +
                       text_of(contrast) + " of their mean, less than eight bits show");
}

} // namespace

void validate_on_meshes(const json &root, const scene &s, issue_list &issues)
{
    std::set<int> used;
    for (int i = 0; i < s.mesh_count; i++) {
        const scene_mesh &mesh = s.meshes[i];
        for (const layer &l : layers_of(s, mesh.material)) {
            check_texcoords(root, l, mesh, issues);
            check_tangents(root, l, s.materials[mesh.material], mesh, issues);
        }
        used.insert(mesh.material);
    }
    for (const int material : used)
        for (const layer &l : layers_of(s, material))
            check_density(s, material, l, issues);
}
