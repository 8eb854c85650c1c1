# What only this tree needs: warnings, the libraries of the program, and ways to compile less.
find_package(CLI11 REQUIRED)
find_package(yaml-cpp REQUIRED)

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
# clang-tidy and check_includes go without that. The options are ccache's wish.
function(glissade_precompile target)
  if(CMAKE_DISABLE_PRECOMPILE_HEADERS)
    return()
  endif()
  target_precompile_headers(${target} ${ARGN})
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
    "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # The bug above (105651) comes up under other names where the standard library's headers are precompiled.
    target_compile_options(${target} PRIVATE -Wno-stringop-overflow -Wno-array-bounds)
  endif()
endfunction()

# glissade_compile_in_bulk(TARGET [EXCEPT sources...]): the target's other sources as a few large files. A whole build then
# takes a third of the time. GLISSADE_COMPILE_IN_BULK=OFF compiles each source by itself.
function(glissade_compile_in_bulk target)
  cmake_parse_arguments(ARG "" "" "EXCEPT" ${ARGN})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${GLISSADE_COMPILE_IN_BULK} UNITY_BUILD_BATCH_SIZE 32)
  if(ARG_EXCEPT)
    set_source_files_properties(${ARG_EXCEPT} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
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
target_compile_options(glissade_precompiled PRIVATE -ffp-contract=off $<$<CONFIG:Release>:-O2>)
set_target_properties(glissade_precompiled PROPERTIES POSITION_INDEPENDENT_CODE ON)
glissade_set_warnings(glissade_precompiled)
glissade_precompile(glissade_precompiled PRIVATE
  <algorithm> <array> <chrono> <cmath> <cstdint> <functional> <memory> <optional> <span> <stdexcept> <string> <utility>
  <vector> <Eigen/Geometry>)
