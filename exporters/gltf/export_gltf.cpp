// glint_export_gltf: options in, a file out, exceptions kept inside.
#include <exception>
#include <new>

#include "exporters/export_call.h"
#include "io/gltf_document.hpp"
#include "io/output_file.h"
#include "io/scene_file.h"

namespace
{

// The reader's whole check; what it read is not needed.
bool check(const char *path, report *r)
{
    scene s = {};
    const bool readable = scene_file_read(path, nullptr, &s, r);
    scene_free(&s);
    return readable;
}

bool write(const char *path, const std::vector<uint8_t> &bytes, report *r)
{
    output_file *out = output_file_open(path, r);
    if (!out)
        return false;
    output_file_write(out, bytes.data(), bytes.size());
    return output_file_commit(out, r);
}

bool copy(const glint_export_gltf_options *options, report *r)
{
    try {
        const std::vector<uint8_t> bytes = file_bytes(options->input, gltf_max_file_bytes);
        return !options->output || write(options->output, bytes, r);
    } catch (const file_error &e) {
        return report_error(r, "%s", gltf_message(options->input, e).c_str());
    } catch (const std::bad_alloc &) {
        return report_error(r, "%s: found a file that needs more memory than there is", options->input);
    } catch (const std::exception &e) {
        return report_error(r, "%s: cannot be exported: %s", options->input, e.what());
    }
}

} // namespace

glint_export_result glint_export_gltf(const glint_export_gltf_options *options, char *message, size_t message_size)
{
    if (!options || options->size != sizeof *options || !options->input)
        return export_wrong_usage("the options need a size and an input", message, message_size);
    report r = export_report(&options->listener);
    const bool done = check(options->input, &r) && copy(options, &r);
    return export_result(&r, done, message, message_size);
}
