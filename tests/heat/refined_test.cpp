// SPDX-License-Identifier: MIT
// Distances where faces differ in size or the border has slivers: what the default does about it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <span>
#include <string>

#include "geotherm/accuracy.h"
#include "geotherm/build_method.h"
#include "geotherm/io.h"
#include "solver/geometry/intrinsic_surface.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// On regular grids of as many faces the heat method has a largest error of 3 to 6 % of the range,
// in the corners.
constexpr double kOfRange = 0.065;
// What inserted vertices leave of the largest errors on the same triangulation without them, at
// most.
constexpr double kErrorLeft = 0.5;
// Waves in the plane are exact but for what an edge's visits leave unnoticed: 1e-4 of a side each.
constexpr double kNearExact = 1e-3;
// The same numbers by two ways but for the round-off of compact factors.
constexpr double kSolved = 1e-6;

Draft stretched_delaunay() {
  Draft draft = random_delaunay(500, 2);
  for (Vec3& p : draft.positions) p.x() *= 30;
  return draft;
}

struct RefinedCase {
  const char* name;
  Draft (*draft)();
};
void PrintTo(const RefinedCase& c, std::ostream* out) { *out << c.name; }
std::string case_name(const testing::TestParamInfo<RefinedCase>& info) { return info.param.name; }

/// Convex regions of the plane: the distance is the straight line.
class RefinedPlane : public testing::TestWithParam<RefinedCase> {
 protected:
  MeshPtr mesh = finish(GetParam().draft());
  HeatMethod method = method_of(mesh);
  Vec3 at(Index v) const { return mesh->positions()[v]; }

  template <class Distance>
  DistanceError error(const HeatMethod& of, const SourceSet& sources,
                      const Distance& distance) const {
    std::vector<double> right;
    for (const Vec3& p : mesh->positions()) right.push_back(distance(p));
    return distance_error(solve(of, sources).distances, right);
  }
  template <class Distance>
  DistanceError error(const SourceSet& sources, const Distance& distance) const {
    return error(method, sources, distance);
  }
};

TEST_P(RefinedPlane, IsRightFromVertices) {
  ASSERT_EQ(method.laplacian(), LaplacianKind::kRefined);
  HeatOptions options;
  options.laplacian = LaplacianKind::kIntrinsicDelaunay;
  const HeatMethod without = method_of(mesh, options);
  double sum = 0, sum_without = 0;
  for (Index v = 1; v < mesh->vertex_count(); v += mesh->vertex_count() / 6) {
    const SourceSet source = SourceSet::of_vertices({v});
    const auto distance = [&](const Vec3& p) { return (p - at(v)).norm(); };
    const DistanceError e = error(source, distance);
    EXPECT_LE(e.max_of_range, kOfRange) << v;
    sum += e.max_of_range;
    sum_without += error(without, source, distance).max_of_range;
  }
  EXPECT_LE(sum, kErrorLeft * sum_without);
}

TEST_P(RefinedPlane, IsRightFromPointsInFaces) {
  for (Index f = 2; f < mesh->face_count(); f += mesh->face_count() / 6) {
    const Face& face = mesh->faces()[f];
    const Vec3 point = 0.2 * at(face[0]) + 0.3 * at(face[1]) + 0.5 * at(face[2]);
    const SourceSet sources{{SurfacePoint::in_face(f, {0.2, 0.3, 0.5})}, {}};
    const DistanceError e = error(sources, [&](const Vec3& p) { return (p - point).norm(); });
    EXPECT_LE(e.max_of_range, kOfRange) << f;
  }
}

