// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "solver/heat/poisson.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// The tolerance is a share of the largest distance. An iterative backend solves different systems
// to 1e-13 in the residual.
constexpr double kDirectModes = 1e-9;
constexpr double kIterativeModes = 1e-6;
// A row replaced by a number leaves that row's residual, one of n terms of like size.
constexpr double kPenaltyShows = 1e-4;
constexpr double kNoResidual = 1e-8;

HeatOptions in_mode(ConstraintMode mode, Index pin = kNoIndex) {
  HeatOptions options;
  options.constraint.mode = mode;
  options.constraint.pin_vertex = pin;
  return options;
}

using ModeCase = std::tuple<std::string, ZooMesh>;

class ConstraintModes : public testing::TestWithParam<ModeCase> {
 protected:
  MeshPtr mesh = std::get<1>(GetParam()).mesh();
  std::string backend = std::get<0>(GetParam());
  bool iterative = !std::ranges::count(direct_backends(), backend);
  double tolerance = iterative ? kIterativeModes : kDirectModes;
  std::vector<Index> sources = {3, mesh->vertex_count() / 2, mesh->vertex_count() - 4};

  DistanceResult in(const HeatOptions& options) const {
    return solve(mesh, sources, with_backend(backend, options));
  }
};

TEST_P(ConstraintModes, ThatAreEquivalentAgreeForEveryPin) {
  const auto reference = in(in_mode(ConstraintMode::kPinVertex)).distances;
  for (const Index pin : {0, mesh->vertex_count() / 3, sources[1], mesh->vertex_count() - 1}) {
    const auto pinned = in(in_mode(ConstraintMode::kPinVertex, pin)).distances;
    EXPECT_LE(relative_difference(pinned, reference), tolerance) << "pinned at " << pin;
  }
  for (const auto mode : {ConstraintMode::kConserveEnergy, ConstraintMode::kPseudoInverse}) {
    EXPECT_LE(relative_difference(in(in_mode(mode)).distances, reference), tolerance)
        << static_cast<int>(mode);
  }
}

TEST_P(ConstraintModes, AgreeWithPinnedSourcesWhereThereIsOneSource) {
  sources.resize(1);
  EXPECT_LE(relative_difference(in(in_mode(ConstraintMode::kPinSources)).distances,
                                in(in_mode(ConstraintMode::kPinVertex)).distances),
            tolerance);
}

TEST_P(ConstraintModes, PinnedSourcesHaveDistanceZeroExactly) {
  const auto result = in(in_mode(ConstraintMode::kPinSources));
  for (const Index s : sources) EXPECT_EQ(result.distances[s], 0);
  EXPECT_EQ(*std::ranges::min_element(result.distances), 0);
}

TEST_P(ConstraintModes, PenaltyShowsInTheResidual) {
  const double pinned = in(in_mode(ConstraintMode::kPinVertex)).quality.poisson_residual;
  const double penalised = in(in_mode(ConstraintMode::kPenalty)).quality.poisson_residual;
  EXPECT_LE(pinned, kNoResidual);
  EXPECT_GE(penalised, kPenaltyShows);
}

std::vector<ZooMesh> mode_meshes() { return zoo(kSmooth); }

INSTANTIATE_TEST_SUITE_P(Backends, ConstraintModes,
                         testing::Combine(testing::ValuesIn(backend_names()),
                                          testing::ValuesIn(mode_meshes())),
                         [](const auto& each) {
                           return test_name(std::get<0>(each.param)) + "_" +
                                  std::get<1>(each.param).name;
                         });

/// Few sources go through a small dense system, many through a factor of their own; an iterative
/// backend holds rows whatever their number.
class PinnedSources : public testing::TestWithParam<Index> {};

TEST_P(PinnedSources, AreTheSameThroughADenseSystemAndThroughHeldRows) {
  const MeshPtr mesh = finish(torus(48, 24, 0.4));
  std::vector<Index> sources;
  sources.reserve(static_cast<std::size_t>(GetParam()));
  for (Index k = 0; k < GetParam(); ++k) sources.push_back(k * 7);
  for (const std::string& direct : direct_backends()) {
    const auto d = solve(mesh, sources, with_backend(direct)).distances;
    for (const Index s : sources) EXPECT_EQ(d[s], 0);
    for (const std::string& iterative : iterative_backends()) {
      EXPECT_LE(relative_difference(solve(mesh, sources, with_backend(iterative)).distances, d),
                kIterativeModes)
          << direct << " and " << iterative;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sources, PinnedSources,
                         testing::Values(2, static_cast<Index>(kMaxSchurRows),
                                         static_cast<Index>(kMaxSchurRows) + 1));

TEST(PinVertex, ThatIsNotOnTheSurfaceIsAnError) {
  Draft draft = sphere(2);
  const Index unused = draft.add({5, 5, 5});
  const MeshPtr mesh = finish(draft);
  for (const Index pin : {unused, unused + 1, Index{-7}}) {
    const auto method = HeatMethod::build(mesh, in_mode(ConstraintMode::kPinVertex, pin));
    ASSERT_FALSE(method) << pin;
    EXPECT_EQ(method.error().code, ErrorCode::kBadInput);
    EXPECT_NE(sentence(method.error()).find(std::to_string(pin)), std::string::npos);
  }
}

}  // namespace
}  // namespace geotherm::test
