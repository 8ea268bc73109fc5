// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "geotherm/build_method.h"
#include "geotherm/directions.h"
#include "solver/geometry/intrinsic_surface.h"
#include "tests/support/broken_mesh.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

MethodOptions with_method(MethodKind kind) {
  MethodOptions options;
  options.method = kind;
  return options;
}

/// What exact answers may be off by, as a share of the size.
constexpr double kLogExact = 1e-9;
/// What waves may be off by on average.
constexpr double kWaves = 1e-3;

LogMap log_map(const MeshPtr& mesh, const SurfacePoint& point, const LogMapOptions& options = {}) {
  const auto directions = Directions::build(mesh);
  EXPECT_TRUE(directions) << directions.error().message;
  auto map = (*directions)->log_map(point, options);
  EXPECT_TRUE(map) << map.error().message;
  return *std::move(map);
}

/// On a plane, and with the normals of the faces, what the map says is where the vertices are.
void expect_plane(const MeshPtr& mesh, const SurfacePoint& point) {
  const LogMap map = log_map(mesh, point);
  const Vec3 middle = position_at(*mesh, point);
  EXPECT_NEAR(map.frame.normal.z(), 1, kLogExact);
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    const Vec3 found = map.frame.vector(map.directions[v], map.distances[v]);
    EXPECT_NEAR((middle + found - mesh->positions()[v]).norm(), 0, kLogExact) << v;
  }
}

/// Waves from all kinds of points, far beyond where windows go along with them.
TEST(LogMap, ByWavesOfThePlaneIsNearThePlaneSlow) {
  const MeshPtr mesh = finish(jittered_plane(120, 0.2, 9));
  for (const MethodKind method : {MethodKind::kWavefront, MethodKind::kWavefrontFine}) {
    for (const SurfacePoint& point :
         {SurfacePoint::at_vertex(0), SurfacePoint::at_vertex(grid_vertex(120, 15, 3)),
          SurfacePoint::in_face(77, {0.2, 0.5, 0.3}), SurfacePoint::in_face(78, {0.25, 0.75, 0})}) {
      const LogMap map = log_map(mesh, point, {method, kUnreached, {}});
      double sum = 0;
      for (Index v = 0; v < mesh->vertex_count(); ++v) {
        const Vec3 found = map.frame.vector(map.directions[v], map.distances[v]);
        sum += (position_at(*mesh, point) + found - mesh->positions()[v]).norm();
      }
      EXPECT_LT(sum / mesh->vertex_count(), kWaves) << to_text(method);
    }
  }
}

TEST(LogMap, OfThePlaneIsThePlaneFromAnInnerVertex) {
  expect_plane(finish(jittered_plane(12, 0.3, 1)), SurfacePoint::at_vertex(grid_vertex(12, 5, 7)));
}

TEST(LogMap, OfThePlaneIsThePlaneFromTheBorder) {
  expect_plane(finish(jittered_plane(12, 0.3, 2)), SurfacePoint::at_vertex(grid_vertex(12, 0, 4)));
}

TEST(LogMap, OfThePlaneIsThePlaneFromACorner) {
  expect_plane(finish(jittered_plane(12, 0.3, 3)), SurfacePoint::at_vertex(0));
}

TEST(LogMap, OfThePlaneIsThePlaneFromAFace) {
  expect_plane(finish(jittered_plane(12, 0.3, 4)), SurfacePoint::in_face(77, {0.2, 0.5, 0.3}));
}

TEST(LogMap, OfThePlaneIsThePlaneFromAnEdge) {
  const MeshPtr mesh = finish(jittered_plane(12, 0.3, 5));
  for (const Index face : {77, 78, 120}) {
    expect_plane(mesh, SurfacePoint::in_face(face, {0.25, 0, 0.75}));
    expect_plane(mesh, SurfacePoint::in_face(face, {0.25, 0.75, 0}));
    expect_plane(mesh, SurfacePoint::in_face(face, {0, 0.4, 0.6}));
    expect_plane(mesh, SurfacePoint::in_face(face, {1e-16, 0.4, 0.6}));  // as if it were 0
  }
}

