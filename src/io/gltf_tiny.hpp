// The only includer of tinygltf: turns checked JSON into its structs.
#ifndef IO_GLTF_TINY_HPP
#define IO_GLTF_TINY_HPP

#include <string>

#include <tiny_gltf.h>

#include "io/json.hpp"

// The model of a document that has passed gltf::check_schema, without buffers, images and animations. tinygltf sees
// neither a file nor bytes, and of extras and extensions only what the reader honours.
tinygltf::Model gltf_tiny_model(json root);

// Whether the reader honours this extension.
bool gltf_knows_extension(const std::string &name);

// The accessor of a primitive's indices, or -1.
int gltf_primitive_indices(const tinygltf::Primitive &primitive);

// ---- values of extensions and extras; types have passed the schema ----

// NULL where there is none.
const tinygltf::Value *gltf_extension(const tinygltf::ExtensionMap &extensions, const char *name);
const tinygltf::Value *gltf_member(const tinygltf::Value &object, const char *name);

double gltf_number(const tinygltf::Value &object, const char *name, double otherwise);
int gltf_integer(const tinygltf::Value &object, const char *name, int otherwise);
std::string gltf_text(const tinygltf::Value &object, const char *name, const char *otherwise);
// Leaves out as it is where there is no such array.
void gltf_numbers(const tinygltf::Value &object, const char *name, float *out, size_t count);

#endif
