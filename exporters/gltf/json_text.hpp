// A JSON text that is changed in place: whatever is not changed keeps its bytes, the spelling of its numbers, the order
// of its members and its white space.
#ifndef EXPORTERS_GLTF_JSON_TEXT_HPP
#define EXPORTERS_GLTF_JSON_TEXT_HPP

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

// How a file spells what it leaves to taste; new text follows.
struct json_style {
    std::string indent; // of one level; empty with one_line
    bool one_line = true;
    bool space_after_colon = false;
};

// Lays out valid JSON text anew: white space follows the style, every token keeps its bytes. The text stands on a
// level. Arrays of numbers, strings and literals stay on one line.
std::string json_layout(std::string_view text, const json_style &style, size_t level);

// The start of a new line on a level; nothing where the style has one line.
std::string json_line_break(const json_style &style, size_t level);

// A value of the text.
struct json_node {
    static constexpr uint32_t none = UINT32_MAX;
    uint32_t begin = 0, end = 0;           // of the value
    uint32_t name_begin = 0, name_end = 0; // of the name with its quotes; both are begin where it has no name
    uint32_t parent = none, first_child = none, last_child = none, next = none;
    uint32_t child_count = 0, level = 0;
};

class json_text
{
  public:
    // The text must be valid (json_parse) and outlive this object; a byte order mark is skipped.
    explicit json_text(std::string_view text);
    // A part of a greater text: its style, and the level that the part stands on there.
    json_text(std::string_view text, const json_style &style, size_t level);

    // ---- what is there ----

    static constexpr uint32_t root = 0, none = json_node::none;
    const json_node &node(uint32_t n) const
    {
        return nodes_[n];
    }
    std::string_view value(uint32_t n) const;
    std::string_view head(uint32_t n) const; // a member's name, its colon and the blanks up to its value
    char kind(uint32_t n) const;             // its first character: { [ " t f n, or - for any number
    std::string name(uint32_t n) const;
    uint32_t member(uint32_t object, std::string_view name) const; // none where there is none
    uint32_t element(uint32_t array, size_t index) const;
    // By JSON pointer; none where there is none.
    uint32_t find(std::string_view pointer) const;
    std::string pointer(uint32_t n) const;
    // White space between the opening bracket and the first child, between the last and the closing bracket.
    std::string_view blanks_before_first(uint32_t container) const;
    std::string_view blanks_behind_last(uint32_t container) const;
    const json_style &style() const
    {
        return style_;
    }
    // The level of what stands inside a container.
    size_t level_inside(uint32_t container) const
    {
        return nodes_[container].level + size_t{ 1 };
    }

    // ---- changes; nothing is changed until result() ----

    // Raw text for the value of n, as it is.
    void replace(uint32_t n, std::string raw);
    // Behind the last member or element, laid out in the style of the file. The text of a member's name is raw too.
    void add_member(uint32_t object, const std::string &name, std::string_view raw);
    void add_element(uint32_t array, std::string_view raw);
    // Takes children out of containers with the comma and the white space that add_member and add_element gave them.
    void remove(const std::vector<uint32_t> &children);
    bool changed() const
    {
        return !edits_.empty();
    }
    std::string result() const;

  private:
    struct edit {
        uint32_t begin, end;
        std::string text;
    };
    uint32_t scan_value(uint32_t &at, uint32_t parent, uint32_t level);
    void scan_children(uint32_t &at, uint32_t n);
    void skip_blanks(uint32_t &at) const;
    void skip_string(uint32_t &at) const;
    void find_style();
    void add(uint32_t container, const std::string &start, std::string_view raw);
    void remove_from(uint32_t container, std::vector<uint32_t> children);

    std::string_view text_;
    std::vector<json_node> nodes_;
    std::vector<edit> edits_;
    std::map<uint32_t, uint32_t> added_; // per container
    json_style style_;
};

// {"NAME":RAW}, the name escaped, the value as it is.
std::string json_object_of(const std::string &name, const std::string &raw);

#endif
