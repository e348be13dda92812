// One texel is one facet: the map has as many as the density says, and the roughness gives up what the map shows.
#include "exporters/gltf/fallback.hpp"

#include <cmath>
#include <memory>

#include "exporters/gltf/attributes.hpp"
#include "exporters/gltf/document.hpp"
#include "exporters/gltf/flakes.h"
#include "exporters/gltf/material.hpp"
#include "exporters/gltf/png.hpp"
#include "io/scene_bounds.h"
#include "scene/surface.h"

namespace
{

// Area in the world over area in texture coordinates, of everything that has the material; 1 where there is none.
class unit_meter
{
  public:
    explicit unit_meter(const scene &s) : scene_(s)
    {
    }

    double metres_per_unit(int material, int set) const
    {
        double world = 0.0, texture = 0.0;
        for (int i = 0; i < scene_.instance_count; i++) {
            const scene_instance &instance = scene_.instances[i];
            const scene_mesh &mesh = scene_.meshes[instance.mesh];
            if (mesh.material != material || !mesh.texcoord[set])
                continue;
            for (uint32_t t = 0; t < mesh.triangle_count; t++) {
                const uint32_t *corners = &mesh.index[3 * static_cast<size_t>(t)];
                world += scene_triangle_area(&scene_, &instance, t);
                texture += area_in_texture(mesh.texcoord[set], corners);
            }
        }
        return world > 0.0 && texture > 0.0 ? std::sqrt(world / texture) : 1.0;
    }

  private:
    static double area_in_texture(const float *uv, const uint32_t *corners)
    {
        double edge[2][2];
        for (size_t e = 0; e < 2; e++)
            for (size_t k = 0; k < 2; k++)
                edge[e][k] = static_cast<double>(uv[2 * size_t{ corners[e + 1] } + k]) -
                             static_cast<double>(uv[2 * size_t{ corners[0] } + k]);
        return 0.5 * std::fabs(edge[0][0] * edge[1][1] - edge[0][1] * edge[1][0]);
    }

    const scene &scene_;
};

std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

// What a layer's glints are baked into.
struct target {
    const char *normal, *roughness;
};

constexpr target base_target = { "/normalTexture", "/pbrMetallicRoughness/roughnessFactor" };
constexpr target coat_target = { "/extensions/KHR_materials_clearcoat/clearcoatNormalTexture",
                                 "/extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor" };

class baker
{
  public:
    baker(const std::string &path, const scene &s, export_container &file, report *r)
        : file_(file), original_(file.text), reading_(path, file, r), meter_(s), patch_(original_), data_(patch_, file),
          packer_(patch_, data_, reading_.images_and_materials),
          materials_(patch_.text().member(json_text::root, "materials"))
    {
    }

    ordered_json run()
    {
        const scene &s = reading_.images_and_materials;
        for (int i = 0; i < s.material_count; i++)
            if (s.materials[i].glint.present || s.materials[i].coat_glint.present)
                bake(i, s.materials[i]);
        for (const auto &[index, raw] : changed_)
            patch_.replace(patch_.text().element(materials_, index), raw);
        add_missing_attributes(reading_.file, changed_, SIZE_MAX, patch_, data_);
        data_.finish(file_);
        file_.text = patch_.result();
        file_.padding = export_padding(file_);
        return done_;
    }

  private:
    void bake(int index, const scene_material &m)
    {
        const uint32_t n = patch_.text().element(materials_, static_cast<size_t>(index));
        material_text text = { std::string(patch_.text().value(n)), patch_.text().style(), 2 };
        for (const scene_glint_layer layer : { SCENE_LAYER_BASE, SCENE_LAYER_CLEARCOAT })
            if (const scene_glint *glint = scene_layer_glint(&m, layer))
                bake_layer(text, m, *glint, index);
        material_remove(text, std::string("/extensions/") + glint_extension);
        material_remove(text, std::string("/extensions/KHR_materials_clearcoat/extensions/") + glint_extension);
        if (text.raw != patch_.text().value(n))
            changed_[static_cast<size_t>(index)] = text.raw;
    }

