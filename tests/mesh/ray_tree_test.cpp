// SPDX-License-Identifier: MIT
#include "solver/mesh/ray_tree.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

#include "bench/models/generate.h"
#include "geotherm/path.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

constexpr unsigned kRaySeed = 20130;
constexpr double kFar = std::numeric_limits<double>::infinity();

/// Of a distance and of a position, relative to the model and the way to it: both searches round,
/// and faces that are seen from their edge magnify that.
constexpr double kRayRoundOff = 1e-10;

RayTree tree_of(const MeshPtr& mesh) {
  auto tree = RayTree::build(mesh);
  EXPECT_TRUE(tree);
  return *tree;
}

MeshPtr model(const char* name, Index faces) {
  auto mesh = generate_model(name, faces);
  EXPECT_TRUE(mesh);
  return std::make_shared<const TriangleMesh>(std::move(*mesh));
}

/// Distance to the first face by looking at all of them (Moeller, Trumbore 1997).
double first_of_all_faces(const TriangleMesh& mesh, const Vec3& origin, const Vec3& direction) {
  using Long = Eigen::Matrix<long double, 3, 1>;
  const Long o = origin.cast<long double>(), d = direction.cast<long double>();
  long double first = std::numeric_limits<long double>::infinity();
  for (const Face& face : mesh.faces()) {
    const Long a = mesh.positions()[static_cast<std::size_t>(face[0])].cast<long double>();
    const Long b = mesh.positions()[static_cast<std::size_t>(face[1])].cast<long double>() - a;
    const Long c = mesh.positions()[static_cast<std::size_t>(face[2])].cast<long double>() - a;
    if (b.cross(c).norm() == 0) continue;
    const Long p = d.cross(c), q = (o - a).cross(b);
    const long double det = b.dot(p);
    if (det == 0) continue;
    const long double u = (o - a).dot(p) / det, v = d.dot(q) / det, t = c.dot(q) / det;
    if (u >= 0 && v >= 0 && u + v <= 1 && t >= 0) first = std::min(first, t);
  }
  return static_cast<double>(first);
}

/// Random points and rays around a mesh.
class Rays {
 public:
  explicit Rays(const TriangleMesh& mesh) : random_(kRaySeed) {
    for (const Vec3& p : mesh.positions()) box_.extend(p);
  }

  double size() const { return box_.diagonal().norm(); }
  double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return Vec3(normal(random_), normal(random_), normal(random_)).normalized();
  }
  Vec3 outside() { return box_.center() + (0.6 + 2 * uniform()) * size() * direction(); }
  /// Of the box and a little around it: in a flat model no point is on the surface.
  Vec3 within() {
    const Vec3 share(uniform(), uniform(), uniform());
    return box_.min() + share.cwiseProduct(box_.diagonal()) + 0.05 * size() * direction();
  }

 private:
  std::mt19937 random_;
  Eigen::AlignedBox3d box_;
};

void expect_valid_weights(const SurfacePoint& point) {
  EXPECT_FALSE(point.is_vertex());
  for (const double w : point.weights) EXPECT_GE(w, 0);
  EXPECT_EQ(point.weights[0] + point.weights[1] + point.weights[2], 1);
}

void expect_same_as_all_faces(const TriangleMesh& mesh, const RayTree& tree, const Vec3& origin,
                              const Vec3& direction, double size) {
  const double expected = first_of_all_faces(mesh, origin, direction);
  const auto hit = tree.first_hit(origin, direction);
  ASSERT_EQ(hit.has_value(), expected < kFar) << "expected at " << expected;
  if (!hit) return;
  const double tolerance = kRayRoundOff * (size + expected * direction.norm());
  EXPECT_NEAR(hit->distance * direction.norm(), expected * direction.norm(), tolerance);
  EXPECT_LE((position_at(mesh, hit->point) - origin - hit->distance * direction).norm(), tolerance);
  expect_valid_weights(hit->point);
}

class RayTreeOfZoo : public testing::TestWithParam<ZooMesh> {};

