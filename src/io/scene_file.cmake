# Scene files and presets. tinygltf, nlohmann-json and Draco stay behind this folder's C header.
find_package(nlohmann_json 3.11 REQUIRED)
pkg_check_modules(TINYGLTF REQUIRED IMPORTED_TARGET GLOBAL tinygltf>=2.7)
pkg_check_modules(DRACO REQUIRED IMPORTED_TARGET GLOBAL draco>=1.5)

glint_folder(io_scene
  SOURCES
    geometry.cpp
    gltf_accessor.cpp
    gltf_animation.cpp
    gltf_container.cpp
    gltf_document.cpp
    gltf_draco.cpp
    gltf_glint.cpp
    gltf_graph.cpp
    gltf_keyframes.cpp
    gltf_light.cpp
    gltf_material.cpp
    gltf_mesh.cpp
    gltf_node.cpp
    gltf_primitive.cpp
    gltf_resource.cpp
    gltf_rules.cpp
    gltf_scene.cpp
    gltf_schema.cpp
    gltf_schema_core.cpp
    gltf_schema_extensions.cpp
    gltf_texture.cpp
    gltf_tiny.cpp
    gltf_transform.cpp
    gltf_validate.cpp
    gltf_validate_mesh.cpp
    json.cpp
    near_names.cpp
    preset.cpp
    scene_bounds.c
    scene_build.cpp
    scene_describe.cpp
    scene_file.cpp
    scene_motion.cpp
    tangent_space.c
    validate.cpp
  SEES glint.h scene io)
target_link_libraries(io_scene_objects PUBLIC nlohmann_json::nlohmann_json PkgConfig::TINYGLTF PkgConfig::DRACO)

# Where the installed program finds its presets, the one in the build folder finds them too.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/share/libglint)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/materials ${PROJECT_BINARY_DIR}/share/libglint/materials SYMBOLIC)
