// SPDX-License-Identifier: MIT
// A method whose vertices move gives what a fresh one gives, and keeps what can stay.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "geotherm/build_method.h"
#include "solver/heat/surface.h"
#include "tests/support/sanitized.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

HeatOptions full_precision() {
  HeatOptions options;
  options.precision = Precision::kFull;
  return options;
}

/// Lengths keep their unit while little moves, which rounds them in another place than a fresh
/// build does: 2e-16 times the condition of the Poisson matrix, some 1e5 at 8,000 vertices.
constexpr double kOtherUnit = 1e-10;

/// A brush: vertices near one of them move.
std::vector<Vec3> brushed(std::span<const Vec3> positions, Index at, double radius) {
  std::vector<Vec3> moved(positions.begin(), positions.end());
  const Vec3 middle = moved[static_cast<std::size_t>(at)];
  for (Vec3& p : moved) {
    const double d = (p - middle).norm() / radius;
    if (d < 1) p[2] += 0.3 * radius * (1 - d) * (1 - d);
  }
  return moved;
}

// The time is absolute, so that the heat step need not follow the mean edge.
TEST(MovingBrush, FactorisesOnlyTheFrontsAboveIt) {
  const MeshPtr mesh = finish(jittered_plane(90, 0.3, 5));
  HeatOptions options = full_precision();
  options.time_step = {TimeRule::kAbsolute, 1, method_of(mesh).t()};
  HeatMethod method = method_of(mesh, options);
  const auto all = method.fronts();
  EXPECT_EQ(all.factored, all.all);
  std::vector<Vec3> positions(mesh->positions().begin(), mesh->positions().end());
  const SourceSet sources = SourceSet::of_vertices({1000});
  Index flips = method.flips(), changes = 0;
  for (int stroke = 0; stroke < 12; ++stroke) {
    positions = brushed(positions, static_cast<Index>(700 * (stroke / 2) + 1500 + stroke), 0.06);
    method = *method.with_positions(positions);
    if (stroke > 0) {
      EXPECT_LT(method.fronts().factored, all.all / 2);
      EXPECT_GT(method.fronts().factored, 0);
    }
    changes += method.flips() != flips;
    flips = method.flips();
    const HeatMethod fresh =
        method_of(std::make_shared<const TriangleMesh>(*mesh->moved(positions)), options);
    ASSERT_EQ(method.flips(), fresh.flips());
    EXPECT_LE(
        relative_difference(solve(method, sources).distances, solve(fresh, sources).distances),
        kOtherUnit)
        << "stroke " << stroke;
  }
  EXPECT_GT(changes, 4);
}

// A fresh order has inserted vertices anywhere within a node, a kept one has them last: nothing is
// taken over from one to the other. Strict, so that no other backend hides what fails.
TEST(MovingBrush, KnowsInsertedVerticesOfAnotherOrder) {
  const MeshPtr mesh = finish(random_delaunay(kSanitized ? 500 : 8000, 2));
  HeatOptions options = full_precision();
  options.strict = true;
  options.time_step = {TimeRule::kAbsolute, 1, method_of(mesh, options).t()};
  HeatMethod method = method_of(mesh, options);
  ASSERT_GT(method.refinement().points, 0);
  std::vector<Vec3> positions(mesh->positions().begin(), mesh->positions().end());
  const SourceSet sources = SourceSet::of_vertices({3});
  for (int stroke = 0; stroke < 4; ++stroke) {
    // The first stroke flips nothing.
    std::vector<Vec3> moved = brushed(positions, 200 + 50 * stroke, 0.03);
    const double share = stroke == 0 ? 1e-4 : 1.0;
    for (std::size_t v = 0; v < moved.size(); ++v) {
      positions[v] += share * (moved[v] - positions[v]);
    }
    const auto next = method.with_positions(positions);
    ASSERT_TRUE(next) << next.error().message;
    method = *next;
    const MeshPtr now = std::make_shared<const TriangleMesh>(*mesh->moved(positions));
    EXPECT_LE(relative_difference(solve(method, sources).distances,
                                  solve(method_of(now, options), sources).distances),
              kOtherUnit);
  }
}

/// Faces by the vertices of their corners, and masses by vertices.
struct OperatorsByVertex {
  explicit OperatorsByVertex(const Surface& surface) : mass(surface.row_of_vertex.size()) {
    const OperatorMesh& mesh = *surface.operators;
    for (Index row = 0; row < mesh.size(); ++row) {
      mass[surface.vertex_of_row[row]] = mesh.mass[row] * surface.unit * surface.unit;
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
      std::set<Index> corners;
      for (const Index row : mesh.faces[f]) corners.insert(surface.vertex_of_row[row]);
      faces.insert({corners, mesh.intrinsic_face[f]});
    }
  }
  std::set<std::pair<std::set<Index>, Index>> faces;
  std::vector<double> mass;
};

