// SPDX-License-Identifier: MIT
#include "solver/linear/multifrontal/front_kernels.h"

namespace geotherm {

namespace kernels_plain {
extern const FrontKernels kFrontKernels;
}
#ifdef GEOTHERM_X86_KERNELS
namespace kernels_avx2 {
extern const FrontKernels kFrontKernels;
}
namespace kernels_avx512 {
extern const FrontKernels kFrontKernels;
}
#endif

const FrontKernels& front_kernels(InstructionSet set) {
#ifdef GEOTHERM_X86_KERNELS
  if (set > best_instruction_set()) set = best_instruction_set();
  if (set == InstructionSet::kAvx512) return kernels_avx512::kFrontKernels;
  if (set == InstructionSet::kAvx2) return kernels_avx2::kFrontKernels;
#else
  static_cast<void>(set);
#endif
  return kernels_plain::kFrontKernels;
}

}  // namespace geotherm
