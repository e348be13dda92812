// Nodes with what hangs on them: meshes, cameras and lights; then the lists that they point into.
#include "exporters/gltf/scene_document.hpp"

#include <algorithm>
#include <set>

#include "exporters/gltf/scene_data.hpp"
#include "exporters/gltf/scene_material.hpp"
#include "exporters/gltf/scene_transform.hpp"

namespace
{

// ---- the document ----

class scene_writer
{
  public:
    scene_writer(const scene &s, bool glb, report *r) : scene_(s), report_(r), images_(s, buffer_)
    {
        file_.glb = glb;
    }

    export_container run(const json &environment)
    {
        for (int i = 0; i < scene_.material_count; i++)
            materials_.push_back(
                export_material(scene_.materials[i], [this](const scene_texture &t) { return images_.texture(t); }));
        write_objects();
        for (int i = 0; i < scene_.camera_count; i++)
            write_camera(scene_.cameras[i]);
        for (int i = 0; i < scene_.light_count; i++)
            write_light(scene_.lights[i]);
        const ordered_json image_based = image_based_of(environment);
        put_together(image_based);
        return std::move(file_);
    }

  private:
    // ---- nodes ----

    ordered_json &node_at(size_t number)
    {
        while (nodes_.size() <= number)
            nodes_.push_back(ordered_json::object());
        return nodes_[number];
    }

    // Numbers that no object has are for what has no facets.
    ordered_json &free_node(const char *name)
    {
        while (next_ < nodes_.size() && !nodes_[next_].empty())
            next_++;
        ordered_json &node = node_at(next_);
        node["name"] = name;
        return node;
    }

    // Instances of one node stand together in the scene, one for each primitive of its mesh.
    void write_objects()
    {
        size_t moved = 0;
        std::vector<int> later;
        for (int first = 0; first < scene_.instance_count;) {
            const int count = primitives_of(first);
            const auto number = static_cast<size_t>(scene_.instances[first].node);
            if (node_at(number).empty())
                write_object(node_at(number), first, count);
            else
                later.push_back(first);
            first += count;
        }
        for (const int first : later) {
            nodes_.push_back(ordered_json::object());
            write_object(nodes_.back(), first, primitives_of(first));
            moved++;
        }
        if (moved > 0)
            report_warning(
                report_, "%s: %zu instances of EXT_mesh_gpu_instancing become nodes of their own, and get other facets",
                scene_.path ? scene_.path : "scene", moved);
    }

    int primitives_of(int first) const
    {
        const scene_instance &a = scene_.instances[first];
        int count = 1;
        for (int i = first + 1; i < scene_.instance_count; i++, count++) {
            const scene_instance &b = scene_.instances[i];
            if (b.node != a.node || b.mesh != a.mesh + count || !std::equal(a.to_world, a.to_world + 16, b.to_world))
                break;
        }
        return count;
    }

    void write_object(ordered_json &node, int first, int count)
    {
        const scene_instance &i = scene_.instances[first];
        if (i.name && *i.name)
            node["name"] = i.name;
        if (is_right_angled(i.to_world)) {
            node["mesh"] = mesh(i.mesh, count);
            set_matrix(node, i.to_world);
        } else {
            node["mesh"] = placed_mesh_of(i, count);
        }
    }

    // ---- meshes ----

    size_t mesh(int first, int count)
    {
        const auto [known, is_new] = meshes_.emplace(std::make_pair(first, count), mesh_list_.size());
        if (is_new) {
            ordered_json primitives = ordered_json::array();
            for (int i = first; i < first + count; i++)
                primitives.push_back(primitive(scene_.meshes[i]));
            mesh_list_.push_back({ { "primitives", primitives } });
        }
        return known->second;
    }

    // Its vertices in the world: glTF has no transform that shears.
    size_t placed_mesh_of(const scene_instance &instance, int count)
    {
        report_warning(report_,
                       "%s: nodes/%d: its transform shears, so its vertices are written in the world; facets in "
                       "\"object\" space are others",
                       scene_.path ? scene_.path : "scene", instance.node);
        ordered_json primitives = ordered_json::array();
        for (int i = instance.mesh; i < instance.mesh + count; i++) {
            placed_mesh vertices = placed(scene_.meshes[i], instance.to_world);
            scene_mesh copy = scene_.meshes[i];
            copy.position = vertices.position.data();
            copy.normal = vertices.normal.data();
            copy.tangent = vertices.tangent.empty() ? nullptr : vertices.tangent.data();
            copy.index = vertices.index.data();
            primitives.push_back(primitive(copy));
        }
        mesh_list_.push_back({ { "primitives", primitives } });
        return mesh_list_.size() - 1;
    }

