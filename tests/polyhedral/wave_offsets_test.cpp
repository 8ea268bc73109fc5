// SPDX-License-Identifier: MIT
// Sources whose distance begins above 0.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "tests/polyhedral/wave_fixture.h"
#include "tests/support/compare.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

// Relative to the largest distance.
constexpr double kOffsetRoundOff = 1e-12;
// Distances are measured from the least offset: into units, added, out of units and off again.
constexpr double kFourUlps = 4 * std::numeric_limits<double>::epsilon();
// Where two waves meet, a fit sees both of them: 0.3 % of the range at most in wavefront.md's
// cases, with edges of a twentieth of the range here. Fast marching's own error is larger.
const std::map<MethodKind, double> kMeeting = {{MethodKind::kWavefront, 0.01},
                                               {MethodKind::kWavefrontFine, 0.005},
                                               {MethodKind::kFastMarching, 0.02},
                                               {MethodKind::kExact, kOffsetRoundOff}};

SourceSet with_offsets(const std::vector<Index>& vertices, std::vector<double> offsets) {
  SourceSet set = SourceSet::of_vertices(vertices);
  set.offsets = std::move(offsets);
  return set;
}

class Offsets : public testing::TestWithParam<MethodKind> {
 protected:
  MeshPtr mesh = finish(torus(36, 18, 0.4));
  std::shared_ptr<const DistanceMethod> method = method_of(mesh, GetParam());

  std::vector<double> from(const std::vector<Index>& vertices,
                           std::vector<double> offsets = {}) const {
    return solve(*method, with_offsets(vertices, std::move(offsets))).distances;
  }
};

TEST_P(Offsets, OfOneSourceAreAddedToEveryDistance) {
  const auto plain = from({7});
  for (const double offset : {0.0, 0.25, 1e6, 1e9, 1e15}) {
    const auto d = from({7}, {offset});
    const double ulps = kFourUlps * (offset + largest(plain));
    EXPECT_NEAR(d[7], offset, ulps);
    for (std::size_t v = 0; v < d.size(); ++v) EXPECT_NEAR(d[v] - offset, plain[v], ulps) << v;
  }
}

TEST_P(Offsets, OfTwoSourcesGiveTheLesserSum) {
  const auto near = from({7}), far = from({400});
  const double first = 0.3, second = 0.9;
  const auto d = from({7, 400}, {first, second});
  std::vector<double> expected;
  for (std::size_t v = 0; v < near.size(); ++v) {
    expected.push_back(std::min(near[v] + first, far[v] + second));
  }
  EXPECT_LE(relative_difference(d, expected), kMeeting.at(GetParam()));
  EXPECT_NEAR(d[7], first, kOffsetRoundOff);
  EXPECT_NEAR(d[400], second, kOffsetRoundOff);
}

TEST_P(Offsets, AboveTheDistanceFromAnotherSourceChangeLittle) {
  const auto alone = from({7});
  const auto d = from({7, 400}, {0, alone[400] + 0.5});
  EXPECT_LE(relative_difference(d, alone), kMeeting.at(GetParam()));
}

TEST_P(Offsets, MayBeLongerThanTheWholeMesh) {
  for (const ZooMesh& each : zoo(kManifold | kClosed)) {
    if (std::string(each.name) != "two_components") continue;
    const MeshPtr parts = each.mesh();
    const Index last = parts->vertex_count() - 1;
    const auto first_alone = distances(parts, GetParam(), SourceSet::of_vertices({0}));
    const auto last_alone = distances(parts, GetParam(), SourceSet::of_vertices({last}));
    const double offset = 1e9;
    // What is left of 16 digits, enlarged by fits to differences along edges.
    const double digits = 1e-11 * offset;
    const auto d = distances(parts, GetParam(), with_offsets({0, last}, {0, offset}));
    for (std::size_t v = 0; v < d.size(); ++v) {
      EXPECT_NEAR(d[v], std::min(first_alone[v], last_alone[v] + offset), digits) << v;
    }
  }
}

TEST_P(Offsets, MayBeAsLargeAsNumbersAre) {
  constexpr double kHuge = 1e300;
  Draft draft = sphere(2);
  const Index first = draft.vertex_count();
  append(draft, transformed(sphere(2), 1, Vec3(4, 0, 0), false));
  const MeshPtr parts = finish(draft);
  const auto alone = distances(parts, GetParam(), SourceSet::of_vertices({0}));
  const auto d = distances(parts, GetParam(), with_offsets({0, first, 5}, {0, kHuge, kHuge}));
  for (Index v = 0; v < parts->vertex_count(); ++v) {
    if (v < first) {
      EXPECT_EQ(d[v], alone[v]) << v;
    } else {
      EXPECT_NEAR(d[v], kHuge, kFourUlps * kHuge) << v;
    }
  }
}

TEST_P(Offsets, HoldInsideFaces) {
  SourceSet set{{SurfacePoint::in_face(3, {0.2, 0.3, 0.5})}, {}};
  const auto plain = solve(*method, set).distances;
  set.offsets = {2.5};
  auto d = solve(*method, set).distances;
  for (double& x : d) x -= 2.5;
  EXPECT_LE(relative_difference(d, plain), kOffsetRoundOff * 10);
}

INSTANTIATE_TEST_SUITE_P(Methods, Offsets,
                         testing::Values(MethodKind::kWavefront, MethodKind::kWavefrontFine,
                                         MethodKind::kFastMarching, MethodKind::kExact),
                         [](const auto& each) { return kind_name(each.param); });

}  // namespace
}  // namespace geotherm::test
