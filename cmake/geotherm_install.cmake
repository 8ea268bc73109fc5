# SPDX-License-Identifier: MIT
# What `cmake --install` puts where: library, headers, package files, program, models, licence.
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/geotherm")

set_target_properties(geotherm_solver PROPERTIES
  EXPORT_NAME solver OUTPUT_NAME geotherm_solver VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
install(TARGETS geotherm_solver EXPORT geothermTargets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development
  RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT development
  FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT development)
if(TARGET geotherm_c)
  install(TARGETS geotherm_c EXPORT geothermTargets
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library
            NAMELINK_COMPONENT development
    FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT development)
endif()
install(EXPORT geothermTargets NAMESPACE geotherm:: DESTINATION "${package_dir}"
        COMPONENT development)

configure_package_config_file(cmake/geothermConfig.cmake.in
  "${PROJECT_BINARY_DIR}/geothermConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/geothermConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/geothermConfig.cmake"
              "${PROJECT_BINARY_DIR}/geothermConfigVersion.cmake" DESTINATION "${package_dir}"
        COMPONENT development)
set(cholmod_libraries "")
if(GEOTHERM_WITH_CHOLMOD)
  install(FILES cmake/FindCHOLMOD.cmake DESTINATION "${package_dir}" COMPONENT development)
  set(cholmod_libraries " -lcholmod -lopenblas")
endif()
set(assimp_libraries "")
if(GEOTHERM_WITH_ASSIMP AND ASSIMP_LIBRARY)
  set(assimp_libraries " -lassimp")
endif()
file(RELATIVE_PATH to_prefix "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
configure_file(cmake/geotherm-solver.pc.in "${PROJECT_BINARY_DIR}/geotherm-solver.pc" @ONLY)
configure_file(cmake/geotherm.pc.in "${PROJECT_BINARY_DIR}/geotherm.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/geotherm-solver.pc" "${PROJECT_BINARY_DIR}/geotherm.pc"
        DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT development)
install(FILES LICENSE README.md DESTINATION "${CMAKE_INSTALL_DOCDIR}")

if(TARGET geotherm_mpi)
  install(TARGETS geotherm_mpi
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/geotherm" COMPONENT mpi)
endif()
if(TARGET geotherm)
  install(TARGETS geotherm RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
  install(DIRECTORY assets/models DESTINATION "${CMAKE_INSTALL_DATADIR}/geotherm"
          COMPONENT program)
  install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program
          PATTERN site EXCLUDE)
endif()