TEST(LogMap, OfThePlaneWithSliversIsThePlane) {
  expect_plane(finish(graded_plane(20, 1e4)), SurfacePoint::at_vertex(grid_vertex(20, 9, 11)));
}

/// A third page turned round changes nothing on the plane of the other two.
TEST(LogMap, FollowsTheFileWhereFacesAreTurnedRound) {
  Draft draft = jittered_plane(8, 0.2, 6);
  for (std::size_t f = 0; f < draft.faces.size(); f += 3) {
    std::swap(draft.faces[f][1], draft.faces[f][2]);
  }
  const MeshPtr mesh = finish(draft);
  for (const Index face : {30, 31, 32}) {
    const SurfacePoint point = SurfacePoint::in_face(face, {0.2, 0.5, 0.3});
    const LogMap map = log_map(mesh, point);
    EXPECT_NEAR(map.frame.normal.z(), face % 3 == 0 ? -1 : 1, kLogExact);
    for (Index v = 0; v < mesh->vertex_count(); ++v) {
      const Vec3 found = map.frame.vector(map.directions[v], map.distances[v]);
      EXPECT_NEAR((position_at(*mesh, point) + found - mesh->positions()[v]).norm(), 0, kLogExact);
    }
  }
}

/// A cone about vertex 0: flat sectors with unit sides, every other corner raised and lowered by
/// `elevation`, which makes more of it than a plane; each cut into 4^3.
struct Cone {
  MeshPtr mesh;
  double total;                                   ///< angle round the tip
  std::vector<std::pair<double, double>> places;  ///< radius and angle of the vertices, unrolled
};

Cone cone(Index sectors, double mean, double zigzag) {
  Draft draft;
  draft.add(Vec3::Zero());
  for (Index k = 0; k < sectors; ++k) {
    const double turn = 2 * std::numbers::pi * k / sectors,
                 up = mean + (k % 2 == 0 ? zigzag : -zigzag);
    draft.add({std::cos(turn) * std::cos(up), std::sin(turn) * std::cos(up), std::sin(up)});
    draft.faces.push_back({0, 1 + k, 1 + (k + 1) % sectors});
  }
  const MeshPtr coarse = finish(draft);
  const auto fine = subdivide(*coarse, 3);
  EXPECT_TRUE(fine);
  Cone out{std::make_shared<const TriangleMesh>(*fine), 0, {}};
  out.places.resize(static_cast<std::size_t>(fine->vertex_count()));
  for (Index k = 0; k < sectors; ++k) {
    const Vec3 first = coarse->positions()[coarse->faces()[k][1]];
    const Vec3 last = coarse->positions()[coarse->faces()[k][2]];
    for (Index f = 64 * k; f < 64 * k + 64; ++f) {
      for (const Index v : fine->faces()[f]) {
        const Vec3& p = fine->positions()[v];
        out.places[v] = {p.norm(), out.total + std::atan2(first.cross(p).norm(), first.dot(p))};
      }
    }
    out.total += std::atan2(first.cross(last).norm(), first.dot(last));
  }
  return out;
}

TEST(LogMap, AboutTheTipOfAConeIsTheConeUnrolledAndScaled) {
  for (const auto& [mean, zigzag] : {std::pair{0.8, 0.0}, {0.0, 0.9}}) {
    const Cone shape = cone(6, mean, zigzag);
    const LogMap map = log_map(shape.mesh, SurfacePoint::at_vertex(0));
    EXPECT_NEAR(map.frame.angle, shape.total, kLogExact);
    for (std::size_t v = 2; v < shape.places.size(); ++v) {
      EXPECT_NEAR(map.distances[v], shape.places[v].first, kLogExact) << v;
      const double turn = shape.places[v].second - shape.places[1].second;
      const double off =
          2 * std::numbers::pi / shape.total * turn - (map.directions[v] - map.directions[1]);
      EXPECT_NEAR(std::remainder(off, 2 * std::numbers::pi), 0, kLogExact) << v;
    }
  }
}

