// glint_export_gltf: options in, files out, exceptions kept inside.
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>

#include "exporters/export_call.h"
#include "exporters/gltf/apply.hpp"
#include "exporters/gltf/document.hpp"
#include "exporters/gltf/fallback.hpp"
#include "exporters/gltf/outside.hpp"
#include "exporters/gltf/scene_document.hpp"
#include "exporters/gltf/strip.hpp"
#include "io/output_file.h"
#include "io/scene_file.h"

namespace
{

namespace fs = std::filesystem;

// Passes warnings on and keeps them for the summary.
struct listener {
    report outer;
    ordered_json warnings = ordered_json::array();
};

void hear(const char *text, void *user)
{
    auto *l = static_cast<listener *>(user);
    l->warnings.push_back(text);
    report_warning(&l->outer, "%s", text);
}

// The input as the renderer reads it. What it refuses is not exported either; its warnings are for those who render.
class rendered
{
  public:
    rendered(const char *path, report *r)
    {
        report quiet = {};
        if (scene_file_read(path, nullptr, &scene_, &quiet))
            return;
        report_error(r, "%s", quiet.error);
        throw file_error("", quiet.error);
    }
    // With its warnings: what the renderer leaves out is not written either.
    rendered(const char *path, const char *variant, report *r)
    {
        const scene_file_options reading = { variant };
        if (!scene_file_read(path, &reading, &scene_, r))
            throw file_error("", r->error);
    }
    ~rendered()
    {
        scene_free(&scene_);
    }
    rendered(const rendered &) = delete;
    rendered &operator=(const rendered &) = delete;
    const scene &get() const
    {
        return scene_;
    }
    scene &get()
    {
        return scene_;
    }

  private:
    scene scene_ = {};
};

bool same_kind(const char *input, const char *output)
{
    return fs::path(input).extension() == fs::path(output).extension();
}

// Writes a file after the renderer's reader has passed it; nothing is written for no name.
void finish(const glint_export_gltf_options &o, const export_container &file, const std::string &output, report *r)
{
    const export_reading check(o.input, file, r);
    if (output.empty())
        return;
    export_copy_outside_files(check, output, r);
    export_write_file(output, export_put_together(file), r);
}

ordered_json bake(const glint_export_gltf_options &o, export_container file, const scene &s, report *r)
{
    const ordered_json materials = export_bake_fallback(o.input, s, file, r);
    const std::string path = o.output ? export_fallback_path(o.output) : "";
    finish(o, file, path, r);
    return { { "output", o.output ? ordered_json(path) : ordered_json() }, { "materials", materials } };
}

ordered_json export_file(const glint_export_gltf_options &o, report *r)
{
    const rendered input(o.input, r);
    const std::vector<uint8_t> bytes = file_bytes(o.input, gltf_max_file_bytes);
    export_container file = export_take_apart(bytes);
    const bool stripped = o.strip && export_strip(file, o.input, r);
    ordered_json summary = { { "input", o.input }, { "output", o.output ? ordered_json(o.output) : ordered_json() } };
    summary.update(export_apply(o, file, r));
    summary["stripped"] = stripped;
    const std::vector<uint8_t> result = export_put_together(file);
    summary["changed"] = result != bytes;
    summary["bytes"] = result.size();
    finish(o, file, o.output ? o.output : "", r);
    if (o.bake_fallback)
        summary["fallback"] = bake(o, file, input.get(), r);
    return summary;
}

// What all functions here do around their work: warnings are heard, exceptions become messages.
template <class Work>
glint_export_result guarded(const char *input, const glint_export_listener &heard, char **summary_text, Work work,
                            char *message, size_t message_size)
{
    listener l = { export_report(&heard) };
    report r = { {}, hear, &l };
    bool done = false;
    try {
        ordered_json summary = work(&r);
        summary["warnings"] = l.warnings;
        if (summary_text)
            *summary_text = strdup(summary.dump(-1, ' ', false, json::error_handler_t::replace).c_str());
        done = true;
    } catch (const file_error &e) {
        report_error(&r, "%s", gltf_message(input, e).c_str());
    } catch (const std::bad_alloc &) {
        report_error(&r, "%s: found a file that needs more memory than there is", input);
    } catch (const std::exception &e) {
        report_error(&r, "%s: cannot be exported: %s", input, e.what());
    }
    return export_result(&r, done, message, message_size);
}

// The light of EXT_lights_image_based that the file's scene shows, as it is spelled there.
json environment_of(const std::string &path)
{
    const json root = json_parse(export_take_apart(file_bytes(path, gltf_max_file_bytes)).text);
    const std::string index = std::to_string(root.value("scene", 0));
    const json::json_pointer used("/scenes/" + index + "/extensions/EXT_lights_image_based/light");
    if (!root.contains(used))
        return nullptr;
    const std::string light = std::to_string(root.at(used).get<size_t>());
    return root.at(json::json_pointer("/extensions/EXT_lights_image_based/lights/" + light));
}

ordered_json export_scene(const glint_export_gltf_scene_options &o, report *r)
{
    rendered input(o.input, o.variant, r);
    for (size_t i = 0; i < o.material_count; i++)
        if (!preset_apply(&input.get(), o.materials[i].name, o.materials[i].value, r))
            throw file_error("", r->error);
    const scene &s = input.get();
    const bool glb = fs::path(o.output ? o.output : o.input).extension() == ".glb";
    const export_container file = export_scene_document(s, environment_of(o.input), glb, r);
    const export_reading check(o.output ? o.output : o.input, file, r);
    const std::vector<uint8_t> bytes = export_put_together(file);
    if (o.output)
        export_write_file(o.output, bytes, r);
    return { { "input", o.input },
             { "output", o.output ? ordered_json(o.output) : ordered_json() },
             { "nodes", check.file.model.nodes.size() },
             { "meshes", check.file.model.meshes.size() },
             { "materials", s.material_count },
             { "cameras", s.camera_count },
             { "lights", s.light_count },
             { "environment", s.environment.present },
             { "bytes", bytes.size() } };
}

} // namespace

glint_export_result glint_export_gltf(const glint_export_gltf_options *options, char *message, size_t message_size)
{
    if (!options || options->size != sizeof *options || !options->input)
        return export_wrong_usage("the options need a size and an input", message, message_size);
    if (options->output && !same_kind(options->input, options->output))
        return export_wrong_usage("the output has to end as the input does, in .gltf or .glb", message, message_size);
    return guarded(
        options->input, options->listener, options->summary, [=](report *r) { return export_file(*options, r); },
        message, message_size);
}

glint_export_result glint_export_gltf_scene(const glint_export_gltf_scene_options *options, char *message,
                                            size_t message_size)
{
    if (!options || options->size != sizeof *options || !options->input)
        return export_wrong_usage("the options need a size and an input", message, message_size);
    const fs::path ending = options->output ? fs::path(options->output).extension() : fs::path(".glb");
    if (ending != ".glb" && ending != ".gltf")
        return export_wrong_usage("the output has to end in .gltf or .glb", message, message_size);
    return guarded(
        options->input, options->listener, options->summary, [=](report *r) { return export_scene(*options, r); },
        message, message_size);
}
