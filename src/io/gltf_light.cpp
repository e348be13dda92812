// Reads KHR_lights_punctual, EXT_lights_area (the draft of pull request 2525 at Khronos) and EXT_lights_image_based.
#include "io/gltf_light.hpp"

#include <algorithm>
#include <cmath>

#include "io/scene_memory.hpp"

namespace
{

constexpr double pi = 3.14159265358979323846;
constexpr double sun_diameter_rad = 0.00929; // of the sun seen from the earth
constexpr double bulb_radius_m = 0.01;       // our choice: a small lamp
constexpr double panel_nits = 1000.0;        // the draft's default

// ---- punctual lights ----

// A number in the extras of a light, which no schema has seen.
float extra(const tinygltf::Light &light, const char *name, double otherwise, double high, const std::string &pointer)
{
    const tinygltf::Value *value = gltf_member(light.extras, name);
    if (!value)
        return static_cast<float>(otherwise);
    const double number = value->IsNumber() ? value->GetNumberAsDouble() : -1.0;
    if (!(number >= 0.0 && number <= high))
        throw file_error(pointer + "/extras/" + name,
                         "found " + (value->IsNumber() ? json(number).dump() : std::string("no number")) +
                             ", expected one from 0 to " + json(high).dump());
    return static_cast<float>(number);
}

void read_punctual(const gltf_file &file, size_t light_number, const std::string &node_name, const matrix4 &to_world,
                   const std::string &pointer, scene *s)
{
    const tinygltf::Light &light = file.model.lights[light_number];
    const std::string light_pointer = json_pointer("/extensions/KHR_lights_punctual/lights", light_number);
    scene_light *out = scene_append(&s->lights, &s->light_count);
    out->name = scene_string(gltf_name_of(node_name, light.name, "light", s->light_count - 1));
    out->kind = light.type == "directional" ? SCENE_LIGHT_DIRECTIONAL
                : light.type == "spot"      ? SCENE_LIGHT_SPOT
                                            : SCENE_LIGHT_POINT;
    for (size_t k = 0; k < 3; k++)
        out->color[k] = light.color.size() == 3 ? static_cast<float>(light.color[k]) : 1.0F;
    out->intensity = static_cast<float>(light.intensity);
    out->range = static_cast<float>(light.range);
    out->inner_cone_rad = static_cast<float>(light.spot.innerConeAngle);
    out->outer_cone_rad = static_cast<float>(light.spot.outerConeAngle);
    if (out->kind == SCENE_LIGHT_DIRECTIONAL)
        out->angular_diameter_rad = extra(light, "angularDiameter", sun_diameter_rad, pi, light_pointer);
    else
        out->radius_m = extra(light, "radius", bulb_radius_m, 1e6, light_pointer);
    store(to_world, pointer, out->to_world);
}

// ---- area lights ----

// The light of an extension's list that a node or a scene points to; the schema has checked the index.
const tinygltf::Value &listed_light(const gltf_file &file, const char *extension, int number)
{
    return gltf_extension(file.model.extensions, extension)->Get("lights").Get(number);
}

// "The absolute value of the largest component of the node's world scale": the longest of the transformed axes.
double largest_scale(const matrix4 &m)
{
    double largest = 0.0;
    for (size_t axis = 0; axis < 12; axis += 4)
        largest = std::max(largest, std::hypot(m[axis], m[axis + 1], m[axis + 2]));
    return largest;
}

void read_area(const gltf_file &file, int light_number, const std::string &node_name, const matrix4 &to_world,
               const std::string &pointer, scene *s)
{
    const tinygltf::Value &light = listed_light(file, "EXT_lights_area", light_number);
    scene_light *out = scene_append(&s->lights, &s->light_count);
    out->name = scene_string(gltf_name_of(node_name, gltf_text(light, "name", ""), "light", s->light_count - 1));
    out->kind = gltf_text(light, "type", "rect") == "disk" ? SCENE_LIGHT_DISK : SCENE_LIGHT_RECT;
    std::fill_n(out->color, 3, 1.0F);
    gltf_numbers(light, "color", out->color, 3);
    out->intensity = static_cast<float>(gltf_number(light, "intensity", panel_nits));

    const double height = largest_scale(to_world) * gltf_number(light, "size", 1.0);
    const tinygltf::Value *rect = out->kind == SCENE_LIGHT_RECT ? gltf_member(light, "rect") : nullptr;
    const double width = height * (rect ? gltf_number(*rect, "aspect", 1.0) : 1.0);
    out->height_m = static_cast<float>(height);
    out->width_m = static_cast<float>(width);
    if (!std::isfinite(out->width_m) || !std::isfinite(out->height_m))
        throw file_error(pointer, "found an area light whose size in the world is beyond single precision");
    store(to_world, pointer, out->to_world);
}

} // namespace

std::string gltf_name_of(const std::string &first, const std::string &second, const char *kind, int number)
{
    return !first.empty() ? first : !second.empty() ? second : std::string(kind) + " " + std::to_string(number);
}

void gltf_read_lights(gltf_file &file, const tinygltf::Node &node, const matrix4 &to_world, const std::string &pointer,
                      scene *s)
{
    if (const tinygltf::Value *light = gltf_extension(node.extensions, "KHR_lights_punctual"))
        read_punctual(file, static_cast<size_t>(gltf_integer(*light, "light", 0)), node.name, to_world, pointer, s);
    const tinygltf::Value *light = gltf_extension(node.extensions, "EXT_lights_area");
    if (!light)
        return;
    if (determinant(to_world) == 0.0)
        file.warn(pointer, "is scaled to nothing; its area light is left out");
    else
        read_area(file, gltf_integer(*light, "light", 0), node.name, to_world, pointer, s);
}

void gltf_read_environment(gltf_file &file, scene *s)
{
    const tinygltf::Model &model = file.model;
    if (model.scenes.empty())
        return;
    const tinygltf::Scene &shown = model.scenes[model.defaultScene < 0 ? 0 : static_cast<size_t>(model.defaultScene)];
    const tinygltf::Value *used = gltf_extension(shown.extensions, "EXT_lights_image_based");
    if (!used)
        return;
    const tinygltf::Value &light = listed_light(file, "EXT_lights_image_based", gltf_integer(*used, "light", 0));
    scene_environment &out = s->environment;
    out.name = scene_string(gltf_text(light, "name", ""));
    out.present = true;
    for (int face = 0; face < 6; face++)
        out.faces[face] = light.Get("specularImages").Get(0).Get(face).GetNumberAsInt();
    out.rotation[3] = 1.0F;
    gltf_numbers(light, "rotation", out.rotation, 4);
    out.intensity = static_cast<float>(gltf_number(light, "intensity", 1.0));
}
