// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <utility>

#include "solver/geometry/polygon_flips.h"
#include "tests/support/cells.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/polygons.h"
#include "tests/support/solve.h"

// Polygons whose triangles at virtual vertices are far from Delaunay.
namespace geotherm::test {
namespace {

/// Triangles joined in pairs to quads, in the order of their edges, where that is a face without
/// corners twice.
PolygonMesh paired(const TriangleMesh& mesh) {
  std::map<std::pair<Index, Index>, Index> open;  // triangle at each directed side
  const auto faces = mesh.faces();
  for (Index f = 0; f < mesh.face_count(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) open[{faces[f][k], faces[f][(k + 1) % 3]}] = f;
  }
  std::vector<char> joined(faces.size(), 0);
  PolygonMesh out{{mesh.positions().begin(), mesh.positions().end()}, {0}, {}};
  const auto put = [&out](std::initializer_list<Index> corners) {
    out.corners.insert(out.corners.end(), corners);
    out.start.push_back(std::ssize(out.corners));
  };
  for (Index f = 0; f < mesh.face_count(); ++f) {
    for (std::size_t k = 0; k < 3 && joined[f] == 0; ++k) {
      const Index a = faces[f][k], b = faces[f][(k + 1) % 3], c = faces[f][(k + 2) % 3];
      const auto other = open.find({b, a});
      if (other == open.end() || other->second <= f || joined[other->second] != 0) continue;
      const Face& g = faces[other->second];
      const Index d = g[0] + g[1] + g[2] - a - b;
      if (d == c) continue;
      joined[f] = joined[other->second] = 1;
      put({a, d, b, c});
    }
    if (joined[f] == 0) put({faces[f][0], faces[f][1], faces[f][2]});
  }
  return out;
}

/// A torus of triangles that are long and lean, of radii 1 and 0.4.
PolygonMesh bad_torus() {
  constexpr Index kRound = 160, kAcross = 12;
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  for (Index i = 0; i < kRound; ++i) {
    for (Index j = 0; j < kAcross; ++j) {
      const double a = 2 * M_PI * (i + shift(random)) / kRound;
      const double b = 2 * M_PI * (j + shift(random) + 0.02 * i) / kAcross;
      const double r = 1 + 0.4 * std::cos(b);
      positions.emplace_back(r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b));
    }
  }
  const auto at = [](Index i, Index j) { return i % kRound * kAcross + j % kAcross; };
  for (Index i = 0; i + 1 < kRound; ++i) {
    for (Index j = 0; j < kAcross; ++j) {
      faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return paired(*TriangleMesh::build(std::move(positions), std::move(faces)));
}

std::shared_ptr<const FlippedPolygons> flipped(const CellComplex& cells) {
  const double unit = std::accumulate(cells.widths.begin(), cells.widths.end(), 0.0) /
                      static_cast<double>(cells.cell_count());
  const auto made = flip_polygons(cells, unit, 1, {});
  EXPECT_TRUE(made);
  return made ? *made : nullptr;
}

TEST(FlippedPolygons, OfBadShapeHaveErrorsLikeThoseOfTheirTriangles) {
  for (const PolygonMesh& polygons : {bad_torus(), moved_quads(24, 9, 0.3)}) {
    ASSERT_TRUE(flipped(*cells_of(polygons)));
    const auto [of_polygons, of_triangles] = errors_beside_triangles(
        polygons, MethodKind::kExact, std::array<Index, 5>{0, 111, 307, 500, 600});
    EXPECT_GT(of_triangles, 0);
    EXPECT_LE(of_polygons, 1.3 * of_triangles);
  }
}

TEST(FlippedPolygons, AreNoneWhereTrianglesAreNearlyDelaunay) {
  EXPECT_FALSE(flipped(*cells_of(moved_quads(12, 1, 0))));
  EXPECT_FALSE(flipped(*cells_of(moved_quads(12, 1.1, 0))));
  EXPECT_TRUE(flipped(*cells_of(moved_quads(12, 8, 0))));
}

TEST(FlippedPolygons, LeaveOtherFacesTheirCells) {
  // Of two squares of squares the upper one has long faces.
  PolygonMesh mesh = moved_quads(16, 1, 0);
  for (Vec3& at : mesh.positions) {
    if (at[0] > 0.5) at[0] = 0.5 + 9 * (at[0] - 0.5);
  }
  const CellComplex cells = *cells_of(mesh);
  const auto made = flipped(cells);
  ASSERT_TRUE(made);
  Index kept = 0;
  for (Index c = 0; c < cells.cell_count(); ++c) {
    if (made->triangle_of_cell[c] != kNoIndex) continue;
    ++kept;
    EXPECT_EQ(made->cells.measures[c], cells.measures[c]);
    EXPECT_TRUE(std::ranges::equal(made->cells.corners_of(c), cells.corners_of(c)));
  }
  EXPECT_GT(kept, cells.cell_count() / 3);
  EXPECT_LT(kept, cells.cell_count());
}

TEST(FlippedPolygons, AreCellsWithTheAreaOfTheFaces) {
  for (const double moved : {0.0, 0.1}) {
    const auto made = flipped(*cells_of(moved_quads(24, 9, moved)));
    ASSERT_TRUE(made);
    const auto valid = check_cells(made->cells);
    EXPECT_TRUE(valid) << (valid ? "" : valid.error().message);
    const auto& areas = made->cells.measures;
    EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 9, 1e-9);
  }
}

TEST(FlippedPolygons, HaveNoVirtualVertexInAnAnswer) {
  const auto cells = shared(cells_of(moved_quads(24, 9, 0.3)));
  const auto made = flipped(*cells);
  ASSERT_TRUE(made);
  ASSERT_GT(made->cells.vertices, cells->vertices);
  const auto method = HeatMethod::build(cells);
  QueryOptions query;
  query.quality = true;
  const auto result = method->solve(SourceSet::of_vertices({3}), query);
  ASSERT_TRUE(result);
  EXPECT_EQ(std::ssize(result->distances), cells->vertices);
  EXPECT_EQ(result->quality.reached_vertices, cells->vertices);
  for (const double distance : result->distances) EXPECT_TRUE(std::isfinite(distance));
  // Numbers of virtual vertices are no sources.
  const auto beyond = method->solve(SourceSet::of_vertices({cells->vertices}));
  ASSERT_FALSE(beyond);
  EXPECT_NE(beyond.error().message.find("out of range"), std::string::npos);
}

TEST(FlippedPolygons, AreCountedWithTheirInsertedVertices) {
  PolygonMesh graded = moved_quads(16, 1, 0);
  for (Vec3& at : graded.positions) {
    if (at[0] > 0.5) at[0] = 0.5 + 20 * (at[0] - 0.5);
  }
  const auto cells = shared(cells_of(graded));
  const auto method = HeatMethod::build(cells);
  ASSERT_TRUE(method);
  const auto made = flipped(*cells);
  ASSERT_TRUE(made);
  std::set<Index> virtual_vertices(made->virtual_of_cell.begin(), made->virtual_of_cell.end());
  virtual_vertices.erase(kNoIndex);
  EXPECT_GT(method->flips(), 0);
  EXPECT_GT(method->refinement().points, 0);
  EXPECT_EQ(method->refinement().points,
            made->cells.vertices - cells->vertices - std::ssize(virtual_vertices));

  const auto even = HeatMethod::build(shared(cells_of(moved_quads(16, 1, 0))));
  ASSERT_TRUE(even);
  EXPECT_EQ(even->flips(), 0);
  EXPECT_EQ(even->refinement().points, 0);
}

TEST(FlippedPolygons, TakeSourcesInside) {
  const PolygonMesh mesh = moved_quads(24, 9, 0.3);
  const auto cells = shared(cells_of(mesh));
  for (const std::array<double, 4> weights :
       {std::array{0.25, 0.25, 0.25, 0.25}, {0.7, 0.1, 0.1, 0.1}, {0.5, 0.5, 0.0, 0.0}}) {
    const Index face = 24 * 11 + 12;
    SourceSet sources;
    sources.cell_points.push_back({face, {weights.begin(), weights.end()}});
    Vec3 at = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      at += weights[k] * mesh.positions[mesh.corners[4 * face + static_cast<Index>(k)]];
    }
    EXPECT_LE(straight_error(*cells, solve_cells(cells, sources).distances, at), 0.03);
  }
}

TEST(FlippedPolygons, HaveTheSameDistancesInAnotherOrder) {
  // Where vertices are inserted their order matters, as on triangle meshes. Here some triangles are
  // flipped, and none is large.
  const PolygonMesh mesh = quad_torus(0.25);
  const auto made = flipped(*cells_of(mesh));
  ASSERT_TRUE(made);
  ASSERT_EQ(std::ssize(made->triangle_of_cell), cells_of(mesh)->cell_count()) << "inserted";
  const auto vertices = static_cast<Index>(mesh.positions.size());
  std::vector<Index> number(mesh.positions.size()), faces(mesh.start.size() - 1);
  std::iota(number.begin(), number.end(), 0);
  std::iota(faces.begin(), faces.end(), 0);
  std::mt19937 random(1);
  std::ranges::shuffle(number, random);
  std::ranges::shuffle(faces, random);
  PolygonMesh other{std::vector<Vec3>(mesh.positions.size()), {0}, {}};
  for (Index v = 0; v < vertices; ++v) other.positions[number[v]] = mesh.positions[v];
  for (const Index f : faces) {
    for (auto k = mesh.start[f]; k < mesh.start[f + 1]; ++k) {
      other.corners.push_back(number[mesh.corners[k]]);
    }
    other.start.push_back(std::ssize(other.corners));
  }
  HeatOptions options;
  options.precision = Precision::kRefined;
  const auto here = solve_cells(shared(cells_of(mesh)), SourceSet::of_vertices({5}), options);
  const auto there =
      solve_cells(shared(cells_of(other)), SourceSet::of_vertices({number[5]}), options);
  double most = 0, largest = 0;
  for (Index v = 0; v < vertices; ++v) {
    most = std::max(most, std::abs(here.distances[v] - there.distances[number[v]]));
    largest = std::max(largest, here.distances[v]);
  }
  EXPECT_LE(most, 1e-9 * largest);
}

TEST(FlippedPolygons, OfAnySoupAreFiniteOrRefused) {
  std::mt19937 random(11);
  for (int round = 0; round < 60; ++round) {
    PolygonMesh soup{{}, {0}, {}};
    const double scale = std::pow(10.0, round % 5 == 0 ? 60 - 2 * round : 0);
    std::uniform_real_distribution<double> place(-scale, scale);
    std::uniform_int_distribution<Index> corner(0, 19), count(2, 7);
    for (int v = 0; v < 20; ++v) {
      soup.positions.emplace_back(place(random), place(random),
                                  round % 2 == 0 ? 0 : 0.1 * place(random));
    }
    if (round % 3 == 0) soup.positions[3] = soup.positions[4];
    for (int f = 0; f < 15; ++f) {
      for (Index k = count(random); k > 0; --k) soup.corners.push_back(corner(random));
      soup.start.push_back(std::ssize(soup.corners));
    }
    auto cells = cells_of(soup);
    if (!cells) continue;
    const Index source = cells->corners.front();
    const auto method = HeatMethod::build(shared(std::move(cells)));
    ASSERT_TRUE(method) << round << ": " << method.error().message;
    const auto result = method->solve(SourceSet::of_vertices({source}));
    ASSERT_TRUE(result) << round << ": " << result.error().message;
    EXPECT_EQ(result->distances.size(), 20U);
    EXPECT_EQ(result->distances[source], 0);
    for (const double distance : result->distances) EXPECT_FALSE(std::isnan(distance)) << round;
  }
}

TEST(FlippedPolygons, BesideAPartWithoutTrianglesKeepTheirTime) {
  // A sliver has no triangle that could be flipped, and large faces of the other part are refined.
  PolygonMesh mesh = bad_torus();
  const auto alone = HeatMethod::build(shared(*cells_of(mesh)));
  ASSERT_TRUE(alone);
  const auto first = static_cast<Index>(mesh.positions.size());
  for (const Vec3& p : {Vec3(5, 0, 0), Vec3(6, 0, 0), Vec3(5.5, 1e-7, 0)}) {
    mesh.positions.push_back(p);
  }
  mesh.corners.insert(mesh.corners.end(), {first, first + 1, first + 2});
  mesh.start.push_back(std::ssize(mesh.corners));
  const auto method = HeatMethod::build(shared(*cells_of(mesh)));
  ASSERT_TRUE(method) << method.error().message;
  const SourceSet source = SourceSet::of_vertices({3});
  const auto expected = alone->solve(source), result = method->solve(source);
  ASSERT_TRUE(expected);
  ASSERT_TRUE(result) << result.error().message;
  for (Index v = 0; v < first; ++v) {
    EXPECT_NEAR(result->distances[v], expected->distances[v], 1e-9) << v;
  }
}

TEST(FlippedPolygons, OfPartsThatAreNoManifoldAreFlippedAsWell) {
  // Three sheets of long faces at one edge: 90 degrees apart, the same distances on each.
  const PolygonMesh sheet = moved_quads(12, 8, 0);
  PolygonMesh fan{{}, {0}, {}};
  constexpr Index kEdge = 13;  // vertices with x = 0
  const auto number = [&](Index v, Index of) {
    const auto rest = static_cast<Index>(sheet.positions.size()) - kEdge;
    return v < kEdge || of == 0 ? v : v + of * rest;
  };
  for (Index of = 0; of < 3; ++of) {
    const double angle = M_PI / 2 * of;
    for (std::size_t v = of == 0 ? 0 : kEdge; v < sheet.positions.size(); ++v) {
      const Vec3& at = sheet.positions[v];
      fan.positions.emplace_back(at[0] * std::cos(angle), at[1], at[0] * std::sin(angle));
    }
    for (std::size_t f = 0; f + 1 < sheet.start.size(); ++f) {
      for (auto k = sheet.start[f]; k < sheet.start[f + 1]; ++k) {
        fan.corners.push_back(number(sheet.corners[k], of));
      }
      fan.start.push_back(std::ssize(fan.corners));
    }
  }
  const auto cells = shared(cells_of(fan));
  ASSERT_TRUE(flipped(*cells));
  const auto distances = solve_cells(cells, SourceSet::of_vertices({6})).distances;
  double error = 0, sum = 0;
  for (Index of = 0; of < 3; ++of) {
    for (Index v = 0; v < static_cast<Index>(sheet.positions.size()); ++v) {
      const double line = (sheet.positions[v] - sheet.positions[6]).norm();
      error += std::abs(distances[number(v, of)] - line);
      sum += line;
    }
  }
  EXPECT_LE(error, 0.03 * sum);
}

}  // namespace
}  // namespace geotherm::test
