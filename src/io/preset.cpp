// Material presets: a glTF material object in a file of its own, read as a document that holds nothing else.
//
// Textures of a preset refer to the arrays "textures", "images" and "samplers" of its extras, which mean what they mean
// at the root of a glTF file; URIs are relative to the preset's folder.
#include "io/preset.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <new>

#include "io/gltf_document.hpp"
#include "io/near_names.hpp"
#include "io/scene_file.h"
#include "io/scene_memory.hpp"

namespace
{

namespace fs = std::filesystem;

constexpr const char *suffix = ".gltf-material.json";

struct freed {
    void operator()(scene *s) const
    {
        scene_free(s);
    }
};

// $GLINT_MATERIALS, or share/libglint/materials beside the folder of the program: the same in the build and when
// installed.
std::string preset_folder()
{
    const char *chosen = std::getenv("GLINT_MATERIALS");
    if (chosen && chosen[0] != '\0')
        return chosen;
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    return (program.parent_path().parent_path() / "share" / "libglint" / "materials").string();
}

std::vector<std::string> preset_names(const std::string &folder)
{
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        const size_t length = std::char_traits<char>::length(suffix);
        if (name.size() > length && name.compare(name.size() - length, length, suffix) == 0)
            names.push_back(name.substr(0, name.size() - length));
    }
    if (error)
        throw file_error("", "the presets cannot be listed: " + error.message() +
                                 "; GLINT_MATERIALS may name another folder");
    std::sort(names.begin(), names.end());
    return names;
}

bool is_path(const std::string &name)
{
    return name.find('/') != name.npos || (name.size() > 5 && name.compare(name.size() - 5, 5, ".json") == 0);
}

json preset_material(const std::string &path)
{
    const std::vector<uint8_t> bytes = file_bytes(path, preset_max_bytes);
    const std::string_view text(reinterpret_cast<const char *>(bytes.data()), bytes.size());
    json material = json_parse(text);
    if (!material.is_object())
        throw file_error("", "found " + json_excerpt(material) + ", expected a glTF material object");
    return material;
}

std::vector<scene_texture *> textures_of(scene_material *m)
{
    const scene_texture *list[SCENE_MATERIAL_TEXTURES];
    scene_material_textures(m, list);
    std::vector<scene_texture *> all;
    for (const scene_texture *texture : list)
        all.push_back(const_cast<scene_texture *>(texture)); // of m, which may be changed
    return all;
}

// Moves the images of a preset behind those of the scene and the material with them.
void move_into(scene *preset, scene *s, scene_material *out)
{
    const int first = s->image_count;
    for (int i = 0; i < preset->image_count; i++) {
        *scene_append_to_any(&s->images, &s->image_count) = preset->images[i];
        preset->images[i] = scene_image{};
    }
    *out = preset->materials[0];
    preset->materials[0].name = nullptr;
    for (scene_texture *texture : textures_of(out))
        if (texture->image != SCENE_NONE)
            texture->image += first;
}

void read_preset(const std::string &path, scene *s, scene_material *out, report *r)
{
    gltf_file file = { path, gltf_folder_of(path), r, {}, {}, {}, 0, {}, {} };
    json material = preset_material(path);
    scene preset = {};
    const std::unique_ptr<scene, freed> owner(&preset); // also when an exception passes
    try {
        gltf_read_document(file, preset_document(std::move(material)), {}, false, &preset);
    } catch (const file_error &e) {
        throw file_error(preset_place(e.place), e.text);
    }
    move_into(&preset, s, out);
}

// Runs work and turns what it throws into the report's error, which starts with name.
template <class Work> bool guarded(const std::string &name, report *r, Work work)
{
    try {
        work();
        return true;
    } catch (const file_error &e) {
        return report_error(r, "%s", gltf_message(name, e).c_str());
    } catch (const std::bad_alloc &) {
        return report_error(r, "%s: found a preset that needs more memory than there is", name.c_str());
    } catch (const std::exception &e) {
        return report_error(r, "%s: cannot be read: %s", name.c_str(), e.what());
    }
}

std::string extra_text(const json &material, const char *name)
{
    const json extras = material.value("extras", json::object());
    return extras.is_object() && extras.contains(name) && extras[name].is_string() ? extras[name].get<std::string>()
                                                                                   : "";
}

// Replaces a material and frees the old one's name, or keeps it in the new one.
void replace_keeping_name(scene_material *old, const scene_material &preset)
{
    char *name = old->name;
    *old = preset;
    old->name = name;
}

std::vector<std::string> material_names(const scene *s)
{
    std::vector<std::string> names(static_cast<size_t>(s->material_count));
    for (size_t i = 0; i < names.size(); i++)
        names[i] = s->materials[i].name;
    return names;
}

void apply(scene *s, const std::string &material_name, const scene_material &preset)
{
    int replaced = 0;
    for (int i = 0; i < s->material_count; i++)
        if (material_name == "*" || material_name == s->materials[i].name) {
            replace_keeping_name(&s->materials[i], preset);
            replaced++;
        }
    if (replaced == 0 && material_name != "*")
        throw file_error("", "found no material called \"" + material_name + "\"" +
                                 names_instead(material_name, material_names(s)));
}

} // namespace

json preset_document(json material)
{
    json root = { { "asset", { { "version", "2.0" } } } };
    const json extras = material.value("extras", json::object());
    for (const char *array : { "textures", "images", "samplers" })
        if (extras.is_object() && extras.contains(array))
            root[array] = extras[array];
    root["materials"] = json::array({ std::move(material) });
    return root;
}

std::string preset_place(const std::string &place)
{
    const std::string material = "/materials/0";
    if (place.compare(0, material.size(), material) == 0)
        return place.substr(material.size());
    return place.empty() ? place : "/extras" + place;
}

std::string preset_path(const std::string &name)
{
    if (is_path(name))
        return name;
    const std::string folder = preset_folder();
    const std::vector<std::string> names = preset_names(folder);
    if (!std::binary_search(names.begin(), names.end(), name))
        throw file_error("", "found no preset of this name in " + folder + names_instead(name, names));
    return folder + "/" + name + suffix;
}

bool preset_read(const char *name_or_path, scene *s, scene_material *out, report *r)
{
    const std::string name = std::string("preset ") + name_or_path;
    std::string path;
    return guarded(name, r, [&] { path = preset_path(name_or_path); }) &&
           guarded(path, r, [&] { read_preset(path, s, out, r); });
}

bool preset_each(void (*visit)(const char *name, const char *title, const char *note, void *user), void *user,
                 report *r)
{
    std::string folder, path;
    std::vector<std::string> names;
    if (!guarded("materials", r, [&] { names = preset_names(folder = preset_folder()); }))
        return false;
    for (const std::string &name : names) {
        path.assign(folder).append("/").append(name).append(suffix);
        const bool read = guarded(path, r, [&] {
            const json material = preset_material(path);
            visit(name.c_str(), extra_text(material, "title").c_str(), extra_text(material, "note").c_str(), user);
        });
        if (!read)
            return false;
    }
    return true;
}

bool preset_apply(scene *s, const char *material_name, const char *preset, report *r)
{
    scene_material material;
    if (!preset_read(preset, s, &material, r))
        return false;
    const bool applied = guarded(s->path ? s->path : "scene", r, [&] { apply(s, material_name, material); });
    std::free(material.name);
    return applied;
}
