// glint_export_gltf: options in, files out, exceptions kept inside.
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>

#include "exporters/export_call.h"
#include "exporters/gltf/apply.hpp"
#include "exporters/gltf/document.hpp"
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

// What the renderer refuses is not exported either. Its warnings are for those who render.
void check_scene(const char *path, report *r)
{
    report quiet = {};
    scene s = {};
    const bool readable = scene_file_read(path, nullptr, &s, &quiet);
    scene_free(&s);
    if (!readable) {
        report_error(r, "%s", quiet.error);
        throw file_error("", quiet.error);
    }
}

bool same_kind(const std::string &a, const std::string &b)
{
    return fs::path(a).extension() == fs::path(b).extension();
}

void check_options(const glint_export_gltf_options &o)
{
    if (o.output && !same_kind(o.input, o.output))
        throw file_error("", std::string("the output ") + o.output + " must end as the input does");
}

ordered_json export_file(const glint_export_gltf_options &o, report *r)
{
    check_scene(o.input, r);
    const std::vector<uint8_t> bytes = file_bytes(o.input, gltf_max_file_bytes);
    export_container file = export_take_apart(bytes);
    const bool stripped = o.strip && export_strip(file, o.input, r);
    ordered_json summary = { { "input", o.input }, { "output", o.output ? ordered_json(o.output) : ordered_json() } };
    summary.update(export_apply(o, file, r));
    summary["stripped"] = stripped;
    const std::vector<uint8_t> result = export_put_together(file);
    summary["changed"] = result != bytes;
    summary["bytes"] = result.size();
    const export_reading check(o.input, file, r);
    if (o.output) {
        export_copy_outside_files(check, o.output, r);
        export_write_file(o.output, result, r);
    }
    return summary;
}

} // namespace

glint_export_result glint_export_gltf(const glint_export_gltf_options *options, char *message, size_t message_size)
{
    if (!options || options->size != sizeof *options || !options->input)
        return export_wrong_usage("the options need a size and an input", message, message_size);
    listener l = { export_report(&options->listener) };
    report r = { {}, hear, &l };
    bool done = false;
    try {
        check_options(*options);
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
