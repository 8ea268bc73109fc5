// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "tests/support/cells.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/polygons.h"
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

TEST(Domains, PolygonsWithoutADirectionAreCountedAsPolygons) {
  PolygonMesh strip = quads(4, 0);
  strip.start.resize(5);
  strip.corners.resize(16);
  HeatOptions options;
  options.boundary = BoundaryRule::kDirichlet;  // all vertices are on it
  const auto result = solve_cells(shared(cells_of(strip)), SourceSet::of_vertices({0}), options);
  EXPECT_TRUE(std::ranges::any_of(result.warnings, [](const Warning& warning) {
    return warning.message.starts_with("the heat has no direction on 3 of 4 polygons");
  }));
}

/// Of every four squares of a plane three are one face, which is concave.
PolygonMesh corner_tiles() {
  constexpr Index kSquares = 40;
  PolygonMesh out = quads(kSquares, 0);
  out.start = {0};
  out.corners.clear();
  const auto at = [](Index i, Index j) { return i * (kSquares + 1) + j; };
  for (Index i = 0; i < kSquares; i += 2) {
    for (Index j = 0; j < kSquares; j += 2) {
      out.corners.insert(out.corners.end(),
                         {at(i, j), at(i + 1, j), at(i + 2, j), at(i + 2, j + 1), at(i + 1, j + 1),
                          at(i + 1, j + 2), at(i, j + 2), at(i, j + 1)});
      out.start.push_back(std::ssize(out.corners));
      out.corners.insert(out.corners.end(),
                         {at(i + 1, j + 1), at(i + 2, j + 1), at(i + 2, j + 2), at(i + 1, j + 2)});
      out.start.push_back(std::ssize(out.corners));
    }
  }
  return out;
}

/// Hexagons over a wave.
PolygonMesh honeycomb() {
  constexpr int kRows = 26;
  PolygonMesh out{{}, {0}, {}};
  std::map<std::pair<int, int>, Index> numbers;  // by thirds and halves of a side
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kRows; ++column) {
      const int x = 3 * column, y = 2 * row + column % 2;
      for (const auto& [dx, dy] : {std::pair{2, 0}, {1, 1}, {-1, 1}, {-2, 0}, {-1, -1}, {1, -1}}) {
        const auto [found, is_new] =
            numbers.try_emplace({x + dx, y + dy}, static_cast<Index>(out.positions.size()));
        if (is_new) {
          const double u = (x + dx) / 2.0 / kRows, v = (y + dy) * std::sqrt(0.75) / kRows;
          out.positions.emplace_back(u, v, 0.05 * std::sin(3 * u) * std::cos(2 * v));
        }
        out.corners.push_back(found->second);
      }
      out.start.push_back(std::ssize(out.corners));
    }
  }
  return out;
}

/// Chevrons five times as long as high: their virtual vertices lie beside a corner.
PolygonMesh chevrons() {
  constexpr Index kSide = 40;
  PolygonMesh out = quads(kSide, 0);
  for (Index v = 0; v < std::ssize(out.positions); ++v) {
    const Index column = v / (kSide + 1), row = v % (kSide + 1);
    out.positions[v] = Vec3(5 * column, row + column % 2, 0);
  }
  out.start = {0};
  out.corners.clear();
  for (Index i = 0; i < kSide; i += 2) {
    for (Index j = 0; j < kSide; ++j) {
      const Index a = i * (kSide + 1) + j, b = a + kSide + 1, c = b + kSide + 1;
      out.corners.insert(out.corners.end(), {a, b, c, c + 1, b + 1, a + 1});
      out.start.push_back(std::ssize(out.corners));
    }
  }
  return out;
}

struct PolygonCase {
  PolygonMesh (*mesh)();
  double most;  ///< error, in errors of their triangles; users ask for no more than 1.3
};

class Polygons : public testing::TestWithParam<PolygonCase> {};

TEST_P(Polygons, HaveErrorsLikeThoseOfTheirTriangles) {
  const auto [of_polygons, of_triangles] = errors_beside_triangles(
      GetParam().mesh(), MethodKind::kWavefront, std::array<Index, 3>{5, 400, 900});
  EXPECT_GT(of_triangles, 0);
  EXPECT_LE(of_polygons, GetParam().most * of_triangles);
}

TEST(Polygons, AreNearExactBesideSources) {
  // Exact in the plane, whose triangles at virtual vertices are not obtuse, from corners, from
  // within faces and from a side.
  const auto cells = shared(cells_of(quads(40, 0)));
  for (const std::vector<double>& weights :
       {std::vector<double>{0.1, 0.2, 0.4, 0.3}, {0.3, 0.7, 0, 0}, {0, 0.6, 0.4, 0}}) {
    SourceSet sources = SourceSet::of_vertices({41 * 20 + 20});
    sources.cell_points.push_back({40 * 8 + 9, weights});
    const auto& corners = cells->corners_of(4 * (40 * 8 + 9));
    Vec3 inside = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) inside += weights[k] * cells->positions[corners[k]];
    const auto distances = solve_cells(cells, sources).distances;
    int count = 0;
    for (std::size_t v = 0; v < distances.size(); ++v) {
      const double line = std::min((cells->positions[v] - cells->positions[41 * 20 + 20]).norm(),
                                   (cells->positions[v] - inside).norm());
      if (line > 1.5 / 40) continue;
      ++count;
      EXPECT_NEAR(distances[v], line, 1e-9);
    }
    EXPECT_GT(count, 12);
  }
}

