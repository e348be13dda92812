// Every primitive of triangles as a scene_mesh: material, normals and tangents complete.
#include "io/gltf_file.hpp"
#include "io/gltf_primitive.hpp"
#include "io/scene_memory.hpp"

namespace
{

// The material of a primitive under a variant of KHR_materials_variants; the scene's last is the default material.
int material_of(const tinygltf::Primitive &primitive, int variant, const scene *s)
{
    const tinygltf::Value *extension = gltf_extension(primitive.extensions, "KHR_materials_variants");
    const tinygltf::Value *mappings =
        extension && variant != SCENE_NONE ? gltf_member(*extension, "mappings") : nullptr;
    for (size_t i = 0; mappings && i < mappings->ArrayLen(); i++) {
        const tinygltf::Value &mapping = mappings->Get(static_cast<int>(i)), &variants = mapping.Get("variants");
        for (size_t k = 0; k < variants.ArrayLen(); k++)
            if (variants.Get(static_cast<int>(k)).GetNumberAsInt() == variant)
                return gltf_integer(mapping, "material", 0);
    }
    return primitive.material >= 0 ? primitive.material : s->material_count - 1;
}

// Tangents belong to the texture coordinates of the normal texture (glTF 2.0 section 3.7.2.1).
int tangent_set(const scene_material &material, const geometry &g)
{
    const int wanted = material.normal_texture.image != SCENE_NONE ? material.normal_texture.texcoord : 0;
    if (!g.texcoord[wanted].empty())
        return wanted;
    return g.texcoord[1 - wanted].empty() ? SCENE_NONE : 1 - wanted;
}

void complete_normals(gltf_file &file, const std::string &pointer, geometry &g)
{
    if (g.normal.empty()) {
        geometry_make_flat_normals(g);
        return;
    }
    geometry_drop_unused_vertices(g);
    const uint32_t repaired = geometry_repair_normals(g);
    if (repaired > 0)
        file.warn(pointer + "/attributes/NORMAL",
                  std::to_string(repaired) + " normals have no length; they are taken from the triangles around them");
}

void complete_tangents(gltf_file &file, const std::string &pointer, const scene_material &material, geometry &g)
{
    if (!g.tangent.empty() && !geometry_normalise_tangents(g)) {
        file.warn(pointer + "/attributes/TANGENT", "a tangent has no length; all are computed anew");
        g.tangent.clear();
    }
    const int set = tangent_set(material, g);
    if (g.tangent.empty() && set != SCENE_NONE)
        geometry_compute_tangents(g, set);
}

void warn_of_missing_texcoords(gltf_file &file, const std::string &pointer, const scene_material &material,
                               const geometry &g)
{
    for (const scene_texture *t : { &material.base_color_texture, &material.metallic_roughness_texture,
                                    &material.normal_texture, &material.occlusion_texture, &material.emissive_texture,
                                    &material.glint.texture, &material.coat_glint.texture })
        if (t->image != SCENE_NONE && g.texcoord[t->texcoord].empty())
            file.warn(pointer, "the material uses TEXCOORD_" + std::to_string(t->texcoord) +
                                   ", which the primitive has not; its textures are read at (0, 0)");
}

void append_mesh(const geometry &g, int material, const std::string &name, scene *s)
{
    scene_mesh *mesh = scene_append(&s->meshes, &s->mesh_count);
    mesh->vertex_count = g.vertex_count;
    mesh->triangle_count = static_cast<uint32_t>(g.index.size() / 3);
    mesh->material = material;
    mesh->name = scene_string(name);
    mesh->position = scene_array(g.position);
    mesh->normal = scene_array(g.normal);
    mesh->tangent = scene_array(g.tangent);
    mesh->texcoord[0] = scene_array(g.texcoord[0]);
    mesh->texcoord[1] = scene_array(g.texcoord[1]);
    mesh->color = scene_array(g.color);
    mesh->index = scene_array(g.index);
}

void read_primitive(gltf_file &file, const tinygltf::Mesh &mesh, size_t number, const std::string &pointer, int variant,
                    scene *s)
{
    const tinygltf::Primitive &primitive = mesh.primitives[number];
    geometry g;
    if (!gltf_read_primitive(file, mesh, primitive, pointer, g) || g.index.empty())
        return;
    const int material = material_of(primitive, variant, s);
    const scene_material &look = s->materials[material];
    complete_normals(file, pointer, g);
    complete_tangents(file, pointer, look, g);
    warn_of_missing_texcoords(file, pointer, look, g);
    append_mesh(g, material, pointer.substr(1), s);
}

} // namespace

std::vector<gltf_mesh_range> gltf_read_meshes(gltf_file &file, scene *s, int variant)
{
    std::vector<gltf_mesh_range> ranges;
    for (size_t i = 0; i < file.model.meshes.size(); i++) {
        const tinygltf::Mesh &mesh = file.model.meshes[i];
        const int first = s->mesh_count;
        for (size_t k = 0; k < mesh.primitives.size(); k++)
            read_primitive(file, mesh, k, json_pointer(json_pointer("/meshes", i) + "/primitives", k), variant, s);
        ranges.push_back({ first, s->mesh_count - first });
    }
    return ranges;
}
