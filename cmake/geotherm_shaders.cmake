# SPDX-License-Identifier: MIT
# GLSL to SPIR-V while building: compiled by glslang, checked by spirv-val, embedded as SYMBOL with
# the file's name, '.' as '_' (surface.frag: surface_frag()). What a shader includes is tracked.
#   geotherm_shaders(TARGET FOLDER FILE...)
find_program(GEOTHERM_GLSLANG glslangValidator)
find_program(GEOTHERM_SPIRV_VAL spirv-val)

function(geotherm_shaders target folder)
  if(NOT GEOTHERM_GLSLANG OR NOT GEOTHERM_SPIRV_VAL)
    message(FATAL_ERROR "The shaders need glslangValidator and spirv-val (Debian: glslang-tools, "
                        "spirv-tools). scripts/setup.sh installs them; -DGEOTHERM_BUILD_ENGINE=OFF "
                        "builds without pictures.")
  endif()
  foreach(file ${ARGN})
    string(REPLACE "." "_" symbol "${file}")
    set(spirv "${CMAKE_CURRENT_BINARY_DIR}/${target}_shaders/${symbol}.spv")
    add_custom_command(
      OUTPUT "${spirv}"
      COMMAND "${CMAKE_COMMAND}" -E make_directory "${CMAKE_CURRENT_BINARY_DIR}/${target}_shaders"
      COMMAND "${GEOTHERM_GLSLANG}" --quiet --target-env vulkan1.3 -V "-I${folder}"
              --depfile "${spirv}.d" -o "${spirv}" "${folder}/${file}"
      COMMAND "${GEOTHERM_SPIRV_VAL}" --target-env vulkan1.3 "${spirv}"
      DEPENDS "${folder}/${file}" DEPFILE "${spirv}.d"
      COMMENT "Compiling shader ${file}" VERBATIM)
    geotherm_embed(${target} ${symbol} "${spirv}")
  endforeach()
endfunction()