TEST_P(RayTreeOfZoo, FindsWhatLookingAtAllFacesFinds) {
  const MeshPtr mesh = GetParam().mesh();
  const RayTree tree = tree_of(mesh);
  Rays rays(*mesh);
  for (int i = 0; i < 150; ++i) {
    const Vec3 outside = rays.outside();
    expect_same_as_all_faces(*mesh, tree, outside, 3 * (rays.within() - outside), rays.size());
    expect_same_as_all_faces(*mesh, tree, rays.within(), 1e-3 * rays.direction(), rays.size());
  }
}

INSTANTIATE_TEST_SUITE_P(All, RayTreeOfZoo, testing::ValuesIn(zoo()), zoo_name);

class RayTreeOfModel : public testing::TestWithParam<const char*> {};

TEST_P(RayTreeOfModel, FindsWhatLookingAtAllFacesFinds) {
  const MeshPtr mesh = model(GetParam(), 4000);
  const RayTree tree = tree_of(mesh);
  Rays rays(*mesh);
  for (int i = 0; i < 150; ++i) {
    const Vec3 outside = rays.outside();
    expect_same_as_all_faces(*mesh, tree, outside, rays.within() - outside, rays.size());
    expect_same_as_all_faces(*mesh, tree, rays.within(), rays.direction(), rays.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Bundled, RayTreeOfModel,
                         testing::Values("terrain", "sleeve", "cube", "gargoyle", "bunny"),
                         [](const auto& test) { return std::string(test.param); });

class RayTreeOfSolid : public testing::TestWithParam<const char*> {
 protected:
  static MeshPtr mesh() {
    const std::string name = GetParam();
    if (name == "sphere") return finish(sphere(3));
    if (name == "torus") return finish(torus(36, 18, 0.4));
    return model(GetParam(), 3000);
  }

  /// A point well inside: between where a ray enters the solid and where it leaves.
  static Vec3 inside(const RayTree& tree, Rays& rays) {
    for (int i = 0; i < 1000; ++i) {
      const Vec3 origin = rays.outside();
      const Vec3 direction = (rays.within() - origin).normalized();
      const auto in = tree.first_hit(origin, direction);
      if (!in) continue;
      const double step = 1e-3 * rays.size();
      const auto out = tree.first_hit(origin + (in->distance + step) * direction, direction);
      if (!out || out->distance < step) continue;
      return origin + (in->distance + step / 2 + out->distance / 2) * direction;
    }
    ADD_FAILURE() << "no ray goes through";
    return Vec3::Zero();
  }
};

TEST_P(RayTreeOfSolid, LetsNoRayOutThroughEdgesAndVertices) {
  const MeshPtr mesh = RayTreeOfSolid::mesh();
  const RayTree tree = tree_of(mesh);
  Rays rays(*mesh);
  for (int i = 0; i < (kSanitized ? 1 : 10); ++i) {
    const Vec3 origin = inside(tree, rays);
    for (const Face& face : mesh->faces()) {
      const Vec3& a = mesh->positions()[static_cast<std::size_t>(face[0])];
      const Vec3& b = mesh->positions()[static_cast<std::size_t>(face[1])];
      for (const double share : {0.0, 0.5, rays.uniform()}) {
        const Vec3 direction = a + share * (b - a) - origin;
        const auto hit = tree.first_hit(origin, direction);
        ASSERT_TRUE(hit) << face[0] << ' ' << face[1] << ' ' << share;
        expect_valid_weights(hit->point);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Closed, RayTreeOfSolid,
                         testing::Values("sphere", "torus", "cube", "gargoyle", "bunny"),
                         [](const auto& test) { return std::string(test.param); });

TEST(RayTree, LetsNoRayThroughAGridAlongItsLines) {
  const MeshPtr mesh = finish(plane_grid(8, 8, 1, 1));
  const RayTree tree = tree_of(mesh);
  for (int i = 0; i <= 32; ++i) {
    for (int j = 0; j <= 32; ++j) {
      const auto hit = tree.first_hit({i / 32.0, j / 32.0, 3}, {0, 0, -2});
      ASSERT_TRUE(hit) << i << ' ' << j;
      EXPECT_EQ(hit->distance, 1.5);
    }
  }
}

TEST(RayTree, SeesBothSidesAndNothingBehindOrBeside) {
  const RayTree tree = tree_of(finish(plane_grid(2, 2, 1, 1)));
  EXPECT_TRUE(tree.first_hit({0.3, 0.6, -1}, {0, 0, 1}));
  EXPECT_TRUE(tree.first_hit({0.3, 0.6, 1}, {0, 0, -1}));
  EXPECT_FALSE(tree.first_hit({0.3, 0.6, 1}, {0, 0, 1}));
  EXPECT_FALSE(tree.first_hit({1.001, 0.6, -1}, {0, 0, 1}));
  EXPECT_FALSE(tree.first_hit({-1, 0.5, 1e-9}, {1, 0, 0}));
  EXPECT_FALSE(tree.first_hit({-1, 0.5, 0}, {1, 0, 0})) << "in the plane of every face";
}

TEST(RayTree, TakesTheFaceWithTheLowerNumberAmongEquals) {
  const Draft draft{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                    {{0, 1, 2}, {1, 2, 0}, {0, 2, 1}}};
  const auto hit = tree_of(finish(draft)).first_hit({0.25, 0.25, 1}, {0, 0, -1});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->point.face, 0);
  EXPECT_EQ(hit->point.weights, (std::array<double, 3>{0.5, 0.25, 0.25}));
}

TEST(RayTree, LeavesOutFacesWithoutArea) {
  // A repeated corner, a segment, a point, and behind them one good triangle.
  const auto mesh = std::make_shared<const TriangleMesh>(*TriangleMesh::build(
      {Vec3(0, 0, 1), Vec3(2, 0, 1), Vec3(1, 0, 1), Vec3(-5, -5, 0), Vec3(5, -5, 0), Vec3(0, 9, 0)},
      {{0, 0, 1}, {0, 1, 2}, {2, 2, 2}, {3, 4, 5}}));
  const auto hit = tree_of(mesh).first_hit({1, 0, 3}, {0, 0, -1});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->point.face, 3);
  EXPECT_EQ(hit->distance, 3);
  const auto none = std::make_shared<const TriangleMesh>(
      *TriangleMesh::build({Vec3(0, 0, 0), Vec3(1, 0, 0)}, {{0, 0, 1}}));
  EXPECT_FALSE(tree_of(none).first_hit({0.5, 0, 1}, {0, 0, -1}));
}

TEST(RayTree, FindsTheSameAtEveryScaleOfModelAndDirection) {
  const Draft draft = sphere(2);
  const Vec3 origin(0.3, -2.5, 1.75), direction(-0.25, 1.5, -1);
  const auto expected = tree_of(finish(draft)).first_hit(origin, direction);
  ASSERT_TRUE(expected);
  for (const double scale : {1e-307, 1e-200, 1e-9, 1e9, 1e200, 4e307}) {
    const RayTree tree = tree_of(finish(transformed(draft, scale, Vec3::Zero(), false)));
    for (const double stride : {1e-250, 1e-3, 1e3, 1e250}) {
      SCOPED_TRACE(testing::Message() << "model " << scale << ", direction " << stride);
      const double distance = expected->distance * scale / stride;
      const auto hit = tree.first_hit(scale * origin, stride * direction);
      ASSERT_TRUE(hit);
      EXPECT_EQ(hit->point.face, expected->point.face);
      if (distance == 0 || distance == kFar) continue;  // the answer is no double
      EXPECT_NEAR(hit->distance / distance, 1, kRayRoundOff);
    }
  }
}

TEST(RayTree, ThatIsMovedMeetsWhatOneThatIsBuiltMeets) {
  const MeshPtr mesh = model("gargoyle", 3000);
  std::vector<Vec3> bent(mesh->positions().begin(), mesh->positions().end());
  for (Vec3& p : bent) {  // a part of it
    if (p.y() > 1) p += 0.4 * Vec3(std::sin(4 * p.y()), 0, std::cos(3 * p.x()));
  }
  const auto moved = std::make_shared<const TriangleMesh>(*mesh->moved(bent));
  const auto fitted = tree_of(mesh).moved(moved);
  ASSERT_TRUE(fitted);
  const RayTree built = tree_of(moved);
  std::mt19937 random(kRaySeed);
  std::normal_distribution<double> normal;
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 direction(normal(random), normal(random), normal(random));
    const Vec3 origin = -8 * direction.normalized() + Vec3(normal(random), normal(random), 0);
    const auto a = fitted->first_hit(origin, direction), b = built.first_hit(origin, direction);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    ++hits;
    EXPECT_EQ(a->point.face, b->point.face);
    EXPECT_NEAR(a->distance, b->distance, kRayRoundOff * a->distance);
  }
  EXPECT_GT(hits, 200);
}

TEST(RayTree, IsNotMovedFarBeyondItsBox) {
  const MeshPtr mesh = finish(sphere(2));
  std::vector<Vec3> far(mesh->positions().begin(), mesh->positions().end());
  far[7] *= 5;
  EXPECT_FALSE(tree_of(mesh).moved(std::make_shared<const TriangleMesh>(*mesh->moved(far))));
}

TEST(RayTree, IsNotMovedWhereItHasLeftAFaceOut) {
  Draft draft = sphere(1);
  draft.positions.push_back(draft.positions[0]);
  draft.faces.push_back({0, 1, static_cast<Index>(draft.positions.size()) - 1});  // no area yet
  const MeshPtr mesh = finish(draft);
  EXPECT_FALSE(tree_of(mesh).moved(mesh));
}

TEST(RayTree, SeesSmallPartsOfALargeModelAndFromFarAway) {
  Draft draft = transformed(sphere(2), 1e-6, {500, 0, 0}, false);
  append(draft, transformed(sphere(2), 1, {-500, 0, 0}, false));
  const RayTree tree = tree_of(finish(draft));
  const auto near = tree.first_hit({500, 0, 1}, {0, 0, -1});
  ASSERT_TRUE(near);
  EXPECT_LT(near->point.face, 320);
  EXPECT_NEAR(near->distance, 1 - 1e-6, 1e-7);
  const auto far = tree.first_hit({-500, 1e9, 0.1}, {0, -1, 0});
  ASSERT_TRUE(far);
  EXPECT_GE(far->point.face, 320);
  EXPECT_NEAR(far->distance, 1e9, 2);
}

TEST(RayTree, MissesWithARayThatIsNone) {
  const RayTree tree = tree_of(finish(sphere(1)));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(tree.first_hit({0, 0, 0}, {0, 0, 0}));
  EXPECT_FALSE(tree.first_hit({0, nan, 0}, {0, 0, 1}));
  EXPECT_FALSE(tree.first_hit({0, 0, 0}, {0, kFar, 1}));
  EXPECT_FALSE(tree.first_hit({1e308, 1e308, 1e308}, {1, 1, 1}));
  EXPECT_TRUE(tree.first_hit({0, 0, 0}, {0, 0, -5e-324}));
}

TEST(RayTree, StopsWhenItIsToldTo) {
  const MeshPtr mesh = finish(sphere(5));
  for (const int most : {0, 1, 3}) {
    int calls = 0;
    const auto tree =
        RayTree::build(mesh, [&](std::string_view, double) { return calls++ < most; });
    ASSERT_FALSE(tree);
    EXPECT_EQ(tree.error().code, ErrorCode::kCancelled);
    EXPECT_EQ(calls, most + 1);
  }
}

TEST(RayTree, TellsItsShareInOrder) {
  double last = 0;
  EXPECT_TRUE(RayTree::build(finish(sphere(5)), [&](std::string_view, double share) {
    EXPECT_GE(share, last);
    last = share;
    return true;
  }));
  EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace geotherm::test
