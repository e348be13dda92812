// Places of values in a JSON text, and a list of changes that is applied in one pass.
#include "exporters/gltf/json_text.hpp"

#include <algorithm>

#include "io/json.hpp"

namespace
{

bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

bool is_container(char kind)
{
    return kind == '{' || kind == '[';
}

// The characters of a raw name or string without its quotes.
std::string unquoted(std::string_view raw)
{
    if (raw.find('\\') == raw.npos)
        return std::string(raw.substr(1, raw.size() - 2));
    return json::parse(raw.begin(), raw.end()).get<std::string>();
}

} // namespace

json_text::json_text(std::string_view text) : text_(text)
{
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    uint32_t at = text.substr(0, byte_order_mark.size()) == byte_order_mark ? 3 : 0;
    scan_value(at, none, 0);
    find_style();
}

json_text::json_text(std::string_view text, const json_style &style, size_t level) : text_(text), style_(style)
{
    uint32_t at = 0;
    scan_value(at, none, static_cast<uint32_t>(level));
}

// ---- scanning; the text is known to be valid ----

void json_text::skip_blanks(uint32_t &at) const
{
    while (at < text_.size() && is_blank(text_[at]))
        at++;
}

void json_text::skip_string(uint32_t &at) const
{
    for (at++; text_[at] != '"'; at++)
        if (text_[at] == '\\')
            at++;
    at++;
}

uint32_t json_text::scan_value(uint32_t &at, uint32_t parent, uint32_t level)
{
    skip_blanks(at);
    const auto n = static_cast<uint32_t>(nodes_.size());
    nodes_.emplace_back();
    nodes_[n].begin = at;
    nodes_[n].parent = parent;
    nodes_[n].level = level;
    if (is_container(text_[at])) {
        scan_children(at, n);
    } else if (text_[at] == '"') {
        skip_string(at);
    } else {
        while (at < text_.size() && !is_blank(text_[at]) && text_[at] != ',' && text_[at] != '}' && text_[at] != ']')
            at++;
    }
    nodes_[n].end = at;
    return n;
}

// From the opening bracket to behind the closing one. json_parse has bounded the depth of this recursion.
void json_text::scan_children(uint32_t &at, uint32_t n)
{
    const bool named = text_[at] == '{';
    const uint32_t level = nodes_[n].level + 1;
    at++;
    for (skip_blanks(at); text_[at] != '}' && text_[at] != ']'; skip_blanks(at)) {
        const uint32_t name_begin = at;
        uint32_t name_end = at;
        if (named) {
            skip_string(at);
            name_end = at;
            skip_blanks(at);
            at++; // the colon
        }
        const uint32_t child = scan_value(at, n, level);
        nodes_[child].name_begin = name_begin;
        nodes_[child].name_end = name_end;
        if (nodes_[n].child_count++ == 0)
            nodes_[n].first_child = child;
        else
            nodes_[nodes_[n].last_child].next = child;
        nodes_[n].last_child = child;
        skip_blanks(at);
        if (text_[at] == ',')
            at++;
    }
    at++;
}

// The first member of the root shows what the file does.
void json_text::find_style()
{
    const uint32_t first = nodes_[root].first_child;
    if (first == none)
        return;
    const json_node &member = nodes_[first];
    const std::string_view before = blanks_before_first(root);
    const size_t line = before.rfind('\n');
    style_.one_line = line == before.npos;
    if (!style_.one_line)
        style_.indent = before.substr(line + 1);
    style_.space_after_colon = member.name_end < member.begin && text_[member.begin - 1] != ':';
}

// ---- what is there ----

std::string_view json_text::value(uint32_t n) const
{
    return text_.substr(nodes_[n].begin, nodes_[n].end - nodes_[n].begin);
}

std::string_view json_text::head(uint32_t n) const
{
    return text_.substr(nodes_[n].name_begin, nodes_[n].begin - nodes_[n].name_begin);
}

char json_text::kind(uint32_t n) const
{
    const char first = text_[nodes_[n].begin];
    return first >= '0' && first <= '9' ? '-' : first;
}

std::string json_text::name(uint32_t n) const
{
    const json_node &named = nodes_[n];
    return named.name_begin == named.name_end
               ? std::string()
               : unquoted(text_.substr(named.name_begin, named.name_end - named.name_begin));
}

uint32_t json_text::member(uint32_t object, std::string_view name) const
{
    if (object == none || kind(object) != '{')
        return none;
    uint32_t child = nodes_[object].first_child;
    while (child != none && this->name(child) != name)
        child = nodes_[child].next;
    return child;
}

uint32_t json_text::element(uint32_t array, size_t index) const
{
    if (array == none || kind(array) != '[')
        return none;
    uint32_t child = nodes_[array].first_child;
    for (; child != none && index > 0; index--)
        child = nodes_[child].next;
    return child;
}

uint32_t json_text::find(std::string_view pointer) const
{
    uint32_t n = root;
    while (n != none && !pointer.empty()) {
        if (pointer[0] != '/')
            return none;
        const size_t end = std::min(pointer.find('/', 1), pointer.size());
        std::string token(pointer.substr(1, end - 1));
        pointer.remove_prefix(end);
        if (kind(n) == '[') {
            const bool number = !token.empty() && token.size() < 10 &&
                                token.find_first_not_of("0123456789") == token.npos &&
                                (token.size() == 1 || token[0] != '0');
            n = number ? element(n, std::stoul(token)) : none;
            continue;
        }
        for (size_t at = token.find('~'); at != token.npos; at = token.find('~', at + 1))
            token.replace(at, 2, token.compare(at, 2, "~1") == 0 ? "/" : "~");
        n = member(n, token);
    }
    return n;
}

