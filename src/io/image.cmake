# Pictures, textures and the files that commands write. Only image_oiio.cpp sees OpenImageIO.
# pkg-config and not find_package: Debian's CMake files name the folders of packages that it does not need.
find_package(PkgConfig REQUIRED)
pkg_check_modules(OIIO REQUIRED IMPORTED_TARGET GLOBAL OpenImageIO>=2.4)

glint_folder(io_image
  SOURCES environment_map.c example_map.c image.c image_bytes.c image_srgb.c mipmap.c output_file.c srgb.c texture_transform.c
    image_oiio.cpp
  SEES glint.h scene io)
target_link_libraries(io_image_objects PUBLIC PkgConfig::OIIO)
