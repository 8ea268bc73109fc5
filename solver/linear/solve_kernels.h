// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "geotherm/types.h"
#include "solver/core/processor.h"

namespace geotherm {

/// One supernode of a factor L: `width` columns that share their rows. Column c holds the rows
/// from the diagonal down, at values[c * height + r]; the first `width` rows are the columns'
/// own, the others are listed in `rows`.
struct Panel {
  Index first;  ///< its first column
  Index width;
  Index height;       ///< width + rows below
  const Index* rows;  ///< height - width row numbers
  const double* values;
  const double* inverse_diagonal;  ///< width: 1 / L(c, c)
  bool padded;                     ///< kPanelPadding doubles may be read after the last value
};

/// Kernels for one right side read whole registers, up to this many doubles past a column's end.
inline constexpr std::ptrdiff_t kPanelPadding = 16;

/// The two inner loops of triangular solves for one group of right sides: x has `stride` doubles a
/// row. `scratch` has room for height * group doubles and kPanelPadding more.
struct SolveKernels {
  void (*panel_forward)(const Panel&, double* x, std::ptrdiff_t stride, double* scratch);
  void (*panel_backward)(const Panel&, double* x, std::ptrdiff_t stride, double* scratch);
};

/// Kernels for a group of 1, 2, 4, 8 or 16 right sides. A set that this build or processor lacks is
/// replaced by the best lower one.
const SolveKernels& solve_kernels(int group, InstructionSet set = best_instruction_set());

}  // namespace geotherm
