// SPDX-License-Identifier: MIT
// Distances grow with the model and are otherwise the same, whatever the unit that it is measured
// in and however its coordinates are rounded in that.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <tuple>
#include <vector>

#include "geotherm/build_method.h"
#include "tests/support/compare.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

// Shares of the range. Scaling rounds coordinates anew, each length by 1e-16 of itself. That
// becomes more where a system is as badly conditioned as a Laplacian on needles.
constexpr double kScaled = 1e-6;

/// Faces round one edge, 0 to 4, one of which has no area: its third corner is in the middle of the
/// edge but for rounding, so that its direction is another one in each unit.
Draft fan_with_a_flat_face() {
  Draft draft;
  draft.positions = {{0, 0, 0},
                     {1, 0, 0.34525658899804723},
                     {0.020794827803092428, 0.999783764189357, -0.9436617229659663},
                     {-0.9991351502732795, 0.04158066243329049, -0.04353740391875567},
                     {-0.06234851460699166, -0.9980544387588794, 0.6477310005423633},
                     {1.8282413424152328, -1.730619280095524, 0.004039517391911218},
                     {-0.03117425730349583, -0.4990272193794397, 0.32386550027118166}};
  draft.faces = {{0, 2, 3}, {0, 1, 2}, {0, 3, 4}, {0, 4, 1}, {0, 4, 5}, {0, 4, 6}};
  return draft;
}

/// Two faces lie on each other but for rounding, at an edge with four.
Draft fan_with_faces_on_each_other() {
  Draft draft = fan_with_a_flat_face();
  draft.faces.pop_back();
  const Vec3 p = draft.positions[4] / 3 + draft.positions[5] * 0.7;
  draft.positions[6] = p;
  draft.faces.push_back({0, 4, 6});
  return draft;
}

constexpr ZooMesh kFans[] = {
    {"fan_with_a_flat_face", 0, fan_with_a_flat_face},
    {"fan_with_faces_on_each_other", 0, fan_with_faces_on_each_other},
};

class Scaling : public testing::TestWithParam<std::tuple<ZooMesh, MethodKind>> {
 protected:
  std::vector<double> distances(const Draft& draft) const {
    MethodOptions options;
    options.method = std::get<1>(GetParam());
    const auto method = build_method(finish(draft), options);
    EXPECT_TRUE(method);
    const auto result = (*method)->solve(SourceSet::of_vertices({draft.faces[0][0]}));
    EXPECT_TRUE(result);
    return result->distances;
  }
};

TEST_P(Scaling, MultipliesDistances) {
  const Draft draft = std::get<0>(GetParam()).draft();
  const std::vector<double> reference = distances(draft);
  for (const double factor : {3.0, 1.0 / 3, 7.0, 1e-3, 1e5}) {
    Draft scaled = draft;
    for (Vec3& p : scaled.positions) p *= factor;
    std::vector<double> d = distances(scaled);
    for (double& each : d) each /= factor;
    EXPECT_LE(relative_difference(d, reference), kScaled) << "by " << factor;
  }
}

std::vector<ZooMesh> meshes() {
  std::vector<ZooMesh> out = zoo();
  out.insert(out.end(), std::begin(kFans), std::end(kFans));
  return out;
}

INSTANTIATE_TEST_SUITE_P(Zoo, Scaling,
                         testing::Combine(testing::ValuesIn(meshes()),
                                          testing::Values(MethodKind::kHeat, MethodKind::kWavefront,
                                                          MethodKind::kWavefrontFine,
                                                          MethodKind::kFastMarching,
                                                          MethodKind::kExact)),
                         [](const auto& each) {
                           std::string name = std::get<0>(each.param).name +
                                              ("_" + to_text(std::get<1>(each.param)));
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace geotherm::test