    void bake_layer(material_text &text, const scene_material &m, const scene_glint &glint, int index)
    {
        const bool coat = glint.layer == SCENE_LAYER_CLEARCOAT;
        if ((coat ? m.clearcoat_normal_texture : m.normal_texture).image != SCENE_NONE) {
            reading_.file.warn(json_pointer("/materials", static_cast<size_t>(index)),
                               "has a normal map, which the fallback keeps; its glints are left out there");
            return;
        }
        if (glint.structure == SCENE_STRUCTURE_EXAMPLE) {
            reading_.file.warn(json_pointer("/materials", static_cast<size_t>(index)),
                               "has an example, which is no flakes; the fallback leaves its glints out");
            return;
        }
        const auto map = std::make_unique<flakes>();
        const flakes_request request = request_of(m, glint);
        if (glint.factor > 0.0F && flakes_make(&request, map.get()))
            put_map(text, glint, index, coat ? coat_target : base_target, *map);
    }

    static flakes_request request_of(const scene_material &m, const scene_glint &glint)
    {
        const bool coat = glint.layer == SCENE_LAYER_CLEARCOAT;
        const scene_texels t = scene_texels_of(&m);
        const glint_surface s = coat ? scene_coat_surface(&m, &t) : scene_base_surface(&m, &t);
        return { glint.distribution,
                 s.alpha_x,
                 s.alpha_y,
                 glint.facet_roughness * glint.facet_roughness,
                 coat ? 0.0 : static_cast<double>(m.anisotropy_rotation),
                 glint.seed };
    }

    void put_map(material_text &text, const scene_glint &glint, int index, const target &to, const flakes &map)
    {
        const std::vector<uint8_t> png = png_bytes(map.rgb, FLAKES_SIDE, FLAKES_SIDE);
        // Unfiltered texels keep the lobe at every distance; their mean would be flat.
        constexpr int nearest = 9728;
        const size_t texture = packer_.texture(png, { { "magFilter", nearest }, { "minFilter", nearest } });
        const double width =
            1.0 / std::sqrt(static_cast<double>(glint.density) * static_cast<double>(glint.elongation));
        const double unit = glint.space == SCENE_SPACE_UV ? static_cast<double>(glint.uv_scale)
                                                          : meter_.metres_per_unit(index, glint.texcoord);
        const double across = unit / (FLAKES_SIDE * width), along = across / static_cast<double>(glint.elongation);
        material_put(text, to.normal,
                     "{\"index\":" + std::to_string(texture) + ",\"texCoord\":" + std::to_string(glint.texcoord) +
                         ",\"scale\":" + number(static_cast<double>(map.scale)) +
                         ",\"extensions\":{\"KHR_texture_transform\":{\"scale\":[" + number(along) + "," +
                         number(across) + "]}}}");
        material_put(text, to.roughness, number(std::sqrt(static_cast<double>(map.alpha_rest))));
        // The map has both roughnesses of the base in it.
        if (glint.layer == SCENE_LAYER_BASE)
            material_remove(text, "/extensions/KHR_materials_anisotropy");
        patch_.use_extension("KHR_texture_transform");
        done_.push_back({ { "index", index }, { "layer", glint.layer == SCENE_LAYER_BASE ? "base" : "clearcoat" } });
    }

    export_container &file_;
    std::string original_;
    export_reading reading_;
    unit_meter meter_;
    patch patch_;
    export_data data_;
    texture_packer packer_;
    uint32_t materials_;
    std::map<size_t, std::string> changed_;
    ordered_json done_ = ordered_json::array();
};

} // namespace

ordered_json export_bake_fallback(const std::string &path, const scene &s, export_container &file, report *r)
{
    return baker(path, s, file, r).run();
}

std::string export_fallback_path(const std::string &path)
{
    const size_t dot = path.rfind('.');
    return path.substr(0, dot) + ".fallback" + (dot == path.npos ? "" : path.substr(dot));
}
