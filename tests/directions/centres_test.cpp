// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "geotherm/build_method.h"
#include "geotherm/directions.h"
#include "tests/support/broken_mesh.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

constexpr double kPi = std::numbers::pi;
/// What exact answers may be off by, as a share of the size.
constexpr double kExact = 1e-8;

std::vector<SurfacePoint> at_vertices(const std::vector<Index>& vertices) {
  std::vector<SurfacePoint> out;
  for (const Index v : vertices) out.push_back(SurfacePoint::at_vertex(v));
  return out;
}

Centres centres(const MeshPtr& mesh, const std::vector<SurfacePoint>& points,
                const std::vector<double>& weights = {}, CentreKind kind = CentreKind::kMean) {
  CentreOptions options;
  options.kind = kind;
  auto found = find_centres(mesh, points, weights, options);
  EXPECT_TRUE(found) << found.error().message;
  for (const Centre& centre : found->found) {
    EXPECT_TRUE(std::ranges::is_sorted(centre.energies,
                                       [](double a, double b) { return a > b * (1 + 1e-11); }));
  }
  return *std::move(found);
}

/// Vertices, points in faces (two in one), and points on edges, of which one is shared.
std::vector<SurfacePoint> mixed_points() {
  return {SurfacePoint::at_vertex(grid_vertex(12, 2, 3)),
          SurfacePoint::at_vertex(grid_vertex(12, 11, 1)),
          SurfacePoint::in_face(77, {0.2, 0.5, 0.3}),
          SurfacePoint::in_face(77, {0.5, 0.2, 0.3}),
          SurfacePoint::in_face(77, {0.25, 0, 0.75}),
          SurfacePoint::in_face(120, {0.6, 0.4, 0}),
          SurfacePoint::in_face(200, {0, 1, 0})};
}

/// Squares of lengths are beyond the range of doubles there.
TEST(Centres, AreFoundInModelsOfAnyUnit) {
  for (const double size : {1e-300, 1e-170, 1e170, 1e300}) {
    const MeshPtr mesh = finish(plane_grid(8, 8, size, size));
    for (const CentreKind kind : {CentreKind::kMean, CentreKind::kMedian}) {
      const Centres found = centres(mesh, at_vertices({0, 8, 72, 80}), {}, kind);
      const Centre& centre = found.found.front();
      const Vec3 at = position_at(*mesh, centre.point);
      EXPECT_NEAR((at / size - Vec3(0.5, 0.5, 0)).norm(), 0, kExact) << size;
      for (const double d : centre.distances) EXPECT_NEAR(d / size, std::sqrt(0.5), kExact);
      if (kind == CentreKind::kMedian) {
        EXPECT_NEAR(centre.energy / size, std::sqrt(0.5), kExact);
      }
    }
  }
}

TEST(Centres, MeanOnThePlaneIsTheCentroid) {
  const MeshPtr mesh = finish(jittered_plane(12, 0.3, 1));
  const std::vector<SurfacePoint> points = mixed_points();
  const std::vector<double> weights = {1, 2, 0.5, 3, 1, 0, 1.5};
  Vec3 centroid = Vec3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    centroid += weights[i] * position_at(*mesh, points[i]);
  }
  centroid /= std::accumulate(weights.begin(), weights.end(), 0.0);
  const Centre mean = centres(mesh, points, weights).found.front();
  EXPECT_TRUE(mean.converged);
  EXPECT_NEAR((position_at(*mesh, mean.point) - centroid).norm(), 0, kExact);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(mean.distances[i], (position_at(*mesh, points[i]) - centroid).norm(), kExact);
  }
}

