// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "geotherm/polyhedral_methods.h"
#include "tests/support/shapes.h"

namespace geotherm::test {

/// Round-off of lengths that are added up over some dozens of faces, relative to the largest.
inline constexpr double kRoundOff = 1e-12;

/// A method that must be possible to build.
std::shared_ptr<const ExactMethod> exact_method(const MeshPtr& mesh, int threads = 1);

/// An answer that must be possible to give; no distances where it was not.
DistanceResult solve_exactly(const ExactMethod& method, const SourceSet& sources,
                             const QueryOptions& query = {});
std::vector<double> exact_distances(const MeshPtr& mesh, const SourceSet& sources);
std::vector<double> exact_distances(const MeshPtr& mesh, const std::vector<Index>& sources);

}  // namespace geotherm::test
