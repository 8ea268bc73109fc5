// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <random>

#include "geotherm/geotherm.h"
#include "tests/support/cells.h"
#include "tests/support/compare.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/sanitized.h"
#include "tests/support/solve.h"

// The heat method on spaces that are no triangle mesh, against closed forms and Dijkstra.
namespace geotherm::test {
namespace {

std::vector<double> dijkstra(const Graph& graph, Index source) {
  std::vector<double> out(static_cast<std::size_t>(graph.vertices), kUnreached);
  out[source] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b, length] : graph.edges) {
      if (out[a] + length < out[b]) out[b] = out[a] + length, changed = true;
      if (out[b] + length < out[a]) out[a] = out[b] + length, changed = true;
    }
  }
  return out;
}

/// Vertices that hang on one of the last few before them, by lengths from a tenth to one.
Graph random_tree(Index vertices) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> length(0.1, 1.0);
  Graph out{vertices, {}};
  for (Index v = 1; v < vertices; ++v) {
    const Index back = 1 + static_cast<Index>(random() % std::min<Index>(v, 6));
    out.edges.push_back({v - back, v, length(random)});
  }
  return out;
}

/// Tets of a grid of cubes in the unit box, its inner vertices moved by a quarter of a cube: six
/// round a diagonal of each cube (Kuhn).
CellComplex box_of_tets(Index n) {
  CellComplex out;
  out.cell_name = "tet";
  out.cells_name = "tets";
  out.dimension = 3;
  out.start.push_back(0);
  const auto number = [n](Index i, Index j, Index k) { return (i * (n + 1) + j) * (n + 1) + k; };
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.25, 0.25);
  for (Index i = 0; i <= n; ++i) {
    for (Index j = 0; j <= n; ++j) {
      for (Index k = 0; k <= n; ++k) {
        Vec3 at(i, j, k);
        const bool inside = std::min({i, j, k}) > 0 && std::max({i, j, k}) < n;
        if (inside) at += Vec3(shift(random), shift(random), shift(random));
        out.positions.push_back(at / n);
        out.on_boundary.push_back(!inside);
      }
    }
  }
  out.vertices = static_cast<Index>(out.positions.size());
  const auto add = [&out](const std::array<Index, 4>& tet) {
    Eigen::Matrix3d edges;
    double width = 0;
    for (int k = 0; k < 4; ++k) {
      for (int j = 0; j < k; ++j)
        width += (out.positions[tet[k]] - out.positions[tet[j]]).norm() / 6;
      if (k > 0) edges.row(k - 1) = (out.positions[tet[k]] - out.positions[tet[0]]).transpose();
    }
    const Eigen::Matrix3d inverse = edges.inverse();
    for (int k = 0; k < 4; ++k) {
      const Vec3 g = k > 0 ? Vec3(inverse.col(k - 1)) : Vec3(-inverse.rowwise().sum());
      out.gradients.insert(out.gradients.end(), {g[0], g[1], g[2]});
      out.corners.push_back(tet[k]);
    }
    out.start.push_back(std::ssize(out.corners));
    out.measures.push_back(std::abs(edges.determinant()) / 6);
    out.widths.push_back(width);
  };
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      for (Index k = 0; k < n; ++k) {
        std::array<int, 3> order = {0, 1, 2};
        do {
          std::array<Index, 3> at = {i, j, k};
          std::array<Index, 4> tet{number(i, j, k)};
          for (int s = 0; s < 3; ++s) {
            ++at[order[s]];
            tet[s + 1] = number(at[0], at[1], at[2]);
          }
          add(tet);
        } while (std::ranges::next_permutation(order).found);
      }
    }
  }
  return out;
}

TEST(Domains, OnATreeDistanceIsThatOfDijkstra) {
  const Graph tree = random_tree(3000);
  const auto cells = shared(cells_of(tree));
  for (const Index source : {0, 1500, 2999}) {
    const auto exact = dijkstra(tree, source);
    const auto result = solve_cells(cells, SourceSet::of_vertices({source}));
    // On each edge u falls away from the source, and phi has that slope: only rounding is left,
    // that of compact factors.
    EXPECT_LE(relative_difference(result.distances, exact), 1e-5);
  }
}

TEST(Domains, OnACycleDistanceIsRightButForTheEdgeWhereFrontsMeet) {
  constexpr Index kVertices = 101;
  Graph cycle{kVertices, {}};
  for (Index v = 0; v < kVertices; ++v) cycle.edges.push_back({v, (v + 1) % kVertices, 1.0});
  const auto result = solve_cells(shared(cells_of(cycle)), SourceSet::of_vertices({7}));
  const auto exact = dijkstra(cycle, 7);
  for (Index v = 0; v < kVertices; ++v) EXPECT_NEAR(result.distances[v], exact[v], 0.5) << v;
}