TEST(Polygons, OfLongFacesAreNearExactAsWell) {
  // Eight times as long as wide, corners moved: their fans are flipped before they are marched
  // over.
  const auto cells = shared(cells_of(moved_quads(40, 8, 0.25)));
  const Index source = 41 * 20 + 20;
  const auto distances = solve_cells(cells, SourceSet::of_vertices({source})).distances;
  double off = 0, sum = 0;
  for (Index v = 0; v < cells->vertices; ++v) {
    const double line = (cells->positions[v] - cells->positions[source]).norm();
    if (line > 0.15) continue;  // six sides, and most of one the other way
    off += distances[v] - line;
    sum += line;
  }
  EXPECT_LE(off, 0.05 * sum);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Polygons,
                         testing::Values(PolygonCase{[] { return quad_torus(); }, 1.3},
                                         PolygonCase{honeycomb, 1.3}, PolygonCase{chevrons, 1.3},
                                         PolygonCase{corner_tiles, 1.3}));

TEST(Domains, PolygonsWithTooManyCornersAreOneLine) {
  PolygonMesh disc{{}, {0, 1200}, {}};
  for (Index k = 0; k < 1200; ++k) {
    const double a = 2 * std::numbers::pi * k / 1200;
    disc.positions.emplace_back(std::cos(a), std::sin(a), 0);
    disc.corners.push_back(k);
  }
  const auto made = cells_of(disc);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("has 1200 corners"), std::string::npos);
  EXPECT_EQ(triangulated(disc)->face_count(), 1198);
}

TEST(Domains, QuadsThatAreNotPlanarKeepTheirDistances) {
  // Bent by a twentieth of a side, ways grow by less than its square.
  const auto cells = std::make_shared<const CellComplex>(*cells_of(quads(48, 0.05)));
  const Index middle = cells->vertices / 2;
  const auto result = solve_cells(cells, SourceSet::of_vertices({middle}));
  EXPECT_LE(straight_error(*cells, result.distances, cells->positions[middle]), 0.02);
}

TEST(Domains, VirtualVerticesThatDoNotFitAreOneLine) {
  const CellComplex whole = *cells_of(quads(4, 0));
  CellComplex few = whole, unnumbered = whole;
  few.virtual_vertices.pop_back();
  unnumbered.numbers.clear();
  for (const CellComplex& cells : {few, unnumbered}) {
    const auto valid = check_cells(cells);
    ASSERT_FALSE(valid);
    EXPECT_NE(valid.error().message.find("virtual vertices"), std::string::npos);
  }
}

TEST(Domains, NumbersOfCellsBeginAtZero) {
  CellComplex cells = *cells_of(quads(4, 0));
  EXPECT_TRUE(check_cells(cells));
  cells.numbers.front() = -1;
  const auto valid = check_cells(cells);
  ASSERT_FALSE(valid);
  EXPECT_NE(valid.error().message.find(" 0 is -1"), std::string::npos) << valid.error().message;
}

TEST(Domains, SharesThatAreNoPartsOfOneAreOneLine) {
  const CellComplex whole = *cells_of(quads(4, 0));
  CellComplex few = whole, more = whole, negative = whole;
  few.shares.pop_back();
  more.shares[5] += 0.5;
  negative.shares[0] -= 1;
  negative.shares[1] += 1;
  for (const CellComplex& cells : {few, more, negative}) {
    const auto valid = check_cells(cells);
    ASSERT_FALSE(valid);
    EXPECT_NE(valid.error().message.find("shares"), std::string::npos);
  }
}

double area_of(const CellComplex& cells) {
  return std::accumulate(cells.measures.begin(), cells.measures.end(), 0.0);
}

TEST(Domains, FacesWithoutAreaAreLeftOutAndSaid) {
  PolygonMesh mesh = quads(4, 0);
  mesh.corners.insert(mesh.corners.end(), {0, 1, 0, 2, 2});
  mesh.start.push_back(mesh.start.back() + 3);
  mesh.start.push_back(mesh.start.back() + 2);
  const auto made = cells_of(mesh);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->cell_count(), 16 * 4) << "triangles";
  ASSERT_EQ(made->notes.size(), 1U);
  EXPECT_NE(made->notes[0].message.find("2 faces were left out"), std::string::npos);
}

TEST(Domains, CornersSaidTwiceInTurnAreOneAndFacesThatMeetThemselvesAreSaid) {
  PolygonMesh mesh = quads(4, 0);
  const double before = area_of(*cells_of(mesh));
  const Index last = mesh.corners.back();
  mesh.corners.push_back(last);  // of the last square
  ++mesh.start.back();
  const auto same = cells_of(mesh);
  ASSERT_TRUE(same) << sentence(same.error());
  EXPECT_TRUE(same->notes.empty());
  EXPECT_EQ(area_of(*same), before);
  mesh.corners.insert(mesh.corners.end(), {0, 1, 6, 5, 1, 2});
  mesh.start.push_back(mesh.start.back() + 6);
  const auto met = cells_of(mesh);
  ASSERT_TRUE(met);
  ASSERT_EQ(met->notes.size(), 1U);
  EXPECT_EQ(sentence(met->notes[0]),
            "1 face was left out: no area, or a corner twice; solve on the triangles that it is "
            "cut into");
}

}  // namespace
}  // namespace geotherm::test
