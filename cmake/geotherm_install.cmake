# SPDX-License-Identifier: MIT
# What `cmake --install` puts where: library, headers, package files, program, models, licence.
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/geotherm")

set_target_properties(geotherm_solver PROPERTIES
  EXPORT_NAME solver OUTPUT_NAME geotherm_solver VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
install(TARGETS geotherm_solver EXPORT geothermTargets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}"
  FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
if(TARGET geotherm_c)
  install(TARGETS geotherm_c EXPORT geothermTargets
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
    FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
endif()
install(EXPORT geothermTargets NAMESPACE geotherm:: DESTINATION "${package_dir}")

configure_package_config_file(cmake/geothermConfig.cmake.in
  "${PROJECT_BINARY_DIR}/geothermConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/geothermConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/geothermConfig.cmake"
              "${PROJECT_BINARY_DIR}/geothermConfigVersion.cmake" DESTINATION "${package_dir}")
if(GEOTHERM_WITH_CHOLMOD)
  install(FILES cmake/FindCHOLMOD.cmake DESTINATION "${package_dir}")
endif()
install(FILES LICENSE README.md DESTINATION "${CMAKE_INSTALL_DOCDIR}")

if(TARGET geotherm)
  install(TARGETS geotherm RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  install(DIRECTORY assets/models DESTINATION "${CMAKE_INSTALL_DATADIR}/geotherm")
endif()