TEST_P(RefinedPlane, IsNearExactBesideTheSource) {
  const auto check = [this](const SourceSet& sources, const Vec3& from) {
    const auto distances = solve(method, sources).distances;
    std::vector<Index> nearest(distances.size());
    std::iota(nearest.begin(), nearest.end(), 0);
    std::ranges::sort(nearest, {}, [&](Index v) { return (at(v) - from).norm(); });
    for (const Index v : std::span(nearest).first(5)) {
      const double right = (at(v) - from).norm();
      EXPECT_NEAR(distances[v], right, kNearExact * right) << v;
    }
  };
  for (Index f = 2; f < mesh->face_count(); f += mesh->face_count() / 6) {
    const Face& face = mesh->faces()[f];
    check(SourceSet::of_vertices({face[0]}), at(face[0]));
    check({{SurfacePoint::in_face(f, {0.2, 0.3, 0.5})}, {}},
          0.2 * at(face[0]) + 0.3 * at(face[1]) + 0.5 * at(face[2]));
  }
}

/// The vertices nearest to a source, and what each is off by there, over the right distance.
std::vector<double> errors_nearby(const std::vector<double>& distances,
                                  const std::vector<double>& right, std::size_t count) {
  std::vector<std::size_t> nearest(right.size());
  std::iota(nearest.begin(), nearest.end(), 0);
  std::ranges::sort(nearest, {}, [&](std::size_t v) { return right[v]; });
  std::vector<double> errors;
  for (const std::size_t v : nearest) {
    if (right[v] > 0 && errors.size() < count) {
      errors.push_back(std::abs(distances[v] - right[v]) / right[v]);
    }
  }
  return errors;
}

TEST_P(RefinedPlane, IsNearExactBesideEachOfSeveralSources) {
  const std::vector<Index> sources = {3, mesh->vertex_count() / 2, mesh->vertex_count() - 5};
  const auto distances = solve(method, SourceSet::of_vertices(sources)).distances;
  for (const Index source : sources) {
    std::vector<double> right(distances.size(), kUnreached);
    for (Index v = 0; v < mesh->vertex_count(); ++v) {
      const auto to = [&](Index s) { return (at(v) - at(s)).norm(); };
      const bool nearest =
          std::ranges::all_of(sources, [&](Index s) { return to(source) <= to(s); });
      if (nearest) right[v] = to(source);
    }
    for (const double error : errors_nearby(distances, right, 2)) EXPECT_LE(error, kNearExact);
  }
}

TEST_P(RefinedPlane, IsNearExactBesideOtherComponents) {
  Draft draft = GetParam().draft();
  const auto own = static_cast<Index>(draft.positions.size());
  const Draft other = plane_grid(80, 80, 100, 100);  // that needs no inserted vertex
  for (const Vec3& p : other.positions) draft.positions.emplace_back(p + Vec3(0, 0, 500));
  for (const Face& f : other.faces) draft.faces.push_back({f[0] + own, f[1] + own, f[2] + own});
  const auto joined = finish(draft);
  const auto both = solve(method_of(joined), SourceSet::of_vertices({3, own + 800})).distances;
  std::vector<double> right;
  for (const Vec3& p : mesh->positions()) right.push_back((p - at(3)).norm());
  for (const double error : errors_nearby(both, right, 2)) EXPECT_LE(error, kNearExact);
  const auto grid = solve(finish(other), {800}).distances;
  for (std::size_t v = 0; v < grid.size(); ++v) {
    EXPECT_NEAR(both[own + v], grid[v], kSolved * 100) << v;
  }
}

TEST_P(RefinedPlane, IsAsPublishedBesideTheSourceOfClassic) {
  HeatOptions classic;
  classic.variant = Variant::kClassic;
  std::vector<double> right;
  for (const Vec3& p : mesh->positions()) right.push_back((p - at(11)).norm());
  const auto near = errors_nearby(solve(mesh, {11}, classic).distances, right, 4);
  EXPECT_GT(*std::ranges::max_element(near), kNearExact);
}

TEST_P(RefinedPlane, IsRightFromEdgesAlongTheBorder) {
  std::vector<std::array<Index, 2>> border;
  const IntrinsicSurface surface = *build_intrinsic_surface(mesh, {});
  const EdgeTable& edges = surface.kept->edges;
  for (Index e = 0; e < edges.edge_count(); ++e) {
    if (edges.sides(e).size() == 1) border.push_back({edges.low(e), edges.high(e)});
  }
  const auto to_border = [&](const Vec3& p) {
    double least = kUnreached;
    for (const auto& [a, b] : border) {
      const Vec3 ab = at(b) - at(a);
      const double t = std::clamp((p - at(a)).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (p - at(a) - t * ab).norm());
    }
    return least;
  };
  // Of the larger side: the range itself is half the smaller one.
  double size = 0;
  for (const Vec3& p : mesh->positions()) size = std::max(size, p.norm());
  EXPECT_LE(error({{}, border}, to_border).max, kOfRange * size / 2);
}

