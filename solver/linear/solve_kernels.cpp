// SPDX-License-Identifier: MIT
#include "solver/linear/solve_kernels.h"

#include <bit>

namespace geotherm {

namespace kernels_plain {
extern const SolveKernels kKernels[5];
}
#ifdef GEOTHERM_X86_KERNELS
namespace kernels_avx2 {
extern const SolveKernels kKernels[5];
}
namespace kernels_avx512 {
extern const SolveKernels kKernels[5];
}
#endif

const SolveKernels& solve_kernels(int group, InstructionSet set) {
  const int slot = std::countr_zero(static_cast<unsigned>(group));
#ifdef GEOTHERM_X86_KERNELS
  if (set > best_instruction_set()) set = best_instruction_set();
  if (set == InstructionSet::kAvx512) return kernels_avx512::kKernels[slot];
  if (set == InstructionSet::kAvx2) return kernels_avx2::kKernels[slot];
#else
  static_cast<void>(set);
#endif
  return kernels_plain::kKernels[slot];
}

}  // namespace geotherm