    // Whether facets lie elsewhere when there is a TEXCOORD_0, which glTF wants before TEXCOORD_1.
    bool hangs_on_first(const scene_mesh &m) const
    {
        const scene_material &look = scene_.materials[m.material];
        for (const scene_glint *g : { &look.glint, &look.coat_glint })
            if (g->present && g->space == SCENE_SPACE_UV && g->texcoord == 0)
                return true;
        return false;
    }

    ordered_json primitive(const scene_mesh &m)
    {
        ordered_json attributes = { { "POSITION", buffer_.add_positions(m.position, m.vertex_count) },
                                    { "NORMAL", buffer_.add_floats(m.normal, m.vertex_count, 3, "VEC3") } };
        if (m.tangent)
            attributes["TANGENT"] = buffer_.add_floats(m.tangent, m.vertex_count, 4, "VEC4");
        const std::vector<float> nowhere(2 * size_t{ m.vertex_count }, 0.0F);
        if (!m.texcoord[0] && m.texcoord[1] && !hangs_on_first(m))
            attributes["TEXCOORD_0"] = buffer_.add_floats(nowhere.data(), m.vertex_count, 2, "VEC2");
        for (int set = 0; set < 2; set++)
            if (m.texcoord[set])
                attributes["TEXCOORD_" + std::to_string(set)] =
                    buffer_.add_floats(m.texcoord[set], m.vertex_count, 2, "VEC2");
        if (m.color)
            attributes["COLOR_0"] = buffer_.add_floats(m.color, m.vertex_count, 4, "VEC4");
        return { { "attributes", attributes },
                 { "indices", buffer_.add_indices(m.index, size_t{ 3 } * m.triangle_count) },
                 { "material", m.material } };
    }

    // ---- cameras and lights ----

    void write_camera(const scene_camera &c)
    {
        ordered_json lens;
        const bool perspective = c.projection == SCENE_PERSPECTIVE;
        if (perspective) {
            lens = { { "yfov", export_number(c.yfov_rad) }, { "znear", export_number(c.znear) } };
            if (c.aspect > 0.0F)
                lens["aspectRatio"] = export_number(c.aspect);
            if (c.zfar > 0.0F)
                lens["zfar"] = export_number(c.zfar);
        } else {
            lens = { { "xmag", export_number(c.xmag) },
                     { "ymag", export_number(c.ymag) },
                     { "znear", export_number(c.znear) },
                     { "zfar", export_number(c.zfar) } };
        }
        const char *kind = perspective ? "perspective" : "orthographic";
        ordered_json &node = free_node(c.name);
        node["camera"] = cameras_.size();
        set_matrix(node, rigid(c.to_world).data());
        cameras_.push_back({ { "type", kind }, { kind, lens } });
    }

    void write_light(const scene_light &l)
    {
        const bool area = l.kind == SCENE_LIGHT_RECT || l.kind == SCENE_LIGHT_DISK;
        ordered_json &list = area ? area_lights_ : punctual_lights_;
        ordered_json &node = free_node(l.name);
        node["extensions"][area ? "EXT_lights_area" : "KHR_lights_punctual"] = { { "light", list.size() } };
        set_matrix(node, rigid(l.to_world).data());
        list.push_back(area ? area_light(l) : punctual_light(l));
    }

