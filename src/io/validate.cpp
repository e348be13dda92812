// From a path to issues: container, JSON, tables, the rules of the extension, the whole reader, the rules for meshes.
#include "io/validate.h"

#include <new>

#include "io/gltf_document.hpp"
#include "io/gltf_schema.hpp"
#include "io/gltf_validate.hpp"
#include "io/preset.hpp"
#include "io/scene_file.h"

namespace
{

struct subject {
    std::string path;
    bool preset;
    std::vector<uint8_t> bytes;
    json root;
};

bool ends_with(const std::string &text, const std::string &end)
{
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

void load(subject &s)
{
    s.bytes = file_bytes(s.path, s.preset ? preset_max_bytes : gltf_max_file_bytes);
    const std::string_view all(reinterpret_cast<const char *>(s.bytes.data()), s.bytes.size());
    s.root = json_parse(s.preset ? all : gltf_open(s.bytes).text);
    if (!s.root.is_object())
        throw file_error("", "found " + json_excerpt(s.root) + ", expected an object");
    if (s.preset)
        s.root = preset_document(s.root);
}

// "found X, expected Y" as its two parts.
void add_text(issue_list &issues, const char *code, const std::string &place, std::string text)
{
    constexpr const char *start = "found ", *middle = ", expected ";
    if (text.compare(0, 6, start) == 0)
        text.erase(0, 6);
    const size_t at = text.find(middle);
    issues.add(VALIDATE_ERROR, code, place, text.substr(0, at), at == text.npos ? "" : text.substr(at + 11));
}

// What the reader only warns of is no fault of the file.
struct listener {
    issue_list *issues;
    std::string prefix; // the path, with which every warning starts
};

void hear(const char *text, void *user)
{
    const listener &l = *static_cast<listener *>(user);
    const std::string all = text;
    const std::string rest = all.compare(0, l.prefix.size(), l.prefix) == 0 ? all.substr(l.prefix.size()) : all;
    const size_t colon = rest[0] == '/' ? rest.find(": ") : rest.npos;
    const std::string pointer = colon == rest.npos ? "" : rest.substr(0, colon);
    l.issues->add(VALIDATE_INFO, "READER", pointer, colon == rest.npos ? rest : rest.substr(colon + 2), "");
}

// The message of the reader is "PATH: PLACE: TEXT".
void add_message(const subject &s, const std::string &message, issue_list &issues)
{
    const std::string prefix = s.path + ": ";
    const std::string rest = message.compare(0, prefix.size(), prefix) == 0 ? message.substr(prefix.size()) : message;
    const bool placed = rest[0] == '/' || rest.compare(0, 5, "byte ") == 0 || rest.compare(0, 5, "line ") == 0;
    const size_t colon = placed ? rest.find(": ") : rest.npos;
    add_text(issues, "CONTENT", colon == rest.npos ? "" : rest.substr(0, colon),
             colon == rest.npos ? rest : rest.substr(colon + 2));
}

void read_whole(const subject &s, issue_list &issues)
{
    listener l = { &issues, s.path + ": " };
    report r = { {}, hear, &l };
    scene read = {};
    if (s.preset) {
        scene_material material;
        if (preset_read(s.path.c_str(), &read, &material, &r))
            std::free(material.name);
        else
            add_message(s, r.error, issues);
    } else if (scene_file_read(s.path.c_str(), nullptr, &read, &r)) {
        validate_on_meshes(s.root, read, issues);
    } else {
        add_message(s, r.error, issues);
    }
    scene_free(&read);
}

void check(subject &s, issue_list &issues)
{
    load(s);
    gltf::check_schema(s.root, [&](const gltf::finding &f) {
        const std::string place = s.preset ? preset_place(f.pointer) : f.pointer;
        issues.add(VALIDATE_ERROR, f.code, place, f.found, f.expected.empty() ? "it, for it is required" : f.expected);
    });
    if (issues.any_error())
        return;
    validate_extension(s.root, issues);
    read_whole(s, issues);
}

struct translator {
    validate_visitor visit;
    void *user;
};

// A preset's issues by their places in its own file.
void translate(const validate_issue *issue, void *user)
{
    const auto *t = static_cast<translator *>(user);
    const std::string place = preset_place(issue->pointer);
    validate_issue copy = *issue;
    if (std::string(issue->pointer).compare(0, 12, "/materials/0") == 0)
        copy.pointer = place.c_str();
    t->visit(&copy, t->user);
}

} // namespace

bool validate_file(const char *path, validate_visitor visit, void *user)
{
    translator t = { visit, user };
    subject s = { path, ends_with(path, ".json"), {}, {} };
    issue_list issues(s.preset ? translate : visit, s.preset ? &t : user);
    try {
        check(s, issues);
    } catch (const file_error &e) {
        const bool is_verb = e.text.compare(0, 7, "cannot ") == 0;
        add_text(issues, "FILE", e.place, (is_verb ? "a file that " : "") + e.text);
    } catch (const std::bad_alloc &) {
        issues.add(VALIDATE_ERROR, "FILE", "", "a file that needs more memory than there is", "");
    } catch (const std::exception &e) {
        issues.add(VALIDATE_ERROR, "FILE", "", std::string("a file that cannot be read: ") + e.what(), "");
    }
    return !issues.any_error();
}
