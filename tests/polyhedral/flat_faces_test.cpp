// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geotherm/build_method.h"
#include "solver/geometry/intrinsic_surface.h"
#include "tests/support/dice.h"
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
  for (const double height : {1e-3, 2e-5}) {
    const auto d = distances_by(GetParam(), sheared_rows(height), kColumns / 2);
    for (Index j = 2; j <= kRows; j += 2) {
      const double line = j * height;
      EXPECT_NEAR(d[grid_vertex(kColumns, kColumns / 2, j)], line, allowed * kRows * height)
          << height << ", row " << j;
    }
  }
}

/// Columns of many widths and rows of which every third is `thin`, turned in space and rounded to
/// floats: what a program that clips surfaces writes.
Draft slivers(double thin, unsigned seed) {
  constexpr Index kCells = 30;
  Draft draft = plane_grid(kCells, kCells, 1, 1);
  Dice dice(seed);
  std::vector<double> x = {0}, y = {0};
  for (Index i = 0; i < kCells; ++i) {
    x.push_back(x.back() + dice.between(0.2, 1));
    y.push_back(y.back() + (i % 3 == 1 ? thin : dice.between(0.5, 1)));
  }
  const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
  for (Index j = 0; j <= kCells; ++j) {
    for (Index i = 0; i <= kCells; ++i) {
      const double shift = i > 0 && i < kCells ? dice.between(0, 0.15) : 0;
      draft.positions[grid_vertex(kCells, i, j)] =
          (turn * Vec3(x[i] + shift, y[j], 0)).cast<float>().cast<double>();
    }
  }
  return draft;
}

TEST(Slivers, HaveDistancesOfThePlaneAndFlipsThatEnd) {
  for (const double thin : {1e-3, 1e-5, 1e-6, 3e-7, 1e-7, 1e-12}) {
    for (unsigned seed = 0; seed < 4; ++seed) {
      const Draft draft = slivers(thin, seed);
      const MeshPtr mesh = finish(draft);
      const auto surface = build_intrinsic_surface(
          mesh, {.flip = FlipRule::kAlways, .strictness = Strictness::kHeights});
      ASSERT_TRUE(surface);
      EXPECT_LT(surface->flips, 10 * mesh->face_count()) << thin;
      for (const auto& lengths : surface->intrinsic.lengths) {
        ASSERT_GT(lay_out(lengths).height, 0) << thin;
      }
      const Index source = mesh->vertex_count() / 2;
      for (const MethodKind kind : {MethodKind::kExact, MethodKind::kWavefront}) {
        MethodOptions options;
        options.method = kind;
        const auto answer = (*build_method(mesh, options))->solve(SourceSet::of_vertices({source}));
        ASSERT_TRUE(answer) << sentence(answer.error());
        EXPECT_TRUE(std::isfinite(answer->quality.eikonal_error_mean)) << thin;
        if (kind != MethodKind::kExact) continue;
        double size = 0, error = 0;
        for (Index v = 0; v < mesh->vertex_count(); ++v) {
          const double line = (draft.positions[v] - draft.positions[source]).norm();
          size = std::max(size, line);
          error = std::max(error, std::abs(answer->distances[v] - line));
        }
        // Ten rows of faces that are made 1e-5 of their side high, and the rounding of floats.
        EXPECT_LT(error, 2e-5 * size) << thin << ", seed " << seed;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(By, FlatFaces,
                         testing::Values(MethodKind::kHeat, MethodKind::kWavefront,
                                         MethodKind::kExact));

}  // namespace
}  // namespace geotherm::test
