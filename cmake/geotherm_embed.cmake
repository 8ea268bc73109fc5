# SPDX-License-Identifier: MIT
# Files that travel inside the program: bytes of FILE as `std::span<const unsigned char> SYMBOL()`,
# declared in the target's embedded/SYMBOL.h. Aligned to 16 bytes; made again when FILE changes.
#   geotherm_embed(TARGET SYMBOL FILE)
set(GEOTHERM_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_DIR}/embed_file.cmake")

function(geotherm_embed target symbol file)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/${target}_embedded")
  set(out "${folder}/embedded/${symbol}")
  add_custom_command(
    OUTPUT "${out}.cpp" "${out}.h"
    COMMAND "${CMAKE_COMMAND}" "-DINPUT=${file}" "-DOUTPUT=${out}" "-DSYMBOL=${symbol}"
            -P "${GEOTHERM_EMBED_SCRIPT}"
    DEPENDS "${file}" "${GEOTHERM_EMBED_SCRIPT}"
    COMMENT "Embedding ${symbol}" VERBATIM)
  target_sources(${target} PRIVATE "${out}.cpp" "${out}.h")
  set_source_files_properties("${out}.cpp" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_include_directories(${target} PRIVATE "${folder}")
endfunction()
