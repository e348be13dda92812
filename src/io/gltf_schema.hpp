// What a glTF JSON object may hold: tables of properties, and the check of a document against them.
#ifndef IO_GLTF_SCHEMA_HPP
#define IO_GLTF_SCHEMA_HPP

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "io/json.hpp"

namespace gltf
{

enum class kind {
    boolean,
    text,
    number,
    integer,
    index,      // into the array at `of`, a JSON pointer without its first slash
    choice,     // one of the strings, or integers, of `of`, separated by |
    numbers,    // array of numbers
    triples,    // array of arrays of three numbers
    indices,    // array of distinct indices into the array at `of`
    texts,      // array of distinct strings
    object,     // as `schema` says
    objects,    // array of them
    index_map,  // object whose values are indices into `of`: attributes
    index_maps, // array of them: morph targets
    integer_map // object whose values are integers
};

struct schema;

struct property {
    const char *name;
    gltf::kind kind;
    const char *of = "";
    const gltf::schema *schema = nullptr;
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    bool above_low = false; // low itself is not allowed
    size_t min_items = 0, max_items = std::numeric_limits<size_t>::max();
    bool required = false;

    property must() const
    {
        property copy = *this;
        copy.required = true;
        return copy;
    }
};

struct extension {
    const char *name;
    const gltf::schema *schema;
};

// Properties that no table names are let through, as JSON schema does; extensions and extras are implied everywhere.
struct schema {
    std::vector<property> properties;
    std::vector<extension> extensions;
};

// The tables: glTF 2.0 itself, then one function for the extensions of each kind of object.
const schema &root_schema();
const schema &animations_schema(); // the root again, but of its members animations alone
const std::vector<extension> &root_extensions();
const std::vector<extension> &scene_extensions();
const std::vector<extension> &node_extensions();
const std::vector<extension> &primitive_extensions();
const std::vector<extension> &material_extensions();
const std::vector<extension> &texture_info_extensions();
const schema &texture_info_schema();
const schema &normal_texture_schema();

// Makers of table rows.
property boolean(const char *name);
property text(const char *name);
property number(const char *name, double low, double high);
property number_above(const char *name, double low);
property integer(const char *name, double low, double high);
property index(const char *name, const char *of);
property choice(const char *name, const char *of);
property numbers(const char *name, size_t count, double low, double high);
property triples(const char *name, size_t min_count, size_t max_count, double low, double high);
property numbers_between(const char *name, size_t min_count, size_t max_count);
property indices(const char *name, const char *of, size_t min_count);
property texts(const char *name);
property object(const char *name, const schema &of);
property objects(const char *name, const schema &of, size_t min_count);
property index_map(const char *name, const char *of);
property index_maps(const char *name, const char *of);
property integer_map(const char *name, double low, double high);

// A value that breaks a table.
struct finding {
    const char *code; // TYPE, RANGE, INDEX, ENUM, COUNT, DUPLICATE or REQUIRED
    std::string pointer, found, expected;
};
using finding_visitor = std::function<void(const finding &)>;

// "found X, expected Y"
std::string finding_text(const finding &f);

// Tells of every value that breaks a table. Integers that are written as 3.0 or 3e0, which glTF 2.0 section 2.7.1
// allows, become integers.
void check_schema(json &root, const finding_visitor &visit);

// The same, but throws a file_error for the first.
void check_schema(json &root);
// Likewise for the animations, which nothing but a motion needs. root has passed check_schema.
void check_animations(json &root);

} // namespace gltf

#endif
