// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "solver/geometry/polygon_fans.h"
#include "tests/support/cells.h"
#include "tests/support/polygons.h"
#include "tests/support/solve.h"

// Faces that do not see all their sides from their virtual vertex, which are cut into triangles.
namespace geotherm::test {
namespace {

using Square = std::pair<int, int>;

/// The corners around squares that hang together without a hole, counterclockwise.
std::vector<Square> outline(const std::set<Square>& squares) {
  std::map<Square, Square> next;
  for (const auto& [x, y] : squares) {
    if (!squares.contains({x, y - 1})) next[{x, y}] = {x + 1, y};
    if (!squares.contains({x + 1, y})) next[{x + 1, y}] = {x + 1, y + 1};
    if (!squares.contains({x, y + 1})) next[{x + 1, y + 1}] = {x, y + 1};
    if (!squares.contains({x - 1, y})) next[{x, y + 1}] = {x, y};
  }
  std::vector<Square> out = {next.begin()->first};
  for (Square at = next[out[0]]; at != out[0]; at = next[at]) out.push_back(at);
  return out;
}

/// A rectangle of `count` x `count` blocks of squares: in each one, squares with the same letter
/// are a face. All is `stretch` times as long.
PolygonMesh tiles(const std::vector<std::string>& block, int count, double stretch) {
  const int wide = static_cast<int>(block[0].size()), high = static_cast<int>(block.size());
  std::map<char, std::set<Square>> faces;
  for (int y = 0; y < high; ++y) {
    for (int x = 0; x < wide; ++x) faces[block[y][x]].insert({x, y});
  }
  PolygonMesh out{{}, {0}, {}};
  std::map<Square, Index> numbers;
  for (int i = 0; i < count * count; ++i) {
    for (const auto& [letter, squares] : faces) {
      for (const auto& [x, y] : outline(squares)) {
        const Square at = {x + i % count * wide, y + i / count * high};
        const auto [found, is_new] =
            numbers.try_emplace(at, static_cast<Index>(out.positions.size()));
        if (is_new) out.positions.emplace_back(stretch * at.first, at.second, 0);
        out.corners.push_back(found->second);
      }
      out.start.push_back(std::ssize(out.corners));
    }
  }
  return out;
}

const std::vector<std::string> kNotch = {"aba", "aaa"};
const std::vector<std::string> kComb = {"abaca", "abaca", "aaaaa"};
const std::vector<std::string> kSpiral = {"aaaaa", "abbba", "abaca", "abbcc", "aaacc"};

Index count_cut(const CellComplex& cells) {
  std::set<Index> faces;
  for (Index c = 0; c < cells.cell_count(); ++c) {
    if (!cells.virtual_vertices[c].allFinite()) faces.insert(cells.numbers[c]);
  }
  return static_cast<Index>(faces.size());
}

TEST(CutPolygons, HaveErrorsLikeThoseOfTheirTrianglesSlow) {
  // What users ask for: at most 1.3 times.
  for (const auto& block : {kNotch, kComb, kSpiral}) {
    for (const double stretch : {1.0, 3.0, 30.0}) {
      const PolygonMesh mesh = tiles(block, 12, stretch);
      EXPECT_GE(count_cut(*cells_of(mesh)), 144);
      const auto [of_polygons, of_triangles] =
          errors_beside_triangles(mesh, MethodKind::kExact, std::array<Index, 4>{0, 100, 205, 333});
      EXPECT_GT(of_triangles, 0);
      EXPECT_LE(of_polygons, 1.3 * of_triangles) << block[0] << " " << stretch;
    }
  }
}

TEST(CutPolygons, AreThoseThatDoNotSeeTheirSidesAlone) {
  const CellComplex cells = *cells_of(tiles(kNotch, 3, 1));
  EXPECT_EQ(count_cut(cells), 9);
  for (Index c = 0; c < cells.cell_count(); ++c) {
    EXPECT_EQ(cells.virtual_vertices[c].allFinite(), cells.corners_of(c).size() == 4);
  }
  EXPECT_TRUE(check_cells(cells));
  EXPECT_NEAR(std::accumulate(cells.measures.begin(), cells.measures.end(), 0.0), 9 * 6, 1e-12);
}

struct SourceInside {
  SourceSet sources;
  Vec3 at;
};

/// A source in the face of a cell. Its weights are brought to a sum of 1.
SourceInside source_inside(const PolygonMesh& mesh, const CellComplex& cells, Index cell,
                           std::vector<double> weights) {
  const auto corners = cells.corners_of(cell);
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  SourceInside out{{}, Vec3::Zero()};
  for (std::size_t c = 0; c < corners.size(); ++c) {
    out.at += (weights[c] /= sum) * mesh.positions[corners[c]];
  }
  out.sources.cell_points.push_back({cells.numbers[cell], std::move(weights)});
  return out;
}

/// A hexagon without symmetry, its list beginning with corner `first`.
PolygonMesh hexagon_from(Index first) {
  PolygonMesh out{
      {{0, 0, 0}, {4, -1, 0}, {7, 1, 0}, {7.5, 2, 0}, {3, 3, 0}, {-1, 2, 0}}, {0, 6}, {}};
  for (Index k = 0; k < 6; ++k) out.corners.push_back((first + k) % 6);
  return out;
}

TEST(CutPolygons, AreAsWideWhereverTheirListsBegin) {
  // Worked out from the lengths: diagonals from one corner, in the mean over all six.
  const auto& at = hexagon_from(0).positions;
  double sides = 0;
  for (std::size_t from = 0; from < 6; ++from) {
    for (std::size_t k = 2; k < 6; ++k) {
      const Vec3 &a = at[from], &b = at[(from + k - 1) % 6], &c = at[(from + k) % 6];
      sides += (a - b).norm() + (b - c).norm() + (c - a).norm();
    }
  }
  for (Index first = 0; first < 6; ++first) {
    const CellComplex cells = *cells_of(hexagon_from(first));
    ASSERT_EQ(count_cut(cells), 0);
    EXPECT_NEAR(cells.widths[0], sides / (6 * 4 * 3), 1e-12);
  }
}

TEST(CutPolygons, WithEqualSharesAreThoseWithout) {
  CellComplex cells = *cells_of(moved_quads(12, 1, 0.2));
  cells.virtual_vertices.clear();
  const auto distances = [&cells] {
    return HeatMethod::build(std::make_shared<const CellComplex>(cells))
        ->solve(SourceSet::of_vertices({30}))
        ->distances;
  };
  cells.shares.assign(cells.corners.size(), 0.25);
  const auto with = distances();
  cells.shares.clear();
  EXPECT_EQ(with, distances());
}

TEST(CutPolygons, AreRefusedWithSharesThatAreNone) {
  const CellComplex good = *cells_of(moved_quads(2, 1, 0));
  const auto says = [](const CellComplex& cells) { return check_cells(cells).error().message; };
  CellComplex cells = good;
  cells.shares.pop_back();
  EXPECT_NE(says(cells).find("shares, and"), std::string::npos);
  cells = good;
  cells.shares[0] += 0.5;
  EXPECT_NE(says(cells).find("sum to 1.5"), std::string::npos);
  cells = good;
  for (Index c = 0; c < cells.cell_count(); ++c) {  // vertex 0 gives what it has to the next corner
    const auto corners = cells.corners_of(c);
    const auto own = std::ranges::find(corners, 0) - corners.begin();
    if (own == std::ssize(corners)) continue;
    const auto begin = cells.shares.begin() + cells.start[c];
    begin[(own + 1) % std::ssize(corners)] += std::exchange(begin[own], 0);
  }
  EXPECT_NE(says(cells).find("vertex 0 has the share 0"), std::string::npos);
}

TEST(CutPolygons, TakeSourcesInside) {
  // Somewhere in one of its triangles, which may be long and lean.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.05, 1);
  for (const auto& block : {kNotch, kComb, kSpiral}) {
    const PolygonMesh mesh = tiles(block, 8, 3);
    const auto triangles = std::make_shared<const TriangleMesh>(*triangulated(mesh));
    const auto cells = shared(cells_of(mesh));
    const HeatMethod on_cells = method_of(cells), on_triangles = method_of(triangles);
    double of_polygons = 0, of_triangles = 0;
    for (int k = 0; k < 12; ++k) {
      Index cell = static_cast<Index>(random() % static_cast<unsigned>(cells->cell_count()));
      while (cells->virtual_vertices[cell].allFinite()) cell = (cell + 1) % cells->cell_count();
      std::vector<double> weights(cells->corners_of(cell).size(), 0.0);
      for (const std::size_t corner : cut_corners(*cells, cell)) weights[corner] = share(random);
      const auto [inside, at] = source_inside(mesh, *cells, cell, weights);
      SourceSet same;
      same.points.push_back(closest_point(*triangles, at)->point);
      of_polygons += straight_error(*cells, solve(on_cells, inside).distances, at);
      of_triangles += straight_error(*cells, solve(on_triangles, same).distances, at);
    }
    EXPECT_LE(of_polygons, 1.3 * of_triangles) << block[0];
  }
}

TEST(CutPolygons, LetSourcesInsideSeeAcrossTheSidesOfTheirFace) {
  // The nearest vertices lie across a long side, which the source sees them through. The march is
  // exact there but where the straight line passes between vertices of which one is farther away.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.02, 1);
  for (const PolygonMesh& mesh :
       {moved_quads(24, 1, 0.25), tiles(kNotch, 12, 10), tiles(kSpiral, 10, 10)}) {
    const auto cells = shared(cells_of(mesh));
    const HeatMethod method = method_of(cells);
    int seen = 0, wrong = 0;
    for (int k = 0; k < 20; ++k) {
      Index cell = static_cast<Index>(random() % static_cast<unsigned>(cells->cell_count()));
      const auto is_fan = [&cells](Index c) {
        return cells->corners_of(c).size() > 4 && cells->virtual_vertices[c].allFinite();
      };
      while (is_fan(cell)) cell = (cell + 1) % cells->cell_count();
      const auto corners = cells->corners_of(cell);
      const auto three = cut_corners(*cells, cell);
      std::vector<double> weights(corners.size(), 0.0);
      for (std::size_t c = 0; c < corners.size(); ++c) {
        const bool is_taken = corners.size() == 4 || std::ranges::count(three, c) > 0;
        if (is_taken) weights[c] = share(random);
      }
      // Every other one lies on a side of its face, or nearly so.
      if (k % 2 == 0) {
        for (double& weight : weights) weight *= std::array{0.0, 1e-8, 1e-6, 1e-5, 1e-4}[k / 2 % 5];
        weights[three.empty() ? 0 : three[0]] = share(random);
        weights[three.empty() ? 1 : three[1]] = share(random);
      }
      const auto [inside, at] = source_inside(mesh, *cells, cell, weights);
      const auto answer = solve(method, inside);
      std::vector<std::pair<double, Index>> nearest;
      for (Index v = 0; v < cells->vertices; ++v) {
        nearest.emplace_back((mesh.positions[v] - at).norm(), v);
      }
      std::ranges::sort(nearest);
      for (std::size_t n = 0; n < 4; ++n) {
        const auto [line, vertex] = nearest[n];
        const double error = answer.distances[vertex] / line - 1;
        EXPECT_LT(error, 0.3) << k << ", " << at.transpose() << " to "
                              << mesh.positions[vertex].transpose() << ", face of "
                              << corners.size() << " corners";
        seen += 1;
        wrong += error > 1e-3 ? 1 : 0;
      }
    }
    EXPECT_LT(12 * wrong, seen);
  }
}

TEST(CutPolygons, TakeSourcesInTheirOwnTriangles) {
  // Where corners lie in a row but for noise, other triangles of the face stand upright.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.05, 1), noise(-0.1, 0.1);
  PolygonMesh mesh = tiles(kSpiral, 6, 1);
  for (Vec3& at : mesh.positions) at[2] = noise(random);
  const auto cells = shared(cells_of(mesh));
  const HeatMethod method = method_of(cells);
  int tried = 0;
  for (Index cell = 0; cell < cells->cell_count(); cell += 11) {
    const auto three = cut_corners(*cells, cell);
    const auto corners = cells->corners_of(cell);
    if (corners.size() < 5 || three.empty() || cells->virtual_vertices[cell].allFinite()) continue;
    std::vector<double> weights(corners.size(), 0.0);
    for (const std::size_t c : three) weights[c] = share(random);
    const auto [inside, at] = source_inside(mesh, *cells, cell, weights);
    const auto answer = solve(method, inside);
    for (const std::size_t c : three) {
      const double line = (mesh.positions[corners[c]] - at).norm();
      EXPECT_NEAR(answer.distances[corners[c]], line, 0.01 * line) << cell;
    }
    ++tried;
  }
  EXPECT_GT(tried, 20);
}

TEST(CutPolygons, AreCountedWithFacesThatWereLeftOut) {
  // On a pleated sheet, whose ways are longer than straight lines.
  PolygonMesh sheet = moved_quads(12, 1, 0.1);
  for (Vec3& at : sheet.positions) at[2] = std::abs(std::remainder(at[0], 4.0));
  PolygonMesh with_others = sheet;
  // Then the face beside the source has the number that is the count of all cells.
  const Index others = cells_of(sheet)->cell_count() - 76;
  for (Index i = 0; i < others; ++i) {
    with_others.corners.insert(with_others.corners.begin(), {0, 0, 1});
  }
  with_others.start = {0};
  for (Index i = 1; i <= others; ++i) with_others.start.push_back(3 * std::int64_t{i});
  for (std::size_t f = 1; f < sheet.start.size(); ++f) {
    with_others.start.push_back(3 * std::int64_t{others} + sheet.start[f]);
  }
  SourceSet inside, same;
  inside.cell_points.push_back({77, {0.1, 0.2, 0.3, 0.4}});
  same.cell_points.push_back({77 + others, {0.1, 0.2, 0.3, 0.4}});
  EXPECT_EQ(solve_cells(shared(cells_of(sheet)), inside).distances,
            solve_cells(shared(cells_of(with_others)), same).distances);
}

TEST(CutPolygons, AreWalkedAroundTheirNotch) {
  // One face alone: the way from one arm to the other leads around the gap between them.
  PolygonMesh alone = tiles({"abbba", "abbba", "abbba", "aaaaa"}, 1, 1);
  alone.start.resize(2);
  alone.corners.resize(static_cast<std::size_t>(alone.start.back()));
  const auto cells = shared(cells_of(alone));
  ASSERT_EQ(count_cut(*cells), 1);
  const auto number = [&alone](const Vec3& at) {
    return static_cast<Index>(std::ranges::find(alone.positions, at) - alone.positions.begin());
  };
  const Index from = number({1, 0, 0}), to = number({4, 0, 0});
  const double around = solve_cells(cells, SourceSet::of_vertices({from})).distances[to];
  EXPECT_NEAR(around, 9, 0.03 * 9);  // down the gap, along its end and up
}

TEST(CutPolygons, OfFacesThatCrossThemselvesAreWhatIsDrawn) {
  PolygonMesh mesh = moved_quads(16, 1, 0.1);
  for (const Index face : {35, 87, 140, 201}) {
    std::swap(mesh.positions[mesh.corners[4 * face]], mesh.positions[mesh.corners[4 * face + 1]]);
  }
  EXPECT_GT(count_cut(*cells_of(mesh)), 4);
  const auto [of_polygons, of_triangles] =
      errors_beside_triangles(mesh, MethodKind::kExact, std::array<Index, 3>{0, 111, 222});
  EXPECT_LE(of_polygons, 1.3 * of_triangles);
}

TEST(CutPolygons, OfFacesWhoseHalvesCancelAreNotLeftOut) {
  // Two corners in the wrong order: the area on one side is that on the other.
  PolygonMesh mesh = quads(12);
  for (const Index face : {30, 44, 45, 90}) {
    std::swap(mesh.corners[4 * face + 2], mesh.corners[4 * face + 3]);
  }
  const CellComplex cells = *cells_of(mesh);
  EXPECT_TRUE(cells.notes.empty());
  EXPECT_EQ(count_cut(cells), 4);
  for (const double distance : solve_cells(shared(cells), SourceSet::of_vertices({0})).distances) {
    EXPECT_TRUE(std::isfinite(distance));
  }
}

TEST(CutPolygons, WithCornersAtOnePlaceAreSolvedOn) {
  // The middle one of three has no side of any length.
  PolygonMesh mesh{{}, {0, 6, 10}, {0, 1, 2, 3, 4, 5, 1, 6, 7, 2}};
  for (const Vec3& at : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(0, 1, 0),
                         Vec3(0, 1, 0), Vec3(2, 0, 0), Vec3(2, 1, 0)}) {
    mesh.positions.push_back(at);
  }
  const auto distances = solve_cells(shared(cells_of(mesh)), SourceSet::of_vertices({0})).distances;
  ASSERT_EQ(distances.size(), mesh.positions.size());
  for (std::size_t v = 0; v < distances.size(); ++v) {
    EXPECT_NEAR(distances[v], mesh.positions[v].norm(), 0.1) << v;
  }
}

TEST(CutPolygons, TurnedAnywhereHaveTheAreaThatIsDrawn) {
  // Corners on a line are on it up to rounding there.
  for (int turn = 0; turn < 40; ++turn) {
    PolygonMesh mesh = tiles(turn % 2 == 0 ? kNotch : kComb, 4, 1);
    const double angle = 0.1 + 0.15 * turn, c = std::cos(angle), s = std::sin(angle);
    for (Vec3& at : mesh.positions) at = Vec3(c * at[0] - s * at[1], s * at[0] + c * at[1], 0);
    const double area = inspect_mesh(*triangulated(mesh)).area;
    const CellComplex cells = *cells_of(mesh);
    EXPECT_NEAR(std::accumulate(cells.measures.begin(), cells.measures.end(), 0.0), area,
                1e-4 * area);
  }
}

TEST(CutPolygons, OfFacesAsLongAsTrianglesBecomeFlatHaveErrorsLikeThem) {
  // Some fans, some of the triangles that replace them, and both beside each other are flat.
  for (const double stretch : {100.0, 450.0, 2000.0}) {
    const auto [of_polygons, of_triangles] = errors_beside_triangles(
        moved_quads(24, stretch, 0.25), MethodKind::kExact, std::array<Index, 3>{0, 300, 444});
    EXPECT_LE(of_polygons, 1.3 * of_triangles) << stretch;
  }
}

TEST(CutPolygons, WithACornerOnTheirLongestSideHaveNoFlatTriangle) {
  // Cutting the ear beyond them would leave the corners on one side as a triangle.
  PolygonMesh mesh{{}, {0}, {}};
  for (const Vec3& at :
       {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0), Vec3(3, 2, 0), Vec3(2, 2, 0),
        Vec3(2, 1, 0), Vec3(1, 1, 0), Vec3(1, 2, 0), Vec3(0, 2, 0)}) {
    mesh.corners.push_back(static_cast<Index>(mesh.positions.size()));
    mesh.positions.push_back(at);
  }
  mesh.start.push_back(std::ssize(mesh.corners));
  const CellComplex cells = *cells_of(mesh);
  ASSERT_EQ(cells.cell_count(), 8);
  EXPECT_EQ(count_cut(cells), 1);
  for (const double area : cells.measures) EXPECT_GE(area, 0.4);
}

}  // namespace
}  // namespace geotherm::test
