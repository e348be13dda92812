// The version of the file, what it requires, and pairs of properties that must fit each other.
#include "io/gltf_rules.hpp"

#include <cmath>

#include "io/file_error.hpp"
#include "io/gltf_tiny.hpp"

namespace gltf
{

namespace
{

constexpr double pi = 3.14159265358979323846;

// Calls check(element, its pointer) for each element of the array at pointer, if there is one.
template <class Check> void for_each(const json &root, const std::string &pointer, Check check)
{
    const json::json_pointer where(pointer);
    if (!root.contains(where))
        return;
    const json &array = root.at(where);
    for (size_t i = 0; i < array.size(); i++)
        check(array[i], json_pointer(pointer, i));
}

void check_version(const json &asset)
{
    const std::string version = asset["version"].get<std::string>(), least = asset.value("minVersion", "2.0");
    if (version.compare(0, 2, "2.") != 0)
        throw file_error("/asset/version", "found " + json_excerpt(asset["version"]) + ", expected 2.0");
    if (least != "2.0")
        throw file_error("/asset/minVersion", "found " + json_excerpt(asset["minVersion"]) + ", expected 2.0");
}

void check_required_extensions(const json &root)
{
    for_each(root, "/extensionsRequired", [](const json &name, const std::string &pointer) {
        if (!gltf_knows_extension(name.get<std::string>()))
            throw file_error(pointer, "found " + json_excerpt(name) + ", an extension that this program does not know");
    });
}

void check_stride(const json &view, const std::string &pointer)
{
    const uint64_t stride = view.value("byteStride", uint64_t{ 4 });
    if (stride % 4 != 0)
        throw file_error(pointer + "/byteStride", "found " + std::to_string(stride) + ", expected a multiple of 4");
}

void check_far(const json &projection, const std::string &pointer)
{
    if (projection.contains("zfar") && !(projection["zfar"].get<double>() > projection["znear"].get<double>()))
        throw file_error(pointer + "/zfar", "found " + json_excerpt(projection["zfar"]) + ", expected more than znear");
}

void check_camera(const json &camera, const std::string &pointer)
{
    const std::string type = camera["type"].get<std::string>();
    if (!camera.contains(type))
        throw file_error(pointer, "found no \"" + type + "\", which the type requires");
    const json &projection = camera[type];
    const std::string here = pointer + "/" + type;
    check_far(projection, here);
    if (type == "perspective" && projection["yfov"].get<double>() >= pi)
        throw file_error(here + "/yfov", "found " + json_excerpt(projection["yfov"]) + ", expected an angle below pi");
    for (const char *size : { "xmag", "ymag" })
        if (type == "orthographic" && projection[size].get<double>() == 0.0)
            throw file_error(json_pointer(here, size), "found 0, expected another number");
}

void check_light(const json &light, const std::string &pointer)
{
    if (light["type"] != "spot")
        return;
    if (!light.contains("spot"))
        throw file_error(pointer, "found no \"spot\", which the type requires");
    const json &spot = light["spot"];
    const double inner = spot.value("innerConeAngle", 0.0), outer = spot.value("outerConeAngle", pi / 4.0);
    if (!(inner < outer))
        throw file_error(pointer + "/spot/innerConeAngle", "found " + json(inner).dump() +
                                                               ", expected less than the outerConeAngle of " +
                                                               json(outer).dump());
}

void check_node(const json &node, const std::string &pointer)
{
    for (const char *part : { "translation", "rotation", "scale" })
        if (node.contains("matrix") && node.contains(part))
            throw file_error(pointer, std::string("found both \"matrix\" and \"") + part + "\", expected one of them");
}

} // namespace

void check_rules(const json &root)
{
    check_version(root["asset"]);
    check_required_extensions(root);
    for_each(root, "/bufferViews", check_stride);
    for_each(root, "/cameras", check_camera);
    for_each(root, "/nodes", check_node);
    for_each(root, "/extensions/KHR_lights_punctual/lights", check_light);
}

} // namespace gltf
