// What a material needs follows from its text; what a primitive lacks is computed from its geometry.
#include "exporters/gltf/attributes.hpp"

#include <algorithm>
#include <cmath>

#include "io/geometry.hpp"
#include "io/gltf_primitive.hpp"
#include "io/tangent_space.h"

namespace
{

struct needs {
    bool tangent = false;
    bool glints_on_uv = false;
    int glint_set = 0;
    double uv_scale = 1.0;
    int texture_sets = 0; // the sets that textures use are those below
    int tangent_set = 0;
};

bool ends_with(const std::string &text, std::string_view end)
{
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

int set_of(const json &info)
{
    const json transform = info.value("/extensions/KHR_texture_transform"_json_pointer, json::object());
    return transform.value("texCoord", info.value("texCoord", 0));
}

void look_for_textures(const json &value, needs &n)
{
    if (value.is_array())
        for (const json &item : value)
            look_for_textures(item, n);
    if (!value.is_object())
        return;
    for (const auto &item : value.items()) {
        if (item.key() == "extras")
            continue;
        if (ends_with(item.key(), "Texture") && item.value().is_object() && item.value().contains("index"))
            n.texture_sets = std::max(n.texture_sets, set_of(item.value()) + 1);
        look_for_textures(item.value(), n);
    }
}

void add_glints(const json &object, needs &n)
{
    const json glint = object.value(json::json_pointer(std::string("/extensions/") + glint_extension), json::object());
    if (!(glint.value("glintFactor", 0.0) > 0.0) || glint.value("glintSpace", "uv") != "uv")
        return;
    n.glints_on_uv = n.tangent = true;
    n.glint_set = glint.value("glintTexCoord", 0);
    n.uv_scale = glint.value("glintUvScale", 1.0);
}

needs needs_of(const json &material)
{
    needs n;
    look_for_textures(material, n);
    const json extensions = material.value("extensions", json::object());
    const json anisotropy = extensions.value("KHR_materials_anisotropy", json::object());
    const json coat = extensions.value("KHR_materials_clearcoat", json::object());
    add_glints(coat, n);
    add_glints(material, n);
    n.tangent = n.tangent || material.contains("normalTexture") || coat.contains("clearcoatNormalTexture") ||
                anisotropy.value("anisotropyStrength", 0.0) > 0.0;
    if (material.contains("normalTexture"))
        n.tangent_set = set_of(material["normalTexture"]);
    return n;
}

// The needs of all materials that a primitive may have, those of variants included.
class gatherer
{
  public:
    gatherer(const std::map<size_t, std::string> &materials, size_t without) : without_(without)
    {
        for (const auto &[index, raw] : materials)
            needs_[index] = needs_of(json::parse(raw));
    }

    bool find(const json &primitive, needs &all) const
    {
        bool any = add(primitive.value("material", json(without_)), all);
        const json mappings =
            primitive.value("/extensions/KHR_materials_variants/mappings"_json_pointer, json::array());
        for (const json &mapping : mappings)
            any = add(mapping["material"], all) || any;
        return any;
    }

  private:
    bool add(const json &material, needs &all) const
    {
        const auto found = material.is_number() ? needs_.find(material.get<size_t>()) : needs_.end();
        if (found == needs_.end())
            return false;
        const needs &n = found->second;
        if (n.glints_on_uv) {
            all.glints_on_uv = true;
            all.glint_set = n.glint_set;
            all.uv_scale = n.uv_scale;
        }
        all.tangent = all.tangent || n.tangent;
        all.texture_sets = std::max(all.texture_sets, n.texture_sets);
        all.tangent_set = std::max(all.tangent_set, n.tangent_set);
        return true;
    }

    size_t without_; // the material of primitives that name none
    std::map<size_t, needs> needs_;
};

std::string attribute(int set)
{
    return "TEXCOORD_" + std::to_string(set);
}

// ---- TEXCOORD ----

// The axis that a normal is nearest to.
size_t nearest_axis(const float n[3])
{
    if (std::fabs(n[0]) > std::max(std::fabs(n[1]), std::fabs(n[2])))
        return 0;
    return std::fabs(n[1]) > std::fabs(n[2]) ? 1 : 2;
}

// Seen along the axis that the normal of each vertex is nearest to, in metres of the mesh over metres per unit. Without
// normals, along the shortest side of the bounding box.
std::vector<float> projected(const geometry &g, double metres_per_unit)
{
    float low[3], high[3];
    std::copy_n(g.position.data(), 3, low);
    std::copy_n(g.position.data(), 3, high);
    for (size_t i = 0; i < g.position.size(); i++) {
        low[i % 3] = std::min(low[i % 3], g.position[i]);
        high[i % 3] = std::max(high[i % 3], g.position[i]);
    }
    size_t axis = 0;
    for (size_t k = 1; k < 3; k++)
        if (high[k] - low[k] < high[axis] - low[axis])
            axis = k;
    std::vector<float> uv;
    for (size_t i = 0; i < g.vertex_count; i++) {
        if (!g.normal.empty())
            axis = nearest_axis(&g.normal[3 * i]);
        for (size_t k = 1; k < 3; k++)
            uv.push_back(static_cast<float>(static_cast<double>(g.position[3 * i + (axis + k) % 3]) / metres_per_unit));
    }
    return uv;
}

// ---- NORMAL ----

// Without NORMAL glTF shades each triangle flat. Where all triangles of each vertex lie in one plane that can be
// written down; elsewhere vertices would have to be split, and the result is empty.
std::vector<float> flat_normals(const geometry &g)
{
    geometry split = g;
    geometry_make_flat_normals(split);
    std::vector<float> normals(g.position.size(), 0.0F);
    std::vector<bool> seen(g.vertex_count);
    for (size_t corner = 0; corner < g.index.size(); corner++) {
        float *mine = &normals[3 * size_t{ g.index[corner] }];
        const float *its = &split.normal[3 * corner];
        if (!seen[g.index[corner]])
            std::copy_n(its, 3, mine);
        seen[g.index[corner]] = true;
        constexpr float rounding = 1e-6F;
        for (size_t k = 0; k < 3; k++)
            if (!(std::fabs(mine[k] - its[k]) <= rounding))
                return {};
    }
    return std::all_of(seen.begin(), seen.end(), [](bool used) { return used; }) ? normals : std::vector<float>();
}

// ---- TANGENT ----

struct tangents {
    std::vector<float> values; // 4 a vertex
    size_t torn = 0;           // vertices at which mirrored texture coordinates meet
};

// Where glints lie on three planes along the object's axes, u of plane k is axis k + 1; perpendicular to n, unit.
void plane_tangent(const float n[3], double out[3])
{
    const size_t u = (nearest_axis(n) + 1) % 3;
    for (size_t k = 0; k < 3; k++)
        out[k] = (k == u ? 1.0 : 0.0) - static_cast<double>(n[u]) * static_cast<double>(n[k]);
    const double length = std::hypot(out[0], out[1], out[2]);
    for (size_t k = 0; k < 3; k++)
        out[k] /= length;
}

void append_tangent(tangents &out, const double t[3], bool mirrored)
{
    for (size_t k = 0; k < 3; k++)
        out.values.push_back(static_cast<float>(t[k]));
    out.values.push_back(mirrored ? -1.0F : 1.0F);
}

tangents plane_tangents(const geometry &g)
{
    tangents out;
    for (size_t v = 0; v < g.vertex_count; v++) {
        double t[3];
        plane_tangent(&g.normal[3 * v], t);
        append_tangent(out, t, false);
    }
    return out;
}

// One tangent a vertex: the mean over its corners of the handedness that most of them have. Vertices stay as they are,
// for other arrays of the file count them too.
tangents compute_tangents(const geometry &g, int set)
{
    std::vector<float> corners(g.index.size() * 4);
    const tangent_space_input input = { g.vertex_count,         static_cast<uint32_t>(g.index.size() / 3),
                                        g.position.data(),      g.normal.data(),
                                        g.texcoord[set].data(), g.index.data() };
    if (!tangent_space_compute(&input, corners.data()))
        throw std::bad_alloc();
    std::vector<int> votes(g.vertex_count), count(g.vertex_count);
    for (size_t i = 0; i < g.index.size(); i++) {
        votes[g.index[i]] += corners[4 * i + 3] < 0.0F ? -1 : 1;
        count[g.index[i]]++;
    }
    std::vector<double> sums(g.vertex_count * size_t{ 3 });
    for (size_t i = 0; i < g.index.size(); i++)
        if ((corners[4 * i + 3] < 0.0F) == (votes[g.index[i]] < 0))
            for (size_t k = 0; k < 3; k++)
                sums[g.index[i] * size_t{ 3 } + k] += static_cast<double>(corners[4 * i + k]);
    tangents out;
    for (size_t v = 0; v < g.vertex_count; v++) {
        double t[3] = { sums[3 * v], sums[3 * v + 1], sums[3 * v + 2] };
        const double length = std::hypot(t[0], t[1], t[2]);
        if (length > 0.0)
            for (double &component : t)
                component /= length;
        else
            plane_tangent(&g.normal[3 * v], t);
        append_tangent(out, t, votes[v] < 0);
        out.torn += std::abs(votes[v]) != count[v];
    }
    return out;
}

// ---- files ----

class adder
{
  public:
    adder(gltf_file &file, patch &p, export_data &data) : file_(file), patch_(p), data_(data)
    {
    }

    void complete(size_t mesh, size_t primitive, uint32_t node, const needs &n)
    {
        const std::string pointer = json_pointer(json_pointer("/meshes", mesh) + "/primitives", primitive);
        const tinygltf::Mesh &whole = file_.model.meshes[mesh];
        geometry g;
        if (whole.primitives[primitive].mode < TINYGLTF_MODE_TRIANGLES ||
            !gltf_read_primitive(file_, whole, whole.primitives[primitive], pointer, g) || g.index.empty())
            return;
        attributes_ = patch_.text().member(node, "attributes");
        add_texcoords(g, n, pointer);
        if (n.glints_on_uv && !has(attribute(n.glint_set)))
            note(pointer, "has no " + attribute(n.glint_set) +
                              ", which the material's glints use; they are laid out in the object's space");
        if (n.tangent && !has("TANGENT"))
            add_tangents(g, n, !whole.primitives[primitive].targets.empty(), pointer);
    }

    // One warning for all primitives that something is said about.
    void warn() const
    {
        for (const auto &[text, pointers] : notes_) {
            const size_t others = pointers.size() - 1;
            file_.warn(pointers[0],
                       text + (others > 0 ? " (and " + std::to_string(others) + " other primitives)" : ""));
        }
    }

    attribute_count done;

  private:
    void note(const std::string &pointer, const std::string &text)
    {
        notes_[text].push_back(pointer);
    }

    bool has(const std::string &name) const
    {
        return patch_.text().member(attributes_, name) != json_text::none || new_.count(name) > 0;
    }

    void add(const std::string &name, const std::vector<float> &values, const char *type, size_t width)
    {
        const size_t view = data_.add_view(values.data(), values.size() * sizeof(float), 34962);
        const ordered_json accessor = {
            { "bufferView", view }, { "componentType", 5126 }, { "count", values.size() / width }, { "type", type }
        };
        patch_.add_member(attributes_, name, std::to_string(patch_.add_element("accessors", accessor.dump())));
        new_.insert(name);
    }

    // TEXCOORD_n may only follow TEXCOORD_(n-1).
    void add_texcoords(geometry &g, const needs &n, const std::string &pointer)
    {
        new_.clear();
        for (int set = 0; set < std::min(n.texture_sets, 2); set++) {
            if (has(attribute(set)))
                continue;
            g.texcoord[set] = projected(g, n.uv_scale);
            add(attribute(set), g.texcoord[set], "VEC2", 2);
            done.texcoords++;
            note(pointer, "has no " + attribute(set) +
                              ", which the material's textures use; it gets the position along two axes");
        }
    }

    void add_tangents(geometry &g, const needs &n, bool morphs, const std::string &pointer)
    {
        int set = std::min(n.tangent_set, 1);
        if (g.texcoord[set].empty())
            set = 1 - set;
        if (g.normal.empty() && !morphs) {
            g.normal = flat_normals(g);
            if (!g.normal.empty())
                add("NORMAL", g.normal, "VEC3", 3);
        }
        if (g.normal.empty()) {
            note(pointer, "gets no TANGENT, which the material uses: it has no NORMAL");
            return;
        }
        geometry_repair_normals(g);
        const tangents t = g.texcoord[set].empty() ? plane_tangents(g) : compute_tangents(g, set);
        if (t.torn > 0)
            note(pointer, "has vertices at which mirrored texture coordinates meet; their TANGENT is that of one side");
        add("TANGENT", t.values, "VEC4", 4);
        done.tangents++;
    }

    gltf_file &file_;
    patch &patch_;
    export_data &data_;
    uint32_t attributes_ = json_text::none;
    std::set<std::string> new_;
    std::map<std::string, std::vector<std::string>> notes_;
};

} // namespace

attribute_count add_missing_attributes(gltf_file &file, const std::map<size_t, std::string> &materials, size_t without,
                                       patch &p, export_data &data)
{
    const gatherer gathered(materials, without);
    adder all(file, p, data);
    const json_text &text = p.text();
    const uint32_t meshes = text.member(json_text::root, "meshes");
    size_t m = 0;
    for (uint32_t mesh = meshes == json_text::none ? meshes : text.node(meshes).first_child; mesh != json_text::none;
         mesh = text.node(mesh).next, m++) {
        size_t k = 0;
        const uint32_t primitives = text.member(mesh, "primitives");
        for (uint32_t primitive = text.node(primitives).first_child; primitive != json_text::none;
             primitive = text.node(primitive).next, k++) {
            needs n;
            if (gathered.find(json::parse(text.value(primitive)), n))
                all.complete(m, k, primitive, n);
        }
    }
    all.warn();
    return all.done;
}
