// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/support/cells.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/solve.h"

// The heat method on polygons.
namespace geotherm::test {
namespace {

TEST(Domains, TrianglesAsPolygonsHaveTheDistancesOfTheTriangleMesh) {
  const auto mesh = finish(plane_grid(20, 20, 1, 1));
  PolygonMesh polygons{{mesh->positions().begin(), mesh->positions().end()}, {0}, {}};
  for (const Face& face : mesh->faces()) {
    polygons.corners.insert(polygons.corners.end(), face.begin(), face.end());
    polygons.start.push_back(std::ssize(polygons.corners));
  }
  auto made = cells_of(polygons);
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->notes.empty());
  HeatOptions options;
  options.variant = Variant::kClassic;
  options.laplacian = LaplacianKind::kCotan;
  options.time_step = {TimeRule::kAbsolute, 1, 0.003};
  const auto sources = SourceSet::of_vertices({0, 210});
  const auto as_polygons =
      solve_cells(std::make_shared<const CellComplex>(*std::move(made)), sources, options);
  const auto as_mesh = HeatMethod::build(mesh, options)->solve(sources);
  EXPECT_LE(relative_difference(as_polygons.distances, as_mesh->distances), 1e-5);
}

/// A square cut into n x n quads, of which each is bent out of the plane by `bend` of its side, or
/// into concave pairs.
PolygonMesh quads(Index n, double bend) {
  PolygonMesh out;
  out.start.push_back(0);
  const auto number = [n](Index i, Index j) { return i * (n + 1) + j; };
  for (Index i = 0; i <= n; ++i) {
    for (Index j = 0; j <= n; ++j) {
      const double up = (i + j) % 2 == 0 ? bend / n : 0;
      out.positions.push_back({double(i) / n, double(j) / n, up});
    }
  }
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      out.corners.insert(out.corners.end(),
                         {number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)});
      out.start.push_back(std::ssize(out.corners));
    }
  }
  return out;
}

TEST(Domains, OnQuadsErrorsFallWithTheSides) {
  double before = 1;
  for (const Index n : {16, 32, 64}) {
    const auto cells = std::make_shared<const CellComplex>(*cells_of(quads(n, 0)));
    const Index middle = cells->vertices / 2;
    const auto result = solve_cells(cells, SourceSet::of_vertices({middle}));
    const double error = straight_error(*cells, result.distances, cells->positions[middle]);
    EXPECT_LE(error, 0.7 * before) << n;  // first order in the middle, less at the border
    before = error;
  }
  EXPECT_LE(before, 0.02);
}

TEST(Domains, QuadsThatAreNotPlanarKeepTheirDistances) {
  // Bent by a twentieth of a side, ways grow by less than its square.
  const auto cells = std::make_shared<const CellComplex>(*cells_of(quads(48, 0.05)));
  const Index middle = cells->vertices / 2;
  const auto result = solve_cells(cells, SourceSet::of_vertices({middle}));
  EXPECT_LE(straight_error(*cells, result.distances, cells->positions[middle]), 0.02);
}

TEST(Domains, FacesWithoutAreaAreLeftOutAndSaid) {
  PolygonMesh mesh = quads(4, 0);
  mesh.corners.insert(mesh.corners.end(), {0, 1, 0, 2, 2});
  mesh.start.push_back(mesh.start.back() + 3);
  mesh.start.push_back(mesh.start.back() + 2);
  const auto made = cells_of(mesh);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->cell_count(), 16);
  ASSERT_EQ(made->notes.size(), 1U);
  EXPECT_NE(made->notes[0].message.find("2 faces were left out"), std::string::npos);
}

}  // namespace
}  // namespace geotherm::test
