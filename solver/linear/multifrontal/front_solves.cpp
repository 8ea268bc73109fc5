// SPDX-License-Identifier: MIT
#include <bit>

#include "solver/linear/multifrontal/front_kernels.h"

namespace geotherm {

namespace kernels_plain {
extern const FrontSolves kFrontSolves[3][5];
}
#ifdef GEOTHERM_X86_KERNELS
namespace kernels_avx2 {
extern const FrontSolves kFrontSolves[3][5];
}
namespace kernels_avx512 {
extern const FrontSolves kFrontSolves[3][5];
}
#endif

const FrontSolves& front_solves(FactorStorage storage, int group, InstructionSet set) {
  const auto row = static_cast<int>(storage);
  const int slot = std::countr_zero(static_cast<unsigned>(group));
#ifdef GEOTHERM_X86_KERNELS
  if (set > best_instruction_set()) set = best_instruction_set();
  if (set == InstructionSet::kAvx512) return kernels_avx512::kFrontSolves[row][slot];
  if (set == InstructionSet::kAvx2) return kernels_avx2::kFrontSolves[row][slot];
#else
  static_cast<void>(set);
#endif
  return kernels_plain::kFrontSolves[row][slot];
}

}  // namespace geotherm