/// From inside a face, in the plane of the cone cut open behind the source. On a cone of more than
/// a plane the tip bends paths, which then start towards it.
void expect_cone_beside_tip(const Cone& shape) {
  constexpr double kRadius = 0.42, kAngle = 0.31;
  const Vec3 first = shape.mesh->positions()[1], last = shape.mesh->positions()[2];
  const Vec3 across = (last - last.dot(first) * first).normalized();
  const Vec3 place = kRadius * (std::cos(kAngle) * first + std::sin(kAngle) * across);
  const auto source = closest_point(*shape.mesh, place);
  ASSERT_TRUE(source);
  ASSERT_LT(source->distance, 1e-12);
  const LogMap map = log_map(shape.mesh, source->point);
  EXPECT_NEAR(map.distances[0], kRadius, kLogExact);
  int bent = 0;
  for (std::size_t v = 1; v < shape.places.size(); ++v) {
    const auto [radius, angle] = shape.places[v];
    const double turn = std::remainder(angle - kAngle, shape.total);
    // Where two paths are equally short, either is right.
    if (shape.total < 2 * std::numbers::pi && std::abs(turn) > shape.total / 2 - 1e-6) continue;
    const double seen = std::remainder(map.directions[v] - map.directions[0], 2 * std::numbers::pi);
    if (std::abs(turn) >= std::numbers::pi) {
      EXPECT_NEAR(map.distances[v], kRadius + radius, kLogExact) << v;
      EXPECT_NEAR(seen, 0, kLogExact) << v;
      ++bent;
      continue;
    }
    // From the source towards the tip is the first axis.
    const double along = kRadius - radius * std::cos(turn), beside = -radius * std::sin(turn);
    EXPECT_NEAR(map.distances[v], std::hypot(along, beside), kLogExact) << v;
    EXPECT_NEAR(std::remainder(seen - std::atan2(beside, along), 2 * std::numbers::pi), 0,
                kLogExact)
        << v;
  }
  EXPECT_EQ(bent > 0, shape.total > 2 * std::numbers::pi);
}

TEST(LogMap, BesideTheTipOfAConeIsExact) { expect_cone_beside_tip(cone(6, 0.8, 0)); }
TEST(LogMap, BehindASaddleStartsTowardsIt) { expect_cone_beside_tip(cone(6, 0, 0.9)); }

/// Vertices in a sphere of level `level` in the map of `source`, against the sphere's own.
double mean_error_on_sphere(int level, Index source, MethodKind method = MethodKind::kExact) {
  const MeshPtr mesh = finish(sphere(level));
  const LogMap map = log_map(mesh, SurfacePoint::at_vertex(source), {method, kUnreached, {}});
  const Vec3 pole = mesh->positions()[source];
  double sum = 0;
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    const Vec3& p = mesh->positions()[v];
    const double distance = std::acos(std::clamp(p.dot(pole), -1.0, 1.0));
    if (distance > 2.5 || v == source) continue;  // far from the point where all lines meet
    const Vec3 way = (p - p.dot(pole) * pole).normalized() * distance;
    sum += (map.frame.vector(map.directions[v], map.distances[v]) - way).norm();
  }
  return sum / mesh->vertex_count();
}

TEST(LogMap, OfSpheresConvergesToTheirs) {
  const double coarse = mean_error_on_sphere(2, 20), fine = mean_error_on_sphere(3, 20),
               finest = mean_error_on_sphere(4, 20);
  EXPECT_LT(fine, coarse / 2);
  EXPECT_LT(finest, fine / 2);
  EXPECT_LT(finest, 0.01);
}

