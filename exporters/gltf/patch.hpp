// Changes to the JSON of a glTF file that the file itself remembers, so that they can be taken back byte for byte.
//
// The record is the member "export" of the extras of the extension's root object:
//   "extensions": {"GLINT_materials_glint": {"extras": {"export": RECORD}}}
//   RECORD = {"added": [pointer...], "replaced": {pointer: the text before...}, "binBytes": n, "jsonPadding": n}
// added: members and elements that were not there, in order. replaced: values by what stood there, as it was spelled.
// binBytes: the BIN chunk before it grew, 0 where there was none. jsonPadding: spaces behind the JSON of a .glb, where
// they were not those that a multiple of four bytes needs.
#ifndef EXPORTERS_GLTF_PATCH_HPP
#define EXPORTERS_GLTF_PATCH_HPP

#include <optional>
#include <set>

#include "exporters/gltf/json_text.hpp"
#include "io/json.hpp"

constexpr const char *glint_extension = "GLINT_materials_glint";

struct export_record {
    std::vector<std::string> added;
    std::map<std::string, std::string> replaced;
    std::optional<size_t> bin_bytes, json_padding;
};

// The record of a file, empty where it has none. Throws a file_error where it is not one.
export_record export_read_record(const json_text &text);

class patch
{
  public:
    // The text must outlive the patch.
    explicit patch(std::string_view text);

    const json_text &text() const
    {
        return text_;
    }
    export_record &record()
    {
        return record_;
    }

    void replace(uint32_t n, const std::string &raw);
    void add_member(uint32_t object, const std::string &name, const std::string &raw);
    // To an array of the root, which comes into being with its first element. Returns the index of the new element.
    size_t add_element(const std::string &array, const std::string &raw);
    // How many elements a root array has by now.
    size_t count(const std::string &array) const;
    void use_extension(const std::string &name);

    // The new text with its record; the old one where nothing changed.
    std::string result();

  private:
    bool is_within_added(const std::string &pointer) const;
    void remember_added(const std::string &pointer);
    void write_elements(const std::string &array, const std::vector<std::string> &elements);
    void write_record();

    std::string_view original_;
    json_text text_;
    export_record record_;
    std::map<std::string, std::vector<std::string>> new_elements_; // of root arrays
    std::set<std::string> extensions_;
};

#endif
