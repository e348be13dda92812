// The parts of glint validate: rules for the extension's JSON, and rules for the scene that carries it.
#ifndef IO_GLTF_VALIDATE_HPP
#define IO_GLTF_VALIDATE_HPP

#include <string>

#include "io/json.hpp"
#include "io/validate.h"
#include "scene/scene.h"

// Collects issues and hands them on.
class issue_list
{
  public:
    issue_list(validate_visitor visit, void *user) : visit_(visit), user_(user)
    {
    }
    void add(validate_severity severity, const char *code, const std::string &pointer, const std::string &found,
             const std::string &expected)
    {
        errors_ += severity == VALIDATE_ERROR;
        const validate_issue issue = { code, severity, pointer.c_str(), found.c_str(), expected.c_str() };
        visit_(&issue, user_);
    }
    bool any_error() const
    {
        return errors_ > 0;
    }

  private:
    validate_visitor visit_;
    void *user_;
    size_t errors_ = 0;
};

// What the JSON alone shows. root has passed gltf::check_schema.
void validate_extension(const json &root, issue_list &issues);

// What needs meshes: texture coordinates, tangents, areas. s was read from root.
void validate_on_meshes(const json &root, const scene &s, issue_list &issues);

#endif