/// Weights are shares of their sum, also where that is no double.
TEST(Centres, WeightsOfAnySizeAreShares) {
  const MeshPtr mesh = finish(jittered_plane(12, 0.3, 1));
  const std::vector<SurfacePoint> points = mixed_points();
  const std::vector<double> weights = {1, 2, 0.5, 3, 1, 0, 1.5};
  for (const CentreKind kind : {CentreKind::kMean, CentreKind::kMedian}) {
    const Centre expected = centres(mesh, points, weights, kind).found.front();
    for (const double unit : {0x1p1022, 0x1p-1070}) {
      std::vector<double> scaled = weights;
      for (double& weight : scaled) weight *= unit;
      const Centre centre = centres(mesh, points, scaled, kind).found.front();
      EXPECT_EQ(centre.energy, expected.energy) << unit;
      EXPECT_EQ(centre.distances, expected.distances) << unit;
    }
  }
}

TEST(Centres, MedianOfFourPointsIsWhereTheDiagonalsCross) {
  const MeshPtr mesh = finish(jittered_plane(12, 0.3, 2));
  const std::vector<Index> corners = {grid_vertex(12, 1, 2), grid_vertex(12, 10, 1),
                                      grid_vertex(12, 11, 11), grid_vertex(12, 3, 9)};
  const Centre median = centres(mesh, at_vertices(corners), {}, CentreKind::kMedian).found.front();
  const auto at = mesh->positions();
  const Vec3 along = at[corners[2]] - at[corners[0]], across = at[corners[3]] - at[corners[1]];
  const Vec3 between = at[corners[1]] - at[corners[0]];
  const double share = between.cross(across).z() / along.cross(across).z();
  const Vec3 crossing = at[corners[0]] + share * along;
  EXPECT_TRUE(median.converged);
  EXPECT_NEAR((position_at(*mesh, median.point) - crossing).norm(), 0, 1e-7);
}

/// The lines to the corners meet at equal angles (Fermat, Torricelli).
TEST(Centres, MedianOfATriangleSeesItsCornersAtEqualAngles) {
  const MeshPtr mesh = finish(jittered_plane(12, 0.3, 3));
  const std::vector<Index> corners = {grid_vertex(12, 1, 2), grid_vertex(12, 11, 4),
                                      grid_vertex(12, 4, 11)};
  const Centre median = centres(mesh, at_vertices(corners), {}, CentreKind::kMedian).found.front();
  Vec3 sum = Vec3::Zero();
  for (const Index v : corners) {
    sum += (mesh->positions()[v] - position_at(*mesh, median.point)).normalized();
  }
  EXPECT_NEAR(sum.norm(), 0, 1e-6);
}

TEST(Centres, MedianIsAPointThatWeighsAsMuchAsTheOthers) {
  const MeshPtr mesh = finish(jittered_plane(12, 0.3, 4));
  std::vector<SurfacePoint> points = mixed_points();
  const std::vector<double> weights = {1, 1, 7, 1, 1, 1, 1};
  const Centre median = centres(mesh, points, weights, CentreKind::kMedian).found.front();
  EXPECT_TRUE(median.converged);
  EXPECT_NEAR((position_at(*mesh, median.point) - position_at(*mesh, points[2])).norm(), 0, kExact);
  EXPECT_EQ(median.distances[2], 0);
}

/// On a cone two points have the straight line of its unrolled half between them.
TEST(Centres, MeanOfTwoPointsOnAConeDividesTheirLine) {
  constexpr Index kSectors = 5, kRings = 8;
  constexpr double kSector = 0.8;
  const MeshPtr mesh = finish(pyramid(kSectors, kRings, kSector));
  // Corners of the outermost ring are at slant height 1.
  std::vector<Index> corners;
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    if (std::abs((mesh->positions()[v] - mesh->positions()[0]).norm() - 1) < 1e-9) {
      corners.push_back(v);
    }
  }
  ASSERT_EQ(corners.size(), 5U);
  for (const int apart : {1, 2}) {
    const double turn = apart * kSector;
    const double whole = 2 * std::sin(turn / 2);
    const Centre mean =
        centres(mesh, at_vertices({corners[0], corners[static_cast<std::size_t>(apart)]}), {3, 1})
            .found.front();
    EXPECT_TRUE(mean.converged);
    EXPECT_NEAR(mean.distances[0], whole / 4, kExact);
    EXPECT_NEAR(mean.distances[1], 3 * whole / 4, kExact);
    EXPECT_NEAR(mean.energy, 3 * whole * whole / 16, kExact);
  }
}

