# SPDX-License-Identifier: MIT

# GEOTHERM_SANITIZE (a list such as "address;undefined" or "thread", set by presets) instruments
# everything that is built here; what is linked from the system stays as it is.
set(GEOTHERM_SANITIZE "" CACHE STRING "Sanitizers to build with: address;undefined or thread")
if(GEOTHERM_SANITIZE)
  list(JOIN GEOTHERM_SANITIZE "," _sanitizers)
  add_compile_options(-fsanitize=${_sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${_sanitizers})
endif()

# What every target of the project has in common.
function(geotherm_target name)
  target_compile_features(${name} PUBLIC cxx_std_20)
  set_target_properties(${name} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                         -Wno-sign-conversion)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False alarms on "text" + std::string (GCC bug 105651).
    target_compile_options(${name} PRIVATE -Wno-restrict)
  endif()
endfunction()
