// SPDX-License-Identifier: MIT
// Sources other than one vertex.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/polyhedral/exact_fixture.h"
#include "tests/support/compare.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

constexpr Index kN = 12;

double to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

Vec3 place_of(const Draft& draft, const SurfacePoint& point) {
  if (point.is_vertex()) return draft.positions[point.vertex];
  Vec3 p = Vec3::Zero();
  for (int k = 0; k < 3; ++k) p += point.weights[k] * draft.positions[draft.faces[point.face][k]];
  return p;
}

/// The same surface with the point as its last vertex.
Draft with_vertex_at(Draft draft, const SurfacePoint& point) {
  const Index v = draft.add(place_of(draft, point));
  const auto [a, b, c] = draft.faces[point.face];
  draft.faces[point.face] = {a, b, v};
  draft.faces.insert(draft.faces.end(), {{b, c, v}, {c, a, v}});
  return draft;
}

/// Points all over a mesh: vertices, on edges and in faces, with offsets.
SourceSet scattered(const Draft& draft, int count, double most_offset, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  SourceSet set;
  for (int i = 0; i < count; ++i) {
    const auto face = static_cast<Index>(random() % draft.faces.size());
    double a = uniform(random), b = uniform(random) * (1 - a);
    if (i % 3 == 1) b = 0;
    set.points.push_back(i % 3 == 2 ? SurfacePoint::at_vertex(draft.faces[face][0])
                                    : SurfacePoint::in_face(face, {1 - a - b, a, b}));
    set.offsets.push_back(most_offset * uniform(random));
  }
  return set;
}

/// In the plane: the least sum of an offset and a straight line.
double least_on_plane(const Draft& draft, const SourceSet& set, const Vec3& p) {
  double least = kUnreached;
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    least = std::min(least, set.offsets[i] + (place_of(draft, set.points[i]) - p).norm());
  }
  return least;
}

class ExactSources : public testing::TestWithParam<unsigned> {};

