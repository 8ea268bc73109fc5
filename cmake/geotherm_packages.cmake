# SPDX-License-Identifier: MIT
# Debian packages, made by cpack (scripts/package.sh): `geotherm`, the program with what a desktop and
# shells know of it, `libgeotherm0`, the C interface, `python3-geotherm`, and `libgeotherm-dev` to
# compile with both interfaces, and `geotherm-mpi`, which the program loads for MPI and PETSc. Parts that are not built are left out.
include(GNUInstallDirs)

set(share "${CMAKE_INSTALL_DATADIR}")
if(TARGET geotherm)
  install(FILES assets/desktop/org.geotherm.Geotherm.desktop DESTINATION "${share}/applications"
          COMPONENT program)
  install(FILES assets/desktop/org.geotherm.Geotherm.metainfo.xml DESTINATION "${share}/metainfo"
          COMPONENT program)
  install(FILES assets/desktop/geotherm-mime.xml DESTINATION "${share}/mime/packages"
          RENAME geotherm.xml COMPONENT program)
  install(FILES assets/desktop/geotherm.svg DESTINATION "${share}/icons/hicolor/scalable/apps"
          COMPONENT program)
  # Completions and, where help2man is there, manual pages are what the program itself says.
  install(CODE "
    set(root \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
    execute_process(COMMAND \"${PROJECT_SOURCE_DIR}/scripts/shell_files.sh\"
      \"$<TARGET_FILE:geotherm>\" \"\${root}/${share}\" COMMAND_ERROR_IS_FATAL ANY)"
    COMPONENT program)
endif()

set(CPACK_PACKAGE_VENDOR "the geotherm authors")
set(CPACK_PACKAGE_CONTACT "The geotherm authors <geotherm@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "geodesic distance by the heat method")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGE_CHECKSUM SHA256)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL development)

# geotherm_package(COMPONENT PACKAGE SECTION DESCRIPTION): the component as a package of this name.
function(geotherm_package component package section description)
  string(TOUPPER "${component}" key)
  set(CPACK_COMPONENT_${key}_DESCRIPTION "${description}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME "${package}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION "${section}" PARENT_SCOPE)
  # What Debian asks of every package: its licence, and what changed.
  set(place "${share}/doc/${package}")
  install(FILES assets/desktop/copyright DESTINATION "${place}" COMPONENT ${component}
          EXCLUDE_FROM_ALL)
  install(CODE "
    set(root \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
    file(MAKE_DIRECTORY \"\${root}/${place}\")
    foreach(file CHANGELOG.md:changelog assets/desktop/changelog:changelog.Debian)
      string(REPLACE : \";\" file \"\${file}\")
      list(GET file 0 from)
      list(GET file 1 to)
      execute_process(COMMAND gzip -9nc \"${PROJECT_SOURCE_DIR}/\${from}\"
        OUTPUT_FILE \"\${root}/${place}/\${to}.gz\" COMMAND_ERROR_IS_FATAL ANY)
    endforeach()"
    COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()

if(TARGET geotherm)
  list(APPEND CPACK_COMPONENTS_ALL program)
  geotherm_package(program geotherm science
"geotherm computes how far every point of a surface is from the sources that
one picks, along the surface, by the heat method, by near-exact wavefronts
and by an exact method, and says how wrong the faster ones are. It solves,
draws pictures, finds shortest paths and contours on the command line, and
has a window to explore models in.")
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libvulkan1, mesa-vulkan-drivers | vulkan-icd")
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg")
endif()
if(TARGET geotherm_mpi)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
  geotherm_package(mpi geotherm-mpi science
"What geotherm loads to share its work between processes (MPI), and its
backend petsc, which solves Poisson systems by multigrid.")
  set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "openmpi-bin")
endif()
if(TARGET geotherm_c)
  list(APPEND CPACK_COMPONENTS_ALL library python)
  geotherm_package(library libgeotherm0 libs
"The shared library of the C interface, which computes geodesic distance on
triangle meshes, point clouds, tetrahedra, polygons and grids.")
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "geotherm")
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA
      "${PROJECT_SOURCE_DIR}/assets/desktop/shlibs;${PROJECT_SOURCE_DIR}/assets/desktop/triggers")
  geotherm_package(python python3-geotherm python
"The Python package: distances, paths and isolines in NumPy arrays, rows of
many sources, moving surfaces.")
  install(DIRECTORY app/python/geotherm DESTINATION lib/python3/dist-packages COMPONENT python
          EXCLUDE_FROM_ALL PATTERN __pycache__ EXCLUDE PATTERN "*.so*" EXCLUDE
          PATTERN ".*" EXCLUDE)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS OFF)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.9), python3-numpy, libgeotherm0 (= ${PROJECT_VERSION}-1)")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "geotherm")
endif()
geotherm_package(development libgeotherm-dev libdevel
"Headers, CMake package and pkg-config files of the C and the C++ library,
which compute geodesic distance on triangle meshes, point clouds,
tetrahedra, polygons and grids.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev, zlib1g-dev, libpng-dev")
if(GEOTHERM_WITH_CHOLMOD)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libsuitesparse-dev, libopenblas-dev")
endif()
if(TARGET geotherm_c)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libgeotherm0 (= ${PROJECT_VERSION}-1)")
endif()
if(GEOTHERM_WITH_ASSIMP AND ASSIMP_LIBRARY)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libassimp-dev")
endif()
include(CPack)
