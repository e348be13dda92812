// Walks a JSON document along the tables of gltf_schema.hpp and names the first value that breaks one.
#include "io/gltf_schema.hpp"

#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string_view>

#include "io/file_error.hpp"

namespace gltf
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double max_integer = 9007199254740991.0; // 2^53 - 1: exact in a double

std::string number_text(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", value);
    return text;
}

std::string range_text(const property &p)
{
    if (std::isinf(p.low) && std::isinf(p.high))
        return "";
    if (std::isinf(p.high))
        return (p.above_low ? " above " : " of at least ") + number_text(p.low);
    return " from " + number_text(p.low) + " to " + number_text(p.high);
}

std::string count_text(const property &p)
{
    if (p.min_items == p.max_items)
        return std::to_string(p.min_items) + " ";
    if (p.max_items == std::numeric_limits<size_t>::max())
        return p.min_items > 0 ? "at least " + std::to_string(p.min_items) + " " : "";
    return std::to_string(p.min_items) + " to " + std::to_string(p.max_items) + " ";
}

class checker
{
  public:
    checker(json &root, const finding_visitor &visit) : root_(root), visit_(visit)
    {
    }

    void check_object(json &value, const schema &s, const std::string &pointer)
    {
        if (!value.is_object())
            return wrong("TYPE", pointer, value, "an object");
        for (const property &p : s.properties) {
            const auto found = value.find(p.name);
            if (found != value.end())
                check_property(*found, p, json_pointer(pointer, p.name));
            else if (p.required)
                visit_({ "REQUIRED", pointer, std::string("no \"") + p.name + "\"", "" });
        }
        check_extensions(value, s, pointer);
    }

  private:
    void wrong(const char *code, const std::string &pointer, const json &found, const std::string &expected)
    {
        visit_({ code, pointer, json_excerpt(found), expected });
    }

    void check_extensions(json &value, const schema &s, const std::string &pointer)
    {
        const auto found = value.find("extensions");
        if (found == value.end())
            return;
        const std::string here = json_pointer(pointer, "extensions");
        if (!found->is_object())
            return wrong("TYPE", here, *found, "an object");
        for (auto &item : found->items())
            if (!item.value().is_object())
                wrong("TYPE", json_pointer(here, item.key()), item.value(), "an object");
        for (const extension &e : s.extensions) {
            const auto known = found->find(e.name);
            if (known != found->end() && known->is_object())
                check_object(*known, *e.schema, json_pointer(here, e.name));
        }
    }

    void check_property(json &value, const property &p, const std::string &pointer)
    {
        switch (p.kind) {
        case kind::boolean:
            if (!value.is_boolean())
                wrong("TYPE", pointer, value, "true or false");
            break;
        case kind::text:
            if (!value.is_string())
                wrong("TYPE", pointer, value, "a string");
            break;
        case kind::number:
            check_number(value, p, pointer);
            break;
        case kind::integer:
            check_integer(value, p, pointer);
            break;
        case kind::index:
            check_index(value, p, pointer);
            break;
        case kind::choice:
            check_choice(value, p, pointer);
            break;
        case kind::object:
            check_object(value, *p.schema, pointer);
            break;
        case kind::index_map:
        case kind::integer_map:
            check_map(value, p, pointer);
            break;
        default:
            check_array(value, p, pointer);
        }
    }

    void check_number(const json &value, const property &p, const std::string &pointer)
    {
        // Renderers keep single precision.
        constexpr double largest = static_cast<double>(std::numeric_limits<float>::max());
        const double number = value.is_number() ? value.get<double>() : infinity;
        if (std::abs(number) > largest || number < p.low || (p.above_low && number == p.low) || number > p.high)
            wrong(value.is_number() ? "RANGE" : "TYPE", pointer, value, "a number" + range_text(p));
    }

    void check_integer(json &value, const property &p, const std::string &pointer)
    {
        const double number = value.is_number() ? value.get<double>() : infinity;
        if (!(number >= p.low && number <= p.high) || number != std::floor(number))
            return wrong(value.is_number() ? "RANGE" : "TYPE", pointer, value, "an integer" + range_text(p));
        if (value.is_number_float() || number >= 0.0)
            value = number >= 0.0 ? json(static_cast<uint64_t>(number)) : json(static_cast<int64_t>(number));
    }

    void check_index(json &value, const property &p, const std::string &pointer)
    {
        const size_t count = array_size(p.of);
        const double number = value.is_number() ? value.get<double>() : infinity;
        if (!(number >= 0.0 && number < static_cast<double>(count)) || number != std::floor(number))
            return wrong("INDEX", pointer, value,
                         std::string("an index into \"") + p.of + "\", of which there " +
                             (count == 1 ? "is 1" : "are " + std::to_string(count)));
        value = static_cast<uint64_t>(number);
    }

    size_t array_size(const char *where)
    {
        const auto known = sizes_.find(where);
        if (known != sizes_.end())
            return known->second;
        const json::json_pointer pointer(std::string("/") + where);
        const size_t size = root_.contains(pointer) && root_.at(pointer).is_array() ? root_.at(pointer).size() : 0;
        return sizes_[where] = size;
    }

