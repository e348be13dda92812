// Material objects, member by member.
#include "exporters/gltf/material.hpp"

#include <algorithm>
#include <array>
#include <functional>

#include "io/file_error.hpp"
#include "io/gltf_schema.hpp"
#include "io/near_names.hpp"

namespace
{

using raw_members = std::vector<std::pair<std::string, std::string>>;

constexpr std::array<const char *, 8> appearance = { "pbrMetallicRoughness", "normalTexture",  "occlusionTexture",
                                                     "emissiveTexture",      "emissiveFactor", "alphaMode",
                                                     "alphaCutoff",          "doubleSided" };

bool is_appearance(const std::string &name)
{
    return std::find(appearance.begin(), appearance.end(), name) != appearance.end();
}

bool is_appearance_extension(const std::string &name)
{
    return name.compare(0, 14, "KHR_materials_") == 0 || name == glint_extension;
}

const std::string *find(const raw_members &members, const std::string &name)
{
    const auto found = std::find_if(members.begin(), members.end(), [&](const auto &m) { return m.first == name; });
    return found == members.end() ? nullptr : &found->second;
}

// An object whose members are those of the old one, without the dropped ones, and with the others set: in the place of
// the old value, or at the end. object none: an empty one. level: of the members.
std::string object_with(const json_text &text, uint32_t object, const raw_members &set,
                        const std::function<bool(const std::string &)> &drop, size_t level)
{
    const bool old = object != json_text::none && text.node(object).child_count > 0;
    const std::string lead(old ? text.blanks_before_first(object) : json_line_break(text.style(), level));
    const std::string tail(old ? text.blanks_behind_last(object) : json_line_break(text.style(), level - 1));
    const std::string colon = text.style().space_after_colon ? ": " : ":";
    std::string out;
    const auto add = [&](std::string_view head, std::string_view raw) {
        out.append(out.empty() ? "" : ",").append(lead).append(head).append(raw);
    };
    for (uint32_t n = old ? text.node(object).first_child : json_text::none; n != json_text::none;
         n = text.node(n).next) {
        const std::string name = text.name(n);
        if (const std::string *raw = find(set, name))
            add(text.head(n), *raw);
        else if (!drop(name))
            add(text.head(n), text.value(n));
    }
    for (const auto &[name, raw] : set)
        if (text.member(object, name) == json_text::none)
            add(json(name).dump() + colon, raw);
    return "{" + out + (out.empty() ? "" : tail) + "}";
}

raw_members members_of(const json_text &from, uint32_t object, const json_style &style, size_t level)
{
    raw_members members;
    for (uint32_t n = object == json_text::none ? object : from.node(object).first_child; n != json_text::none;
         n = from.node(n).next)
        members.emplace_back(from.name(n), json_layout(from.value(n), style, level));
    return members;
}

// Calls visit for every object below n; its own extras are no part of glTF.
void each_object(const json_text &text, uint32_t n, const std::function<void(uint32_t)> &visit)
{
    if (text.kind(n) == '{')
        visit(n);
    if (text.kind(n) != '{' && text.kind(n) != '[')
        return;
    for (uint32_t child = text.node(n).first_child; child != json_text::none; child = text.node(child).next)
        if (text.name(child) != "extras")
            each_object(text, child, visit);
}

bool ends_with(const std::string &text, std::string_view end)
{
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// A property of the extension, by the reader's own table.
void check_name(const std::string &name)
{
    std::vector<std::string> names;
    for (const gltf::extension &e : gltf::material_extensions())
        if (e.name == std::string(glint_extension))
            for (const gltf::property &p : e.schema->properties)
                names.emplace_back(p.name);
    if (name != "extras" && name != "extensions" && std::find(names.begin(), names.end(), name) == names.end())
        throw file_error("", "found no property \"" + name + "\" of " + glint_extension + names_instead(name, names));
}

std::vector<std::string> tokens_of(const std::string &pointer)
{
    std::vector<std::string> tokens;
    for (size_t start = 1; start <= pointer.size();) {
        const size_t end = std::min(pointer.find('/', start), pointer.size());
        std::string token = pointer.substr(start, end - start);
        for (size_t at = token.find('~'); at != token.npos; at = token.find('~', at + 1))
            token.replace(at, 2, token.compare(at, 2, "~1") == 0 ? "/" : "~");
        tokens.push_back(token);
        start = end + 1;
    }
    return tokens;
}

std::string value_text(const std::string &value)
{
    try {
        json_parse(value);
        return value;
    } catch (const file_error &) {
        return json(value).dump();
    }
}

} // namespace

std::string preset_with_textures(const export_preset &preset, texture_packer &packer)
{
    json_text text(preset.text);
    each_object(text, json_text::root, [&](uint32_t n) {
        const uint32_t index = text.member(n, "index");
        if (index != json_text::none && ends_with(text.name(n), "Texture"))
            text.replace(index, std::to_string(packer.texture(preset, json::parse(text.value(index)).get<size_t>())));
    });
    return text.result();
}

void material_take_preset(material_text &m, const std::string &preset)
{
    const json_text old(m.raw, m.style, m.level), from(preset);
    const size_t inside = m.level + 1;
    raw_members set = members_of(from, json_text::root, m.style, inside);
    set.erase(
        std::remove_if(set.begin(), set.end(), [](const auto &p) { return p.first == "name" || p.first == "extras"; }),
        set.end());

    const raw_members extensions = members_of(from, from.member(json_text::root, "extensions"), m.style, inside + 1);
    const std::string merged =
        object_with(old, old.member(json_text::root, "extensions"), extensions, is_appearance_extension, inside + 1);
    set.erase(std::remove_if(set.begin(), set.end(), [](const auto &p) { return p.first == "extensions"; }), set.end());
    if (merged != "{}")
        set.emplace_back("extensions", merged);
    m.raw = object_with(
        old, json_text::root, set, [](const std::string &name) { return is_appearance(name) || name == "extensions"; },
        inside);
}

void material_put(material_text &m, const std::string &pointer, std::string raw)
{
    const std::vector<std::string> tokens = tokens_of(pointer);
    json_text text(m.raw, m.style, m.level);
    uint32_t n = json_text::root;
    size_t depth = 0;
    std::string here;
    for (; depth < tokens.size(); depth++) {
        const uint32_t next = text.find(json_pointer(here, tokens[depth]));
        if (next == json_text::none)
            break;
        here = json_pointer(here, tokens[depth]);
        n = next;
    }
    if (depth == tokens.size()) {
        text.replace(n, json_layout(raw, m.style, text.node(n).level));
    } else {
        if (text.kind(n) != '{')
            throw file_error(here, "found no object, expected one to set \"" + tokens[depth] + "\" in");
        for (size_t i = tokens.size() - 1; i > depth; i--)
            raw = json_object_of(tokens[i], raw);
        text.add_member(n, tokens[depth], raw);
    }
    m.raw = text.result();
}

void material_set(material_text &m, const std::string &pointer, const std::string &value)
{
    const std::vector<std::string> tokens = tokens_of(pointer);
    const auto extension = std::find(tokens.begin(), tokens.end(), glint_extension);
    if (extension == tokens.end() || extension + 1 == tokens.end())
        throw file_error("", "found the pointer " + pointer + ", expected one into " + glint_extension);
    check_name(*(extension + 1));
    material_put(m, pointer, value_text(value));
}

void material_remove(material_text &m, const std::string &pointer)
{
    json_text text(m.raw, m.style, m.level);
    uint32_t n = text.find(pointer);
    if (n == json_text::none)
        return;
    const uint32_t parent = text.node(n).parent;
    if (text.node(parent).child_count == 1 && text.name(parent) == "extensions")
        n = parent;
    text.remove({ n });
    m.raw = text.result();
}

std::set<std::string> material_extension_names(const std::string &raw)
{
    std::set<std::string> names;
    const json_text text(raw);
    each_object(text, json_text::root, [&](uint32_t n) {
        const uint32_t extensions = text.member(n, "extensions");
        if (extensions == json_text::none || text.kind(extensions) != '{')
            return;
        for (uint32_t e = text.node(extensions).first_child; e != json_text::none; e = text.node(e).next)
            names.insert(text.name(e));
    });
    return names;
}
