// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace geotherm {

/// An instruction set that inner loops are compiled for; all give the same answer to round-off.
enum class InstructionSet { kPlain, kAvx2, kAvx512 };

/// The best one that this build and this processor have.
InstructionSet best_instruction_set();

/// The widest group of columns, 16, 8, 4, 2 or 1, that kernels take at once out of so many.
inline int column_group(std::ptrdiff_t columns) {
  for (const int width : {16, 8, 4, 2}) {
    if (columns >= width) return width;
  }
  return 1;
}

}  // namespace geotherm
