/* One material that uses one image twice is all that a lookup needs. */
#include "texture_scene.h"

scene_texture texture_plain(bool srgb)
{
    scene_texture t = scene_texture_none();
    t.image = 0;
    t.srgb = srgb;
    return t;
}

static textures *open_image(scene_image only, report *r)
{
    scene_material material = scene_material_default();
    material.base_color_texture = texture_plain(true);
    material.normal_texture = texture_plain(false);
    const scene s = { .images = &only, .image_count = 1, .materials = &material, .material_count = 1 };
    textures *t;
    return textures_open(&s, &t, r) ? t : NULL;
}

textures *open_bytes(bytes encoded, report *r)
{
    return open_image((scene_image){ .name = "images/0", .bytes = encoded.data, .byte_count = encoded.size }, r);
}

textures *open_file(const char *path, report *r)
{
    return open_image((scene_image){ .name = (char *)path, .path = (char *)path }, r);
}

void texture_at(const textures *t, const scene_texture *which, float s, float t_, float rgba[4])
{
    texture_lookup(t, which, s, t_, 0.0F, 0.0F, 0.0F, 0.0F, rgba);
}
