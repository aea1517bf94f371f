# One target per folder of the house. Every include names the folder,
# #include "plume/mesh/mesh.h", in this tree as in an installed one: here,
# build/include/plume is a link to the source directory.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/include)
file(CREATE_LINK ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR}/include/plume SYMBOLIC)

# Flags that every target of ours shares.
function(plume_flags target)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${CMAKE_BINARY_DIR}/include>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wpedantic)
  # A product that is fused in one place and not in another would let two
  # places decide differently about the same edge (docs/architecture.md).
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  if(PLUME_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# plume_folder(mesh SOURCES a.cpp b.cpp LINK other libraries COMPONENT core HEADERS a.h)
#
# A folder with a COMPONENT is installed as part of it (install.cmake), with these of its headers:
# what a host program includes, and what that includes.
function(plume_folder name)
  cmake_parse_arguments(ARG "" "COMPONENT" "SOURCES;LINK;LINK_PRIVATE;HEADERS" ${ARGN})
  add_library(plume_${name} STATIC ${ARG_SOURCES})
  add_library(plume::${name} ALIAS plume_${name})
  set_target_properties(plume_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  plume_flags(plume_${name})
  target_link_libraries(plume_${name} PUBLIC ${ARG_LINK} PRIVATE ${ARG_LINK_PRIVATE})
  if(ARG_COMPONENT)
    plume_install(${name} ${ARG_COMPONENT} "${ARG_HEADERS}")
  endif()
endfunction()

# Sources that are compiled for each instruction set. With sanitizers one takes a quarter of an hour,
# so they go without; what they call is compiled with them. GCC stops to inline where a frame gets
# large, which with vectors is at once: a call that is left in a step costs up to a quarter of it.
# What AVX3_DL adds to AVX3 is of no use to floats, and processors with SSSE3 and no SSE4 are of 2006:
# each set is all of it compiled once more. Who names the sets that are left out (CMakePresets.json
# does for the sanitizers) has named them all.
function(plume_compile_vectors)
  if(NOT CMAKE_CXX_FLAGS MATCHES "HWY_DISABLED_TARGETS")
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_DEFINITIONS
                                                   HWY_DISABLED_TARGETS=HWY_AVX3_DL+HWY_SSSE3)
  endif()
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -fno-sanitize=all)
  elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set_source_files_properties(
      ${ARGN} PROPERTIES COMPILE_OPTIONS
                         "--param=large-stack-frame=1000000;--param=large-stack-frame-growth=100000")
  endif()
endfunction()