TEST(Domains, HeatThatUnderflowsGoesOn) {
  // At t = h^2 heat falls by about 2.6 an edge: doubles end after some 700 edges.
  constexpr Index kVertices = 5000;
  Graph chain{kVertices, {}};
  for (Index v = 1; v < kVertices; ++v) chain.edges.push_back({v - 1, v, 0.5});
  const auto result = solve_cells(shared(cells_of(chain)), SourceSet::of_vertices({0}));
  EXPECT_NEAR(result.distances.back(), 0.5 * (kVertices - 1), 1e-5 * kVertices);
}

TEST(Domains, PartsWithoutSourceAndVerticesInNoCellAreUnreached) {
  const Graph two{5, {{0, 1, 1.0}, {2, 3, 1.0}}};
  const auto result = solve_cells(shared(cells_of(two)), SourceSet::of_vertices({0}));
  EXPECT_NEAR(result.distances[1], 1.0, 1e-6);
  for (const Index v : {2, 3, 4}) EXPECT_EQ(result.distances[v], kUnreached) << v;
}

TEST(Domains, InABoxOfTetsErrorsFallWithTheEdgesSlow) {
  constexpr double kHalved = 0.7;  // first order in the middle, less at the border
  double before = 1;
  for (const Index n : {6, 12, 24}) {
    const auto cells = std::make_shared<const CellComplex>(box_of_tets(n));
    const Index middle = cells->vertices / 2;
    HeatOptions options;
    options.boundary = BoundaryRule::kAverage;
    options.variant = Variant::kClassic;  // straight lines leave little to fall
    const auto d = solve_cells(cells, SourceSet::of_vertices({middle}), options).distances;
    const double error = straight_error(*cells, d, cells->positions[middle]);
    EXPECT_LE(error, kHalved * before) << n;
    before = error;
  }
  EXPECT_LE(before, 0.02);  // users accept that much of 80,000 tets
}

/// The same box as tets with the widths of tets, stretched along x.
TetMesh stretched_box(Index n, double stretch) {
  CellComplex cells = box_of_tets(n);
  std::vector<Tet> tets(cells.corners.size() / 4);
  for (std::size_t c = 0; c < cells.corners.size(); ++c) tets[c / 4][c % 4] = cells.corners[c];
  for (Vec3& at : cells.positions) at[0] *= stretch;
  return *TetMesh::build(std::move(cells.positions), std::move(tets));
}

TEST(Domains, DiffusionTimesOfTetsFollowTheThicknessInWidthsSlow) {
  // Edges and corners of the border count as less area than they have; t has its inverse squared.
  constexpr double kOfBorder = 0.03;
  for (const Index n : {24, 28}) {
    const auto cube = HeatMethod::build(shared(cells_of(stretched_box(n, 1))));
    ASSERT_TRUE(cube);
    const double width = std::sqrt(cube->t() / cube->relative_t());
    const double expected = std::pow(0.5 * std::pow(0.5 / 0.6, 2) / width / 13, 2.0 / 3);
    EXPECT_NEAR(cube->grading(), expected, 2 * kOfBorder * expected) << n;
  }
  const auto rod = HeatMethod::build(shared(cells_of(stretched_box(12, 8))));
  EXPECT_EQ(rod->grading(), 0.6) << "few tets across";
}

/// Two arms of 3 x 1 x 1 that share a cube at the origin, cut into n x n x n cubes of tets a unit.
TetMesh elbow_of_tets(Index n) {
  const auto is_inside = [n](Index i, Index j) { return i < n || j < n; };
  std::map<std::array<Index, 3>, Index> number;
  std::vector<Vec3> positions;
  const auto vertex = [&](const std::array<Index, 3>& at) {
    const auto [entry, is_new] = number.try_emplace(at, static_cast<Index>(positions.size()));
    if (is_new) positions.push_back(Vec3(at[0], at[1], at[2]) / n);
    return entry->second;
  };
  std::vector<Tet> tets;
  for (Index i = 0; i < 3 * n; ++i) {
    for (Index j = 0; j < 3 * n; ++j) {
      for (Index k = 0; is_inside(i, j) && k < n; ++k) {
        std::array<int, 3> order = {0, 1, 2};
        do {
          std::array<Index, 3> at = {i, j, k};
          Tet& tet = tets.emplace_back(Tet{vertex(at)});
          for (std::size_t s = 0; s < 3; ++s) {
            ++at[order[s]];
            tet[s + 1] = vertex(at);
          }
        } while (std::ranges::next_permutation(order).found);
      }
    }
  }
  return *TetMesh::build(std::move(positions), std::move(tets));
}

