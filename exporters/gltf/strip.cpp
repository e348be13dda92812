// The record says what was added and what stood where something was replaced (patch.hpp).
#include "exporters/gltf/strip.hpp"

#include <algorithm>

#include "exporters/gltf/patch.hpp"
#include "io/file_error.hpp"

namespace
{

bool is_empty(const export_record &record)
{
    return record.added.empty() && record.replaced.empty();
}

void take_back_bytes(const export_record &record, export_container &file)
{
    file.padding = record.json_padding.value_or(export_padding(file));
    if (!record.bin_bytes || *record.bin_bytes > file.bin.size())
        return;
    file.bin.resize(*record.bin_bytes);
    file.has_bin = *record.bin_bytes > 0;
}

void take_back(const export_record &record, export_container &file, const std::string &path, report *r)
{
    json_text text(file.text);
    std::vector<uint32_t> added;
    size_t lost = 0;
    for (const std::string &pointer : record.added) {
        const uint32_t n = text.find(pointer);
        if (n == json_text::none || n == json_text::root)
            lost++;
        else
            added.push_back(n);
    }
    for (const auto &[pointer, raw] : record.replaced) {
        const uint32_t n = text.find(pointer);
        if (n == json_text::none)
            lost++;
        else
            text.replace(n, raw);
    }
    text.remove(added);
    if (lost > 0)
        report_warning(r, "%s: was changed since the export: %zu of the places that its record names are not there",
                       path.c_str(), lost);
    file.text = text.result();
    take_back_bytes(record, file);
}

// The extension's place among all objects of a file; with it goes an object that is then empty.
void find_extensions(const json_text &text, uint32_t n, std::vector<uint32_t> &found)
{
    if (text.kind(n) != '{' && text.kind(n) != '[')
        return;
    for (uint32_t child = text.node(n).first_child; child != json_text::none; child = text.node(child).next) {
        const bool names_extensions = text.name(child) == "extensions";
        const uint32_t extension = names_extensions ? text.member(child, glint_extension) : json_text::none;
        if (text.name(child) == "extras")
            continue;
        if (extension != json_text::none)
            found.push_back(text.node(child).child_count == 1 ? child : extension);
        if (extension == json_text::none || text.node(child).child_count > 1)
            find_extensions(text, child, found);
    }
}

bool remove_extension(export_container &file)
{
    json_text text(file.text);
    std::vector<uint32_t> found;
    find_extensions(text, json_text::root, found);
    for (const char *list : { "extensionsUsed", "extensionsRequired" }) {
        const uint32_t names = text.member(json_text::root, list);
        if (names == json_text::none)
            continue;
        for (uint32_t n = text.node(names).first_child; n != json_text::none; n = text.node(n).next)
            if (json::parse(text.value(n)) == glint_extension)
                found.push_back(text.node(names).child_count == 1 ? names : n);
    }
    if (found.empty())
        return false;
    text.remove(found);
    file.text = text.result();
    file.padding = export_padding(file);
    return true;
}

} // namespace

bool export_strip(export_container &file, const std::string &path, report *r)
{
    const export_record record = export_read_record(json_text(file.text));
    if (is_empty(record))
        return remove_extension(file);
    take_back(record, file, path, r);
    return true;
}
