// SPDX-License-Identifier: MIT
#include "geotherm/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "geotherm/mesh_report.h"
#include "solver/core/text.h"
#include "solver/geometry/clean_faces.h"
#include "solver/mesh/merge_close.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

/// Every face with vertices of its own, moved at random by up to `off` along each axis.
Draft torn(const Draft& whole, double off, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-off, off);
  Draft draft;
  for (const Face& face : whole.faces) {
    Face own;
    for (int k = 0; k < 3; ++k) {
      const Vec3 by(shift(random), shift(random), shift(random));
      own[k] = draft.add(whole.positions[face[k]] + by);
    }
    draft.faces.push_back(own);
  }
  return draft;
}

std::vector<Index> merged_slowly(const std::vector<Vec3>& points, double distance) {
  std::vector<Index> lowest(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) lowest[i] = static_cast<Index>(i);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!((points[i] - points[j]).norm() <= distance)) continue;
      const Index low = std::min(lowest[i], lowest[j]), high = std::max(lowest[i], lowest[j]);
      for (Index& one : lowest) one = one == high ? low : one;
    }
  }
  return lowest;
}

TEST(MergeClose, FindsWhatComparingAllPairsFinds) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Vec3> points;
  for (int i = 0; i < 300; ++i) points.emplace_back(uniform(random), uniform(random), 0);
  for (int i = 0; i < 60; ++i) points.push_back(points[static_cast<std::size_t>(i) * 3]);
  for (const double distance : {0.0, 0.01, 0.03, 0.05, 0.1, 0.5, 2.0}) {
    EXPECT_EQ(merge_close(points, distance), merged_slowly(points, distance)) << distance;
  }
}

TEST(MergeClose, TakesEqualPlacesOfAnySizeForOneAndNoOthers) {
  for (const double size : {1e-300, 1e-8, 1.0, 1e150, 1e300}) {
    const Vec3 p(size, -size, size), q(std::nextafter(size, 2 * size), -size, size);
    const std::vector<Vec3> points = {p, q, p, Vec3(-0.0, 0, 0), Vec3::Zero(), q};
    EXPECT_EQ(merge_close(points, 0), (std::vector<Index>{0, 1, 0, 3, 3, 1})) << size;
    EXPECT_EQ(merge_close(points, size / 2), (std::vector<Index>{0, 0, 0, 3, 3, 0})) << size;
  }
}

TEST(Weld, MakesATornSurfaceWholeAndKeepsTheNumbers) {
  const Draft whole = sphere(2);
  const double off = 1e-4;
  const MeshPtr mesh = finish(torn(whole, off, 3));
  const auto welded = weld(*mesh, 8 * off);
  ASSERT_TRUE(welded) << welded.error().message;
  EXPECT_EQ(welded->mesh.vertex_count(), mesh->vertex_count());
  EXPECT_EQ(welded->mesh.face_count(), mesh->face_count());
  EXPECT_EQ(welded->merged, mesh->vertex_count() - whole.vertex_count());
  const MeshReport report = inspect_mesh(welded->mesh);
  EXPECT_EQ(report.boundary_edges, 0);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.merged_vertices, welded->merged);
  EXPECT_EQ(report.unreferenced_vertices, 0) << "what is merged belongs to faces";
  EXPECT_EQ(report.duplicate_positions, 0);
  for (Index f = 0; f < mesh->face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(welded->mesh.faces()[f][k], welded->mesh.standing_for(mesh->faces()[f][k]));
    }
  }
}

TEST(Weld, LeavesAWholeMeshAsItIs) {
  const MeshPtr mesh = finish(torus(20, 10, 0.4));
  const auto welded = weld(*mesh, 0);
  ASSERT_TRUE(welded);
  EXPECT_EQ(welded->merged, 0);
  EXPECT_TRUE(std::ranges::equal(welded->mesh.faces(), mesh->faces()));
}

TEST(Weld, SaysWhyADistanceDoesNotDo) {
  const MeshPtr mesh = finish(sphere(1));
  for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const auto none = weld(*mesh, bad);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::kBadInput);
  }
  const auto collapsed = weld(*mesh, 10);
  ASSERT_FALSE(collapsed);
  EXPECT_NE(sentence(collapsed.error()).find("every face collapses"), std::string::npos);
}

TEST(FindCracks, FindsTheDistanceThatClosesThem) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Draft whole = transformed(sphere(2), scale, Vec3(3, 2, 1) * scale, true);
    const CrackReport cut = find_cracks(*finish(torn(whole, 0, 1)));
    EXPECT_EQ(cut.distance, 0);
    EXPECT_EQ(cut.closed_edges, cut.boundary_edges);
    const MeshPtr torn_mesh = finish(torn(whole, 1e-4 * scale, 1));
    const CrackReport cracks = find_cracks(*torn_mesh);
    EXPECT_GT(cracks.distance, 0);
    EXPECT_EQ(cracks.closed_edges, cracks.boundary_edges);
    const auto welded = weld(*torn_mesh, cracks.distance);
    ASSERT_TRUE(welded);
    EXPECT_EQ(welded->merged, cracks.vertices);
    EXPECT_EQ(inspect_mesh(welded->mesh).boundary_edges, 0);
  }
}

TEST(FindCracks, LeavesAHoleAlone) {
  EXPECT_EQ(find_cracks(*finish(plane_grid(8, 8, 1, 1))).vertices, 0);
  EXPECT_EQ(find_cracks(*finish(sphere(1))).vertices, 0);
}

/// Two sheets of 4 x 4 squares of side 1, the second `gap` beside the first.
Draft two_sheets(double gap) {
  Draft draft = plane_grid(4, 4, 4, 4);
  const Draft other = transformed(draft, 1, Vec3(4 + gap, 0, 0), false);
  append(draft, other);
  return draft;
}

TEST(FindCracks, RecommendsNoDistanceThatMakesAnInnerEdgeCollapse) {
  Draft sheets = two_sheets(5e-3);
  const CrackReport whole = find_cracks(*finish(sheets));
  EXPECT_EQ(whole.vertices, 5);
  EXPECT_EQ(whole.closed_edges, 8);
  // An inner vertex is put beside its neighbour, nearer than the sheets are to each other.
  const Vec3 middle = sheets.positions[12];
  sheets.positions[13] = middle + Vec3(0, 2e-3, 0);
  const MeshPtr mesh = finish(sheets);
  const auto welded = weld(*mesh, 6e-3);
  ASSERT_TRUE(welded) << welded.error().message;
  EXPECT_GT(inspect_mesh(welded->mesh).repeated_corner_faces, 0);
  EXPECT_EQ(find_cracks(*mesh).vertices, 0);
}

TEST(FindCracks, LooksPastFacesThatHaveCollapsedAlready) {
  Draft sheets = two_sheets(5e-3);
  sheets.positions[13] = sheets.positions[12];
  const CrackReport cracks = find_cracks(*finish(sheets));
  EXPECT_EQ(cracks.closed_edges, 8);
  EXPECT_EQ(cracks.vertices, 6) << "the two at one place as well";
}

TEST(FindCracks, NamesADistanceOfOneDigit) {
  for (const double scale : {1e-7, 2.999e-3, 0.77, 1e5, 9.99e9}) {
    const Draft cut = transformed(two_sheets(5e-3), scale, Vec3::Zero(), false);
    const std::string text = number_text(find_cracks(*finish(cut)).distance);
    const std::string digits = text.substr(0, text.find('e'));
    EXPECT_EQ(std::ranges::count_if(digits, [](char c) { return c >= '1' && c <= '9'; }), 1)
        << text;
  }
}

}  // namespace
}  // namespace geotherm::test
