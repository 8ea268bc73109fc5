// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "solver/core/processor.h"

namespace geotherm::bench {

/// Sums `count` doubles with as many registers as keep up with memory. Precondition: a multiple of
/// 64, aligned to 64 bytes. The sum is returned so that no compiler leaves the reading out.
double read_all(const double* values, std::size_t count, InstructionSet set);

/// So many rounds of independent fused multiply-adds that live in registers. Returns the
/// floating-point operations done (two each); `sink` gets what was computed.
double multiply_add(std::int64_t rounds, InstructionSet set, double& sink);

}  // namespace geotherm::bench