    static ordered_json punctual_light(const scene_light &l)
    {
        const bool sun = l.kind == SCENE_LIGHT_DIRECTIONAL;
        ordered_json out = { { "type", sun                          ? "directional"
                                       : l.kind == SCENE_LIGHT_SPOT ? "spot"
                                                                    : "point" },
                             { "color", export_numbers(l.color, 3) },
                             { "intensity", export_number(l.intensity) } };
        if (l.range > 0.0F)
            out["range"] = export_number(l.range);
        if (l.kind == SCENE_LIGHT_SPOT)
            out["spot"] = { { "innerConeAngle", export_number(l.inner_cone_rad) },
                            { "outerConeAngle", export_number(l.outer_cone_rad) } };
        out["extras"] = { { sun ? "angularDiameter" : "radius",
                            export_number(sun ? l.angular_diameter_rad : l.radius_m) } };
        return out;
    }

    static ordered_json area_light(const scene_light &l)
    {
        ordered_json out = { { "type", l.kind == SCENE_LIGHT_DISK ? "disk" : "rect" },
                             { "color", export_numbers(l.color, 3) },
                             { "intensity", export_number(l.intensity) },
                             { "size", export_number(l.height_m) } };
        if (l.kind == SCENE_LIGHT_RECT)
            out["rect"] = { { "aspect", static_cast<double>(l.width_m) / static_cast<double>(l.height_m) } };
        return out;
    }

    // Its smaller images are of no use to anybody who has the largest.
    ordered_json image_based_of(const json &from)
    {
        if (from.is_null() || !scene_.environment.present)
            return {};
        ordered_json out = ordered_json::parse(from.dump());
        for (ordered_json &level : out["specularImages"])
            for (ordered_json &face : level)
                face = images_.image(face.get<int>());
        return out;
    }

    // ---- all of it ----

    void put_together(const ordered_json &image_based)
    {
        const std::string version = std::to_string(GLINT_VERSION_MAJOR) + "." + std::to_string(GLINT_VERSION_MINOR) +
                                    "." + std::to_string(GLINT_VERSION_PATCH);
        ordered_json document = {
            { "asset", { { "version", "2.0" }, { "generator", "glint export gltf, libglint " + version } } }
        };
        ordered_json shown = ordered_json::object(), extensions = ordered_json::object();
        for (size_t i = 0; i < nodes_.size(); i++)
            if (!nodes_[i].empty())
                shown["nodes"].push_back(i);
        if (!punctual_lights_.empty())
            extensions["KHR_lights_punctual"] = { { "lights", punctual_lights_ } };
        if (!area_lights_.empty())
            extensions["EXT_lights_area"] = { { "lights", area_lights_ } };
        if (!image_based.is_null()) {
            extensions["EXT_lights_image_based"] = { { "lights", ordered_json::array({ image_based }) } };
            shown["extensions"]["EXT_lights_image_based"] = { { "light", 0 } };
        }
        document["scene"] = 0;
        document["scenes"] = ordered_json::array({ shown });
        put(document, "nodes", nodes_);
        put(document, "cameras", cameras_);
        put(document, "meshes", mesh_list_);
        put(document, "materials", materials_);
        images_.finish(document);
        buffer_.finish(document, file_);
        if (!extensions.empty())
            document["extensions"] = extensions;
        std::set<std::string> used;
        find_extensions(document, used);
        if (!used.empty())
            document["extensionsUsed"] = used;
        file_.text = document.dump();
        file_.padding = export_padding(file_);
    }

    static void put(ordered_json &document, const char *name, const ordered_json &list)
    {
        if (!list.empty())
            document[name] = list;
    }

    static void find_extensions(const ordered_json &value, std::set<std::string> &used)
    {
        for (const auto &item : value.items()) {
            if (!item.value().is_structured())
                continue;
            if (value.is_object() && item.key() == "extensions")
                for (const auto &extension : item.value().items())
                    used.insert(extension.key());
            find_extensions(item.value(), used);
        }
    }

    const scene &scene_;
    report *report_;
    export_container file_;
    buffer_writer buffer_;
    image_writer images_;
    size_t next_ = 0;
    std::map<std::pair<int, int>, size_t> meshes_; // first primitive and count
    ordered_json nodes_ = ordered_json::array(), mesh_list_ = ordered_json::array(), materials_ = ordered_json::array(),
                 cameras_ = ordered_json::array(), punctual_lights_ = ordered_json::array(),
                 area_lights_ = ordered_json::array();
};

} // namespace

export_container export_scene_document(const scene &s, const json &environment, bool glb, report *r)
{
    return scene_writer(s, glb, r).run(environment);
}