/// Flat sectors round a saddle, more than 2 pi in all.
MeshPtr saddle() {
  Draft draft;
  draft.add(Vec3::Zero());
  constexpr Index kSectors = 6;
  for (Index k = 0; k < kSectors; ++k) {
    const double turn = 2 * kPi * k / kSectors, up = k % 2 == 0 ? 0.9 : -0.9;
    draft.add({std::cos(turn) * std::cos(up), std::sin(turn) * std::cos(up), std::sin(up)});
    draft.faces.push_back({0, 1 + k, 1 + (k + 1) % kSectors});
  }
  const auto fine = subdivide(*finish(draft), 2);
  EXPECT_TRUE(fine);
  return std::make_shared<const TriangleMesh>(*fine);
}

/// Such means are sticky (Hotz and others 2013): small changes of the weights do not move them.
TEST(Centres, MeanRoundASaddleIsItsTip) {
  const MeshPtr mesh = saddle();
  for (const double first : {1.0, 1.1}) {
    const Centre mean =
        centres(mesh, at_vertices({1, 2, 3, 4, 5, 6}), {first, 1, 1, 1, 1, 1}).found.front();
    EXPECT_NEAR(position_at(*mesh, mean.point).norm(), 0, kExact) << first;
    EXPECT_NEAR(mean.energy, 1, kExact) << first;
  }
}

TEST(Centres, OfARingRoundThePoleOfASphereIsThePole) {
  const MeshPtr mesh = finish(sphere(4));
  const Vec3 pole = Vec3(0.3, -0.5, 0.8).normalized();
  const Vec3 side = pole.unitOrthogonal(), other = pole.cross(side);
  std::vector<SurfacePoint> ring;
  for (int i = 0; i < 5; ++i) {
    const double turn = 2 * kPi * i / 5;
    const auto point =
        closest_point(*mesh, std::cos(0.9) * pole +
                                 std::sin(0.9) * (std::cos(turn) * side + std::sin(turn) * other));
    ASSERT_TRUE(point);
    ring.push_back(point->point);
  }
  for (const CentreKind kind : {CentreKind::kMean, CentreKind::kMedian}) {
    const Centres found = centres(mesh, ring, {}, kind);
    const Centre& centre = found.found.front();
    EXPECT_TRUE(centre.converged);
    EXPECT_LT((position_at(*mesh, centre.point) - pole).norm(), 0.01);
    EXPECT_NEAR(centre.distances[3], 0.9, 0.01);
  }
}

TEST(Centres, OfOppositePointsAreSaidToBeMany) {
  const MeshPtr mesh = finish(sphere(3));
  const Vec3 first = mesh->positions()[0];
  Index last = 0;
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    if (mesh->positions()[v].dot(first) < mesh->positions()[last].dot(first)) last = v;
  }
  const Centres found = centres(mesh, at_vertices({0, last}));
  ASSERT_GT(found.found.size(), 1U);
  for (const Centre& centre : found.found) {
    EXPECT_NEAR(position_at(*mesh, centre.point).dot(first), 0, 0.05);
  }
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_NE(found.warnings.back().message.find("not unique"), std::string::npos);
}

