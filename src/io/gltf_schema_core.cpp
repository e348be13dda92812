// The properties of glTF 2.0 itself (chapter 5 of the text: types, ranges and what is required). More is let through
// than the text allows where exporters are known to round or to write nothing: empty arrays, and quaternions a little
// too long.
#include "io/gltf_schema.hpp"

namespace gltf
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double max_size = 4294967295.0; // a .glb cannot hold more
constexpr double max_int = 2147483647.0;  // what tinygltf keeps in an int
constexpr size_t any = std::numeric_limits<size_t>::max();

schema asset_schema()
{
    return { { text("version").must(), text("minVersion"), text("generator"), text("copyright") }, {} };
}

const schema &sparse_schema()
{
    static const schema index_part = { { index("bufferView", "bufferViews").must(), integer("byteOffset", 0, max_int),
                                         choice("componentType", "5121|5123|5125").must() },
                                       {} };
    static const schema value_part = { { index("bufferView", "bufferViews").must(), integer("byteOffset", 0, max_int) },
                                       {} };
    static const schema all = { { integer("count", 1, max_int).must(), object("indices", index_part).must(),
                                  object("values", value_part).must() },
                                {} };
    return all;
}

schema accessor_schema()
{
    return { { index("bufferView", "bufferViews"), integer("byteOffset", 0, max_size),
               choice("componentType", "5120|5121|5122|5123|5125|5126").must(), boolean("normalized"),
               integer("count", 1, max_size).must(), choice("type", "SCALAR|VEC2|VEC3|VEC4|MAT2|MAT3|MAT4").must(),
               numbers_between("max", 1, 16), numbers_between("min", 1, 16), object("sparse", sparse_schema()),
               text("name") },
             {} };
}

schema buffer_schema()
{
    return { { text("uri"), integer("byteLength", 1, max_size).must(), text("name") }, {} };
}

schema buffer_view_schema()
{
    return { { index("buffer", "buffers").must(), integer("byteOffset", 0, max_size),
               integer("byteLength", 1, max_size).must(), integer("byteStride", 4, 252),
               choice("target", "34962|34963"), text("name") },
             {} };
}

const schema &camera_schema()
{
    static const schema perspective = { { number_above("aspectRatio", 0.0), number_above("yfov", 0.0).must(),
                                          number_above("zfar", 0.0), number_above("znear", 0.0).must() },
                                        {} };
    static const schema orthographic = { { number("xmag", -infinity, infinity).must(),
                                           number("ymag", -infinity, infinity).must(), number_above("zfar", 0.0).must(),
                                           number("znear", 0.0, infinity).must() },
                                         {} };
    static const schema all = { { choice("type", "perspective|orthographic").must(), object("perspective", perspective),
                                  object("orthographic", orthographic), text("name") },
                                {} };
    return all;
}

schema image_schema()
{
    return { { text("uri"), text("mimeType"), index("bufferView", "bufferViews"), text("name") }, {} };
}

schema sampler_schema()
{
    return { { choice("magFilter", "9728|9729"), choice("minFilter", "9728|9729|9984|9985|9986|9987"),
               choice("wrapS", "33071|33648|10497"), choice("wrapT", "33071|33648|10497"), text("name") },
             {} };
}

schema texture_schema()
{
    return { { index("sampler", "samplers"), index("source", "images"), text("name") }, {} };
}

const schema &material_schema()
{
    static const schema metallic_roughness = {
        { numbers("baseColorFactor", 4, 0.0, 1.0), object("baseColorTexture", texture_info_schema()),
          number("metallicFactor", 0.0, 1.0), number("roughnessFactor", 0.0, 1.0),
          object("metallicRoughnessTexture", texture_info_schema()) },
        {}
    };
    static const schema occlusion = { { index("index", "textures").must(), integer("texCoord", 0, max_int),
                                        number("strength", 0.0, 1.0) },
                                      texture_info_extensions() };
    static const schema all = {
        { text("name"), object("pbrMetallicRoughness", metallic_roughness),
          object("normalTexture", normal_texture_schema()), object("occlusionTexture", occlusion),
          object("emissiveTexture", texture_info_schema()), numbers("emissiveFactor", 3, 0.0, 1.0),
          choice("alphaMode", "OPAQUE|MASK|BLEND"), number("alphaCutoff", 0.0, infinity), boolean("doubleSided") },
        material_extensions()
    };
    return all;
}

