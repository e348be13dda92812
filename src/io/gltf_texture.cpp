// textureInfo, texture, sampler and KHR_texture_transform in one struct.
#include "io/gltf_texture.hpp"

namespace
{

scene_wrap wrap_of(int mode)
{
    switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return SCENE_WRAP_CLAMP;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return SCENE_WRAP_MIRROR;
    default:
        return SCENE_WRAP_REPEAT;
    }
}

void read_sampler(const gltf_file &file, int index, scene_texture *t)
{
    if (index < 0)
        return;
    const tinygltf::Sampler &sampler = file.model.samplers[static_cast<size_t>(index)];
    t->wrap_s = wrap_of(sampler.wrapS);
    t->wrap_t = wrap_of(sampler.wrapT);
    t->nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
}

void read_transform(const tinygltf::Value &transform, scene_texture *t)
{
    gltf_numbers(transform, "offset", t->offset, 2);
    gltf_numbers(transform, "scale", t->scale, 2);
    t->rotation = static_cast<float>(gltf_number(transform, "rotation", 0.0));
    t->texcoord = gltf_integer(transform, "texCoord", t->texcoord);
}

scene_texture read_texture(gltf_file &file, int index, int texcoord, const tinygltf::Value *transform,
                           texture_colors colors, const std::string &pointer)
{
    scene_texture t = scene_texture_none();
    if (index < 0)
        return t;
    const tinygltf::Texture &texture = file.model.textures[static_cast<size_t>(index)];
    t.texcoord = texcoord;
    t.srgb = colors == texture_colors::srgb;
    read_sampler(file, texture.sampler, &t);
    if (transform)
        read_transform(*transform, &t);
    if (texture.source < 0) {
        file.warn(json_pointer("/textures", static_cast<size_t>(index)),
                  "has no image that is read here; it is left out");
        return scene_texture_none();
    }
    if (t.texcoord > 1) {
        file.warn(pointer, "uses TEXCOORD_" + std::to_string(t.texcoord) +
                               ", but only 0 and 1 are read; the texture is left out");
        return scene_texture_none();
    }
    t.image = texture.source;
    return t;
}

} // namespace

scene_texture gltf_texture(gltf_file &file, int index, int texcoord, const tinygltf::ExtensionMap &extensions,
                           texture_colors colors, const std::string &pointer)
{
    return read_texture(file, index, texcoord, gltf_extension(extensions, "KHR_texture_transform"), colors, pointer);
}

scene_texture gltf_texture(gltf_file &file, const tinygltf::Value &extension, const char *name, texture_colors colors,
                           const std::string &pointer)
{
    const tinygltf::Value *info = gltf_member(extension, name);
    if (!info)
        return scene_texture_none();
    const tinygltf::Value *extensions = gltf_member(*info, "extensions");
    const tinygltf::Value *transform = extensions ? gltf_member(*extensions, "KHR_texture_transform") : nullptr;
    scene_texture t = read_texture(file, gltf_integer(*info, "index", -1), gltf_integer(*info, "texCoord", 0),
                                   transform, colors, json_pointer(pointer, name));
    t.strength = static_cast<float>(gltf_number(*info, "scale", 1.0));
    return t;
}
