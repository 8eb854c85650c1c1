# glissade_add_component(NAME
#   HEADERS  public headers, installed as <glissade/NAME/...>
#   SOURCES  sources and private headers
#   DEPENDS  targets that users of the component see
#   PRIVATE_DEPENDS  targets that only its sources see)
#
# Defines the library glissade_NAME with the alias glissade::NAME. Its include root is a directory link in the build tree,
#   build/include/NAME/glissade/NAME -> the component's folder,
# so that an include reads the same in the tree and installed, and an include of a component that is not among DEPENDS
# fails to compile.
function(glissade_add_component name)
  cmake_parse_arguments(ARG "" "" "HEADERS;SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  set(target glissade_${name})
  set(include_root ${PROJECT_BINARY_DIR}/include/${name})
  file(MAKE_DIRECTORY ${include_root}/glissade)
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${include_root}/glissade/${name} SYMBOLIC)

  add_library(${target} ${ARG_SOURCES})
  add_library(glissade::${name} ALIAS ${target})
  list(TRANSFORM ARG_HEADERS PREPEND ${include_root}/glissade/${name}/)
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${include_root} FILES ${ARG_HEADERS})
  target_link_libraries(${target} PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE_DEPENDS})
  target_compile_features(${target} PUBLIC cxx_std_20)
  # The same inputs must give the same bits on every processor: no silent fused multiply-add.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name}
    POSITION_INDEPENDENT_CODE ON
    VERIFY_INTERFACE_HEADER_SETS ${PROJECT_IS_TOP_LEVEL})
  if(COMMAND glissade_set_warnings)
    glissade_set_warnings(${target})
  endif()
  if(COMMAND glissade_compile_in_bulk AND GLISSADE_COMPILE_IN_BULK)
    # Highway's kernels include themselves once for each instruction set.
    set(kernels ${ARG_SOURCES})
    foreach(source IN LISTS ARG_SOURCES)
      file(STRINGS ${source} is_kernel REGEX "foreach_target\\.h")
      if(NOT is_kernel)
        list(REMOVE_ITEM kernels ${source})
      endif()
    endforeach()
    glissade_compile_in_bulk(${target} EXCEPT ${kernels})
  endif()

  install(TARGETS ${target} EXPORT glissadeTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()
