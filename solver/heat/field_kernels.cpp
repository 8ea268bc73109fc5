// SPDX-License-Identifier: MIT
#include "solver/heat/field_kernels.h"

#include <algorithm>
#include <bit>

namespace geotherm {

using FieldKernel = void (*)(const FieldPass&);

namespace kernels_plain {
extern const FieldKernel kFieldKernels[5];
extern void (*const kLogarithms)(const double*, double*, std::size_t);
extern void (*const kMarkSmall)(const double*, std::int64_t, int, const double*, std::uint16_t*);
}  // namespace kernels_plain
#ifdef GEOTHERM_X86_KERNELS
namespace kernels_avx2 {
extern const FieldKernel kFieldKernels[5];
extern void (*const kLogarithms)(const double*, double*, std::size_t);
extern void (*const kMarkSmall)(const double*, std::int64_t, int, const double*, std::uint16_t*);
}  // namespace kernels_avx2
namespace kernels_avx512 {
extern const FieldKernel kFieldKernels[5];
extern void (*const kLogarithms)(const double*, double*, std::size_t);
extern void (*const kMarkSmall)(const double*, std::int64_t, int, const double*, std::uint16_t*);
}  // namespace kernels_avx512
#endif

void add_unit_divergence(const FieldPass& pass, int group, InstructionSet set) {
  const int slot = std::countr_zero(static_cast<unsigned>(group));
#ifdef GEOTHERM_X86_KERNELS
  set = std::min(set, best_instruction_set());
  if (set == InstructionSet::kAvx512) return kernels_avx512::kFieldKernels[slot](pass);
  if (set == InstructionSet::kAvx2) return kernels_avx2::kFieldKernels[slot](pass);
#else
  static_cast<void>(set);
#endif
  kernels_plain::kFieldKernels[slot](pass);
}

void logarithms(const double* u, double* out, std::size_t count, InstructionSet set) {
#ifdef GEOTHERM_X86_KERNELS
  set = std::min(set, best_instruction_set());
  if (set == InstructionSet::kAvx512) return kernels_avx512::kLogarithms(u, out, count);
  if (set == InstructionSet::kAvx2) return kernels_avx2::kLogarithms(u, out, count);
#else
  static_cast<void>(set);
#endif
  kernels_plain::kLogarithms(u, out, count);
}

void mark_small(const double* u, std::int64_t rows, int columns, const double* floors,
                std::uint16_t* masks, InstructionSet set) {
#ifdef GEOTHERM_X86_KERNELS
  set = std::min(set, best_instruction_set());
  if (set == InstructionSet::kAvx512) {
    return kernels_avx512::kMarkSmall(u, rows, columns, floors, masks);
  }
  if (set == InstructionSet::kAvx2) {
    return kernels_avx2::kMarkSmall(u, rows, columns, floors, masks);
  }
#else
  static_cast<void>(set);
#endif
  kernels_plain::kMarkSmall(u, rows, columns, floors, masks);
}

}  // namespace geotherm