TEST(Domains, RoundTheCornerOfAnElbowOfTetsDistancesFollowTheShortestWay) {
  const TetMesh elbow = elbow_of_tets(6);
  const Vec3 source(0.5, 3, 0.5), corner(1, 1, 0);
  double off = 0, sum = 0;
  const auto at_source = std::ranges::find(elbow.positions(), source);
  ASSERT_NE(at_source, elbow.positions().end());
  const auto vertex = static_cast<Index>(at_source - elbow.positions().begin());
  const auto result = solve_cells(shared(cells_of(elbow)), SourceSet::of_vertices({vertex}));
  for (Index v = 0; v < elbow.vertex_count(); ++v) {
    const Vec3& at = elbow.positions()[v];
    // Seen from above the way is straight, or bends at the corner; it climbs evenly.
    const Vec3 to = at - source, to_corner = corner - source;
    const bool hidden = to_corner.x() * to.y() - to_corner.y() * to.x() > 0 && at.x() > 1;
    const double level =
        hidden ? to_corner.head<2>().norm() + (at - corner).head<2>().norm() : to.head<2>().norm();
    const double exact = std::hypot(level, to.z());
    off += std::abs(result.distances[v] - exact);
    sum += exact;
  }
  // 6.6 % where X keeps its length beside the border, and t is the square of the longest edges.
  EXPECT_LE(off, 0.045 * sum);
}

TEST(Domains, AutoBoundaryIsAverageInVolumesAndNeumannElsewhere) {
  const auto rule_of = [](CellComplex cells) {
    const auto method = HeatMethod::build(std::make_shared<const CellComplex>(std::move(cells)));
    return method->boundary();
  };
  EXPECT_EQ(rule_of(box_of_tets(3)), BoundaryRule::kAverage);
  EXPECT_EQ(rule_of(*cells_of(Graph{2, {{0, 1, 1.0}}})), BoundaryRule::kNeumann);
  CellComplex without_border = box_of_tets(3);
  without_border.on_boundary.clear();
  EXPECT_EQ(rule_of(std::move(without_border)), BoundaryRule::kNeumann);
}

TEST(Domains, ASourceInsideATetIsAPointOfIt) {
  const auto cells = std::make_shared<const CellComplex>(box_of_tets(12));
  SourceSet inside;
  const Index tet = cells->cell_count() / 2;
  inside.cell_points.push_back({tet, {0.1, 0.2, 0.3, 0.4}});
  Vec3 at = Vec3::Zero();
  const auto corners = cells->corners_of(tet);
  for (std::size_t k = 0; k < 4; ++k) {
    at += inside.cell_points[0].weights[k] * cells->positions[corners[k]];
  }
  const auto result = solve_cells(cells, inside);
  for (const Index v : corners) {  // held there
    EXPECT_NEAR(result.distances[v], (cells->positions[v] - at).norm(), 1e-9);
  }
  EXPECT_LE(straight_error(*cells, result.distances, at), 0.06);
}

class OnTets : public testing::TestWithParam<std::string> {};

