// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "geotherm/build_method.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/shapes.h"

namespace geotherm::test {

/// The methods that walk over a WaveSurface without windows.
inline constexpr MethodKind kWaveKinds[] = {MethodKind::kWavefront, MethodKind::kWavefrontFine,
                                            MethodKind::kFastMarching};
/// Those whose waves are round: exact on the plane, but for rounding.
inline constexpr MethodKind kRoundWaves[] = {MethodKind::kWavefront, MethodKind::kWavefrontFine};

/// A method that must be possible to build.
std::shared_ptr<const DistanceMethod> method_of(const MeshPtr& mesh, MethodKind kind,
                                                int threads = 1);

/// An answer that must be possible to give; empty where it was not.
DistanceResult solve(const DistanceMethod& method, const SourceSet& sources,
                     const QueryOptions& query = {});
std::vector<double> distances(const MeshPtr& mesh, MethodKind kind, const SourceSet& sources);

/// In per cent: mean of |d - e| / e where e > 0, largest |d - e| over the largest e. Vertices that
/// only one of the two reaches make both infinite.
struct ErrorPercent {
  double mean = 0, largest = 0;
};
ErrorPercent errors(std::span<const double> d, std::span<const double> exact);

/// A name as GoogleTest wants it.
std::string kind_name(MethodKind kind);

/// The name of a parameter (something with a name, kind).
inline constexpr auto name_and_kind = [](const auto& each) {
  return std::get<0>(each.param).name + ("_" + kind_name(std::get<1>(each.param)));
};

/// A mesh of the zoo, and a method on it.
class MethodOnMesh : public testing::TestWithParam<std::tuple<ZooMesh, MethodKind>> {
 protected:
  MeshPtr mesh = std::get<0>(GetParam()).mesh();
  MethodKind kind = std::get<1>(GetParam());
  std::shared_ptr<const DistanceMethod> method = method_of(mesh, kind);
};

}  // namespace geotherm::test
