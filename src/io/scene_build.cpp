// A caller's arrays as meshes, one a material, and a caller's JSON as materials.
#include "io/scene_build.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "io/geometry.hpp"
#include "io/gltf_document.hpp"
#include "io/gltf_rules.hpp"
#include "io/gltf_schema.hpp"
#include "io/scene_memory.hpp"

namespace
{

// Runs work and turns what it throws into an error that begins with name.
template <class Work> bool guarded(const char *name, report *r, Work work)
{
    try {
        work();
        return true;
    } catch (const file_error &e) {
        report_error(r, "%s", gltf_message(name, e).c_str());
    } catch (const std::bad_alloc &) {
        report_error(r, "%s: does not fit into memory", name);
    } catch (const std::exception &e) {
        report_error(r, "%s: cannot be read: %s", name, e.what());
    }
    return false;
}

const char *name_of(const scene_arrays *from)
{
    return from->name ? from->name : "a mesh";
}

// ---- materials ----

// The smallest document around them. Of images only the number counts, which the indices are checked with.
json material_document(json root, int image_count)
{
    if (!root.is_object())
        throw file_error("", "found " + json_excerpt(root) + ", expected an object with \"materials\"");
    json out = { { "asset", { { "version", "2.0" } } } };
    for (const char *array : { "materials", "textures", "samplers" })
        if (root.contains(array))
            out[array] = std::move(root[array]);
    for (int i = 0; i < image_count; i++)
        out["images"].push_back(json::object());
    return out;
}

void read_materials(scene *s, std::string_view text, report *r)
{
    json root = material_document(json_parse(text), s->image_count);
    gltf::check_schema(root);
    gltf::check_rules(root);
    root.erase("images");
    gltf_file file = { "materials", "", r, {}, {}, {}, 0, {}, {} };
    file.model = gltf_tiny_model(std::move(root));
    gltf_read_materials(file, s);
}

// ---- meshes ----

void check_finite(const float *values, size_t components, const scene_arrays *from, const char *what)
{
    const size_t count = values ? components * from->vertex_count : 0;
    for (size_t i = 0; i < count; i++)
        if (!std::isfinite(values[i]))
            throw file_error(json_pointer(std::string("/") + what, i / components),
                             "found " + std::to_string(values[i]) + ", expected a finite number");
}

void check_indices(const scene_arrays *from, int material_count)
{
    const size_t corners = size_t{ 3 } * from->triangle_count;
    for (size_t i = 0; i < corners; i++)
        if (from->index[i] >= from->vertex_count)
            throw file_error(json_pointer("/index", i), "found " + std::to_string(from->index[i]) +
                                                            ", expected less than the " +
                                                            std::to_string(from->vertex_count) + " vertices");
    for (size_t i = 0; from->material && i < from->triangle_count; i++)
        if (from->material[i] < 0 || from->material[i] >= material_count)
            throw file_error(json_pointer("/material", i), "found " + std::to_string(from->material[i]) +
                                                               ", expected an index into the " +
                                                               std::to_string(material_count) + " materials");
}

void check_arrays(const scene *s, const scene_arrays *from)
{
    if (from->triangle_count > 0 && (!from->position || !from->index))
        throw file_error(from->position ? "/index" : "/position",
                         "found none, expected those of " + std::to_string(from->triangle_count) + " triangles");
    if (from->triangle_count > UINT32_MAX / 3)
        throw file_error("", "found " + std::to_string(from->triangle_count) + " triangles, expected at most " +
                                 std::to_string(UINT32_MAX / 3));
    if (s->material_count == 0 && from->triangle_count > 0)
        throw file_error("", "found triangles but no material; expected at least one");
    check_finite(from->position, 3, from, "position");
    check_finite(from->normal, 3, from, "normal");
    check_finite(from->tangent, 4, from, "tangent");
    check_finite(from->texcoord[0], 2, from, "texcoord0");
    check_finite(from->texcoord[1], 2, from, "texcoord1");
    check_finite(from->color, 4, from, "color");
    check_indices(from, s->material_count);
}

// The values of some vertices; all of them where the list is NULL.
std::vector<float> copy(const float *values, size_t width, size_t vertex_count, const std::vector<uint32_t> *vertices)
{
    if (!values)
        return {};
    if (!vertices)
        return std::vector<float>(values, values + width * vertex_count);
    std::vector<float> out(width * vertices->size());
    for (size_t i = 0; i < vertices->size(); i++)
        std::copy_n(&values[(*vertices)[i] * width], width, &out[i * width]);
    return out;
}

void copy_vertices(const scene_arrays *from, const std::vector<uint32_t> *vertices, geometry &g)
{
    const size_t count = from->vertex_count;
    g.vertex_count = vertices ? static_cast<uint32_t>(vertices->size()) : from->vertex_count;
    g.position = copy(from->position, 3, count, vertices);
    g.normal = copy(from->normal, 3, count, vertices);
    g.tangent = copy(from->tangent, 4, count, vertices);
    g.texcoord[0] = copy(from->texcoord[0], 2, count, vertices);
    g.texcoord[1] = copy(from->texcoord[1], 2, count, vertices);
    g.color = copy(from->color, 4, count, vertices);
}

// The triangles of one material, with the vertices that they use.
geometry triangles_of(const scene_arrays *from, int material)
{
    geometry g;
    if (!from->material) {
        g.index.assign(from->index, from->index + size_t{ 3 } * from->triangle_count);
        copy_vertices(from, nullptr, g);
        geometry_drop_unused_vertices(g);
        return g;
    }
    constexpr uint32_t unused = UINT32_MAX;
    std::vector<uint32_t> renumbered(from->vertex_count, unused), vertices;
    for (size_t corner = 0; corner < size_t{ 3 } * from->triangle_count; corner++) {
        if (from->material[corner / 3] != material)
            continue;
        uint32_t &number = renumbered[from->index[corner]];
        if (number == unused) {
            number = static_cast<uint32_t>(vertices.size());
            vertices.push_back(from->index[corner]);
        }
        g.index.push_back(number);
    }
    copy_vertices(from, &vertices, g);
    return g;
}

bool lies_along_texcoords(const scene_glint &glint)
{
    return glint.present && glint.factor > 0.0F;
}

// Only what has a direction on the surface needs a tangent: normal maps, anisotropy, and facets, whose slopes have one.
bool needs_tangents(const scene_material &m)
{
    return m.normal_texture.image != SCENE_NONE || m.clearcoat_normal_texture.image != SCENE_NONE ||
           m.anisotropy != 0.0F || lies_along_texcoords(m.glint) || lies_along_texcoords(m.coat_glint);
}

// Tangents belong to the texture coordinates of the normal texture (glTF 2.0 section 3.7.2.1).
size_t tangent_texcoord(const scene_material &m)
{
    return m.normal_texture.image != SCENE_NONE ? static_cast<size_t>(m.normal_texture.texcoord) : 0;
}

void complete_tangents(const scene_material &m, geometry &g)
{
    const size_t wanted = tangent_texcoord(m);
    const size_t set = g.texcoord[wanted].empty() ? 1 - wanted : wanted;
    if (!g.tangent.empty() && geometry_normalise_tangents(g))
        return;
    g.tangent.clear();
    if (needs_tangents(m) && !g.texcoord[set].empty())
        geometry_compute_tangents(g, static_cast<int>(set));
}

void append_mesh(scene *s, const scene_arrays *from, int material, report *r)
{
    geometry g = triangles_of(from, material);
    if (g.normal.empty())
        geometry_make_flat_normals(g);
    const uint32_t repaired = geometry_repair_normals(g);
    if (repaired > 0)
        report_warning(r, "%s: %u normals have no length; they are taken from the triangles around them", name_of(from),
                       repaired);
    complete_tangents(s->materials[material], g);
    scene_mesh *mesh = scene_append(&s->meshes, &s->mesh_count);
    mesh->vertex_count = g.vertex_count;
    mesh->triangle_count = static_cast<uint32_t>(g.index.size() / 3);
    mesh->material = material;
    mesh->name = scene_string(name_of(from));
    mesh->position = scene_array(g.position);
    mesh->normal = scene_array(g.normal);
    mesh->tangent = scene_array(g.tangent);
    mesh->texcoord[0] = scene_array(g.texcoord[0]);
    mesh->texcoord[1] = scene_array(g.texcoord[1]);
    mesh->color = scene_array(g.color);
    mesh->index = scene_array(g.index);
}

// In the order of the materials, as they come in the scene.
std::vector<bool> used_materials(const scene *s, const scene_arrays *from)
{
    std::vector<bool> used(static_cast<size_t>(s->material_count), false);
    if (!from->material && from->triangle_count > 0)
        used[0] = true;
    for (size_t i = 0; from->material && i < from->triangle_count; i++)
        used[static_cast<size_t>(from->material[i])] = true;
    return used;
}

} // namespace

bool scene_build_materials(scene *s, const char *text, size_t length, report *r)
{
    return guarded("materials", r, [&] { read_materials(s, std::string_view(text, length), r); });
}

bool scene_build_mesh(scene *s, const scene_arrays *from, report *r)
{
    return guarded(name_of(from), r, [&] {
        check_arrays(s, from);
        const std::vector<bool> used = used_materials(s, from);
        for (size_t material = 0; material < used.size(); material++)
            if (used[material])
                append_mesh(s, from, static_cast<int>(material), r);
    });
}

bool scene_build_same_meshes(const scene_material *a, const scene_material *b)
{
    return needs_tangents(*a) == needs_tangents(*b) && tangent_texcoord(*a) == tangent_texcoord(*b);
}