std::string json_text::pointer(uint32_t n) const
{
    const uint32_t parent = nodes_[n].parent;
    if (parent == none)
        return "";
    if (kind(parent) == '{')
        return json_pointer(pointer(parent), name(n));
    size_t index = 0;
    for (uint32_t child = nodes_[parent].first_child; child != n; child = nodes_[child].next)
        index++;
    return json_pointer(pointer(parent), index);
}

std::string_view json_text::blanks_before_first(uint32_t container) const
{
    const json_node &c = nodes_[container];
    return text_.substr(c.begin + 1, nodes_[c.first_child].name_begin - c.begin - 1);
}

std::string_view json_text::blanks_behind_last(uint32_t container) const
{
    const json_node &c = nodes_[container];
    return text_.substr(nodes_[c.last_child].end, c.end - 1 - nodes_[c.last_child].end);
}

// ---- changes ----

void json_text::replace(uint32_t n, std::string raw)
{
    if (raw != value(n))
        edits_.push_back({ nodes_[n].begin, nodes_[n].end, std::move(raw) });
}

void json_text::add(uint32_t container, const std::string &start, std::string_view raw)
{
    const json_node &c = nodes_[container];
    const size_t level = level_inside(container);
    std::string blanks;
    if (c.first_child != none)
        blanks = blanks_before_first(container);
    else if (kind(container) == '{')
        blanks = json_line_break(style_, level);
    const bool first = c.child_count + added_[container]++ == 0;
    const uint32_t at = c.last_child != none ? nodes_[c.last_child].end : c.begin + 1;
    edits_.push_back({ at, at, (first ? "" : ",") + blanks + start + json_layout(raw, style_, level) });
}

void json_text::add_member(uint32_t object, const std::string &name, std::string_view raw)
{
    add(object, json(name).dump() + (style_.space_after_colon ? ": " : ":"), raw);
}

void json_text::add_element(uint32_t array, std::string_view raw)
{
    add(array, "", raw);
}

// What add() put in lies between the end of the child before, or the opening bracket, and the end of the child.
void json_text::remove_from(uint32_t container, std::vector<uint32_t> children)
{
    std::sort(children.begin(), children.end());
    uint32_t kept_end = none, from = nodes_[container].begin + 1;
    bool open = false; // children before the first that is kept
    for (uint32_t child = nodes_[container].first_child; child != none; child = nodes_[child].next) {
        const json_node &c = nodes_[child];
        if (!std::binary_search(children.begin(), children.end(), child)) {
            if (open)
                edits_.push_back({ from, c.name_begin, "" });
            open = false;
            kept_end = c.end;
        } else if (kept_end != none) {
            edits_.push_back({ kept_end, c.end, "" });
            kept_end = c.end;
        } else {
            open = true;
        }
    }
    if (open)
        edits_.push_back({ from, nodes_[nodes_[container].last_child].end, "" });
}

void json_text::remove(const std::vector<uint32_t> &children)
{
    std::map<uint32_t, std::vector<uint32_t>> by_container;
    for (const uint32_t child : children)
        by_container[nodes_[child].parent].push_back(child);
    for (const auto &group : by_container)
        remove_from(group.first, group.second);
}

std::string json_text::result() const
{
    std::vector<edit> sorted = edits_;
    std::stable_sort(sorted.begin(), sorted.end(), [](const edit &a, const edit &b) { return a.begin < b.begin; });
    std::string out;
    uint32_t at = 0;
    for (const edit &e : sorted) {
        out.append(text_.substr(at, e.begin - at)).append(e.text);
        at = e.end;
    }
    return out.append(text_.substr(at));
}

// ---- layout ----

namespace
{

class layout
{
  public:
    layout(const json_text &text, const json_style &style) : text_(text), style_(style)
    {
    }

    void write(uint32_t n, size_t level)
    {
        if (!is_container(text_.kind(n))) {
            out.append(text_.value(n));
            return;
        }
        const bool object = text_.kind(n) == '{';
        const bool flat = style_.one_line || text_.node(n).child_count == 0 || (!object && only_scalars(n));
        out += object ? '{' : '[';
        for (uint32_t child = text_.node(n).first_child; child != json_text::none; child = text_.node(child).next) {
            if (child != text_.node(n).first_child)
                out += flat && style_.space_after_colon ? ", " : ",";
            if (!flat)
                out += json_line_break(style_, level + 1);
            if (object)
                out.append(json(text_.name(child)).dump()).append(style_.space_after_colon ? ": " : ":");
            write(child, level + 1);
        }
        if (!flat)
            out += json_line_break(style_, level);
        out += object ? '}' : ']';
    }

    std::string out;

  private:
    bool only_scalars(uint32_t n) const
    {
        for (uint32_t child = text_.node(n).first_child; child != json_text::none; child = text_.node(child).next)
            if (is_container(text_.kind(child)))
                return false;
        return true;
    }

    const json_text &text_;
    const json_style &style_;
};

} // namespace

std::string json_line_break(const json_style &style, size_t level)
{
    if (style.one_line)
        return "";
    std::string text = "\n";
    for (size_t i = 0; i < level; i++)
        text += style.indent;
    return text;
}

std::string json_layout(std::string_view text, const json_style &style, size_t level)
{
    const json_text parsed(text);
    layout l(parsed, style);
    l.write(json_text::root, level);
    return l.out;
}

std::string json_object_of(const std::string &name, const std::string &raw)
{
    return std::string("{").append(json(name).dump()).append(":").append(raw).append("}");
}
