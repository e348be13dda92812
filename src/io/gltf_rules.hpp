// Rules of glTF 2.0 that tie one property to another, which tables of properties cannot say.
#ifndef IO_GLTF_RULES_HPP
#define IO_GLTF_RULES_HPP

#include "io/json.hpp"

namespace gltf
{

// Throws a file_error with the JSON pointer of the first value that breaks a rule. root has passed check_schema.
void check_rules(const json &root);

} // namespace gltf

#endif
