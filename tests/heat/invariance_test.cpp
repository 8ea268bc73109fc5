// SPDX-License-Identifier: MIT
// Distances do not depend on how a surface is numbered, turned, measured or placed.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "tests/support/mesh_zoo.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// Another order of operations, and a factor whose condition number is that of a Laplacian.
constexpr double kInvariantRoundOff = 1e-9;
// A model moved by 1e6 times its size keeps 10 digits of each coordinate, 9 of each edge, and
// derivatives of the distance by the edges' lengths are up to a few hundred.
constexpr double kPlaced = 1e-6;
// A power of ten is rounded; so are all coordinates.
constexpr double kScaled = 1e-9;

class Invariance : public testing::TestWithParam<ZooMesh> {
 protected:
  Draft draft = GetParam().draft();
  std::vector<Index> sources = {4, draft.vertex_count() / 2};
  std::vector<double> reference = solve(finish(draft), sources).distances;

  std::vector<double> moved(double scale, const Vec3& shift, bool rotate) const {
    auto d = solve(finish(transformed(draft, scale, shift, rotate)), sources).distances;
    for (double& x : d) x /= scale;
    return d;
  }
  double size() const {
    double most = 0;
    for (const Vec3& p : draft.positions) most = std::max(most, (p - draft.positions[0]).norm());
    return most;
  }
};

TEST_P(Invariance, UnderRenumbering) {
  std::vector<Index> number;
  const Draft other = renumbered(draft, 21, number);
  std::vector<Index> renamed;
  for (const Index s : sources) renamed.push_back(number[s]);
  const auto d = solve(finish(other), renamed).distances;
  std::vector<double> back(d.size());
  for (std::size_t v = 0; v < d.size(); ++v) back[v] = d[number[v]];
  EXPECT_LE(relative_difference(back, reference), kInvariantRoundOff);
}

TEST_P(Invariance, UnderRotation) {
  EXPECT_LE(relative_difference(moved(1, Vec3::Zero(), true), reference), kInvariantRoundOff);
}

TEST_P(Invariance, UnderTranslationByAMillionSizes) {
  const Vec3 far = 1e6 * size() * Vec3(0.6, -0.64, 0.48);
  EXPECT_LE(relative_difference(moved(1, far, false), reference), kPlaced);
}

TEST_P(Invariance, UnderScalingByABillion) {
  EXPECT_LE(relative_difference(moved(1e9, Vec3::Zero(), false), reference), kScaled);
}

TEST_P(Invariance, UnderScalingToABillionth) {
  EXPECT_LE(relative_difference(moved(1e-9, Vec3::Zero(), false), reference), kScaled);
}

TEST_P(Invariance, UnderScalingByAPowerOfTwoIsExact) {
  const auto d = moved(std::ldexp(1.0, 40), Vec3::Zero(), false);
  EXPECT_EQ(relative_difference(d, reference), 0);
}

TEST_P(Invariance, UnderScalingToWhereAreasLeaveTheRangeOfDoubles) {
  for (const int power : {-600, 600}) {
    EXPECT_EQ(relative_difference(moved(std::ldexp(1.0, power), Vec3::Zero(), false), reference),
              0);
  }
}

std::vector<ZooMesh> turned_meshes() {
  std::vector<ZooMesh> out = zoo(kSmooth);
  for (const ZooMesh& mesh : zoo(kRegular)) {
    const std::string name = mesh.name;
    if (name == "caps" || name == "fin" || name == "two_components") out.push_back(mesh);
  }
  return out;
}
INSTANTIATE_TEST_SUITE_P(Zoo, Invariance, testing::ValuesIn(turned_meshes()), zoo_name);

}  // namespace
}  // namespace geotherm::test