TEST(Centres, RefuseWhatCannotBe) {
  Draft two = plane_grid(2, 2, 1, 1);
  append(two, plane_grid(2, 2, 1, 1));
  const MeshPtr mesh = finish(two);
  const auto code = [&](const std::vector<SurfacePoint>& points, std::vector<double> weights) {
    const auto found = find_centres(mesh, points, weights);
    EXPECT_FALSE(found);
    EXPECT_EQ(found.error().message.find('\n'), std::string::npos);
    return found.error().code;
  };
  EXPECT_EQ(code({}, {}), ErrorCode::kBadInput);
  EXPECT_EQ(code(at_vertices({0, 10}), {}), ErrorCode::kBadInput);  // two components
  EXPECT_EQ(code(at_vertices({0, 10}), {1, 0}), ErrorCode::kBadInput);
  EXPECT_EQ(code(at_vertices({0, 1}), {1}), ErrorCode::kBadInput);
  EXPECT_EQ(code(at_vertices({0, 1}), {1, -1}), ErrorCode::kBadInput);
  EXPECT_EQ(code(at_vertices({0, 1}), {0, 0}), ErrorCode::kBadInput);
  EXPECT_EQ(code(at_vertices({0, 99}), {}), ErrorCode::kBadInput);
}

/// Lloyd's iteration on points of the plane with weights, written out.
struct PlainLloyd {
  std::vector<Vec3> places;
  std::vector<double> weights;
  std::vector<Vec3> centres;

  double step(bool move) {
    std::vector<Vec3> sums(centres.size(), Vec3::Zero());
    std::vector<double> weight(centres.size(), 0.0);
    double energy = 0;
    for (std::size_t v = 0; v < places.size(); ++v) {
      const auto nearest = std::ranges::min_element(
          centres, {}, [&](const Vec3& c) { return (c - places[v]).squaredNorm(); });
      const auto c = static_cast<std::size_t>(nearest - centres.begin());
      energy += weights[v] * (*nearest - places[v]).squaredNorm();
      sums[c] += weights[v] * places[v];
      weight[c] += weights[v];
    }
    for (std::size_t c = 0; move && c < centres.size(); ++c) centres[c] = sums[c] / weight[c];
    return energy;
  }
};

TEST(Relaxation, OnThePlaneIsLloydsIteration) {
  const MeshPtr mesh = finish(jittered_plane(24, 0.3, 7));
  PlainLloyd plain{{mesh->positions().begin(), mesh->positions().end()}, {}, {}};
  plain.weights.assign(plain.places.size(), 0.0);
  for (const Face& f : mesh->faces()) {
    const auto at = mesh->positions();
    const double area = (at[f[1]] - at[f[0]]).cross(at[f[2]] - at[f[0]]).norm() / 2;
    for (const Index v : f) plain.weights[v] += area / 3;
  }
  std::mt19937 random(5);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 9; ++i) {
    points.push_back(SurfacePoint::at_vertex(static_cast<Index>(random() % plain.places.size())));
    plain.centres.push_back(position_at(*mesh, points.back()));
  }
  MethodOptions options;
  options.method = MethodKind::kExact;
  const auto method = build_method(mesh, options);
  ASSERT_TRUE(method);
  constexpr int kSteps = 12;
  const auto relaxed = relax_points(**method, mesh, points, kSteps);
  ASSERT_TRUE(relaxed) << relaxed.error().message;
  ASSERT_EQ(relaxed->energies.size(), kSteps + 1U);
  ASSERT_EQ(relaxed->moves.size(), static_cast<std::size_t>(kSteps));
  for (int i = 0; i <= kSteps; ++i) {
    EXPECT_NEAR(relaxed->energies[static_cast<std::size_t>(i)], plain.step(i < kSteps), kExact)
        << i;
  }
  for (std::size_t c = 0; c < points.size(); ++c) {
    EXPECT_NEAR((position_at(*mesh, relaxed->points[c]) - plain.centres[c]).norm(), 0, kExact);
  }
}

