// Every change goes to the text and, the first time that its place is touched, to the record.
#include "exporters/gltf/patch.hpp"

#include <algorithm>

#include "io/file_error.hpp"

namespace
{

constexpr const char *record_path[] = { "extensions", glint_extension, "extras", "export" };

std::string record_pointer()
{
    std::string pointer;
    for (const char *name : record_path)
        pointer = json_pointer(pointer, name);
    return pointer;
}

[[noreturn]] void refuse_record(const std::string &expected)
{
    throw file_error(record_pointer(), "found a record of an export that was changed, expected " + expected);
}

std::optional<size_t> size_of(const json &record, const char *name)
{
    if (!record.contains(name))
        return std::nullopt;
    if (!record[name].is_number_unsigned())
        refuse_record(std::string("a whole number for \"") + name + "\"");
    return record[name].get<size_t>();
}

std::string record_text(const export_record &record)
{
    ordered_json out = ordered_json::object();
    if (!record.added.empty())
        out["added"] = record.added;
    if (!record.replaced.empty())
        out["replaced"] = record.replaced;
    if (record.bin_bytes)
        out["binBytes"] = *record.bin_bytes;
    if (record.json_padding)
        out["jsonPadding"] = *record.json_padding;
    return out.dump();
}

} // namespace

export_record export_read_record(const json_text &text)
{
    export_record record;
    const uint32_t n = text.find(record_pointer());
    if (n == json_text::none)
        return record;
    const json in = json::parse(text.value(n));
    if (!in.is_object())
        refuse_record("an object");
    const json added = in.value("added", json::array()), replaced = in.value("replaced", json::object());
    if (!added.is_array() || !replaced.is_object())
        refuse_record("an array \"added\" and an object \"replaced\"");
    for (const json &pointer : added) {
        if (!pointer.is_string())
            refuse_record("JSON pointers in \"added\"");
        record.added.push_back(pointer.get<std::string>());
    }
    for (const auto &item : replaced.items()) {
        if (!item.value().is_string())
            refuse_record("JSON texts in \"replaced\"");
        json_parse(item.value().get_ref<const std::string &>());
        record.replaced[item.key()] = item.value().get<std::string>();
    }
    record.bin_bytes = size_of(in, "binBytes");
    record.json_padding = size_of(in, "jsonPadding");
    return record;
}

patch::patch(std::string_view text) : original_(text), text_(text), record_(export_read_record(text_))
{
    const uint32_t used = text_.member(json_text::root, "extensionsUsed");
    if (used != json_text::none)
        extensions_ = json::parse(text_.value(used)).get<std::set<std::string>>();
}

bool patch::is_within_added(const std::string &pointer) const
{
    return std::any_of(record_.added.begin(), record_.added.end(), [&](const std::string &added) {
        return pointer.compare(0, added.size(), added) == 0 &&
               (pointer.size() == added.size() || pointer[added.size()] == '/');
    });
}

void patch::replace(uint32_t n, const std::string &raw)
{
    if (raw == text_.value(n))
        return;
    const std::string pointer = text_.pointer(n);
    if (!is_within_added(pointer))
        record_.replaced.emplace(pointer, text_.value(n));
    text_.replace(n, raw);
}

void patch::add_member(uint32_t object, const std::string &name, const std::string &raw)
{
    text_.add_member(object, name, raw);
    remember_added(json_pointer(text_.pointer(object), name));
}

void patch::remember_added(const std::string &pointer)
{
    if (!is_within_added(pointer))
        record_.added.push_back(pointer);
}

size_t patch::count(const std::string &array) const
{
    const uint32_t n = text_.member(json_text::root, array);
    const auto fresh = new_elements_.find(array);
    return (n == json_text::none ? 0 : text_.node(n).child_count) +
           (fresh == new_elements_.end() ? 0 : fresh->second.size());
}

size_t patch::add_element(const std::string &array, const std::string &raw)
{
    const size_t index = count(array);
    new_elements_[array].push_back(raw);
    return index;
}

void patch::use_extension(const std::string &name)
{
    if (extensions_.insert(name).second)
        add_element("extensionsUsed", json(name).dump());
}

// Into the deepest object of its path that is there.
void patch::write_record()
{
    const uint32_t old = text_.find(record_pointer());
    if (old != json_text::none) {
        text_.replace(old, json_layout(record_text(record_), text_.style(), text_.node(old).level));
        return;
    }
    uint32_t n = json_text::root;
    size_t depth = 0;
    std::string pointer;
    for (uint32_t next; (next = text_.member(n, record_path[depth])) != json_text::none; n = next) {
        pointer = json_pointer(pointer, record_path[depth++]);
        if (text_.kind(next) != '{')
            throw file_error(pointer, "found " + json_excerpt(json::parse(text_.value(next))) + ", expected an object");
    }
    record_.added.push_back(json_pointer(pointer, record_path[depth]));
    std::string raw = record_text(record_);
    for (size_t i = std::size(record_path) - 1; i > depth; i--)
        raw = json_object_of(record_path[i], raw);
    text_.add_member(n, record_path[depth], raw);
}

void patch::write_elements(const std::string &array, const std::vector<std::string> &elements)
{
    const uint32_t n = text_.member(json_text::root, array);
    if (n == json_text::none) {
        std::string all;
        for (const std::string &raw : elements)
            all += (all.empty() ? "" : ",") + raw;
        add_member(json_text::root, array, "[" + all + "]");
        return;
    }
    size_t index = text_.node(n).child_count;
    for (const std::string &raw : elements) {
        text_.add_element(n, raw);
        remember_added(json_pointer(json_pointer("", array), index++));
    }
}

std::string patch::result()
{
    for (const auto &[array, elements] : new_elements_)
        write_elements(array, elements);
    if (!text_.changed())
        return std::string(original_);
    write_record();
    return text_.result();
}
