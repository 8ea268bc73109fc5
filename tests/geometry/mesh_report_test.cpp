// SPDX-License-Identifier: MIT
#include "geotherm/mesh_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/geometry/clean_faces.h"
#include "solver/geometry/intrinsic_mesh.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

/// Sums of some thousand terms.
constexpr double kReportRoundOff = 1e-12;

MeshReport report_of(Draft draft) { return inspect_mesh(*finish(std::move(draft))); }

class MeshReports : public testing::TestWithParam<ZooMesh> {};

TEST_P(MeshReports, AgreeWithWhatTheMeshIsKnownToBe) {
  const ZooMesh& zoo = GetParam();
  const MeshPtr mesh = zoo.mesh();
  const MeshReport report = inspect_mesh(*mesh);
  EXPECT_EQ(report.vertices, mesh->vertex_count());
  EXPECT_EQ(report.faces, mesh->face_count());
  if (zoo.tags & kClosed) {
    EXPECT_EQ(report.boundary_edges, 0);
  }
  if (zoo.tags & kBorder) {
    EXPECT_GT(report.boundary_edges, 0);
  }
  EXPECT_EQ(report.boundary_loops > 0, report.boundary_edges > 0);
  if (zoo.tags & kManifold) {
    EXPECT_EQ(report.nonmanifold_edges, 0);
    EXPECT_EQ(report.nonmanifold_vertices, 0);
    EXPECT_EQ(report.edge_components, report.components);
  }
  if (zoo.tags & kConnected) {
    EXPECT_EQ(report.components, 1);
    EXPECT_EQ(report.unreferenced_vertices, 0);
  }
  if (zoo.tags & kRegular) {
    EXPECT_EQ(report.degenerate_faces, 0);
    EXPECT_EQ(report.duplicate_faces, 0);
  }
}

TEST_P(MeshReports, GiveTheMeanEdgeLengthOfTheSolver) {
  const MeshPtr mesh = GetParam().mesh();
  EXPECT_EQ(inspect_mesh(*mesh).mean_edge_length,
            mean_edge_length(mesh->positions(), clean_faces(*mesh).edges));
}

INSTANTIATE_TEST_SUITE_P(Zoo, MeshReports, testing::ValuesIn(zoo()), zoo_name);

TEST(MeshReport, MeasuresAGrid) {
  const MeshReport report = report_of(plane_grid(3, 4, 3, 4));  // unit squares
  EXPECT_EQ(report.edges, 3 * 5 + 4 * 4 + 12);
  EXPECT_EQ(report.boundary_edges, 14);
  EXPECT_EQ(report.boundary_loops, 1);
  EXPECT_EQ(report.euler_characteristic, 1);
  EXPECT_NEAR(report.area, 12, 12 * kReportRoundOff);
  EXPECT_NEAR(report.smallest_angle, 45, 45 * kReportRoundOff);
  EXPECT_NEAR(report.shortest_edge, 1, kReportRoundOff);
  EXPECT_NEAR(report.longest_edge, std::numbers::sqrt2, kReportRoundOff);
  EXPECT_NEAR(report.mean_quality, 4 * std::numbers::sqrt3 * 0.5 / 4, kReportRoundOff);
  EXPECT_EQ(report.box_min, Vec3(0, 0, 0));
  EXPECT_EQ(report.box_max, Vec3(3, 4, 0));
}

TEST(MeshReport, KnowsTopology) {
  EXPECT_EQ(report_of(sphere(2)).euler_characteristic, 2);
  EXPECT_EQ(report_of(torus(12, 8, 0.4)).euler_characteristic, 0);
  EXPECT_EQ(report_of(prism(12, 4, 1)).boundary_loops, 2);
  EXPECT_TRUE(report_of(torus(12, 8, 0.4)).orientable);
  EXPECT_FALSE(report_of(moebius(12, 2)).orientable);
}

TEST(MeshReport, CountsWhatIsWrong) {
  Draft draft = plane_grid(2, 2, 2, 2);
  draft.add(Vec3(9, 9, 9));                         // in no face
  draft.add(draft.positions[0]);                    // a copy of vertex 0, in no face
  draft.faces.push_back({0, 0, 1});                 // repeats a corner
  draft.faces.push_back(draft.faces[0]);            // twice
  std::swap(draft.faces[2][0], draft.faces[2][1]);  // turned
  const Index a = draft.add(Vec3(5, 0, 0));
  draft.add(Vec3(6, 0, 0));
  draft.add(Vec3(7, 0, 0));
  draft.faces.push_back({a, a + 1, a + 2});  // no area; a component of its own
  const MeshReport report = report_of(std::move(draft));
  EXPECT_EQ(report.components, 2);
  EXPECT_EQ(report.unreferenced_vertices, 2);
  EXPECT_EQ(report.duplicate_positions, 1);
  EXPECT_EQ(report.repeated_corner_faces, 1);
  EXPECT_EQ(report.degenerate_faces, 2);
  EXPECT_EQ(report.duplicate_faces, 1);
  EXPECT_EQ(report.inconsistent_faces, 1);
  EXPECT_EQ(report.smallest_angle, 0);
}

TEST(MeshReport, CountsVerticesAtWhichTwoFansMeet) {
  Draft draft = plane_grid(1, 1, 1, 1);
  const Index a = draft.add(Vec3(-1, 0, 0));
  const Index b = draft.add(Vec3(-1, -1, 0));
  draft.faces.push_back({0, a, b});
  const MeshReport report = report_of(std::move(draft));
  EXPECT_EQ(report.nonmanifold_vertices, 1);
  EXPECT_EQ(report.nonmanifold_edges, 0);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.edge_components, 2);
}

TEST(MeshReport, IsTheSameAtEveryScale) {
  const MeshReport one = report_of(torus(16, 8, 0.4));
  for (const double scale : {1e-100, 1e-9, 1e9, 1e100}) {
    const MeshReport other = report_of(transformed(torus(16, 8, 0.4), scale, Vec3::Zero(), false));
    EXPECT_EQ(other.degenerate_faces, 0) << scale;
    EXPECT_NEAR(other.mean_edge_length / scale, one.mean_edge_length, kReportRoundOff) << scale;
    EXPECT_NEAR(other.area / scale / scale, one.area, kReportRoundOff * one.area) << scale;
    EXPECT_NEAR(other.smallest_angle, one.smallest_angle, 1e-9) << scale;
  }
}

}  // namespace
}  // namespace geotherm::test
