// SPDX-License-Identifier: MIT
// A method whose vertices move gives what a fresh one gives, and keeps what can stay.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

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
