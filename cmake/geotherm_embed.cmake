# SPDX-License-Identifier: MIT
# Files that travel inside the program: bytes of FILE as `std::span<const unsigned char> SYMBOL()`,
# declared in the target's embedded/SYMBOL.h. Aligned to 16 bytes; made again when FILE changes.
#   geotherm_embed(TARGET SYMBOL FILE)
set(GEOTHERM_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_DIR}/embed_file.cmake")

function(geotherm_embed target symbol file)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/${target}_embedded")
  set(out "${folder}/embedded/${symbol}")
  set(library ${target}_embedded)
  if(NOT TARGET ${library})
    # The files of the target itself would be made after all that it links.
    add_library(${library} OBJECT)
    geotherm_target(${library})
    geotherm_compile_together(${library})
    target_include_directories(${library} PUBLIC "${folder}")
    target_link_libraries(${target} PRIVATE ${library})
  endif()
  add_custom_command(
    OUTPUT "${out}.cpp" "${out}.h"
    COMMAND "${CMAKE_COMMAND}" "-DINPUT=${file}" "-DOUTPUT=${out}" "-DSYMBOL=${symbol}"
            -P "${GEOTHERM_EMBED_SCRIPT}"
    DEPENDS "${file}" "${GEOTHERM_EMBED_SCRIPT}"
    COMMENT "Embedding ${symbol}" VERBATIM)
  target_sources(${library} PRIVATE "${out}.cpp" "${out}.h")
endfunction()
