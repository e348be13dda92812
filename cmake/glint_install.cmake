# What `cmake --install` puts where: the library with its header, find_package and pkg-config files; the command; presets.
include(CMakePackageConfigHelpers)

set(installed_targets glint)
install(TARGETS glint EXPORT libglint_targets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES src/glint.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(TARGET glint_image) # loaded by the command and by the two libraries below
  list(APPEND installed_targets glint_image)
  install(TARGETS glint_image LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()
if(TARGET glint_export)
  set_target_properties(glint_export PROPERTIES INSTALL_RPATH "$ORIGIN")
  list(APPEND installed_targets glint_export)
  install(TARGETS glint_export LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(FILES exporters/glint_export.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()
if(TARGET glint_preview)
  set_target_properties(glint_preview PROPERTIES INSTALL_RPATH "$ORIGIN")
  list(APPEND installed_targets glint_preview)
  install(TARGETS glint_preview LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(FILES src/preview/glint_preview.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()

# find_package(libglint) gives the target libglint::glint.
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/libglint)
install(EXPORT libglint_targets NAMESPACE libglint:: FILE libglint-targets.cmake DESTINATION ${package_dir})
configure_package_config_file(cmake/libglintConfig.cmake.in ${PROJECT_BINARY_DIR}/libglintConfig.cmake
  INSTALL_DESTINATION ${package_dir})
# While the major version is 0 every minor version may break its users.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/libglintConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/libglintConfig.cmake ${PROJECT_BINARY_DIR}/libglintConfigVersion.cmake
  DESTINATION ${package_dir})

# The prefix in libglint.pc is relative to the file itself, so that an installed tree can be moved.
file(RELATIVE_PATH GLINT_PC_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/libglint.pc.in ${PROJECT_BINARY_DIR}/libglint.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/libglint.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(DIRECTORY materials DESTINATION ${CMAKE_INSTALL_DATADIR}/libglint FILES_MATCHING PATTERN *.gltf-material.json)
install(FILES exporters/povray/glint.inc DESTINATION ${CMAKE_INSTALL_DATADIR}/libglint/povray)
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs FILES_MATCHING PATTERN *.md PATTERN *.png)

if(TARGET glint_command)
  file(RELATIVE_PATH library_from_bin /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
  set_target_properties(glint_command PROPERTIES INSTALL_RPATH "$ORIGIN/${library_from_bin}")
  list(APPEND installed_targets glint_command)
  install(TARGETS glint_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

# All that `cmake --install` asks for and nothing else: no tests.
add_custom_target(installed DEPENDS ${installed_targets})