TEST(LogMap, ByWavesOfASphereIsAsNearSlow) {
  for (const MethodKind method : {MethodKind::kWavefront, MethodKind::kWavefrontFine}) {
    EXPECT_LT(mean_error_on_sphere(6, 20, method), 0.005);
  }
}

/// Behind hills two paths of almost one length leave the point in directions that differ by much,
/// and valleys spread what is behind them.
TEST(LogMap, ByWavesSaysWhereItHangsOnWhichPathIsTheShorter) {
  const Draft flat = plane_grid(120, 120, 1, 1);
  Draft hilly = flat;
  for (Vec3& p : hilly.positions) {
    p.z() = 0.05 * std::sin(12 * std::numbers::pi * p.x() + 1) *
            std::sin(12 * std::numbers::pi * p.y() + 2);
  }
  const MeshPtr hills = finish(hilly), plane = finish(flat);
  const Index source = grid_vertex(120, 10, 60);
  const LogMapOptions waves{MethodKind::kWavefront, kUnreached, {}};
  const auto warnings = [&](const MeshPtr& mesh, const LogMapOptions& options) {
    const auto map = (*Directions::build(mesh))->log_map(SurfacePoint::at_vertex(source), options);
    EXPECT_TRUE(map);
    return map->warnings;
  };
  const auto found = warnings(hills, waves);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].message.find("directions of "), std::string::npos);
  EXPECT_FALSE(settings_of(found[0].hint).empty());
  EXPECT_NE(found[0].message.find("less than 0.4 %"), std::string::npos);
  EXPECT_TRUE(warnings(hills, {}).empty());
  EXPECT_TRUE(warnings(plane, waves).empty());
}

TEST(LogMap, EndsAtItsReach) {
  const MeshPtr mesh = finish(sphere(4));
  const SurfacePoint source = SurfacePoint::at_vertex(20);
  for (const MethodKind method : {MethodKind::kExact, MethodKind::kWavefront}) {
    const LogMap whole = log_map(mesh, source, {method, kUnreached, {}});
    const LogMap near = log_map(mesh, source, {method, 0.5, {}});
    const LogMap one = log_map(mesh, source, {method, kUnreached, {77, 500}});
    int inside = 0;
    for (Index v = 0; v < mesh->vertex_count(); ++v) {
      const bool in = whole.distances[v] <= 0.5;
      inside += in;
      EXPECT_EQ(near.distances[v], in ? whole.distances[v] : kUnreached);
      EXPECT_EQ(std::isfinite(near.directions[v]), in);
      if (in) {
        EXPECT_EQ(near.directions[v], whole.directions[v]);
      }
      EXPECT_EQ(std::isfinite(one.distances[v]), v == 77 || v == 500);
    }
    EXPECT_GT(inside, 50);
    EXPECT_EQ(one.distances[500], whole.distances[500]);
    EXPECT_EQ(one.directions[77], whole.directions[77]);
  }
}

TEST(LogMap, RefusesMethodsWithoutDirections) {
  const auto directions = Directions::build(finish(sphere(1)));
  ASSERT_TRUE(directions);
  const auto map =
      (*directions)->log_map(SurfacePoint::at_vertex(0), {MethodKind::kHeat, kUnreached, {}});
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, ErrorCode::kNotAvailable);
  EXPECT_FALSE(
      (*directions)->log_map(SurfacePoint::at_vertex(0), {MethodKind::kExact, kUnreached, {9999}}));
}

