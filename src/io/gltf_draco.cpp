// Decodes Draco meshes to plain triangles; Draco checks its stream, this file what comes out of it.
#include "io/gltf_draco.hpp"

#include <algorithm>
#include <cmath>

#include <draco/compression/decode.h>

#include "io/file_error.hpp"

namespace
{

std::vector<float> attribute_values(const draco::Mesh &mesh, const std::string &name, const draco_request &request,
                                    const std::string &pointer)
{
    const draco::PointAttribute *attribute = mesh.GetAttributeByUniqueId(request.id);
    if (!attribute)
        throw file_error(pointer,
                         "found no Draco attribute with the id " + std::to_string(request.id) + " for " + name);
    if (attribute->num_components() != request.components)
        throw file_error(pointer, "found Draco attribute " + name + " with " +
                                      std::to_string(attribute->num_components()) + " components, expected the " +
                                      std::to_string(request.components) + " of its accessor");
    const size_t width = static_cast<size_t>(request.components);
    const float divisor = attribute->normalized() ? 1.0F : request.divisor;
    std::vector<float> values(mesh.num_points() * width);
    for (uint32_t i = 0; i < mesh.num_points(); i++) {
        const draco::AttributeValueIndex source = attribute->mapped_index(draco::PointIndex(i));
        if (source.value() >= attribute->size() ||
            !attribute->ConvertValue<float>(source, static_cast<int8_t>(request.components), &values[i * width]))
            throw file_error(pointer,
                             "found Draco attribute " + name + " without a value for point " + std::to_string(i));
    }
    for (float &value : values) {
        if (!std::isfinite(value))
            throw file_error(pointer, "found NaN or infinity in Draco attribute " + name + ", expected finite numbers");
        if (divisor > 1.0F)
            value = std::max(value / divisor, -1.0F);
    }
    return values;
}

} // namespace

draco_geometry draco_decode(byte_view bytes, const std::map<std::string, draco_request> &requests,
                            uint64_t max_elements, const std::string &pointer)
{
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char *>(bytes.data), bytes.size);
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        throw file_error(pointer, std::string("found data that is not a Draco mesh: ") + decoded.status().error_msg());
    const draco::Mesh &mesh = *decoded.value();
    if (mesh.num_points() > max_elements || mesh.num_faces() > max_elements)
        throw file_error(pointer, "found a Draco mesh that is too large for the bytes of the file");
    draco_geometry geometry;
    geometry.vertex_count = mesh.num_points();
    for (uint32_t i = 0; i < mesh.num_faces(); i++)
        for (const draco::PointIndex &corner : mesh.face(draco::FaceIndex(i))) {
            if (corner.value() >= mesh.num_points())
                throw file_error(pointer, "found vertex " + std::to_string(corner.value()) + " in Draco face " +
                                              std::to_string(i) + ", expected less than " +
                                              std::to_string(mesh.num_points()));
            geometry.indices.push_back(corner.value());
        }
    for (const auto &[name, request] : requests)
        geometry.attributes[name] = attribute_values(mesh, name, request, pointer);
    return geometry;
}
