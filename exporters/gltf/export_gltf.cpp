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

} // namespace

glint_export_result glint_export_gltf(const glint_export_gltf_options *options, char *message, size_t message_size)
{
    if (!options || options->size != sizeof *options || !options->input)
        return export_wrong_usage("the options need a size and an input", message, message_size);
    if (options->output && !same_kind(options->input, options->output))
        return export_wrong_usage("the output has to end as the input does, in .gltf or .glb", message, message_size);
    listener l = { export_report(&options->listener) };
    report r = { {}, hear, &l };
    bool done = false;
    try {
        ordered_json summary = export_file(*options, &r);
        summary["warnings"] = l.warnings;
        if (options->summary)
            *options->summary = strdup(summary.dump(-1, ' ', false, json::error_handler_t::replace).c_str());
        done = true;
    } catch (const file_error &e) {
        report_error(&r, "%s", gltf_message(options->input, e).c_str());
    } catch (const std::bad_alloc &) {
        report_error(&r, "%s: found a file that needs more memory than there is", options->input);
    } catch (const std::exception &e) {
        report_error(&r, "%s: cannot be exported: %s", options->input, e.what());
    }
    return export_result(&r, done, message, message_size);
}
