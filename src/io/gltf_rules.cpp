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

// The array of that name, with count elements or, where count is 0, with some; the tables know no nested arrays.
const json &check_array(const json &object, const char *name, const std::string &pointer, size_t count,
                        const char *what)
{
    const std::string expected = "expected an array of " + (count > 0 ? std::to_string(count) + " " : "") + what;
    if (!object.contains(name))
        throw file_error(pointer, std::string("found no \"") + name + "\", " + expected);
    const json &array = object[name];
    if (!array.is_array() || array.empty() || (count > 0 && array.size() != count))
        throw file_error(json_pointer(pointer, name), "found " + json_excerpt(array) + ", " + expected);
    return array;
}

void check_row(const json &row, const std::string &pointer, size_t count, const char *what)
{
    if (!row.is_array() || row.size() != count)
        throw file_error(pointer,
                         "found " + json_excerpt(row) + ", expected an array of " + std::to_string(count) + " " + what);
}

void check_faces(const json &faces, const std::string &pointer, size_t image_count)
{
    check_row(faces, pointer, 6, "images");
    for (size_t i = 0; i < 6; i++)
        if (!faces[i].is_number_unsigned() || faces[i].get<uint64_t>() >= image_count)
            throw file_error(json_pointer(pointer, i), "found " + json_excerpt(faces[i]) +
                                                           ", expected an index into \"images\", of which there are " +
                                                           std::to_string(image_count));
}

void check_image_based_light(const json &light, const std::string &pointer, size_t image_count)
{
    const json &images = check_array(light, "specularImages", pointer, 0, "mip levels");
    for (size_t level = 0; level < images.size(); level++)
        check_faces(images[level], json_pointer(pointer + "/specularImages", level), image_count);
    const json &bands = check_array(light, "irradianceCoefficients", pointer, 9, "colours");
    for (size_t i = 0; i < bands.size(); i++) {
        const std::string here = json_pointer(pointer + "/irradianceCoefficients", i);
        check_row(bands[i], here, 3, "numbers");
        for (size_t k = 0; k < 3; k++)
            if (!bands[i][k].is_number())
                throw file_error(json_pointer(here, k), "found " + json_excerpt(bands[i][k]) + ", expected a number");
    }
    const json turn = light.value("rotation", json::array({ 0.0, 0.0, 0.0, 1.0 }));
    double length = 0.0;
    for (const json &part : turn)
        length = std::hypot(length, part.get<double>());
    if (!(std::abs(length - 1.0) < 0.01)) // as exporters round
        throw file_error(pointer + "/rotation",
                         "found a quaternion of length " + json(length).dump() + ", expected length 1");
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
    const size_t image_count = root.contains("images") ? root["images"].size() : 0;
    for_each(root, "/extensions/EXT_lights_image_based/lights",
             [image_count](const json &light, const std::string &pointer) {
                 check_image_based_light(light, pointer, image_count);
             });
}

} // namespace gltf
