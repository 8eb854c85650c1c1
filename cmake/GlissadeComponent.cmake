set(glissade_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/glissade)

# Before 1.0.0, a minor version may break the interface. Afterwards, only a major version may. The loader learns it from the
# SONAME, find_package from the compatibility.
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(glissade_interface_version ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  set(glissade_compatibility SameMinorVersion)
else()
  set(glissade_interface_version ${PROJECT_VERSION_MAJOR})
  set(glissade_compatibility SameMajorVersion)
endif()

# glissade_find_package(PACKAGE [VERSION] [options...]): finds a package that components may need, for targets named
# PACKAGE::... among their DEPENDS. The installed glissade finds it with the same arguments, where a requested component
# needs it.
macro(glissade_find_package package)
  find_package(${ARGV} REQUIRED)
  set_property(GLOBAL PROPERTY glissade_package_${package} "${ARGV}")
endmacro()

# With BUILD_SHARED_LIBS, one library of all installed components is installed in place of theirs. Theirs stay static, for
# the program and the tests, which look into the rooms. The library hides what GLISSADE_EXPORT does not mark.
if(BUILD_SHARED_LIBS)
  add_library(glissade_library SHARED)
  set_target_properties(glissade_library PROPERTIES
    OUTPUT_NAME glissade
    EXPORT_NAME library
    LINKER_LANGUAGE CXX
    VERSION ${PROJECT_VERSION}
    SOVERSION ${glissade_interface_version})
  target_link_options(glissade_library PRIVATE LINKER:--no-undefined,--as-needed)
  install(TARGETS glissade_library EXPORT glissade_library
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
  install(EXPORT glissade_library FILE glissade_libraryTargets.cmake NAMESPACE glissade::
    DESTINATION ${glissade_package_dir} COMPONENT development)
endif()

# glissade_install_component(NAME TARGET [arguments of install(TARGETS)...]): installs the target, with an export set of
# its own, as a component of find_package(glissade).
function(glissade_install_component name target)
  set_property(GLOBAL APPEND PROPERTY glissade_components ${name})
  set_property(GLOBAL PROPERTY glissade_target_of_${name} ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS ${target} EXPORT ${target} ${ARGN})
  install(EXPORT ${target} FILE glissade_${name}Targets.cmake NAMESPACE glissade::
    DESTINATION ${glissade_package_dir} COMPONENT development)
endfunction()

# glissade_add_to_library(NAME HEADERS headers... DEPENDS targets... PRIVATE_DEPENDS targets...): adds a component to the
# one shared library, and installs its headers with a target that links this library.
function(glissade_add_to_library name)
  cmake_parse_arguments(ARG "" "" "HEADERS;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  set(packages ${ARG_DEPENDS} ${ARG_PRIVATE_DEPENDS})
  list(FILTER packages EXCLUDE REGEX "^glissade")
  target_sources(glissade_library PRIVATE $<TARGET_OBJECTS:glissade_${name}>)
  target_link_libraries(glissade_library PRIVATE ${packages})
  if(NOT ARG_HEADERS)
    return()
  endif()
  set(target glissade_${name}_shared)
  list(TRANSFORM ARG_DEPENDS REPLACE "^glissade::(.+)$" "glissade_\\1_shared")
  add_library(${target} INTERFACE)
  target_sources(${target} INTERFACE FILE_SET HEADERS BASE_DIRS ${PROJECT_BINARY_DIR}/include/${name}
    FILES ${ARG_HEADERS})
  target_link_libraries(${target} INTERFACE glissade_library ${ARG_DEPENDS})
  target_compile_features(${target} INTERFACE cxx_std_20)
  glissade_install_component(${name} ${target}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
endfunction()

# glissade_add_component(NAME
#   HEADERS  its public face: the headers directly in its folder, installed as <glissade/NAME/...>
#   SOURCES  its sources; those in its subfolders are private rooms
#   DEPENDS  targets that users of the component see
#   PRIVATE_DEPENDS  targets that only its sources see
#   NOT_INSTALLED  for the program, tests and benchmarks of this tree only
#   WITHOUT_HEADERS  installed for other components to link, but without its headers)
#
# Defines the library glissade_NAME with the alias glissade::NAME. Its include root is a directory link in the build tree,
#   build/include/NAME/glissade/NAME -> the component's folder,
# so that an include reads the same in the tree and installed, and an include of a component that is not among DEPENDS
# fails to compile.
function(glissade_add_component name)
  cmake_parse_arguments(ARG "NOT_INSTALLED;WITHOUT_HEADERS" "" "HEADERS;SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  set(target glissade_${name})
  set(include_root ${PROJECT_BINARY_DIR}/include/${name})
  file(MAKE_DIRECTORY ${include_root}/glissade)
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${include_root}/glissade/${name} SYMBOLIC)

  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(glissade::${name} ALIAS ${target})
  list(TRANSFORM ARG_HEADERS PREPEND ${include_root}/glissade/${name}/)
  if(ARG_WITHOUT_HEADERS)
    # The set of a target that is exported would have to be installed.
    target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${include_root}>)
    set_property(GLOBAL APPEND PROPERTY glissade_components_without_headers ${name})
    add_library(${target}_headers INTERFACE)
    target_sources(${target}_headers INTERFACE FILE_SET HEADERS BASE_DIRS ${include_root} FILES ${ARG_HEADERS})
    target_link_libraries(${target}_headers INTERFACE ${target})
    set_target_properties(${target}_headers PROPERTIES VERIFY_INTERFACE_HEADER_SETS ${PROJECT_IS_TOP_LEVEL})
  else()
    target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${include_root} FILES ${ARG_HEADERS})
    set(header_set FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
  endif()
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include/export>)
  # Headers of rooms are included with quotes, by their path in the component: "ROOM/header.h".
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  list(TRANSFORM ARG_PRIVATE_DEPENDS REPLACE "^glissade_base$" "$<BUILD_INTERFACE:glissade_base>")
  target_link_libraries(${target} PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE_DEPENDS})
  target_compile_features(${target} PUBLIC cxx_std_20)
  # The same inputs must give the same bits on every processor: no silent fused multiply-add.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  set_target_properties(${target} PROPERTIES
    POSITION_INDEPENDENT_CODE ON
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    VERIFY_INTERFACE_HEADER_SETS ${PROJECT_IS_TOP_LEVEL})
  # Kernels, the sources that Highway compiles once for each instruction set, are compiled alone.
  set(kernels ${ARG_SOURCES})
  foreach(source IN LISTS ARG_SOURCES)
    file(STRINGS ${source} is_kernel REGEX "foreach_target\\.h")
    if(NOT is_kernel)
      list(REMOVE_ITEM kernels ${source})
    endif()
  endforeach()
  if(PROJECT_IS_TOP_LEVEL)
    glissade_set_warnings(${target})
    if("${ARG_DEPENDS}" MATCHES "Eigen3::Eigen|glissade::geometry")
      glissade_precompile(${target} REUSE_FROM glissade_precompiled)
    endif()
    glissade_compile_in_bulk(${target} EXCEPT ${kernels})
  endif()

  if(ARG_NOT_INSTALLED)
    return()
  endif()
  if(BUILD_SHARED_LIBS)
    if(ARG_WITHOUT_HEADERS)
      set(ARG_HEADERS)
    endif()
    glissade_add_to_library(${name}
      HEADERS ${ARG_HEADERS} DEPENDS ${ARG_DEPENDS} PRIVATE_DEPENDS ${ARG_PRIVATE_DEPENDS})
  else()
    glissade_install_component(${name} ${target}
      ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
      ${header_set})
  endif()
endfunction()

# glissade_compile_for_instruction_sets(TARGET): the vector code. SSSE3 adds nothing to SSE4 here, nor the newest AVX-512
# to the first; vectors of unknown length do not fit code for sixteen pairs. EMU128 is plain C++ in vectors of 16 bytes.
# Highway leaves it out before g++ 12.3 for a fault of the compiler; what we use of it is compared with the other
# instruction sets by the tests of the kernels. GLISSADE_WITHOUT_INSTRUCTION_SETS leaves out more.
function(glissade_compile_for_instruction_sets target)
  set(left_out HWY_SSSE3 HWY_AVX3_DL HWY_SVE HWY_SVE2 HWY_SVE_256 HWY_SVE2_128 HWY_RVV
    ${GLISSADE_WITHOUT_INSTRUCTION_SETS})
  list(JOIN left_out "|" left_out)
  target_compile_definitions(${target} PRIVATE HWY_BROKEN_EMU128=0 "HWY_DISABLED_TARGETS=(${left_out})")
endfunction()
