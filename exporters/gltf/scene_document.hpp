// A new glTF document from a scene in memory: all that a renderer sees, and nothing else.
#ifndef EXPORTERS_GLTF_SCENE_DOCUMENT_HPP
#define EXPORTERS_GLTF_SCENE_DOCUMENT_HPP

#include "exporters/gltf/container.hpp"
#include "io/json.hpp"
#include "scene/report.h"
#include "scene/scene.h"

// One node for each of the file's that shows something, under the number that it has there, since facets hang on it;
// its transform in the world. environment: the element of EXT_lights_image_based that the scene shows, whose irradiance
// a scene does not keep; null where there is none. glb: in a BIN chunk, else in a data URI.
export_container export_scene_document(const scene &s, const json &environment, bool glb, report *r);

#endif