    void check_choice(json &value, const property &p, const std::string &pointer)
    {
        if (value.is_number_float() && std::abs(value.get<double>()) < max_integer &&
            value.get<double>() == std::floor(value.get<double>()))
            value = static_cast<int64_t>(value.get<double>());
        const std::string found = value.is_string()           ? value.get<std::string>()
                                  : value.is_number_integer() ? value.dump()
                                                              : "";
        const std::string_view choices = p.of;
        for (size_t start = 0; start <= choices.size();) {
            const size_t end = std::min(choices.find('|', start), choices.size());
            if (!found.empty() && choices.substr(start, end - start) == found)
                return;
            start = end + 1;
        }
        wrong("ENUM", pointer, value, "one of " + std::string(choices));
    }

    void check_map(json &value, const property &p, const std::string &pointer)
    {
        if (!value.is_object())
            return wrong("TYPE", pointer, value, "an object");
        for (auto &item : value.items()) {
            const std::string here = json_pointer(pointer, item.key());
            if (p.kind == kind::integer_map)
                check_integer(item.value(), p, here);
            else
                check_index(item.value(), p, here);
        }
    }

    void check_array(json &value, const property &p, const std::string &pointer)
    {
        if (!value.is_array() || value.size() < p.min_items || value.size() > p.max_items)
            return wrong(value.is_array() ? "COUNT" : "TYPE", pointer, value,
                         "an array of " + count_text(p) + item_text(p.kind));
        std::set<json> seen;
        for (size_t i = 0; i < value.size(); i++) {
            const std::string here = json_pointer(pointer, i);
            check_item(value[i], p, here);
            if ((p.kind == kind::indices || p.kind == kind::texts) && !seen.insert(value[i]).second)
                wrong("DUPLICATE", here, value[i], "each value only once");
        }
    }

    void check_item(json &value, const property &p, const std::string &pointer)
    {
        switch (p.kind) {
        case kind::numbers:
            check_number(value, p, pointer);
            break;
        case kind::triples:
            check_array(value, numbers(p.name, 3, p.low, p.high), pointer);
            break;
        case kind::indices:
            check_index(value, p, pointer);
            break;
        case kind::objects:
            check_object(value, *p.schema, pointer);
            break;
        case kind::index_maps:
            check_map(value, p, pointer);
            break;
        default:
            if (!value.is_string())
                wrong("TYPE", pointer, value, "a string");
        }
    }

    static const char *item_text(kind k)
    {
        switch (k) {
        case kind::numbers:
            return "numbers";
        case kind::triples:
            return "arrays of 3 numbers";
        case kind::indices:
            return "indices";
        case kind::texts:
            return "strings";
        default:
            return "objects";
        }
    }

    json &root_;
    const finding_visitor &visit_;
    std::map<std::string, size_t> sizes_;
};

} // namespace

property boolean(const char *name)
{
    return { name, kind::boolean };
}

property text(const char *name)
{
    return { name, kind::text };
}

property number(const char *name, double low, double high)
{
    return { name, kind::number, "", nullptr, low, high };
}

property number_above(const char *name, double low)
{
    return { name, kind::number, "", nullptr, low, infinity, true };
}

property integer(const char *name, double low, double high)
{
    return { name, kind::integer, "", nullptr, low, high };
}

property index(const char *name, const char *of)
{
    return { name, kind::index, of };
}

property choice(const char *name, const char *of)
{
    return { name, kind::choice, of };
}

property numbers(const char *name, size_t count, double low, double high)
{
    return { name, kind::numbers, "", nullptr, low, high, false, count, count };
}

property triples(const char *name, size_t min_count, size_t max_count, double low, double high)
{
    return { name, kind::triples, "", nullptr, low, high, false, min_count, max_count };
}

property numbers_between(const char *name, size_t min_count, size_t max_count)
{
    return { name, kind::numbers, "", nullptr, -infinity, infinity, false, min_count, max_count };
}

property indices(const char *name, const char *of, size_t min_count)
{
    return { name, kind::indices, of, nullptr, -infinity, infinity, false, min_count };
}

property texts(const char *name)
{
    return { name, kind::texts };
}

property object(const char *name, const schema &of)
{
    return { name, kind::object, "", &of };
}

property objects(const char *name, const schema &of, size_t min_count)
{
    return { name, kind::objects, "", &of, -infinity, infinity, false, min_count };
}

property index_map(const char *name, const char *of)
{
    return { name, kind::index_map, of };
}

property index_maps(const char *name, const char *of)
{
    return { name, kind::index_maps, of };
}

property integer_map(const char *name, double low, double high)
{
    return { name, kind::integer_map, "", nullptr, low, high };
}

std::string finding_text(const finding &f)
{
    return "found " + f.found + (f.expected.empty() ? ", which is required" : ", expected " + f.expected);
}

void check_schema(json &root, const finding_visitor &visit)
{
    checker(root, visit).check_object(root, root_schema(), "");
}

namespace
{

void refuse(const finding &f)
{
    throw file_error(f.pointer, finding_text(f));
}

} // namespace

void check_schema(json &root)
{
    check_schema(root, refuse);
}

void check_animations(json &root)
{
    const finding_visitor visit = refuse;
    checker(root, visit).check_object(root, animations_schema(), "");
}

} // namespace gltf
