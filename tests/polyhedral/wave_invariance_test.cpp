// SPDX-License-Identifier: MIT
// Distances do not depend on how a surface is numbered, turned, measured or placed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>

#include "tests/polyhedral/wave_fixture.h"
#include "tests/support/broken_mesh.h"
#include "tests/support/compare.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

// Relative to the largest distance.
constexpr double kInvariantRoundOff = 1e-9;
// Edges that wait at the same distance are visited in an order that another placement changes, and
// a fall below the threshold of notice (1e-4 of an edge) is passed on in one order and not in
// another. Fast marching has one order and no threshold.
constexpr double kAnotherOrder = 1e-4;
// A model moved by 1e6 times its size keeps 10 digits of each coordinate, 9 of each edge.
constexpr double kPlaced = 1e-6;

class WaveInvariance : public testing::TestWithParam<std::tuple<ZooMesh, MethodKind>> {
 protected:
  Draft draft = std::get<0>(GetParam()).draft();
  MethodKind kind = std::get<1>(GetParam());
  std::vector<Index> sources = {4, draft.vertex_count() / 2};
  std::vector<double> reference = distances(finish(draft), kind, SourceSet::of_vertices(sources));
  bool waves = kind != MethodKind::kFastMarching;

  std::vector<double> moved(double scale, const Vec3& shift, bool rotate) const {
    auto d = distances(finish(transformed(draft, scale, shift, rotate)), kind,
                       SourceSet::of_vertices(sources));
    for (double& x : d) x /= scale;
    return d;
  }
  double size() const {
    double most = 0;
    for (const Vec3& p : draft.positions) most = std::max(most, (p - draft.positions[0]).norm());
    return most;
  }
};

TEST_P(WaveInvariance, UnderRenumbering) {
  std::vector<Index> number;
  const Draft other = renumbered(draft, 21, number);
  std::vector<Index> renamed;
  for (const Index s : sources) renamed.push_back(number[s]);
  const auto d = distances(finish(other), kind, SourceSet::of_vertices(renamed));
  std::vector<double> back(d.size());
  for (std::size_t v = 0; v < d.size(); ++v) back[v] = d[number[v]];
  EXPECT_LE(relative_difference(back, reference), kInvariantRoundOff);
}

TEST_P(WaveInvariance, OfCurvesUnderRenumbering) {
  std::vector<Index> number;
  const Draft other = renumbered(draft, 22, number);
  const Face& face = draft.faces[draft.faces.size() / 3];
  SourceSet curve, renamed;
  curve.edges = {{face[0], face[1]}, {face[1], face[2]}};
  for (const auto& [a, b] : curve.edges) renamed.edges.push_back({number[a], number[b]});
  const auto d = distances(finish(other), kind, renamed);
  std::vector<double> back(d.size());
  for (std::size_t v = 0; v < d.size(); ++v) back[v] = d[number[v]];
  EXPECT_LE(relative_difference(back, distances(finish(draft), kind, curve)), kInvariantRoundOff);
}

/// Surfaces that no turning of faces orients: which edges stay in disagreement, and are not
/// flipped, has to follow from the shape.
class OneSided : public testing::TestWithParam<std::tuple<std::uint64_t, MethodKind>> {};

TEST_P(OneSided, DistancesDoNotHangOnTheNumbering) {
  const auto& [seed, kind] = GetParam();
  const BrokenMesh mesh = broken_mesh(seed, {0, false});
  ASSERT_TRUE(mesh.recipe.find("Moebius") != std::string::npos ||
              mesh.recipe.find("Klein") != std::string::npos)
      << mesh.recipe;
  const Index source = mesh.draft.faces[0][0];
  const auto reference = distances(finish(mesh.draft), kind, SourceSet::of_vertices({source}));
  for (const unsigned numbering : {1, 2, 3, 4, 5}) {
    std::vector<Index> number;
    const Draft other = renumbered(mesh.draft, numbering, number);
    const auto d = distances(finish(other), kind, SourceSet::of_vertices({number[source]}));
    std::vector<double> back(d.size());
    for (std::size_t v = 0; v < d.size(); ++v) back[v] = d[number[v]];
    EXPECT_LE(relative_difference(back, reference), kInvariantRoundOff)
        << "numbering " << numbering;
  }
}

// Klein bottles, Moebius strips, and of these two that are regular, so that many edges rank alike.
INSTANTIATE_TEST_SUITE_P(BrokenMeshes, OneSided,
                         testing::Combine(testing::Values(3, 8, 13, 23, 32, 42, 98, 258, 389),
                                          testing::ValuesIn(kWaveKinds)),
                         [](const auto& each) {
                           return std::to_string(std::get<0>(each.param)) + "_" +
                                  kind_name(std::get<1>(each.param));
                         });

TEST_P(WaveInvariance, UnderRotation) {
  EXPECT_LE(relative_difference(moved(1, Vec3::Zero(), true), reference),
            waves ? kAnotherOrder : kInvariantRoundOff);
}

TEST_P(WaveInvariance, UnderTranslationByAMillionSizes) {
  const Vec3 far = 1e6 * size() * Vec3(0.6, -0.64, 0.48);
  EXPECT_LE(relative_difference(moved(1, far, false), reference), waves ? kAnotherOrder : kPlaced);
}

TEST_P(WaveInvariance, UnderScalingByABillion) {
  EXPECT_LE(relative_difference(moved(1e9, Vec3::Zero(), false), reference), kInvariantRoundOff);
}

TEST_P(WaveInvariance, UnderScalingToABillionth) {
  EXPECT_LE(relative_difference(moved(1e-9, Vec3::Zero(), false), reference), kInvariantRoundOff);
}

TEST_P(WaveInvariance, UnderScalingToWhereAreasLeaveTheRangeOfDoublesIsExact) {
  for (const int power : {-600, 40, 600}) {
    EXPECT_EQ(relative_difference(moved(std::ldexp(1.0, power), Vec3::Zero(), false), reference),
              0);
  }
}

std::vector<ZooMesh> meshes() {
  std::vector<ZooMesh> out = zoo(kSmooth);
  for (const ZooMesh& mesh : zoo(kRegular)) {
    const std::string name = mesh.name;
    if (name == "caps" || name == "fin" || name == "two_components") out.push_back(mesh);
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(Zoo, WaveInvariance,
                         testing::Combine(testing::ValuesIn(meshes()),
                                          testing::ValuesIn(kWaveKinds)),
                         name_and_kind);

}  // namespace
}  // namespace geotherm::test
