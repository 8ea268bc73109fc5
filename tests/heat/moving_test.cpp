// SPDX-License-Identifier: MIT
// A method whose vertices move gives what a fresh one gives, and keeps what can stay.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geotherm/build_method.h"
#include "tests/support/sanitized.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

struct Kind {
  const char* name;
  Draft (*draft)();
  double amount;  ///< by which vertices move at random, in mean edges
};

Draft two_parts() {
  Draft draft = torus(24, 12, 0.4);
  append(draft, transformed(sphere(2), 0.3, {4, 0, 0}, true));
  return draft;
}

const Kind kKinds[] = {
    {"plane", [] { return jittered_plane(20, 0.3, 4); }, 0.4},
    {"sphere", [] { return sphere(3); }, 0.2},
    {"random_delaunay", [] { return random_delaunay(300, 7); }, 0.1},
    {"spikes", spiky_sphere, 0.1},
    {"book", [] { return graded_book(8); }, 0.1},
    {"one_sided", [] { return moebius(60, 6); }, 0.2},
    {"two_parts", two_parts, 0.2},
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

/// A wave along x, and vertices moved at random.
class Mover {
 public:
  Mover(const TriangleMesh& mesh, double amount)
      : start_(mesh.positions().begin(), mesh.positions().end()), amount_(amount) {
    double sum = 0;
    for (const Face& f : mesh.faces()) sum += (start_[f[0]] - start_[f[1]]).norm();
    edge_ = sum / mesh.face_count();
  }
  std::vector<Vec3> next() {
    std::uniform_real_distribution<double> share(-1, 1);
    const double phase = 3 * share(random_);
    std::vector<Vec3> moved = start_;
    for (Vec3& p : moved) {
      p[2] += 2 * edge_ * std::sin(p[0] / edge_ / 4 + phase);
      for (int k = 0; k < 3; ++k) p[k] += amount_ * edge_ * share(random_);
    }
    return moved;
  }

 private:
  std::vector<Vec3> start_;
  double amount_, edge_ = 0;
  std::mt19937 random_{11};
};

HeatOptions in_doubles() {
  HeatOptions options;
  options.precision = Precision::kFull;
  return options;
}

class Moving : public testing::TestWithParam<Kind> {
 protected:
  MeshPtr mesh = finish(GetParam().draft());
  Mover mover{*mesh, GetParam().amount};
};

// 1e-12 of the largest distance is what rounding in another order makes of these systems.
TEST_P(Moving, AnswersAsAFreshBuildDoesFrameAfterFrame) {
  constexpr double kRounding = 1e-12;
  const SourceSet sources = SourceSet::of_vertices({3, mesh->vertex_count() / 2});
  HeatMethod method = method_of(mesh, in_doubles());
  int changed = 0;
  for (int frame = 0; frame < (kSanitized ? 5 : 150); ++frame) {
    const std::vector<Vec3> positions = mover.next();
    const Index flips = method.flips() + method.refinement().points;
    auto moved = method.with_positions(positions);
    ASSERT_TRUE(moved) << moved.error().message;
    method = *std::move(moved);
    const HeatMethod fresh =
        method_of(std::make_shared<const TriangleMesh>(*mesh->moved(positions)), in_doubles());
    ASSERT_EQ(method.flips(), fresh.flips());
    ASSERT_EQ(method.refinement().points, fresh.refinement().points);
    ASSERT_EQ(method.t(), fresh.t());
    const auto here = solve(method, sources).distances, there = solve(fresh, sources).distances;
    ASSERT_LE(relative_difference(here, there), kRounding) << "frame " << frame;
    changed += method.flips() + method.refinement().points != flips;
  }
  EXPECT_GT(changed, kSanitized ? 2 : 75);
}

// A new order is made where the kept one would be 15 % larger than the last fresh one was.
TEST_P(Moving, KeepsFactorsSmall) {
  HeatMethod method = method_of(mesh);
  double fresh = method.memory_mb();
  for (int frame = 0; frame < 20; ++frame) {
    const std::vector<Vec3> positions = mover.next();
    method = *method.with_positions(positions);
    const MeshPtr moved = std::make_shared<const TriangleMesh>(*mesh->moved(positions));
    fresh = std::max(fresh, method_of(moved).memory_mb());
    EXPECT_LE(method.memory_mb(), 1.15 * fresh);
  }
}

TEST_P(Moving, EveryMethodAnswersAsFresh) {
  const SourceSet sources = SourceSet::of_vertices({3});
  for (const MethodKind kind : {MethodKind::kHeat, MethodKind::kWavefront, MethodKind::kExact}) {
    MethodOptions options;
    options.method = kind;
    options.precision = Precision::kFull;
    auto method = build_method(mesh, options);
    for (int frame = 0; frame < 3; ++frame) {
      const auto moved = std::make_shared<const TriangleMesh>(*mesh->moved(mover.next()));
      method = build_method_moved(moved, options, method->get());
      ASSERT_TRUE(method) << method.error().message;
      const auto fresh = build_method(moved, options);
      EXPECT_LE(relative_difference((*method)->solve(sources)->distances,
                                    (*fresh)->solve(sources)->distances),
                1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Moving, testing::ValuesIn(kKinds),
                         [](const auto& each) { return each.param.name; });

// Large enough to be dissected, which smaller ones are not.
TEST(MovingLarge, KeepsTheOrderWhereEdgesFlip) {
  const MeshPtr mesh = finish(jittered_plane(60, 0.3, 5));
  Mover mover(*mesh, 0.2);
  HeatMethod method = method_of(mesh, in_doubles());
  const SourceSet sources = SourceSet::of_vertices({1000});
  for (int frame = 0; frame < 5; ++frame) {
    const std::vector<Vec3> positions = mover.next();
    method = *method.with_positions(positions);
    const HeatMethod fresh =
        method_of(std::make_shared<const TriangleMesh>(*mesh->moved(positions)), in_doubles());
    EXPECT_LE(
        relative_difference(solve(method, sources).distances, solve(fresh, sources).distances),
        1e-12);
    EXPECT_LE(method.memory_mb(), 1.16 * fresh.memory_mb());
  }
}

TEST(MovingLarge, KeepsTheAnalysisWhereTrianglesStay) {
  const MeshPtr mesh = finish(plane_grid(50, 50, 1, 1));
  std::vector<Vec3> positions(mesh->positions().begin(), mesh->positions().end());
  for (Vec3& p : positions) p[2] = 0.3 * p[0];
  const auto moved = method_of(mesh).with_positions(positions);
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->timing().analyze, 0);
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
  HeatOptions options = in_doubles();
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
  HeatOptions options = in_doubles();
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
  HeatOptions options = in_doubles();
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
  HeatMethod method = method_of(mesh, in_doubles());
  std::vector<Vec3> positions(mesh->positions().begin(), mesh->positions().end());
  for (int stroke = 0; stroke < 3; ++stroke) {
    positions = brushed(positions, 3000, 0.06);
    method = *method.with_positions(positions);
    const HeatMethod fresh =
        method_of(std::make_shared<const TriangleMesh>(*mesh->moved(positions)), in_doubles());
    EXPECT_NEAR(method.t() / fresh.t(), 1, 1e-14);
    EXPECT_LE(relative_difference(solve(method, SourceSet::of_vertices({40})).distances,
                                  solve(fresh, SourceSet::of_vertices({40})).distances),
              kOtherUnit);
  }
  const auto fronts = method.fronts();
  EXPECT_GT(fronts.factored, fronts.all / 2);
  EXPECT_LT(fronts.factored, fronts.all);
}

class MovingBackends : public testing::TestWithParam<std::string> {};

TEST_P(MovingBackends, AnswerAsFresh) {
  const MeshPtr mesh = finish(jittered_plane(20, 0.3, 4));
  Mover mover(*mesh, 0.3);
  const HeatOptions options = with_backend(GetParam(), in_doubles());
  HeatMethod method = method_of(mesh, options);
  for (int frame = 0; frame < 5; ++frame) {
    const std::vector<Vec3> positions = mover.next();
    method = *method.with_positions(positions);
    EXPECT_EQ(method.options(), options);
    const HeatMethod fresh =
        method_of(std::make_shared<const TriangleMesh>(*mesh->moved(positions)), options);
    // Iterations end at a residual, each at its own place.
    EXPECT_LE(relative_difference(solve(method, SourceSet::of_vertices({7})).distances,
                                  solve(fresh, SourceSet::of_vertices({7})).distances),
              GetParam() == "cg" ? 1e-6 : 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, MovingBackends, testing::ValuesIn(backend_names()),
                         backend_test_name);

TEST(MovingRefusals, NameWhatDiffers) {
  const MeshPtr mesh = finish(sphere(2));
  const HeatMethod method = method_of(mesh);
  std::vector<Vec3> positions(mesh->positions().begin(), mesh->positions().end());
  positions.pop_back();
  const auto fewer = method.with_positions(positions);
  ASSERT_FALSE(fewer);
  EXPECT_EQ(fewer.error().message, "there are 161 positions for 162 vertices");
  positions.emplace_back(0, NAN, 0);
  const auto broken = method.with_positions(positions);
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().message, "vertex 161 has a coordinate that is not finite");

  Draft other = sphere(2);
  std::swap(other.faces[5][0], other.faces[5][1]);
  const auto turned = method.with_mesh(finish(other), method.options());
  ASSERT_FALSE(turned);
  EXPECT_EQ(turned.error().message, "face 5 has other corners than before");
  const auto finer = method.with_mesh(finish(sphere(3)), method.options());
  ASSERT_FALSE(finer);
  EXPECT_EQ(finer.error().message,
            "the mesh has 642 vertices and 1280 faces, not 162 vertices and 320 faces");
}

TEST(MovingRefusals, LeaveTheEarlierMethodAsItWas) {
  const MeshPtr mesh = finish(torus(30, 15, 0.4));
  Mover mover(*mesh, 0.3);
  const HeatMethod method = method_of(mesh);
  const SourceSet sources = SourceSet::of_vertices({9});
  const auto before = solve(method, sources).distances;
  const std::vector<Vec3> positions = mover.next();
  EXPECT_EQ(
      method.with_positions(positions, [](std::string_view, double) { return false; }).error().code,
      ErrorCode::kCancelled);
  ASSERT_TRUE(method.with_positions(positions));
  EXPECT_EQ(solve(method, sources).distances, before);
}

}  // namespace
}  // namespace geotherm::test
