# SPDX-License-Identifier: MIT
# Script of geotherm_embed: INPUT -> OUTPUT.cpp and OUTPUT.h, which define SYMBOL.
file(READ "${INPUT}" bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
set(head "// Made from ${SYMBOL}'s file by cmake/embed_file.cmake.\n")
file(WRITE "${OUTPUT}.h" "${head}#pragma once\n#include <span>\n"
     "namespace geotherm::embedded {\nstd::span<const unsigned char> ${SYMBOL}();\n}\n")
file(WRITE "${OUTPUT}.cpp" "${head}#include \"embedded/${SYMBOL}.h\"\n"
     "namespace geotherm::embedded {\nstd::span<const unsigned char> ${SYMBOL}() {\n"
     "  alignas(16) static constexpr unsigned char kBytes[] = {${bytes}};\n  return kBytes;\n}\n}\n")
