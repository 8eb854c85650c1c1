# What only this tree needs: warnings, the libraries of the program, and ways to compile less.
find_package(CLI11 REQUIRED)

function(glissade_set_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
    -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast -Wcast-align -Wdouble-promotion -Wimplicit-fallthrough
    -Wno-missing-field-initializers)  # designated initialisers name only the members that they set
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # g++ 12 sees overlapping copies in any inlined `"literal" + std::string` (GCC bug 105651).
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  if(GLISSADE_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# glissade_precompile(TARGET PRIVATE headers... | REUSE_FROM target): these headers are compiled once for the whole target.
# clang-tidy and check_includes go without that. So does g++: it compiles functions of a precompiled header by the options
# of that header, so code that reads LCM messages would lose -fno-strict-aliasing. The option is ccache's wish.
function(glissade_precompile target)
  if(CMAKE_DISABLE_PRECOMPILE_HEADERS OR CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    return()
  endif()
  target_precompile_headers(${target} ${ARGN})
  target_compile_options(${target} PRIVATE "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endfunction()

# glissade_compile_in_bulk(TARGET [APART sources...] [EXCEPT sources...]): the target's sources as a few large files, of at
# most 64 sources each. A whole build then takes a quarter of the time. Those APART are not in a file with others, so that a
# change of what they do not include leaves them compiled. Those in EXCEPT are compiled alone.
# GLISSADE_COMPILE_IN_BULK=OFF compiles each source alone.
function(glissade_compile_in_bulk target)
  cmake_parse_arguments(ARG "" "" "APART;EXCEPT" ${ARGN})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${GLISSADE_COMPILE_IN_BULK} UNITY_BUILD_MODE GROUP)
  get_target_property(together ${target} SOURCES)
  if(ARG_APART OR ARG_EXCEPT)
    list(REMOVE_ITEM together ${ARG_APART} ${ARG_EXCEPT})
  endif()
  foreach(group together ARG_APART)
    list(LENGTH ${group} count)
    math(EXPR files "(${count} + 63) / 64")
    set(index 0)
    foreach(source IN LISTS ${group})
      math(EXPR file "${index} * ${files} / ${count}")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${file})
      math(EXPR index "${index} + 1")
    endforeach()
  endforeach()
  if(GLISSADE_COMPILE_IN_BULK)
    # No warnings about what stands in other files of the target.
    target_compile_options(${target} PRIVATE -Wno-shadow
      $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local> $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# What all components with Eigen precompile, once.
add_library(glissade_precompiled OBJECT ${CMAKE_CURRENT_LIST_DIR}/precompiled.cpp)
target_link_libraries(glissade_precompiled PRIVATE Eigen3::Eigen)
target_compile_features(glissade_precompiled PRIVATE cxx_std_20)
target_compile_options(glissade_precompiled PRIVATE -ffp-contract=off)
set_target_properties(glissade_precompiled PROPERTIES
  POSITION_INDEPENDENT_CODE ON
  CXX_VISIBILITY_PRESET hidden
  VISIBILITY_INLINES_HIDDEN ON)
glissade_set_warnings(glissade_precompiled)
glissade_precompile(glissade_precompiled PRIVATE
  <algorithm> <array> <chrono> <cmath> <cstdint> <functional> <memory> <optional> <span> <stdexcept> <string> <utility>
  <vector> <Eigen/Geometry>)
