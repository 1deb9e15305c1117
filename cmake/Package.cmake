# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# What `cmake --install` puts where, so that others can write find_package(stucco).
include(CMakePackageConfigHelpers)

get_property(modules GLOBAL PROPERTY STUCCO_MODULES)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/stucco)
# Headers say #include "survey/camera.h", so they live below a folder of their own.
install(TARGETS ${modules} EXPORT stuccoTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stucco)
install(EXPORT stuccoTargets NAMESPACE stucco:: DESTINATION ${package_dir})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/stuccoConfig.cmake.in
  ${PROJECT_BINARY_DIR}/stuccoConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/stuccoConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/stuccoConfig.cmake
  ${PROJECT_BINARY_DIR}/stuccoConfigVersion.cmake DESTINATION ${package_dir})

install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/LICENSE
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
