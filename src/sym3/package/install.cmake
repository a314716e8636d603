# Installs the library, its public headers, and package files for CMake and pkg-config. Programs that use the library
# need neither Eigen nor Highway.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/viete)
set(pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(TARGETS viete_sym3 EXPORT viete-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library
  PUBLIC_HEADER DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/viete/sym3 COMPONENT library
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/src/sym3/README.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT library)

install(EXPORT viete-targets NAMESPACE viete:: DESTINATION ${package_dir} COMPONENT library)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/viete-config.cmake.in viete-config.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a new minor version may change the interface.
write_basic_package_version_file(viete-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/viete-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/viete-config-version.cmake
  DESTINATION ${package_dir} COMPONENT library)

# The relative path from the .pc file to the prefix makes it possible to move the installed files.
file(RELATIVE_PATH up_to_prefix /prefix/${pkgconfig_dir} /prefix)
configure_file(${CMAKE_CURRENT_LIST_DIR}/viete.pc.in viete.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/viete.pc DESTINATION ${pkgconfig_dir} COMPONENT library)
