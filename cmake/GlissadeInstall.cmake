# The installed package: find_package(glissade) gives glissade::collision, ::realtime, ::devices, ::haptics, ::lcmtypes.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/glissade)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/glissadeConfig.cmake.in
  ${PROJECT_BINARY_DIR}/glissadeConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/glissadeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/glissadeConfig.cmake ${PROJECT_BINARY_DIR}/glissadeConfigVersion.cmake
  ${CMAKE_CURRENT_LIST_DIR}/FindLCM.cmake DESTINATION ${package_dir})
install(EXPORT glissadeTargets NAMESPACE glissade:: DESTINATION ${package_dir})
