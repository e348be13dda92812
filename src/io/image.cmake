# Pictures, textures and the files that commands write. pkg-config and not find_package: Debian's CMake files name the folders of
# packages that are not needed.
find_package(PkgConfig REQUIRED)
pkg_check_modules(OIIO REQUIRED IMPORTED_TARGET GLOBAL OpenImageIO>=2.4)
pkg_check_modules(OPENEXR REQUIRED IMPORTED_TARGET GLOBAL OpenEXR>=3.1)
pkg_check_modules(PNG REQUIRED IMPORTED_TARGET GLOBAL libpng>=1.6)

# What programs and the module below both need.
glint_folder(io_pixels SOURCES image.c image_bytes.c image_srgb.c mipmap.c srgb.c texture_transform.c SEES glint.h scene io)

# Only image_oiio.cpp sees OpenImageIO. It is a module that image_engine.c loads at need: see image_engine.h.
add_library(glint_image MODULE image_oiio.cpp)
target_link_libraries(glint_image PRIVATE glint_flags io_pixels_objects scene_objects PkgConfig::OIIO m)
glint_see(glint_image glint.h scene io)
target_link_options(glint_image PRIVATE -Wl,--version-script=${CMAKE_CURRENT_SOURCE_DIR}/glint_image.map)
set_target_properties(glint_image PROPERTIES LINK_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/glint_image.map)

# image_png.c alone sees libpng, image_exr.cpp OpenEXR.
glint_folder(io_image
  SOURCES environment_map.c example_map.c image_engine.c image_exr.cpp image_merge.c image_metadata.c image_png.c output_file.c
  SEES glint.h scene io)
target_sources(io_image_objects INTERFACE $<TARGET_OBJECTS:io_pixels_objects>)
# OpenEXR's list has libraries that nobody here calls.
target_link_options(io_image_objects INTERFACE -Wl,--as-needed)
target_link_libraries(io_image_objects PUBLIC PkgConfig::OPENEXR PkgConfig::PNG INTERFACE ${CMAKE_DL_LIBS})
# Nobody links the module; who may load it is built after it.
set_target_properties(io_image_objects PROPERTIES INTERFACE_LINK_DEPENDS $<TARGET_FILE:glint_image>)
if(GLINT_SANITIZE)
  # Loaded from the start: LeakSanitizer dies of thread-local storage of libraries that come later ("Tracer caught signal 11").
  target_link_libraries(io_image_objects INTERFACE -Wl,--push-state,--no-as-needed ${OIIO_LINK_LIBRARIES} -Wl,--pop-state)
endif()
