// SPDX-License-Identifier: MIT
#include "solver/polyhedral/wave_kernels.h"

#include <algorithm>

namespace geotherm {

using WaveKernel = std::size_t (*)(WavePass&, std::size_t);

namespace kernels_plain {
extern const WaveKernel kWaveKernels[2][2];
}  // namespace kernels_plain
#ifdef GEOTHERM_X86_KERNELS
namespace kernels_avx2 {
extern const WaveKernel kWaveKernels[2][2];
}  // namespace kernels_avx2
#endif

std::size_t visit_current_bucket(WavePass& pass, int samples, std::size_t most,
                                 InstructionSet set) {
  const int fine = samples > 1 ? 1 : 0;
  const int labels = pass.label != nullptr ? 1 : 0;
#ifdef GEOTHERM_X86_KERNELS
  set = std::min(set, best_instruction_set());
  if (set != InstructionSet::kPlain) return kernels_avx2::kWaveKernels[fine][labels](pass, most);
#else
  static_cast<void>(set);
#endif
  return kernels_plain::kWaveKernels[fine][labels](pass, most);
}

}  // namespace geotherm
