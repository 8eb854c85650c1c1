# The installed package: find_package(glissade COMPONENTS ...) defines glissade::COMPONENT for each component. It
# searches only for the packages that these components need. Which those are is read off the targets here.

# glissade_get_needs(COMPONENT DEPENDS PACKAGES): sets DEPENDS to the components that a component links, PACKAGES to the
# packages, each as arguments of find_package joined by spaces. Private ones count: users of a static library link them.
function(glissade_get_needs component depends packages)
  get_target_property(private_links glissade_${component} LINK_LIBRARIES)
  get_target_property(public_links glissade_${component} INTERFACE_LINK_LIBRARIES)
  string(REGEX MATCHALL "[A-Za-z0-9_]+::[A-Za-z0-9_]+|yaml-cpp" targets "${private_links};${public_links}")
  list(REMOVE_DUPLICATES targets)
  set(found_depends)
  set(found_packages)
  foreach(target IN LISTS targets)
    string(REGEX MATCH "^[^:]+" package ${target})
    if(package STREQUAL "glissade")
      string(REPLACE "glissade::" "" depend ${target})
      list(APPEND found_depends ${depend})
      continue()
    endif()
    get_property(arguments GLOBAL PROPERTY glissade_package_${package})
    if(NOT arguments)
      message(FATAL_ERROR "Component ${component} links ${target}, but glissade_find_package(${package}) is missing.")
    endif()
    list(JOIN arguments " " arguments)
    list(APPEND found_packages ${arguments})
  endforeach()
  list(REMOVE_DUPLICATES found_packages)
  set(${depends} "${found_depends}" PARENT_SCOPE)
  set(${packages} "${found_packages}" PARENT_SCOPE)
endfunction()

get_property(components GLOBAL PROPERTY glissade_components)
# Those that a user may ask for; the others come with them.
set(offered_components ${components})
get_property(without_headers GLOBAL PROPERTY glissade_components_without_headers)
list(REMOVE_ITEM offered_components ${without_headers})
set(component_needs)
foreach(component IN LISTS components)
  glissade_get_needs(${component} depends packages)
  string(APPEND component_needs
    "  set(${component}_depends \"${depends}\")\n  set(${component}_packages \"${packages}\")\n")
endforeach()
configure_file(${CMAKE_CURRENT_LIST_DIR}/glissadeConfig.cmake.in ${PROJECT_BINARY_DIR}/glissadeConfig.cmake @ONLY)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/glissadeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/glissadeConfig.cmake ${PROJECT_BINARY_DIR}/glissadeConfigVersion.cmake
  ${CMAKE_CURRENT_LIST_DIR}/FindLCM.cmake ${CMAKE_CURRENT_LIST_DIR}/Findsodium.cmake DESTINATION ${glissade_package_dir})
