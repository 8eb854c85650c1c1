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
  if(GLISSADE_COMPILE_IN_BULK)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 20)
    # Warnings about what stands in other files of the component; the release build warns of the rest.
    target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
    # Highway's kernels include themselves once for each instruction set.
    foreach(source IN LISTS ARG_SOURCES)
      file(STRINGS ${source} is_kernel REGEX "foreach_target\\.h")
      if(is_kernel)
        set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      endif()
    endforeach()
  endif()

  install(TARGETS ${target} EXPORT glissadeTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()
