// SPDX-License-Identifier: MIT
#include "solver/core/processor.h"

namespace geotherm {

InstructionSet best_instruction_set() {
#ifdef GEOTHERM_X86_KERNELS
  static const InstructionSet kBest = [] {
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")) {
      return InstructionSet::kAvx512;
    }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
      return InstructionSet::kAvx2;
    }
    return InstructionSet::kPlain;
  }();
  return kBest;
#else
  return InstructionSet::kPlain;
#endif
}

}  // namespace geotherm
