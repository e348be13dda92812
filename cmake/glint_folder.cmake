# Compiler flags for our own code, and the rule that a folder sees only the folders that the design allows.

add_library(glint_flags INTERFACE)
target_compile_options(glint_flags INTERFACE
  # The same bits from every compiler and instruction set: no fused multiply-add unless the source asks for it.
  -ffp-contract=off -fno-math-errno
  # GCC 12 makes one division of four floats out of two of one, and whatever lies beside them may be a signalling NaN.
  -fno-tree-slp-vectorize
  -Wall -Wextra -Wshadow -Wpointer-arith -Wundef -Wvla -Wdouble-promotion
  # Public structs grow at their end; what an initialiser leaves out is zero, and means what it meant before.
  -Wno-missing-field-initializers
  $<$<COMPILE_LANGUAGE:C>:-Wstrict-prototypes> $<$<COMPILE_LANGUAGE:C>:-Wmissing-prototypes>
  $<$<BOOL:${GLINT_WERROR}>:-Werror>
  $<$<BOOL:${GLINT_COVERAGE}>:--coverage>)
target_link_options(glint_flags INTERFACE $<$<BOOL:${GLINT_COVERAGE}>:--coverage>)
if(GLINT_SANITIZE)
  target_compile_options(glint_flags INTERFACE -fsanitize=${GLINT_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  # RPATH for RUNPATH: dlopen is the sanitizer's own, and where that may look only the program can say.
  target_link_options(glint_flags INTERFACE -fsanitize=${GLINT_SANITIZE} -Wl,--disable-new-dtags)
endif()

# glint_view(<folder>): a directory that holds nothing but a link to src/<folder>, or to exporters. On the include path it
# lets `#include "<folder>/x.h"` through and no other folder.
function(glint_view folder)
  set(view ${PROJECT_BINARY_DIR}/views/${folder})
  file(MAKE_DIRECTORY ${view})
  if(folder STREQUAL "glint.h")
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/src/glint.h ${view}/glint.h SYMBOLIC)
  elseif(folder STREQUAL "glint_export.h")
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/exporters/glint_export.h ${view}/glint_export.h SYMBOLIC)
  elseif(folder STREQUAL "exporters")
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/exporters ${view}/exporters SYMBOLIC)
  else()
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/src/${folder} ${view}/${folder} SYMBOLIC)
  endif()
endfunction()

# glint_folder(<name> SOURCES <file>... [SEES <folder>...]): the object library of one folder.
function(glint_folder name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;SEES")
  add_library(${name}_objects OBJECT ${arg_SOURCES})
  target_link_libraries(${name}_objects PRIVATE glint_flags)
  glint_see(${name}_objects ${name} ${arg_SEES})
endfunction()

# glint_see(<target> <folder>...): puts folders on the include path of a target.
function(glint_see target)
  foreach(folder IN LISTS ARGN)
    glint_view(${folder})
    target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR}/views/${folder})
  endforeach()
endfunction()
