# SPDX-License-Identifier: MIT
# Dear ImGui as Debian packages it: a static library with its back ends, and stb beside it. Defines
# ImGui::ImGui, and no macro: the packaged library was built without any.
find_path(ImGui_INCLUDE_DIR imgui.h PATH_SUFFIXES imgui)
find_library(ImGui_LIBRARY NAMES libimgui.a imgui)
find_library(ImGui_STB_LIBRARY NAMES stb)
mark_as_advanced(ImGui_INCLUDE_DIR ImGui_LIBRARY ImGui_STB_LIBRARY)

if(ImGui_INCLUDE_DIR)
  file(STRINGS "${ImGui_INCLUDE_DIR}/imgui.h" _line REGEX "^#define IMGUI_VERSION_NUM" LIMIT_COUNT 1)
  string(REGEX REPLACE "[^0-9]" "" _number "${_line}")
  math(EXPR _major "${_number} / 10000")
  math(EXPR _minor "${_number} / 100 % 100")
  set(ImGui_VERSION "${_major}.${_minor}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ImGui
  REQUIRED_VARS ImGui_LIBRARY ImGui_INCLUDE_DIR ImGui_STB_LIBRARY VERSION_VAR ImGui_VERSION)

if(ImGui_FOUND AND NOT TARGET ImGui::ImGui)
  add_library(ImGui::ImGui INTERFACE IMPORTED)
  target_include_directories(ImGui::ImGui INTERFACE "${ImGui_INCLUDE_DIR}"
                             "${ImGui_INCLUDE_DIR}/backends")
  target_link_libraries(ImGui::ImGui INTERFACE "${ImGui_LIBRARY}" "${ImGui_STB_LIBRARY}")
endif()
