// What a scene holds, as JSON for programs and as lines for people; both from the same JSON document.
#include <cstdio>
#include <cstdlib>

#include <unistd.h>

#include "io/json.hpp"
#include "io/scene_file.h"
#include "io/scene_memory.hpp"

namespace
{

// The fewest digits that give the same float: nine are enough for any.
ordered_json rounded(float value)
{
    char text[32];
    for (int digits = 6; digits <= 9; digits++) {
        std::snprintf(text, sizeof text, "%.*g", digits, static_cast<double>(value));
        if (std::strtof(text, nullptr) == value)
            break;
    }
    return std::strtod(text, nullptr);
}

template <size_t count> ordered_json rounded_array(const float (&values)[count])
{
    ordered_json array = ordered_json::array();
    for (const float value : values)
        array.push_back(rounded(value));
    return array;
}

ordered_json describe_bounds(const scene *s)
{
    if (s->bounds_min[0] > s->bounds_max[0])
        return nullptr;
    float size[3];
    for (size_t k = 0; k < 3; k++)
        size[k] = s->bounds_max[k] - s->bounds_min[k];
    return { { "min", rounded_array(s->bounds_min) },
             { "max", rounded_array(s->bounds_max) },
             { "size", rounded_array(size) } };
}

ordered_json describe_counts(const scene *s)
{
    uint64_t triangles = 0, vertices = 0, visible = 0;
    for (int i = 0; i < s->mesh_count; i++) {
        triangles += s->meshes[i].triangle_count;
        vertices += s->meshes[i].vertex_count;
    }
    for (int i = 0; i < s->instance_count; i++)
        visible += s->meshes[s->instances[i].mesh].triangle_count;
    return { { "meshes", s->mesh_count },     { "instances", s->instance_count }, { "vertices", vertices },
             { "triangles", triangles },      { "visible_triangles", visible },   { "materials", s->material_count },
             { "images", s->image_count },    { "cameras", s->camera_count },     { "lights", s->light_count },
             { "variants", s->variant_count } };
}

const char *image_of(const scene *s, const scene_texture &texture)
{
    return s->images[texture.image].name;
}

ordered_json describe_glint(const scene *s, const scene_glint &g)
{
    ordered_json out = { { "factor", rounded(g.factor) },
                         { "distribution", g.distribution == GLINT_DISTRIBUTION_GGX ? "ggx" : "beckmann" },
                         { "density_per_m2", rounded(g.density) },
                         { "facet_roughness", rounded(g.facet_roughness) },
                         { "color", rounded_array(g.color) },
                         { "color_variation", rounded(g.color_variation) },
                         { "elongation", rounded(g.elongation) },
                         { "coverage", rounded(g.coverage) },
                         { "density_variation", rounded(g.density_variation) },
                         { "space", g.space == SCENE_SPACE_UV ? "uv" : "object" },
                         { "texcoord", g.texcoord },
                         { "uv_scale_m", rounded(g.uv_scale) },
                         { "layer", g.layer == SCENE_LAYER_BASE ? "base" : "clearcoat" },
                         { "structure", g.structure == SCENE_STRUCTURE_FLAKES ? "flakes" : "example" },
                         { "seed", g.seed } };
    if (g.structure == SCENE_STRUCTURE_EXAMPLE) {
        out["example_placement"] = g.example_placement == SCENE_PLACEMENT_TILED ? "tiled" : "scattered";
        out["example_size_m"] = rounded(g.example_size);
        out["example_rotation_variation_rad"] = rounded(g.example_rotation_variation);
        out["example_scale_variation"] = rounded(g.example_scale_variation);
    }
    for (uint32_t i = 0; i < g.color_count; i++)
        out["colors"].push_back(rounded_array(g.colors[i]));
    const std::pair<const char *, const scene_texture &> textures[] = { { "texture", g.texture },
                                                                        { "density_texture", g.density_texture },
                                                                        { "color_texture", g.color_texture },
                                                                        { "example_texture", g.example_texture } };
    for (const auto &[name, texture] : textures)
        if (texture.image != SCENE_NONE)
            out[name] = image_of(s, texture);
    return out;
}

ordered_json describe_material(const scene *s, const scene_material &m)
{
    static const char *const alpha_modes[] = { "opaque", "mask", "blend" };
    ordered_json out = { { "name", m.name },
                         { "base_color", rounded_array(m.base_color) },
                         { "metallic", rounded(m.metallic) },
                         { "roughness", rounded(m.roughness) },
                         { "ior", rounded(m.ior) },
                         { "clearcoat", rounded(m.clearcoat) },
                         { "anisotropy", rounded(m.anisotropy) },
                         { "alpha_mode", alpha_modes[m.alpha_mode] },
                         { "double_sided", m.double_sided },
                         { "unlit", m.unlit } };
    const std::pair<const char *, const scene_texture &> textures[] = {
        { "base_color_texture", m.base_color_texture }, { "metallic_roughness_texture", m.metallic_roughness_texture },
        { "normal_texture", m.normal_texture },         { "occlusion_texture", m.occlusion_texture },
        { "emissive_texture", m.emissive_texture },
    };
    for (const auto &[name, texture] : textures)
        if (texture.image != SCENE_NONE)
            out[name] = image_of(s, texture);
    out["glint"] = m.glint.present ? describe_glint(s, m.glint) : ordered_json(nullptr);
    return out;
}

ordered_json describe_camera(const scene_camera &c)
{
    ordered_json out = { { "name", c.name },
                         { "projection", c.projection == SCENE_PERSPECTIVE ? "perspective" : "orthographic" } };
    if (c.projection == SCENE_PERSPECTIVE) {
        out["yfov_rad"] = rounded(c.yfov_rad);
        out["aspect"] = c.aspect > 0.0F ? rounded(c.aspect) : ordered_json(nullptr);
    } else {
        out["xmag_m"] = rounded(c.xmag);
        out["ymag_m"] = rounded(c.ymag);
    }
    out["position_m"] = { rounded(c.to_world[12]), rounded(c.to_world[13]), rounded(c.to_world[14]) };
    return out;
}

ordered_json describe_light(const scene_light &l)
{
    static const char *const kinds[] = { "directional", "point", "spot", "rect", "disk" };
    ordered_json out = { { "name", l.name },
                         { "kind", kinds[l.kind] },
                         { "color", rounded_array(l.color) },
                         { "intensity", rounded(l.intensity) } };
    if (l.kind == SCENE_LIGHT_DIRECTIONAL) {
        out["angular_diameter_rad"] = rounded(l.angular_diameter_rad);
        return out;
    }
    if (l.kind == SCENE_LIGHT_RECT || l.kind == SCENE_LIGHT_DISK) {
        out["width_m"] = rounded(l.width_m);
        out["height_m"] = rounded(l.height_m);
        out["position_m"] = { rounded(l.to_world[12]), rounded(l.to_world[13]), rounded(l.to_world[14]) };
        return out;
    }
    out["radius_m"] = rounded(l.radius_m);
    out["range_m"] = l.range > 0.0F ? rounded(l.range) : ordered_json(nullptr);
    out["position_m"] = { rounded(l.to_world[12]), rounded(l.to_world[13]), rounded(l.to_world[14]) };
    if (l.kind == SCENE_LIGHT_SPOT) {
        out["inner_cone_rad"] = rounded(l.inner_cone_rad);
        out["outer_cone_rad"] = rounded(l.outer_cone_rad);
    }
    return out;
}

ordered_json describe_environment(const scene *s)
{
    const scene_environment &e = s->environment;
    if (!e.present)
        return nullptr;
    ordered_json faces = ordered_json::array();
    for (const int face : e.faces)
        faces.push_back(s->images[face].name);
    return { { "name", e.name },
             { "intensity", rounded(e.intensity) },
             { "rotation", rounded_array(e.rotation) },
             { "faces", faces } };
}

ordered_json describe_image(const scene_image &image)
{
    return image.path ? ordered_json{ { "name", image.name },
                                      { "embedded", false },
                                      { "missing", access(image.path, R_OK) != 0 } }
                      : ordered_json{ { "name", image.name }, { "embedded", true }, { "bytes", image.byte_count } };
}

ordered_json describe_mesh(const scene *s, const scene_mesh &mesh)
{
    return { { "name", mesh.name },
             { "vertices", mesh.vertex_count },
             { "triangles", mesh.triangle_count },
             { "material", s->materials[mesh.material].name },
             { "texcoords", (mesh.texcoord[0] ? 1 : 0) + (mesh.texcoord[1] ? 1 : 0) },
             { "colors", mesh.color != nullptr } };
}

// What a user of the file would want to know before rendering.
ordered_json describe_notes(const scene *s)
{
    ordered_json notes = ordered_json::array();
    if (s->instance_count == 0)
        notes.push_back("nothing to see: no triangles");
    if (s->camera_count == 0)
        notes.push_back("no camera: rendering frames the whole scene");
    if (s->light_count == 0 && !s->environment.present)
        notes.push_back("no lights: rendering adds a lookdev rig");
    for (int i = 0; i < s->mesh_count; i++) {
        const scene_mesh &mesh = s->meshes[i];
        const scene_material &m = s->materials[mesh.material];
        if (m.glint.present && m.glint.space == SCENE_SPACE_UV && !mesh.texcoord[m.glint.texcoord])
            notes.push_back(std::string(mesh.name) + ": the glints of " + m.name + " need TEXCOORD_" +
                            std::to_string(m.glint.texcoord) + ", which the mesh has not");
    }
    for (int i = 0; i < s->image_count; i++)
        if (s->images[i].path && access(s->images[i].path, R_OK) != 0)
            notes.push_back(std::string(s->images[i].name) + ": the image cannot be read");
    return notes;
}

ordered_json describe(const scene *s)
{
    ordered_json out = { { "file", s->path ? s->path : "" },
                         { "counts", describe_counts(s) },
                         { "bounds_m", describe_bounds(s) } };
    for (const char *list : { "meshes", "materials", "cameras", "lights", "images", "variants" })
        out[list] = ordered_json::array();
    for (int i = 0; i < s->mesh_count; i++)
        out["meshes"].push_back(describe_mesh(s, s->meshes[i]));
    for (int i = 0; i < s->material_count; i++)
        out["materials"].push_back(describe_material(s, s->materials[i]));
    for (int i = 0; i < s->camera_count; i++)
        out["cameras"].push_back(describe_camera(s->cameras[i]));
    for (int i = 0; i < s->light_count; i++)
        out["lights"].push_back(describe_light(s->lights[i]));
    out["environment"] = describe_environment(s);
    for (int i = 0; i < s->image_count; i++)
        out["images"].push_back(describe_image(s->images[i]));
    for (int i = 0; i < s->variant_count; i++)
        out["variants"].push_back(s->variants[i]);
    out["notes"] = describe_notes(s);
    return out;
}

// "name value, name value": one line for an object of plain values; what is false goes without saying.
std::string line_of(const ordered_json &object)
{
    std::string line;
    for (const auto &item : object.items()) {
        if (item.key() == "name" || item.value().is_object() || item.value().is_null() || item.value() == false)
            continue;
        const bool text = item.value().is_string();
        line += (line.empty() ? "" : ", ") + item.key() + " " +
                (text ? item.value().get<std::string>() : item.value().dump());
    }
    return line;
}

void add_list(std::string &out, const std::string &title, const ordered_json &list)
{
    for (const ordered_json &item : list) {
        if (item.is_string()) {
            out += title + ": " + item.get<std::string>() + "\n";
            continue;
        }
        out += title + " " + item["name"].get<std::string>() + ": " + line_of(item) + "\n";
        if (item.contains("glint") && item["glint"].is_object())
            out += "  glint: " + line_of(item["glint"]) + "\n";
    }
}

std::string text_of(const ordered_json &all)
{
    std::string out = "file: " + all["file"].get<std::string>() + "\ncounts: " + line_of(all["counts"]) + "\n";
    out +=
        "bounds: " + (all["bounds_m"].is_null() ? std::string("none") : line_of(all["bounds_m"]) + " (metres)") + "\n";
    add_list(out, "material", all["materials"]);
    add_list(out, "mesh", all["meshes"]);
    add_list(out, "camera", all["cameras"]);
    add_list(out, "light", all["lights"]);
    if (!all["environment"].is_null())
        add_list(out, "environment", ordered_json::array({ all["environment"] }));
    add_list(out, "image", all["images"]);
    add_list(out, "variant", all["variants"]);
    add_list(out, "note", all["notes"]);
    return out;
}

} // namespace

char *scene_describe(const scene *s, bool as_json)
{
    try {
        const ordered_json all = describe(s);
        return scene_string(as_json ? all.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n"
                                    : text_of(all));
    } catch (const std::exception &) {
        return nullptr;
    }
}
