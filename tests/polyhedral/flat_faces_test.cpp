// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geotherm/build_method.h"
#include "tests/support/shapes.h"

// Flat obtuse faces, whose distances are those of the plane they lie in. What lengthens edges so
// that triangle inequalities are strict makes a triangle of this shape many times as high.
namespace geotherm::test {
namespace {

constexpr Index kRows = 200, kColumns = 10;

/// Rows of faces as long as 1 and as high as `height`, every other row moved by half a face.
MeshPtr sheared_rows(double height) {
  Draft draft = plane_grid(kColumns, kRows, kColumns, kRows * height);
  for (Index j = 1; j <= kRows; j += 2) {
    for (Index i = 0; i <= kColumns; ++i) draft.positions[grid_vertex(kColumns, i, j)].x() += 0.5;
  }
  draft.faces.clear();
  for (Index j = 0; j < kRows; ++j) {
    for (Index i = 0; i < kColumns; ++i) {
      const Index a = grid_vertex(kColumns, i, j), b = a + 1, c = a + kColumns + 1, d = c + 1;
      if (j % 2 == 0) {
        draft.faces.insert(draft.faces.end(), {{a, b, c}, {b, d, c}});
      } else {
        draft.faces.insert(draft.faces.end(), {{a, d, c}, {a, b, d}});
      }
    }
  }
  return finish(draft);
}

std::vector<double> distances_by(MethodKind method, const MeshPtr& mesh, Index source) {
  MethodOptions options;
  options.method = method;
  return (*build_method(mesh, options))->solve(SourceSet::of_vertices({source}))->distances;
}

class FlatFaces : public testing::TestWithParam<MethodKind> {};

TEST_P(FlatFaces, AreAsHighAsTheFileHasThem) {
  // Heat is within a hundredth on well-shaped faces; the others are exact straight up.
  const double allowed = GetParam() == MethodKind::kHeat ? 1e-2 : 1e-6;
  for (const double height : {1e-3, 1e-5}) {
    const auto d = distances_by(GetParam(), sheared_rows(height), kColumns / 2);
    for (Index j = 2; j <= kRows; j += 2) {
      const double line = j * height;
      EXPECT_NEAR(d[grid_vertex(kColumns, kColumns / 2, j)], line, allowed * kRows * height)
          << height << ", row " << j;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(By, FlatFaces,
                         testing::Values(MethodKind::kHeat, MethodKind::kWavefront,
                                         MethodKind::kExact));

}  // namespace
}  // namespace geotherm::test
