// Strict JSON: what glTF 2.0 section 2.7 asks for (unique keys), and limits that keep hostile text cheap.
#include "io/json.hpp"

#include <set>
#include <vector>

#include "io/file_error.hpp"

namespace
{

// Our choices: real files nest about ten deep; 2^24 values take less than 1 GiB once parsed.
constexpr int max_depth = 64;
constexpr size_t max_values = size_t{ 1 } << 24;

// Line and column, both from 1, of a byte of the text.
std::string place_of(std::string_view text, size_t byte)
{
    size_t line = 1, line_start = 0;
    const size_t end = std::min(byte, text.size());
    for (size_t i = 0; i < end; i++) {
        if (text[i] == '\n') {
            line++;
            line_start = i + 1;
        }
    }
    return "line " + std::to_string(line) + ", column " + std::to_string(end - line_start + 1);
}

// Sees every value while it is parsed, so that a document that is too deep or too large is never built.
class limits
{
  public:
    bool operator()(int depth, json::parse_event_t event, const json &parsed)
    {
        switch (event) {
        case json::parse_event_t::object_start:
            check_depth(depth);
            keys_.emplace_back();
            break;
        case json::parse_event_t::object_end:
            keys_.pop_back();
            break;
        case json::parse_event_t::array_start:
            check_depth(depth);
            break;
        case json::parse_event_t::key:
            if (!keys_.back().insert(parsed.get<std::string>()).second)
                throw file_error("",
                                 "found the key " + json_excerpt(parsed) + " twice in one object; keys must be unique");
            break;
        default:
            break;
        }
        if (++values_ > max_values)
            throw file_error("",
                             "found more than " + std::to_string(max_values) + " JSON values, the most that is read");
        return true;
    }

  private:
    static void check_depth(int depth)
    {
        if (depth >= max_depth)
            throw file_error("", "found JSON nested deeper than " + std::to_string(max_depth) +
                                     " levels, the most that is read");
    }

    std::vector<std::set<std::string>> keys_;
    size_t values_ = 0;
};

} // namespace

json json_parse(std::string_view text)
{
    try {
        return json::parse(text.begin(), text.end(), limits());
    } catch (const json::parse_error &e) {
        throw file_error(place_of(text, e.byte > 0 ? e.byte - 1 : 0), "found text that is not JSON");
    } catch (const json::out_of_range &) {
        throw file_error("", "found a number beyond the range of a double; numbers must be finite");
    }
}

std::string json_pointer(const std::string &parent, const std::string &key)
{
    std::string pointer = parent + "/";
    for (const char c : key) {
        if (c == '~')
            pointer += "~0";
        else if (c == '/')
            pointer += "~1";
        else
            pointer += c;
    }
    return pointer;
}

std::string json_pointer(const std::string &parent, size_t index)
{
    return parent + "/" + std::to_string(index);
}

std::string json_excerpt(const json &value)
{
    constexpr size_t longest = 60;
    if (value.is_object())
        return "an object";
    if (value.is_array())
        return "an array of " + std::to_string(value.size());
    const std::string text = value.dump(-1, ' ', true);
    return text.size() <= longest ? text : text.substr(0, longest) + "...";
}