TEST(Relaxation, LowersTheEnergyWithEveryStepUntilItSettlesSlow) {
  const MeshPtr mesh = finish(torus(60, 30, 0.4));
  MethodOptions options;
  options.method = MethodKind::kWavefront;
  const auto method = build_method(mesh, options);
  ASSERT_TRUE(method);
  std::vector<SurfacePoint> points;  // all at first in one corner
  for (Index v = 0; v < 20; ++v) points.push_back(SurfacePoint::at_vertex(v));
  const auto relaxed = relax_points(**method, mesh, points, 200);
  ASSERT_TRUE(relaxed) << relaxed.error().message;
  const std::vector<double>& energies = relaxed->energies;
  for (std::size_t i = 1; i < energies.size(); ++i) EXPECT_LT(energies[i], energies[i - 1]) << i;
  EXPECT_LT(energies.back(), energies.front() / 10);
  // Cells of equal size as hexagons have the least energy in the plane (Fejes Toth); no cells of a
  // surface of little curvature can have much less.
  const double area = 4 * kPi * kPi * 0.4;
  const double hexagons = 5 / (18 * std::sqrt(3.0)) * area * area / 20;
  EXPECT_GT(energies.back(), 0.9 * hexagons);
  EXPECT_LT(energies.back(), 1.3 * hexagons);
}

TEST(Relaxation, IsTheSameWithAnyNumberOfThreads) {
  const MeshPtr mesh = finish(sphere(3));
  MethodOptions options;
  options.method = MethodKind::kWavefront;
  const auto method = build_method(mesh, options);
  ASSERT_TRUE(method);
  const auto points = at_vertices({0, 5, 77, 300});
  const auto one = relax_points(**method, mesh, points, 5, {}, 1);
  const auto three = relax_points(**method, mesh, points, 5, {}, 3);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(one->points, three->points);
  EXPECT_EQ(one->energies, three->energies);
}

/// On meshes as files bring them, at worst: finite numbers, or one sentence.
TEST(Relaxation, AndCentresOfBrokenMeshesAreFiniteOrOneSentence) {
  int found = 0;
  for (unsigned seed = 0; seed < 120; ++seed) {
    const BrokenMesh broken = broken_mesh(seed, {.placed = false});
    const auto built = TriangleMesh::build(broken.draft.positions, broken.draft.faces);
    if (!built) continue;
    const auto mesh = std::make_shared<const TriangleMesh>(*built);
    const Index last = mesh->vertex_count() - 1;
    const auto points = at_vertices({0, last / 2, last});
    for (const CentreKind kind : {CentreKind::kMean, CentreKind::kMedian}) {
      CentreOptions options;
      options.kind = kind;
      const auto centres = find_centres(mesh, points, {}, options);
      if (!centres) {
        EXPECT_EQ(centres.error().message.find('\n'), std::string::npos) << broken.recipe;
        continue;
      }
      ++found;
      EXPECT_TRUE(position_at(*mesh, centres->found.front().point).allFinite()) << broken.recipe;
      EXPECT_TRUE(std::isfinite(centres->found.front().energy)) << broken.recipe;
    }
    MethodOptions options;
    options.method = MethodKind::kWavefront;
    const auto method = build_method(mesh, options);
    if (!method) continue;
    const auto relaxed = relax_points(**method, mesh, points, 3);
    if (!relaxed) continue;
    for (const SurfacePoint& point : relaxed->points) {
      EXPECT_TRUE(position_at(*mesh, point).allFinite()) << broken.recipe;
    }
    for (std::size_t i = 1; i < relaxed->energies.size(); ++i) {
      EXPECT_LT(relaxed->energies[i], relaxed->energies[i - 1]) << broken.recipe;
    }
  }
  EXPECT_GT(found, 20);
}

TEST(Relaxation, RefusesMethodsWithoutNearestPoints) {
  const MeshPtr mesh = finish(sphere(2));
  const auto heat = build_method(mesh, {});
  ASSERT_TRUE(heat);
  const auto relaxed = relax_points(**heat, mesh, at_vertices({0, 5}), 3);
  ASSERT_FALSE(relaxed);
  EXPECT_EQ(relaxed.error().code, ErrorCode::kNotAvailable);
}

}  // namespace
}  // namespace geotherm::test
