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

// Reads the text once without building anything, so that a document that is too deep or too large is never built. (The
// parser's own callbacks would do, were they not quadratic in the length of an array.)
class checker : public nlohmann::json_sax<json>
{
  public:
    explicit checker(std::string_view text) : text_(text)
    {
    }
    bool null() override
    {
        return count();
    }
    bool boolean(bool) override
    {
        return count();
    }
    bool number_integer(number_integer_t) override
    {
        return count();
    }
    bool number_unsigned(number_unsigned_t) override
    {
        return count();
    }
    bool number_float(number_float_t, const string_t &) override
    {
        return count();
    }
    bool string(string_t &) override
    {
        return count();
    }
    bool binary(binary_t &) override
    {
        return count();
    }
    bool start_object(size_t) override
    {
        keys_.emplace_back();
        return deeper();
    }
    bool key(string_t &name) override
    {
        if (!keys_.back().insert(name).second)
            throw file_error("",
                             "found the key " + json_excerpt(json(name)) + " twice in one object; keys must be unique");
        return true;
    }
    bool end_object() override
    {
        keys_.pop_back();
        depth_--;
        return true;
    }
    bool start_array(size_t) override
    {
        return deeper();
    }
    bool end_array() override
    {
        depth_--;
        return true;
    }
    bool parse_error(size_t byte, const std::string &, const nlohmann::detail::exception &e) override
    {
        constexpr int number_overflow = 406;
        throw file_error(place_of(text_, byte > 0 ? byte - 1 : 0),
                         e.id == number_overflow ? "found a number beyond the range of a double; numbers must be finite"
                                                 : "found text that is not JSON");
    }

  private:
    bool count()
    {
        if (++values_ > max_values)
            throw file_error("",
                             "found more than " + std::to_string(max_values) + " JSON values, the most that is read");
        return true;
    }
    bool deeper()
    {
        if (++depth_ > max_depth)
            throw file_error("", "found JSON nested deeper than " + std::to_string(max_depth) +
                                     " levels, the most that is read");
        return count();
    }

    std::string_view text_;
    std::vector<std::set<std::string>> keys_;
    int depth_ = 0;
    size_t values_ = 0;
};

} // namespace

json json_parse(std::string_view text)
{
    checker check(text);
    json::sax_parse(text.begin(), text.end(), &check);
    return json::parse(text.begin(), text.end());
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
