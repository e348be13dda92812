// What hangs on the nodes of the scene: instances of meshes and cameras; gltf_light.cpp reads the lights.
#include <algorithm>
#include <cmath>

#include "io/gltf_accessor.hpp"
#include "io/gltf_graph.hpp"
#include "io/gltf_light.hpp"
#include "io/scene_memory.hpp"

namespace
{

constexpr int max_instances = 1 << 26; // our choice: 6 GB of them

struct node_reader {
    gltf_file &file;
    const gltf_graph &graph;
    const std::vector<gltf_mesh_range> &meshes;
    scene *s;
};

// ---- meshes ----

void append_instances(node_reader &r, size_t number, gltf_mesh_range range, const matrix4 &to_world,
                      const std::string &pointer)
{
    if (determinant(to_world) == 0.0) {
        r.file.warn(pointer, "is scaled to nothing; its mesh is left out");
        return;
    }
    for (int i = 0; i < range.count; i++) {
        if (r.file.elements_left == 0 || r.s->instance_count >= max_instances)
            throw file_error(pointer, "found more instances than the bytes of the file account for");
        r.file.elements_left--;
        scene_instance *instance = scene_append(&r.s->instances, &r.s->instance_count);
        instance->name = scene_string(r.file.model.nodes[number].name);
        instance->mesh = range.first + i;
        instance->node = static_cast<int>(number);
        store(to_world, pointer, instance->to_world);
    }
}

// EXT_mesh_gpu_instancing: one attribute of all instances, or defaults.
std::vector<float> instance_attribute(gltf_file &file, const tinygltf::Value &attributes, const char *name,
                                      int components, const std::string &pointer, size_t &count)
{
    const int accessor = gltf_integer(attributes, name, -1);
    if (accessor < 0)
        return {};
    const unsigned allowed = components == 4 ? GLTF_FLOAT | GLTF_BYTE_NORMALIZED | GLTF_SHORT_NORMALIZED : GLTF_FLOAT;
    gltf_check_accessor(file, accessor, components, components, allowed, std::string("the instance attribute ") + name);
    std::vector<float> values = gltf_read_floats(file, accessor);
    const size_t found = values.size() / static_cast<size_t>(components);
    if (count != 0 && found != count)
        throw file_error(json_pointer(pointer + "/attributes", name),
                         "found " + std::to_string(found) + " instances, expected the " + std::to_string(count) +
                             " of the other attributes");
    count = found;
    return values;
}

void append_gpu_instances(node_reader &r, size_t number, gltf_mesh_range range, const tinygltf::Value &extension,
                          const std::string &pointer)
{
    const std::string here = pointer + "/extensions/EXT_mesh_gpu_instancing";
    const tinygltf::Value *attributes = gltf_member(extension, "attributes");
    size_t count = 0;
    if (!attributes)
        return;
    const std::vector<float> translations = instance_attribute(r.file, *attributes, "TRANSLATION", 3, here, count),
                             rotations = instance_attribute(r.file, *attributes, "ROTATION", 4, here, count),
                             scales = instance_attribute(r.file, *attributes, "SCALE", 3, here, count);
    for (size_t i = 0; i < count; i++) {
        double translation[3] = { 0, 0, 0 }, rotation[4] = { 0, 0, 0, 1 }, scale[3] = { 1, 1, 1 };
        if (!translations.empty())
            std::copy_n(&translations[3 * i], 3, translation);
        if (!rotations.empty())
            std::copy_n(&rotations[4 * i], 4, rotation);
        if (!scales.empty())
            std::copy_n(&scales[3 * i], 3, scale);
        if (rotation[0] == 0.0 && rotation[1] == 0.0 && rotation[2] == 0.0 && rotation[3] == 0.0)
            throw file_error(here + "/attributes/ROTATION",
                             "found a quaternion of length 0 in instance " + std::to_string(i));
        append_instances(r, number, range, multiply(r.graph.to_world[number], compose(translation, rotation, scale)),
                         pointer);
    }
}

// In its bind pose every joint moves a skinned mesh alike: by the joint's place times its inverse bind matrix. The
// node's own transform does not count (glTF 2.0 section 3.7.3.3).
matrix4 skinned_transform(node_reader &r, int skin_number, const std::string &pointer)
{
    const tinygltf::Skin &skin = r.file.model.skins[static_cast<size_t>(skin_number)];
    r.file.warn(pointer, "skins stand still, in their bind pose");
    const matrix4 &joint = r.graph.to_world[static_cast<size_t>(skin.joints[0])];
    if (skin.inverseBindMatrices < 0)
        return joint;
    gltf_check_accessor(r.file, skin.inverseBindMatrices, 16, 16, GLTF_FLOAT, "inverse bind matrices");
    const std::vector<float> matrices = gltf_read_floats(r.file, skin.inverseBindMatrices);
    matrix4 inverse_bind;
    std::copy_n(matrices.begin(), 16, inverse_bind.begin());
    return multiply(joint, inverse_bind);
}

void read_mesh(node_reader &r, size_t number, const std::string &pointer)
{
    const tinygltf::Node &node = r.file.model.nodes[number];
    const gltf_mesh_range range = r.meshes[static_cast<size_t>(node.mesh)];
    if (!node.weights.empty() && node.weights != r.file.model.meshes[static_cast<size_t>(node.mesh)].weights)
        r.file.warn(pointer + "/weights", "are left out; morph targets have the weights of the mesh");
    if (const tinygltf::Value *instancing = gltf_extension(node.extensions, "EXT_mesh_gpu_instancing"))
        append_gpu_instances(r, number, range, *instancing, pointer);
    else if (node.skin >= 0)
        append_instances(r, number, range, skinned_transform(r, node.skin, pointer), pointer);
    else
        append_instances(r, number, range, r.graph.to_world[number], pointer);
}

// ---- cameras ----

void read_camera(node_reader &r, size_t number, const std::string &pointer)
{
    const tinygltf::Node &node = r.file.model.nodes[number];
    const tinygltf::Camera &camera = r.file.model.cameras[static_cast<size_t>(node.camera)];
    const bool perspective = camera.type == "perspective";
    scene_camera *out = scene_append(&r.s->cameras, &r.s->camera_count);
    out->name = scene_string(gltf_name_of(node.name, camera.name, "camera", r.s->camera_count - 1));
    out->projection = perspective ? SCENE_PERSPECTIVE : SCENE_ORTHOGRAPHIC;
    out->yfov_rad = static_cast<float>(camera.perspective.yfov);
    out->aspect = static_cast<float>(camera.perspective.aspectRatio);
    out->xmag = static_cast<float>(std::abs(camera.orthographic.xmag));
    out->ymag = static_cast<float>(std::abs(camera.orthographic.ymag));
    out->znear = static_cast<float>(perspective ? camera.perspective.znear : camera.orthographic.znear);
    out->zfar = static_cast<float>(perspective ? camera.perspective.zfar : camera.orthographic.zfar);
    store(r.graph.to_world[number], pointer, out->to_world);
}

} // namespace

void gltf_read_nodes(gltf_file &file, const std::vector<gltf_mesh_range> &meshes, scene *s)
{
    const gltf_graph graph = gltf_read_graph(file);
    node_reader r = { file, graph, meshes, s };
    for (const size_t number : graph.visible) {
        const tinygltf::Node &node = file.model.nodes[number];
        const std::string pointer = json_pointer("/nodes", number);
        if (node.mesh >= 0)
            read_mesh(r, number, pointer);
        if (node.camera >= 0)
            read_camera(r, number, pointer);
        gltf_read_lights(file, node, graph.to_world[number], pointer, s);
    }
}