TEST_P(RefinedPlane, KeepsVerticesAndSources) {
  const auto result = solve(method, SourceSet::of_vertices({3, 7}), {.fields = true});
  const auto count = static_cast<std::size_t>(mesh->vertex_count());
  EXPECT_EQ(result.distances.size(), count);
  EXPECT_EQ(result.heat.size(), count);
  EXPECT_EQ(result.log_heat.size(), count);
  EXPECT_EQ(result.distances[3], 0);
  EXPECT_EQ(result.distances[7], 0);
}

TEST_P(RefinedPlane, KeepsItsVerticesWhenTheTimeChanges) {
  HeatOptions other;
  other.time_step.factor = 3;
  const HeatMethod changed = *method.with(other);
  EXPECT_EQ(changed.refinement().points, method.refinement().points);
  EXPECT_EQ(changed.timing().analyze, 0);
  EXPECT_DOUBLE_EQ(changed.t(), 3 * method.t());
  EXPECT_EQ(solve(changed, SourceSet::of_vertices({5})).distances,
            solve(method_of(mesh, other), SourceSet::of_vertices({5})).distances);
}

TEST_P(RefinedPlane, AnswersTheSameWithEveryBackendAndConstraint) {
  const auto right = solve(method, SourceSet::of_vertices({11})).distances;
  for (const std::string& name : direct_backends()) {
    for (const ConstraintMode mode :
         {ConstraintMode::kPinSources, ConstraintMode::kPinVertex, ConstraintMode::kConserveEnergy,
          ConstraintMode::kPseudoInverse}) {
      HeatOptions options = with_backend(name);
      options.constraint.mode = mode;
      EXPECT_LE(relative_difference(solve(mesh, {11}, options).distances, right), kSolved)
          << name << static_cast<int>(mode);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, RefinedPlane,
    testing::Values(RefinedCase{"delaunay", [] { return random_delaunay(500, 1); }},
                    RefinedCase{"stretched", stretched_delaunay},
                    RefinedCase{"graded", [] { return graded_plane(24, 300); }}),
    case_name);

/// Surfaces in space, against the exact method.
class RefinedSurface : public testing::TestWithParam<RefinedCase> {};

TEST_P(RefinedSurface, IsRight) {
  const MeshPtr mesh = finish(GetParam().draft());
  const HeatMethod method = method_of(mesh);
  ASSERT_GT(method.refinement().points, 0);
  MethodOptions exact;
  exact.method = MethodKind::kExact;
  const auto reference = *build_method(mesh, exact);
  for (const Index v : {Index{10}, Index{5}, mesh->vertex_count() / 2}) {
    const SourceSet source = SourceSet::of_vertices({v});
    const DistanceError e =
        distance_error(solve(method, source).distances, reference->solve(source)->distances);
    EXPECT_LE(e.max_of_range, kOfRange) << v;
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, RefinedSurface,
                         testing::Values(RefinedCase{"spiky", spiky_sphere},
                                         RefinedCase{"book", [] { return graded_book(20); }}),
                         case_name);

/// Meshes on which the method was 10 to 90 % wrong; those that are not part of the project.
struct KnownCase {
  const char* file;
  double mean, of_range;  ///< wanted: mean relative error, largest one of the range; in per cent
};
void PrintTo(const KnownCase& c, std::ostream* out) { *out << c.file; }

class KnownCases : public testing::TestWithParam<KnownCase> {};

TEST_P(KnownCases, AreRightOnAverageOverSources) {
  const char* folder = std::getenv("GEOTHERM_TEST_CASES");
  if (folder == nullptr) GTEST_SKIP() << "GEOTHERM_TEST_CASES is not set";
  const auto file = read_mesh(std::string(folder) + '/' + GetParam().file);
  ASSERT_TRUE(file);
  const auto mesh = std::make_shared<const TriangleMesh>(file->mesh);
  const HeatMethod method = method_of(mesh);
  MethodOptions waves;
  waves.method = MethodKind::kWavefrontFine;
  const auto reference = *build_method(mesh, waves);
  double mean = 0, most = 0;
  const Index sources = 8;
  for (Index i = 0; i < sources; ++i) {
    const SourceSet source = SourceSet::of_vertices({i * (mesh->vertex_count() / sources)});
    const DistanceError e =
        distance_error(solve(method, source).distances, reference->solve(source)->distances);
    mean += e.mean_relative / sources;
    most = std::max(most, e.max_of_range);
  }
  EXPECT_LE(100 * mean, GetParam().mean);
  EXPECT_LE(100 * most, GetParam().of_range);
}

// An error of 5 % of the range is fair; in the bow it is reached in a corner. In the last one edges
// differ by 10^3.
INSTANTIATE_TEST_SUITE_P(Files, KnownCases,
                         testing::Values(KnownCase{"uniform_delaunay_3000.ply", 1.5, 5},
                                         KnownCase{"bow_40_0.001.ply", 1.5, 6},
                                         KnownCase{"graded_box.obj", 1.5, 5},
                                         KnownCase{"spikes_105.ply", 1.5, 5},
                                         KnownCase{"cluster_118.ply", 5, 5}),
                         [](const auto& each) {
                           const std::string name = each.param.file;
                           return name.substr(0, name.find_first_of("_."));
                         });

/// Narrow regions of the plane, on which the corrections of the method say nothing.
class NarrowPlane : public testing::TestWithParam<RefinedCase> {};

TEST_P(NarrowPlane, CorrectedIsAsGoodAsClassic) {
  constexpr double kMax = 1.1;  // of the error of classic
  const MeshPtr mesh = finish(GetParam().draft());
  HeatOptions classic;
  classic.variant = Variant::kClassic;
  const HeatMethod corrected = method_of(mesh), published = method_of(mesh, classic);
  const auto positions = mesh->positions();
  for (Index v = 0; v < mesh->vertex_count(); v += mesh->vertex_count() / 5) {
    std::vector<double> straight;
    for (const Vec3& p : positions) straight.push_back((p - positions[v]).norm());
    const SourceSet source = SourceSet::of_vertices({v});
    EXPECT_LE(distance_error(solve(corrected, source).distances, straight).mean_relative,
              kMax * distance_error(solve(published, source).distances, straight).mean_relative)
        << v;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, NarrowPlane,
    testing::Values(RefinedCase{"one_face_wide", [] { return plane_grid(400, 1, 400, 1); }},
                    RefinedCase{"two_faces_wide", [] { return plane_grid(300, 2, 300, 2); }},
                    RefinedCase{"thin_faces", [] { return plane_grid(60, 6, 60, 0.5); }}),
    case_name);

TEST(RefinedGoodMeshes, PayNothing) {
  for (const auto& draft : {torus(40, 20, 0.4), plane_grid(20, 20, 1, 1)}) {
    const MeshPtr mesh = finish(draft);
    const HeatMethod method = method_of(mesh);
    EXPECT_EQ(method.refinement().points, 0);
    HeatOptions plain;
    plain.laplacian = method.laplacian();
    ASSERT_NE(plain.laplacian, LaplacianKind::kRefined);
    EXPECT_EQ(solve(method, SourceSet::of_vertices({3})).distances,
              solve(mesh, {3}, plain).distances);
  }
}

TEST(RefinedTime, IsAsGivenWhereItIsAbsolute) {
  HeatOptions options;
  options.time_step = {TimeRule::kAbsolute, 1, 0.01};
  const HeatMethod method = method_of(finish(graded_plane(24, 300)), options);
  EXPECT_GT(method.refinement().points, 0);
  EXPECT_EQ(method.t(), 0.01);
}

}  // namespace
}  // namespace geotherm::test
