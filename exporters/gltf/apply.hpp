// Presets and single values put on the materials of a file.
#ifndef EXPORTERS_GLTF_APPLY_HPP
#define EXPORTERS_GLTF_APPLY_HPP

#include "exporters/gltf/container.hpp"
#include "glint_export.h"
#include "io/json.hpp"
#include "scene/report.h"

// Changes the parts of the file; returns what was done for the summary. Throws a file_error.
ordered_json export_apply(const glint_export_gltf_options &options, export_container &file, report *r);

#endif