// Faces keep their places, but for those that have changed; two ranges and faces that cross.
TEST(MovingBrush, UpdatesTheOperators) {
  const MeshPtr mesh = finish(jittered_plane(kSanitized ? 60 : 130, 0.3, 5));
  const Backend& native = **find_backend("native");
  const auto built = [&](MeshPtr moved, const Surface* earlier) {
    return *build_surface(std::move(moved), native, LaplacianKind::kAuto, 2, {}, earlier);
  };
  auto surface = built(mesh, nullptr);
  std::vector<Vec3> positions(mesh->positions().begin(), mesh->positions().end());
  int patterns = 0;
  for (int stroke = 0; stroke < 6; ++stroke) {
    positions = brushed(positions, (2 * stroke + 1) * mesh->vertex_count() / 13, 0.06);
    const MeshPtr moved = std::make_shared<const TriangleMesh>(*mesh->moved(positions));
    const auto before = surface->analysis;
    surface = built(moved, surface.get());
    patterns += surface->analysis != before;
    ASSERT_FALSE(surface->changed_rows.empty());
    const OperatorMesh& mesh_now = *surface->operators;
    const SymmetricPattern pattern =
        pattern_of_faces(mesh_now.size(), std::span(mesh_now.faces.data(), mesh_now.faces.size()));
    EXPECT_EQ(mesh_now.pattern, pattern_hash(pattern));
    EXPECT_EQ(mesh_now.lower.row, lower_of(pattern, 1).row);
    Index rows = 0, faces = 0;
    for (const RowRange& range : mesh_now.ranges) {
      EXPECT_EQ(range.first_row, std::exchange(rows, range.end_row));
      EXPECT_EQ(range.first_cell, std::exchange(faces, range.end_cell));
      for (Index f = range.first_cell; f < range.end_cell; ++f) {
        const auto [low, high] = std::ranges::minmax(mesh_now.faces[f]);
        EXPECT_TRUE(low >= range.first_row && high < range.end_row);
      }
    }
    EXPECT_EQ(rows, mesh_now.size());
    EXPECT_EQ(faces, mesh_now.crossing);
    const OperatorsByVertex here(*surface), there(*built(moved, nullptr));
    EXPECT_EQ(here.faces, there.faces);
    EXPECT_LE(relative_difference(here.mass, there.mass), 1e-12);
  }
  EXPECT_GT(patterns, 2);
}

struct BrushOptions {
  const char* name;
  void (*set)(HeatOptions&);
};
void PrintTo(const BrushOptions& options, std::ostream* out) { *out << options.name; }

class MovingBrushOptions : public testing::TestWithParam<BrushOptions> {};

// Systems with held rows, several factors or narrow numbers take over what has not changed, too.
TEST_P(MovingBrushOptions, AnswersAsAFreshBuildDoes) {
  Draft draft = jittered_plane(70, 0.3, 5);
  append(draft, transformed(jittered_plane(20, 0.3, 6), 1, {2, 0, 0}, false));
  const MeshPtr mesh = finish(draft);
  HeatOptions options = full_precision();
  options.time_step = {TimeRule::kAbsolute, 1, method_of(mesh).t()};
  GetParam().set(options);
  HeatMethod method = method_of(mesh, options);
  std::vector<Vec3> positions(mesh->positions().begin(), mesh->positions().end());
  const SourceSet sources = SourceSet::of_vertices({2000, 5100});
  for (int stroke = 0; stroke < 5; ++stroke) {
    positions = brushed(positions, 1500 + 60 * stroke, 0.08);
    method = *method.with_positions(positions);
    const MeshPtr moved = std::make_shared<const TriangleMesh>(*mesh->moved(positions));
    const double difference = relative_difference(
        solve(method, sources).distances, solve(method_of(moved, options), sources).distances);
    EXPECT_LE(difference, options.precision == Precision::kFull ? kOtherUnit : 1e-6);
  }
}

const BrushOptions kBrushOptions[] = {
    {"average", [](HeatOptions& o) { o.boundary = BoundaryRule::kAverage; }},
    {"dirichlet", [](HeatOptions& o) { o.boundary = BoundaryRule::kDirichlet; }},
    {"pin",
     [](HeatOptions& o) {
       o.constraint = {ConstraintMode::kPinVertex, 1500, 10};
     }},
    {"hold", [](HeatOptions& o) { o.heat = HeatMode::kHold; }},
    {"classic", [](HeatOptions& o) { o.variant = Variant::kClassic; }},
    {"compact", [](HeatOptions& o) { o.precision = Precision::kCompact; }},
    {"tufted", [](HeatOptions& o) { o.laplacian = LaplacianKind::kTufted; }},
};
INSTANTIATE_TEST_SUITE_P(Options, MovingBrushOptions, testing::ValuesIn(kBrushOptions),
                         [](const auto& each) { return each.param.name; });

// The mean edge changes, and with it every number of the heat step; not those of the Poisson step.
TEST(MovingBrush, FollowsTheMeanEdgeByDefault) {
  const MeshPtr mesh = finish(jittered_plane(90, 0.3, 5));
  HeatMethod method = method_of(mesh, full_precision());
  std::vector<Vec3> positions(mesh->positions().begin(), mesh->positions().end());
  for (int stroke = 0; stroke < 3; ++stroke) {
    positions = brushed(positions, 3000, 0.06);
    method = *method.with_positions(positions);
    const HeatMethod fresh =
        method_of(std::make_shared<const TriangleMesh>(*mesh->moved(positions)), full_precision());
    EXPECT_NEAR(method.t() / fresh.t(), 1, 1e-14);
    EXPECT_LE(relative_difference(solve(method, SourceSet::of_vertices({40})).distances,
                                  solve(fresh, SourceSet::of_vertices({40})).distances),
              kOtherUnit);
  }
  const auto fronts = method.fronts();
  EXPECT_GT(fronts.factored, fronts.all / 2);
  EXPECT_LT(fronts.factored, fronts.all);
}

}  // namespace
}  // namespace geotherm::test