const schema &mesh_schema()
{
    static const schema primitive = { { index_map("attributes", "accessors").must(), index("indices", "accessors"),
                                        index("material", "materials"), choice("mode", "0|1|2|3|4|5|6"),
                                        index_maps("targets", "accessors") },
                                      primitive_extensions() };
    static const schema all = {
        { objects("primitives", primitive, 1).must(), numbers_between("weights", 1, any), text("name") }, {}
    };
    return all;
}

schema node_schema()
{
    return { { index("camera", "cameras"), indices("children", "nodes", 0), index("skin", "skins"),
               numbers("matrix", 16, -infinity, infinity), index("mesh", "meshes"),
               numbers("rotation", 4, -infinity, infinity), numbers("scale", 3, -infinity, infinity),
               numbers("translation", 3, -infinity, infinity), numbers_between("weights", 1, any), text("name") },
             node_extensions() };
}

schema scene_schema()
{
    return { { indices("nodes", "nodes", 0), text("name") }, scene_extensions() };
}

schema skin_schema()
{
    return { { index("inverseBindMatrices", "accessors"), index("skeleton", "nodes"),
               indices("joints", "nodes", 1).must(), text("name") },
             {} };
}

const schema &animation_schema()
{
    static const schema target = {
        { index("node", "nodes"), choice("path", "translation|rotation|scale|weights|pointer").must() }, {}
    };
    // Of the samplers of its animation, which no table knows.
    static const schema channel = { { integer("sampler", 0, max_int).must(), object("target", target).must() }, {} };
    static const schema sampler = { { index("input", "accessors").must(), index("output", "accessors").must(),
                                      choice("interpolation", "LINEAR|STEP|CUBICSPLINE") },
                                    {} };
    static const schema all = {
        { objects("channels", channel, 1).must(), objects("samplers", sampler, 1).must(), text("name") }, {}
    };
    return all;
}

} // namespace

const schema &animations_schema()
{
    static const schema root = { { objects("animations", animation_schema(), 0) }, {} };
    return root;
}

const schema &texture_info_schema()
{
    static const schema s = { { index("index", "textures").must(), integer("texCoord", 0, max_int) },
                              texture_info_extensions() };
    return s;
}

const schema &normal_texture_schema()
{
    static const schema s = { { index("index", "textures").must(), integer("texCoord", 0, max_int),
                                number("scale", -infinity, infinity) },
                              texture_info_extensions() };
    return s;
}

const schema &root_schema()
{
    static const schema asset = asset_schema(), accessor = accessor_schema(), buffer = buffer_schema(),
                        buffer_view = buffer_view_schema(), image = image_schema(), sampler = sampler_schema(),
                        texture = texture_schema(), node = node_schema(), scene = scene_schema(), skin = skin_schema();
    static const schema root = { { object("asset", asset).must(), texts("extensionsUsed"), texts("extensionsRequired"),
                                   objects("buffers", buffer, 0), objects("bufferViews", buffer_view, 0),
                                   objects("accessors", accessor, 0), objects("images", image, 0),
                                   objects("samplers", sampler, 0), objects("textures", texture, 0),
                                   objects("materials", material_schema(), 0), objects("meshes", mesh_schema(), 0),
                                   objects("cameras", camera_schema(), 0), objects("skins", skin, 0),
                                   objects("nodes", node, 0), objects("scenes", scene, 0), index("scene", "scenes") },
                                 root_extensions() };
    return root;
}

} // namespace gltf
