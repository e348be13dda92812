// Takes exports back.
#ifndef EXPORTERS_GLTF_STRIP_HPP
#define EXPORTERS_GLTF_STRIP_HPP

#include "exporters/gltf/container.hpp"
#include "scene/report.h"

// With the record of an export: the file that was there, byte for byte. Without one: the extension leaves all materials
// and extensionsUsed. Warns where the record no longer fits the file. Returns false where there was nothing to take.
bool export_strip(export_container &file, const std::string &path, report *r);

#endif
