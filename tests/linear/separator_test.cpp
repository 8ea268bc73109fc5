// SPDX-License-Identifier: MIT
#include "solver/linear/separator.h"

#include <gtest/gtest.h>

#include <numeric>

#include "solver/linear/plane_cuts.h"
#include "solver/linear/symmetric_pattern.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

GraphPart part_of(const TriangleMesh& mesh) {
  const SymmetricPattern pattern = pattern_of_faces(mesh.vertex_count(), mesh.faces());
  GraphPart out;
  out.start.assign(pattern.start.begin(), pattern.start.end());
  out.neighbor = pattern.neighbor;
  out.vertex.resize(static_cast<std::size_t>(pattern.size()));
  std::iota(out.vertex.begin(), out.vertex.end(), 0);
  for (const Vec3& p : mesh.positions()) {
    out.position.push_back(
        {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
  return out;
}

/// That it separates, and counts right.
void expect_separates(const GraphPart& part, const Separator& separator) {
  ASSERT_EQ(separator.half.size(), part.vertex.size());
  std::array<Index, 3> count{};
  for (Index i = 0; i < part.size(); ++i) {
    ++count[separator.half[i]];
    for (Index k = part.start[i]; k < part.start[i + 1]; ++k) {
      const int both = separator.half[i] + separator.half[part.neighbor[k]];
      const bool crosses = separator.half[i] != kSeparator &&
                           separator.half[part.neighbor[k]] != kSeparator && both == 1;
      ASSERT_FALSE(crosses) << i << " beside " << part.neighbor[k];
    }
  }
  EXPECT_EQ(separator.count, count);
}

class SeparatorOf : public testing::TestWithParam<ZooMesh> {
 protected:
  GraphPart part = part_of(*GetParam().mesh());
};

TEST_P(SeparatorOf, APartKeepsItsHalvesApart) { expect_separates(part, find_separator(part)); }

TEST_P(SeparatorOf, EveryPlaneKeepsTheHalvesApartAndAQuarterOnEachSide) {
  for (const Separator& cut : plane_cuts(part, 9, 1)) {
    expect_separates(part, cut);
    const Index separator = cut.count[kSeparator];
    EXPECT_GE(std::min(cut.count[kLeft], cut.count[kRight]) + separator,
              static_cast<Index>(kSmallestShare * part.size()));
  }
}

TEST_P(SeparatorOf, APlaneNeverGrowsByRefinement) {
  for (Separator cut : plane_cuts(part, 9, 1)) {
    const Index before = cut.count[kSeparator];
    refine_separator(part, cut);
    expect_separates(part, cut);
    EXPECT_LE(cut.count[kSeparator], before);
  }
}

INSTANTIATE_TEST_SUITE_P(Zoo, SeparatorOf, testing::ValuesIn(zoo()), zoo_name);

TEST(Separator, OfATubeIsARing) {
  // 200 rings of 20: no cut is smaller than a ring. It is tilted, so that no axis lies along it.
  const auto tube = finish(torus(200, 20, 0.1));
  GraphPart part = part_of(*tube);
  const Separator separator = find_separator(part);
  EXPECT_LE(separator.count[kSeparator], 2 * 20);  // a torus takes two
}

TEST(Separator, FindsADiagonalCut) {
  // A thin band along the diagonal of x and y: a plane across an axis leaves more than one across
  // the band.
  GraphPart part = part_of(*finish(plane_grid(120, 10, 1, 1)));
  const float c = std::sqrt(0.5F);
  for (auto& p : part.position) p = {c * (12 * p[0] - p[1]), c * (12 * p[0] + p[1]), 0};
  const std::vector<Separator> cuts = plane_cuts(part, 1, 1);
  ASSERT_FALSE(cuts.empty());
  EXPECT_EQ(cuts[0].count[kSeparator], 11);
}

}  // namespace
}  // namespace geotherm::test
