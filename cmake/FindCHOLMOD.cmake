# SPDX-License-Identifier: MIT
# Finds CHOLMOD of SuiteSparse, for which Debian ships no CMake configuration.
#
#   CHOLMOD_FOUND, CHOLMOD_VERSION (CHOLMOD's own, such as 3.0.14)
#   CHOLMOD::CHOLMOD   imported target: cholmod, amd, colamd, suitesparseconfig and their headers
#
# CHOLMOD_ROOT (variable or environment) names a prefix to look in first. Installed with the
# package, because geothermConfig.cmake needs it again.

find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse SuiteSparse)
find_library(CHOLMOD_LIBRARY cholmod)
find_library(CHOLMOD_AMD_LIBRARY amd)
find_library(CHOLMOD_COLAMD_LIBRARY colamd)
find_library(CHOLMOD_CONFIG_LIBRARY suitesparseconfig)

if(CHOLMOD_INCLUDE_DIR)
  set(CHOLMOD_VERSION "")
  foreach(header cholmod_core.h cholmod.h)  # SuiteSparse before 7 and since 7
    if(EXISTS "${CHOLMOD_INCLUDE_DIR}/${header}" AND NOT CHOLMOD_VERSION)
      file(STRINGS "${CHOLMOD_INCLUDE_DIR}/${header}" lines
           REGEX "^ *# *define +CHOLMOD_(MAIN|SUB|SUBSUB)_VERSION +[0-9]+")
      string(REGEX REPLACE "[^;0-9]+" "" numbers "${lines}")
      list(JOIN numbers "." CHOLMOD_VERSION)
    endif()
  endforeach()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CHOLMOD
  REQUIRED_VARS CHOLMOD_LIBRARY CHOLMOD_INCLUDE_DIR CHOLMOD_AMD_LIBRARY CHOLMOD_COLAMD_LIBRARY
                CHOLMOD_CONFIG_LIBRARY
  VERSION_VAR CHOLMOD_VERSION
  REASON_FAILURE_MESSAGE
    "install libsuitesparse-dev and libopenblas-dev (scripts/setup.sh does), or configure with -DGEOTHERM_WITH_CHOLMOD=OFF to build without this backend")
mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY CHOLMOD_AMD_LIBRARY CHOLMOD_COLAMD_LIBRARY
                 CHOLMOD_CONFIG_LIBRARY)

if(CHOLMOD_FOUND AND NOT TARGET CHOLMOD::CHOLMOD)
  add_library(CHOLMOD::CHOLMOD UNKNOWN IMPORTED)
  set_target_properties(CHOLMOD::CHOLMOD PROPERTIES
    IMPORTED_LOCATION "${CHOLMOD_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES
      "${CHOLMOD_AMD_LIBRARY};${CHOLMOD_COLAMD_LIBRARY};${CHOLMOD_CONFIG_LIBRARY}")
endif()