TEST(LogMap, PassesTheSeamOfAMoebiusStrip) {
  const MeshPtr mesh = finish(moebius(30, 4));
  const auto exact = build_method(mesh, with_method(MethodKind::kExact));
  ASSERT_TRUE(exact);
  const SourceSet source = SourceSet::of_vertices({12});
  const auto distances = (*exact)->solve(source);
  ASSERT_TRUE(distances);
  const LogMap map = log_map(mesh, SurfacePoint::at_vertex(12));
  const auto directions = *Directions::build(mesh);
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    EXPECT_NEAR(map.distances[v], distances->distances[v], kLogExact);
    EXPECT_TRUE(std::isfinite(map.directions[v])) << v;
  }
}

TEST(LogMap, RefusesAVertexOfSeveralFans) {
  Draft draft = plane_grid(2, 2, 1, 1);
  append(draft, plane_grid(2, 2, 1, 1));
  for (std::size_t f = 8; f < draft.faces.size(); ++f) {
    for (Index& v : draft.faces[f]) v = v == 9 ? 0 : v;
  }
  const auto directions = Directions::build(finish(draft));
  ASSERT_TRUE(directions);
  const auto map = (*directions)->log_map(SurfacePoint::at_vertex(0));
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, ErrorCode::kBadInput);
  EXPECT_EQ(map.error().message.find('\n'), std::string::npos);
  EXPECT_TRUE((*directions)->log_map(SurfacePoint::at_vertex(3)));
}

class LogMapOnBroken : public testing::TestWithParam<unsigned> {};

/// Distances are those of exact on the same surface, but for what edges of degenerate faces are
/// lengthened by (1e-5 of a side), which flips may call for as well; and directions are there where
/// they are.
TEST_P(LogMapOnBroken, MeshesIsFiniteOrOneSentence) {
  for (unsigned seed = 40 * GetParam(); seed < 40 * GetParam() + 40; ++seed) {
    const BrokenMesh broken = broken_mesh(seed, {.placed = false});
    const auto mesh = TriangleMesh::build(broken.draft.positions, broken.draft.faces);
    if (!mesh) continue;
    const auto shared = std::make_shared<const TriangleMesh>(*mesh);
    const auto directions = Directions::build(shared);
    const auto exact = build_method(shared, with_method(MethodKind::kExact));
    ASSERT_EQ(directions.has_value(), exact.has_value()) << broken.recipe;
    if (!directions) continue;
    const auto flipped = build_intrinsic_surface(
        shared, {.flip = FlipRule::kAlways, .strictness = Strictness::kHeights});
    for (const Index v : {Index{0}, shared->vertex_count() / 2, shared->vertex_count() - 1}) {
      const auto map = (*directions)->log_map(SurfacePoint::at_vertex(v));
      if (!map) {
        EXPECT_EQ(map.error().message.find('\n'), std::string::npos) << broken.recipe;
        continue;
      }
      const auto distances = (*exact)->solve(SourceSet::of_vertices({v}));
      ASSERT_TRUE(distances) << broken.recipe;
      const auto waves =
          (*directions)
              ->log_map(SurfacePoint::at_vertex(v), {MethodKind::kWavefront, kUnreached, {}});
      EXPECT_TRUE(waves || waves.error().message.find('\n') == std::string::npos);
      for (std::size_t w = 0; waves && w < waves->distances.size(); ++w) {
        EXPECT_EQ(std::isfinite(waves->distances[w]), std::isfinite(waves->directions[w]))
            << broken.recipe;
      }
      double size = 0;
      for (const double d : distances->distances)
        size = std::isfinite(d) ? std::max(size, d) : size;
      const bool lengthened = flipped->intrinsic.mollified.most > 0;
      for (Index w = 0; w < shared->vertex_count(); ++w) {
        const double d = distances->distances[w];
        EXPECT_EQ(std::isfinite(map->directions[w]), std::isfinite(d)) << broken.recipe;
        if (!std::isfinite(d)) continue;
        EXPECT_NEAR(map->distances[w], d, (lengthened ? 1e-5 : kLogExact) * size) << broken.recipe;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, LogMapOnBroken, testing::Range(0U, 6U));

}  // namespace
}  // namespace geotherm::test
