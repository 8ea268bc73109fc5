// SPDX-License-Identifier: MIT
// What a method decides about a mesh before there is a source.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "solver/geometry/intrinsic_surface.h"
#include "solver/geometry/tufted_cover.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/operators.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// Sums over some thousand edges or faces.
constexpr double kRoundOff = 1e-12;

class Setup : public testing::TestWithParam<ZooMesh> {
 protected:
  MeshPtr mesh = GetParam().mesh();
  Intrinsic in = intrinsic_of(*mesh, false);

  /// Then each has a time of its own (component_times_test.cpp).
  bool has_several_components() const {
    return face_components(in.clean.faces, mesh->vertex_count()).count > 1;
  }
};

TEST_P(Setup, TakesTheTimeFromTheMeanEdge) {
  if (has_several_components()) return;
  const auto p = mesh->positions();
  double sum = 0;
  for (Index e = 0; e < in.clean.edges.edge_count(); ++e) {
    sum += (p[in.clean.edges.low(e)] - p[in.clean.edges.high(e)]).norm();
  }
  const double mean = sum / in.clean.edges.edge_count();
  HeatOptions options;
  options.time_step.factor = 2.5;
  const HeatMethod method = method_of(mesh, options);
  EXPECT_NEAR(method.t(), 2.5 * mean * mean * method.grading(), kRoundOff * mean * mean);
  if (method.refinement().large_faces == 0) {
    EXPECT_EQ(method.grading(), 1);
  }
}

TEST_P(Setup, TakesTheTimeAsGiven) {
  HeatOptions options;
  options.time_step = {TimeRule::kAbsolute, 1, 0.0123};
  EXPECT_EQ(method_of(mesh, options).t(), 0.0123);
}

TEST_P(Setup, FlipsEdgesWhereNeededUnlessToldNotTo) {
  const bool needed = count_non_delaunay(in.mesh) > 0;
  const HeatMethod chosen = method_of(mesh);
  if (chosen.refinement().points > 0) {
    EXPECT_EQ(chosen.laplacian(), LaplacianKind::kRefined);
  } else if (faces_that_need_cover(in.clean, mesh->vertex_count()).empty()) {
    EXPECT_EQ(chosen.flips() > 0, needed);
    EXPECT_EQ(chosen.laplacian(),
              needed ? LaplacianKind::kIntrinsicDelaunay : LaplacianKind::kCotan);
  } else {
    EXPECT_EQ(chosen.laplacian(), LaplacianKind::kTufted);
  }
  HeatOptions options;
  options.laplacian = LaplacianKind::kCotan;
  EXPECT_EQ(method_of(mesh, options).flips(), 0);
}

TEST_P(Setup, WarnsWhereFacesWereLeftOutOrLengthened) {
  const bool left_out = in.clean.repeated_corner + in.clean.duplicate > 0;
  const bool lengthened = in.mesh.mollified.most > 0;
  HeatOptions as_given;
  as_given.laplacian = LaplacianKind::kCotan;
  EXPECT_EQ(!method_of(mesh, as_given).warnings().empty(), left_out || lengthened);
  // Flips may leave nothing to lengthen.
  const auto flipped = build_intrinsic_surface(
      mesh, {FlipRule::kWhereNeeded, CoverRule::kWhereNeeded, RefineRule::kWhereNeeded});
  EXPECT_EQ(!method_of(mesh).warnings().empty(),
            left_out || flipped->intrinsic.mollified.most > 0 || !flipped->refinement.complete);
}

INSTANTIATE_TEST_SUITE_P(Zoo, Setup, testing::ValuesIn(zoo()), zoo_name);

class SetupOfRegularMeshes : public Setup {};

TEST_P(SetupOfRegularMeshes, TakesTheTimeFromTheMeanFaceArea) {
  if (has_several_components()) return;
  const auto p = mesh->positions();
  double area = 0;
  for (const auto& [a, b, c] : mesh->faces()) area += (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
  HeatOptions options;
  options.time_step = {TimeRule::kMeanFaceArea, 3, 0};
  const double expected = 3 * area / mesh->face_count();
  EXPECT_NEAR(method_of(mesh, options).t(), expected, 1e-9 * expected);  // area from lengths
}

INSTANTIATE_TEST_SUITE_P(Zoo, SetupOfRegularMeshes, testing::ValuesIn(zoo(kRegular)), zoo_name);

TEST(SetupMemory, IsReportedWhereThereIsAFactor) {
  const MeshPtr mesh = finish(sphere(3));
  for (const std::string& name : direct_backends()) {
    EXPECT_GT(method_of(mesh, with_backend(name)).memory_mb(), 0) << name;
  }
  for (const std::string& name : iterative_backends()) {
    EXPECT_EQ(method_of(mesh, with_backend(name)).memory_mb(), 0) << name;
  }
}

}  // namespace
}  // namespace geotherm::test