TEST_P(ExactSources, ScatteredOverAPlaneWithOffsetsGiveTheLeastSum) {
  // Few and far apart, or many that shade each other.
  const Draft draft = jittered_plane(kN, 0.3, GetParam());
  const int count = GetParam() % 2 == 0 ? 3 : 25;
  const SourceSet set = scattered(draft, count, 0.3, GetParam());
  const auto d = exact_distances(finish(draft), set);
  for (std::size_t v = 0; v < d.size(); ++v) {
    const double expected = least_on_plane(draft, set, draft.positions[v]);
    EXPECT_NEAR(d[v], expected, kRoundOff) << "vertex " << v;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ExactSources, testing::Range(1U, 13U));

class ExactSourcesOnTheZoo : public testing::TestWithParam<std::tuple<ZooMesh, unsigned>> {};

TEST_P(ExactSourcesOnTheZoo, TogetherGiveTheLeastOfEachAlone) {
  const auto& [mesh, seed] = GetParam();
  const Draft draft = mesh.draft();
  const auto method = exact_method(finish(draft));
  const SourceSet set = scattered(draft, 5, 0.2, seed);
  const auto together = solve_exactly(*method, set, {.nearest = true});
  std::vector<double> least(draft.positions.size(), kUnreached);
  std::vector<std::vector<double>> alone;
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    alone.push_back(solve_exactly(*method, {{set.points[i]}, {}, {set.offsets[i]}}).distances);
    for (std::size_t v = 0; v < least.size(); ++v) least[v] = std::min(least[v], alone[i][v]);
  }
  EXPECT_LE(relative_difference(together.distances, least), kRoundOff);
  for (std::size_t v = 0; v < least.size(); ++v) {
    if (least[v] == kUnreached) continue;
    const Index label = together.nearest_source[v];
    ASSERT_TRUE(label >= 0 && label < 5);
    EXPECT_NEAR(alone[label][v], least[v], kRoundOff * largest(least));
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, ExactSourcesOnTheZoo,
                         testing::Combine(testing::ValuesIn(zoo(kRegular)), testing::Range(1U, 4U)),
                         [](const auto& each) {
                           return std::string(std::get<0>(each.param).name) + "_" +
                                  std::to_string(std::get<1>(each.param));
                         });

class ExactInAFace : public testing::TestWithParam<ZooMesh> {};

TEST_P(ExactInAFace, IsAsIfTheMeshHadAVertexThere) {
  const Draft draft = GetParam().draft();
  const auto faces = static_cast<Index>(draft.faces.size());
  for (const auto& point : {SurfacePoint::in_face(faces / 2, {0.2, 0.5, 0.3}),
                            SurfacePoint::in_face(faces / 3, {0.01, 0.98, 0.01})}) {
    const Draft other = with_vertex_at(draft, point);
    auto expected = exact_distances(finish(other), std::vector<Index>{other.vertex_count() - 1});
    expected.pop_back();
    EXPECT_LE(
        relative_difference(exact_distances(finish(draft), SourceSet{{point}, {}, {}}), expected),
        kRoundOff);
  }
}

INSTANTIATE_TEST_SUITE_P(Zoo, ExactInAFace, testing::ValuesIn(zoo(kSmooth)), zoo_name);

class ExactSourcesThatShade : public testing::TestWithParam<unsigned> {};

TEST_P(ExactSourcesThatShade, OthersByAHairLeaveThemTheRest) {
  // The wave of vertex 0 meets sources in large faces that are ahead of it by very little.
  const Draft draft = jittered_plane(4, 0.3, GetParam());
  SourceSet set = scattered(draft, 12, 1, GetParam());
  set.points.push_back(SurfacePoint::at_vertex(0));
  set.offsets.push_back(0);
  for (std::size_t i = 0; i + 1 < set.points.size(); ++i) {
    const double from_0 = (place_of(draft, set.points[i]) - draft.positions[0]).norm();
    set.offsets[i] = from_0 * (1 - 0.1 * set.offsets[i] * set.offsets[i]);
  }
  const auto d = exact_distances(finish(draft), set);
  for (std::size_t v = 0; v < d.size(); ++v) {
    EXPECT_NEAR(d[v], least_on_plane(draft, set, draft.positions[v]), kRoundOff) << "vertex " << v;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ExactSourcesThatShade, testing::Range(1U, 41U));

TEST(ExactFromAPointBesideAVertex, IsThatFromTheVertex) {
  const Draft draft = jittered_plane(kN, 0.3, 3);
  for (const double gap : {1e-3, 1e-7, 1e-11, 1e-15}) {
    const auto point = SurfacePoint::in_face(77, {1 - 2 * gap, gap, gap});
    const auto d = exact_distances(finish(draft), SourceSet{{point}, {}, {}});
    for (std::size_t v = 0; v < d.size(); ++v) {
      EXPECT_NEAR(d[v], (place_of(draft, point) - draft.positions[v]).norm(), kRoundOff) << gap;
    }
  }
}

TEST(ExactFromACurve, OnAPlaneIsTheDistanceToTheSegment) {
  const Draft draft = plane_grid(kN, kN, 1, 1);
  SourceSet set;
  for (Index i = 3; i < 9; ++i) {
    set.edges.push_back({grid_vertex(kN, i, 5), grid_vertex(kN, i + 1, 5)});
  }
  const Vec3 a = draft.positions[grid_vertex(kN, 3, 5)], b = draft.positions[grid_vertex(kN, 9, 5)];
  const auto d = exact_distances(finish(draft), set);
  for (std::size_t v = 0; v < d.size(); ++v) {
    EXPECT_NEAR(d[v], to_segment(draft.positions[v], a, b), kRoundOff) << "vertex " << v;
  }
}

class ExactFromEdges : public testing::TestWithParam<unsigned> {};

TEST_P(ExactFromEdges, OfAShearedPlaneIsTheDistanceToTheNearest) {
  // Sheared, so that many edges of the mesh are no sides of the triangulation.
  Draft draft = jittered_plane(kN, 0.3, GetParam());
  for (Vec3& p : draft.positions) p.x() += 3 * p.y();
  std::mt19937 random(GetParam());
  SourceSet set;
  for (int i = 0; i < 4; ++i) {
    const Face& face = draft.faces[random() % draft.faces.size()];
    set.edges.push_back({face[0], face[1]});
  }
  set.points.push_back(SurfacePoint::in_face(40, {0.3, 0.3, 0.4}));
  const auto d = exact_distances(finish(draft), set);
  for (std::size_t v = 0; v < d.size(); ++v) {
    const Vec3& p = draft.positions[v];
    double expected = (p - place_of(draft, set.points[0])).norm();
    for (const auto& [a, b] : set.edges) {
      expected = std::min(expected, to_segment(p, draft.positions[a], draft.positions[b]));
    }
    EXPECT_NEAR(d[v], expected, 4 * kRoundOff) << "vertex " << v;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ExactFromEdges, testing::Range(1U, 13U));

TEST(ExactFromACurve, RoundACylinderIsTheHeight) {
  constexpr Index kAround = 15, kAlong = 8;
  const Draft draft = prism(kAround, kAlong, 0.6);
  SourceSet set;
  for (Index i = 0; i < kAround; ++i) {
    set.edges.push_back({3 * kAround + i, 3 * kAround + (i + 1) % kAround});
  }
  const auto d = exact_distances(finish(draft), set);
  for (std::size_t v = 0; v < d.size(); ++v) {
    EXPECT_NEAR(d[v], std::abs(draft.positions[v].z() - 0.6 * 3 / kAlong), kRoundOff);
  }
}

TEST(ExactWithAnOffset, AVertexThatOthersReachSoonerIsNoSource) {
  const Draft draft = plane_grid(kN, kN, 1, 1);
  SourceSet set = SourceSet::of_vertices({0, grid_vertex(kN, kN, kN)});
  set.offsets = {0, 5};
  const auto result = solve_exactly(*exact_method(finish(draft)), set, {.nearest = true});
  EXPECT_NEAR(result.distances.back(), std::sqrt(2), kRoundOff);
  EXPECT_EQ(std::ranges::count(result.nearest_source, 0), draft.vertex_count());
}

TEST(ExactWithAnOffset, OfAnySizeIsAddedToAll) {
  const Draft draft = jittered_plane(kN, 0.3, 3);
  SourceSet set = SourceSet::of_vertices({17});
  const auto plain = exact_distances(finish(draft), set);
  for (const double offset : {1e-9, 3.0, 1e12}) {
    set.offsets = {offset};
    const auto d = exact_distances(finish(draft), set);
    for (std::size_t v = 0; v < d.size(); ++v) {
      EXPECT_NEAR(d[v], plain[v] + offset, kRoundOff * std::max(offset, 1.0));
    }
  }
}

TEST(ExactSourcesThatAreNone, AreErrors) {
  const auto method = exact_method(finish(plane_grid(4, 4, 1, 1)));
  SourceSet negative = SourceSet::of_vertices({3});
  negative.offsets = {-1};
  SourceSet no_number = negative;
  no_number.offsets = {std::numeric_limits<double>::quiet_NaN()};
  for (const SourceSet& set : {SourceSet{}, SourceSet::of_vertices({99}),
                               SourceSet{{}, {{0, 24}}, {}}, negative, no_number}) {
    const auto result = method->solve(set);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
    EXPECT_FALSE(result.error().message.empty());
  }
}

}  // namespace
}  // namespace geotherm::test
