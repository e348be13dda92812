// Rules for GLINT_materials_glint that need the meshes: what attributes a material uses, and how many facets fit.
#include <cmath>
#include <set>

#include "io/gltf_validate.hpp"

namespace
{

// The picture that a density is judged by: the whole scene across the width of 4K.
constexpr double picture_width = 3840.0;
// An eighth of a bit more contrast than eight bits show.
constexpr double least_contrast = 1.0 / 255.0;
constexpr double sun_sr = 6.8e-5; // solid angle of the sun

const json &attributes_of(const json &root, const std::string &mesh)
{
    return root.at(json::json_pointer("/" + mesh)).at("attributes");
}

std::string material_pointer(int material)
{
    return "/materials/" + std::to_string(material) + "/extensions/GLINT_materials_glint";
}

// ---- attributes ----

void check_texcoords(const json &root, const scene &s, const scene_mesh &mesh, issue_list &issues)
{
    const scene_glint &g = s.materials[mesh.material].glint;
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
                       "it, for " + material_pointer(mesh.material) + "/" + use.name);
    }
    const std::string set = "TEXCOORD_" + std::to_string(g.texcoord);
    if (g.space == SCENE_SPACE_UV && !attributes.contains(set))
        issues.add(VALIDATE_WARNING, "NO_TEXCOORD", "/" + std::string(mesh.name) + "/attributes",
                   "no " + set + ", so that glints lie in the object's space",
                   "it, for glintSpace \"uv\" of " + material_pointer(mesh.material));
}

void check_tangents(const json &root, const scene &s, const scene_mesh &mesh, issue_list &issues)
{
    const scene_material &m = s.materials[mesh.material];
    const scene_glint &g = m.glint;
    const bool directed = g.elongation > 1.0F || g.structure == SCENE_STRUCTURE_EXAMPLE || m.anisotropy > 0.0F ||
                          m.normal_texture.image != SCENE_NONE;
    if (g.space == SCENE_SPACE_UV && directed && !attributes_of(root, mesh.name).contains("TANGENT"))
        issues.add(VALIDATE_WARNING, "NO_TANGENT", "/" + std::string(mesh.name) + "/attributes", "no TANGENT",
                   "it, for " + material_pointer(mesh.material) +
                       ": viewers compute tangents, but not all compute the same");
}

// ---- densities ----

double triangle_area(const scene_mesh &mesh, const float *m, uint32_t triangle)
{
    double p[3][3];
    for (int corner = 0; corner < 3; corner++) {
        const float *v =
            &mesh.position[3 * static_cast<size_t>(mesh.index[3 * static_cast<size_t>(triangle) + corner])];
        for (int k = 0; k < 3; k++)
            p[corner][k] = static_cast<double>(m[k]) * static_cast<double>(v[0]) +
                           static_cast<double>(m[4 + k]) * static_cast<double>(v[1]) +
                           static_cast<double>(m[8 + k]) * static_cast<double>(v[2]);
    }
    double n[3];
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        n[k] = (p[1][a] - p[0][a]) * (p[2][b] - p[0][b]) - (p[1][b] - p[0][b]) * (p[2][a] - p[0][a]);
    }
    return 0.5 * std::hypot(n[0], n[1], n[2]);
}

double area_of_material(const scene &s, int material)
{
    double area = 0.0;
    for (int i = 0; i < s.instance_count; i++) {
        const scene_mesh &mesh = s.meshes[s.instances[i].mesh];
        for (uint32_t t = 0; mesh.material == material && t < mesh.triangle_count; t++)
            area += triangle_area(mesh, s.instances[i].to_world, t);
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

void check_density(const scene &s, int material, issue_list &issues)
{
    const scene_material &m = s.materials[material];
    const double density = static_cast<double>(m.glint.density), area = area_of_material(s, material);
    const std::string pointer = material_pointer(material) + "/glintDensity";
    if (!(area > 0.0))
        return;
    if (density * area * static_cast<double>(m.glint.coverage) < 1.0)
        issues.add(VALIDATE_WARNING, "DENSITY_EMPTY", pointer, json(density).dump(),
                   "at least " + json(1.0 / area).dump() + ", one facet on the " + json(area).dump() +
                       " m^2 that have the material");
    // N facets a pixel, each lit with p, vary by sqrt((1 - p) / (N p)) around their mean.
    const double pixel = scene_size(s) / picture_width, alpha = static_cast<double>(m.roughness * m.roughness);
    const double lit = std::min(1.0, sun_sr / (4.0 * 3.14159265358979323846 * alpha * alpha + 1e-12));
    const double contrast = std::sqrt((1.0 - lit) / (density * pixel * pixel * lit));
    if (contrast < least_contrast)
        issues.add(VALIDATE_WARNING, "DENSITY_UNRESOLVED", pointer, json(density).dump(),
                   "fewer: where the scene fills a picture of 3840 pixels under the sun, pixels differ by " +
                       json(contrast).dump() + " of their mean, less than eight bits show");
}

} // namespace

void validate_on_meshes(const json &root, const scene &s, issue_list &issues)
{
    std::set<int> used;
    for (int i = 0; i < s.mesh_count; i++) {
        const scene_glint &g = s.materials[s.meshes[i].material].glint;
        if (!g.present || !(g.factor > 0.0F))
            continue;
        check_texcoords(root, s, s.meshes[i], issues);
        check_tangents(root, s, s.meshes[i], issues);
        used.insert(s.meshes[i].material);
    }
    for (const int material : used)
        check_density(s, material, issues);
}
