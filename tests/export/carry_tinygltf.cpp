// tinygltf's own reader and writer.
#include "carry_tinygltf.h"

#include <tiny_gltf.h>

bool carry_tinygltf(const char *from, const char *to, double *density, int *tangents)
{
    tinygltf::TinyGLTF carrier;
    tinygltf::Model model;
    std::string error, warning;
    if (!carrier.LoadBinaryFromFile(&model, &error, &warning, from))
        return false;
    const auto &extensions = model.materials[0].extensions;
    const auto glint = extensions.find("GLINT_materials_glint");
    *density = glint == extensions.end() ? 0.0 : glint->second.Get("glintDensity").GetNumberAsDouble();
    *tangents = 0;
    for (const tinygltf::Primitive &primitive : model.meshes[0].primitives)
        *tangents += static_cast<int>(primitive.attributes.count("TANGENT"));
    return carrier.WriteGltfSceneToFile(&model, to, true, true, false, true);
}
