// SPDX-License-Identifier: MIT
#include "solver/heat/field_kernels.h"

#include <algorithm>
#include <bit>

namespace geotherm {

namespace kernels_plain {
extern const FieldKernels kFieldKernels;
}
#ifdef GEOTHERM_X86_KERNELS
namespace kernels_avx2 {
extern const FieldKernels kFieldKernels;
}
namespace kernels_avx512 {
extern const FieldKernels kFieldKernels;
}
#endif

namespace {

const FieldKernels& field_kernels(InstructionSet set) {
#ifdef GEOTHERM_X86_KERNELS
  set = std::min(set, best_instruction_set());
  if (set == InstructionSet::kAvx512) return kernels_avx512::kFieldKernels;
  if (set == InstructionSet::kAvx2) return kernels_avx2::kFieldKernels;
#else
  static_cast<void>(set);
#endif
  return kernels_plain::kFieldKernels;
}

}  // namespace

void add_unit_divergence(const FieldPass& pass, int group, InstructionSet set) {
  const int slot = std::countr_zero(static_cast<unsigned>(group));
  field_kernels(set).add_unit_divergence[slot](pass);
}

void add_tet_divergence(const TetPass& pass, int group, InstructionSet set) {
  const int slot = std::countr_zero(static_cast<unsigned>(group));
  field_kernels(set).add_tet_divergence[slot](pass);
}

void logarithms(const double* u, double* out, std::size_t count, InstructionSet set) {
  field_kernels(set).logarithms(u, out, count);
}

void mark_small(const double* u, std::int64_t rows, int columns, const double* floors,
                std::uint16_t* masks, InstructionSet set) {
  field_kernels(set).mark_small(u, rows, columns, floors, masks);
}

}  // namespace geotherm
