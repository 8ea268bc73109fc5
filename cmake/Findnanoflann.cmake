# SPDX-License-Identifier: MIT
# nanoflann, a header of templates; Debian's package has no CMake files. Defines
# nanoflann::nanoflann.
find_path(nanoflann_INCLUDE_DIR nanoflann.hpp)
mark_as_advanced(nanoflann_INCLUDE_DIR)

if(nanoflann_INCLUDE_DIR)
  # 0x142 is 1.4.2.
  file(STRINGS "${nanoflann_INCLUDE_DIR}/nanoflann.hpp" _line
       REGEX "^#define NANOFLANN_VERSION 0x" LIMIT_COUNT 1)
  string(REGEX REPLACE ".*0x([0-9A-Fa-f])([0-9A-Fa-f])([0-9A-Fa-f]).*" "\\1.\\2.\\3"
         nanoflann_VERSION "${_line}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(nanoflann
  REQUIRED_VARS nanoflann_INCLUDE_DIR VERSION_VAR nanoflann_VERSION)

if(nanoflann_FOUND AND NOT TARGET nanoflann::nanoflann)
  add_library(nanoflann::nanoflann INTERFACE IMPORTED)
  target_include_directories(nanoflann::nanoflann INTERFACE "${nanoflann_INCLUDE_DIR}")
endif()
