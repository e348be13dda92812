// The only includer of nlohmann-json: JSON values, and the strict reading of JSON text.
#ifndef IO_JSON_HPP
#define IO_JSON_HPP

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

using json = nlohmann::json;
using ordered_json = nlohmann::ordered_json;

// Parses UTF-8 text. Throws a file_error for anything but one JSON document with unique keys, finite numbers, a depth
// of at most 64 and at most 2^24 values.
json json_parse(std::string_view text);

// Appends a key to a JSON pointer (RFC 6901).
std::string json_pointer(const std::string &parent, const std::string &key);
std::string json_pointer(const std::string &parent, size_t index);

// A value as it looks in the file, cut to a length that a message can hold.
std::string json_excerpt(const json &value);

#endif