TEST_P(OnTets, BackendsAndConstraintModesAgree) {
  const auto cells = std::make_shared<const CellComplex>(box_of_tets(8));
  const auto sources = SourceSet::of_vertices({100});
  HeatOptions reference;
  reference.backend = "eigen-ldlt";
  reference.precision = Precision::kFull;
  const auto expected = solve_cells(cells, sources, reference).distances;
  for (const auto mode : {ConstraintMode::kPinSources, ConstraintMode::kPinVertex,
                          ConstraintMode::kConserveEnergy, ConstraintMode::kPseudoInverse}) {
    HeatOptions options;
    options.backend = GetParam();
    options.constraint.mode = mode;
    // Compact factors are right to 1e-6 of the largest distance.
    EXPECT_LE(relative_difference(solve_cells(cells, sources, options).distances, expected), 1e-5)
        << to_text(options.constraint);
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, OnTets, testing::ValuesIn(backend_names()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(Domains, AnswersHaveTheSameBitsForAnyNumberOfThreadsParallel) {
  // Several pieces of rows, more sets than one block has; a sanitizer looks at the threads alone.
  const auto cells = std::make_shared<const CellComplex>(box_of_tets(kSanitized ? 21 : 24));
  std::vector<SourceSet> sets;
  for (Index v = 0; v < (kSanitized ? 18 : 40); ++v)
    sets.push_back(SourceSet::of_vertices({v * 331}));
  std::vector<std::vector<double>> first;
  for (const int threads : kSanitized ? std::vector{4} : std::vector{1, 4}) {
    HeatOptions options;
    options.threads = threads;
    const auto method = HeatMethod::build(cells, options);
    ASSERT_TRUE(method);
    const auto results = method->solve_each(sets);
    ASSERT_TRUE(results);
    for (std::size_t i = 0; i < sets.size(); ++i) {
      if (first.size() == i) {
        first.push_back((*results)[i].distances);
      } else {
        EXPECT_EQ((*results)[i].distances, first[i]) << i;
      }
    }
  }
}

TEST(Domains, OtherOptionsShareWhatStays) {
  const auto cells = std::make_shared<const CellComplex>(box_of_tets(8));
  const auto method = HeatMethod::build(cells);
  ASSERT_TRUE(method);
  HeatOptions options;
  options.time_step.factor = 4;
  options.boundary = BoundaryRule::kAverage;
  const auto other = method->with(options);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->timing().analyze, 0);
  const auto sources = SourceSet::of_vertices({300});
  EXPECT_EQ(other->solve(sources)->distances, solve_cells(cells, sources, options).distances);
}

struct BadCells {
  const char* name;
  void (*spoil)(CellComplex& cells);
  const char* says;
};

class RefusedCells : public testing::TestWithParam<BadCells> {};

TEST_P(RefusedCells, AreOneLine) {
  CellComplex cells = box_of_tets(2);
  GetParam().spoil(cells);
  const auto method = HeatMethod::build(std::make_shared<const CellComplex>(std::move(cells)));
  ASSERT_FALSE(method);
  EXPECT_EQ(method.error().code, ErrorCode::kBadInput);
  EXPECT_NE(method.error().message.find(GetParam().says), std::string::npos)
      << method.error().message;
}

const BadCells kBad[] = {
    {"none", [](CellComplex& c) { c = {}; }, "there are no cells"},
    {"dimension", [](CellComplex& c) { c.dimension = 4; }, "the dimension is 4"},
    {"corner", [](CellComplex& c) { c.corners[5] = 99; }, "the corner 99"},
    {"twice", [](CellComplex& c) { c.corners[5] = c.corners[4]; }, "twice"},
    {"starts", [](CellComplex& c) { c.start.back() += 1; }, "starts go"},
    {"middle", [](CellComplex& c) { c.start[1] = -7; }, "corners"},
    {"gradients", [](CellComplex& c) { c.gradients.pop_back(); }, "numbers of gradients"},
    {"constant", [](CellComplex& c) { c.gradients[0] += 1; }, "sum to"},
    {"nan", [](CellComplex& c) { c.gradients[0] = kNan; }, "sum to"},
    {"measure", [](CellComplex& c) { c.measures[3] = 0; }, "measure 0"},
    {"width", [](CellComplex& c) { c.widths[3] = kNan; }, "width"},
    {"place", [](CellComplex& c) { c.positions[3][1] = kNan; }, "vertex 3"},
};
INSTANTIATE_TEST_SUITE_P(Arrays, RefusedCells, testing::ValuesIn(kBad),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Domains, SourcesThatDoNotFitAreOneLine) {
  const auto method = HeatMethod::build(std::make_shared<const CellComplex>(box_of_tets(2)));
  ASSERT_TRUE(method);
  SourceSet face, curve, weights, far;
  face.points.push_back(SurfacePoint::in_face(0, {0.2, 0.3, 0.5}));
  curve.edges.push_back({0, 1});
  weights.cell_points.push_back({0, {0.5, 0.5}});
  far.cell_points.push_back({48, {0.25, 0.25, 0.25, 0.25}});
  for (const SourceSet& sources :
       {face, curve, weights, far, SourceSet{}, SourceSet::of_vertices({27})}) {
    const auto result = method->solve(sources);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kBadInput) << result.error().message;
  }
}

TEST(Domains, TheTuftedLaplacianIsOfTriangleMeshes) {
  HeatOptions options;
  options.laplacian = LaplacianKind::kTufted;
  const auto method =
      HeatMethod::build(std::make_shared<const CellComplex>(box_of_tets(2)), options);
  ASSERT_FALSE(method);
  EXPECT_NE(method.error().message.find("these are tets"), std::string::npos);
}

TEST(Domains, PointsOfCellsAreNoSourcesOfATriangleMesh) {
  SourceSet sources;
  sources.cell_points.push_back({0, {0.2, 0.3, 0.5}});
  const auto result = HeatMethod::build(finish(plane_grid(2, 2, 1, 1)))->solve(sources);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
}

}  // namespace
}  // namespace geotherm::test
