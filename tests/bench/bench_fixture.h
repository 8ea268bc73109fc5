// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "bench/report.h"

namespace geotherm::test {

/// A contender's figures on a mesh of so many faces: `pace` times a power of them.
bench::Figures figures_of(const std::string& name, Index faces, double pace, double exponent);

/// Closed mesh: half as many vertices as faces.
bench::SolveGroup group_of(const std::string& mesh, Index faces, bool regular);

/// A run over a regular and an irregular mesh at four sizes; "quick" beats the baseline by 4 to 1
/// in everything and takes half of its memory, "slow" was left out of the largest.
bench::BenchRun sample_run();

}  // namespace geotherm::test
