// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geotherm/accuracy.h"
#include "geotherm/build_method.h"
#include "geotherm/mesh.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

MethodOptions options_of(MethodKind kind, int refine) {
  MethodOptions options;
  options.method = kind;
  options.refine = refine;
  return options;
}

DistanceResult answer(const MeshPtr& mesh, const SourceSet& sources, const MethodOptions& options,
                      const QueryOptions& query = {}) {
  const auto method = build_method(mesh, options);
  EXPECT_TRUE(method) << method.error().message;
  if (!method) return {};
  auto result = (*method)->solve(sources, query);
  EXPECT_TRUE(result) << result.error().message;
  return result ? *std::move(result) : DistanceResult();
}

double mean_error(const MeshPtr& mesh, const SourceSet& sources, MethodKind kind, int refine) {
  const auto exact = answer(mesh, sources, options_of(MethodKind::kExact, 0)).distances;
  return distance_error(answer(mesh, sources, options_of(kind, refine)).distances, exact)
      .mean_relative;
}

/// A vertex, a point in a face and one on an edge, and a curve of two edges.
SourceSet mixed_sources(const TriangleMesh& mesh) {
  SourceSet set = SourceSet::of_vertices({0});
  const Index middle = mesh.face_count() / 2;
  set.points.push_back(SurfacePoint::in_face(middle, {0.2, 0.3, 0.5}));
  set.points.push_back(SurfacePoint::in_face(mesh.face_count() / 3, {0.3, 0.7, 0}));
  const Face& last = mesh.faces().back();
  set.edges = {{last[0], last[1]}, {last[1], last[2]}};
  return set;
}

struct Shape {
  const char* name;
  Draft (*draft)();
};

void PrintTo(const Shape& shape, std::ostream* out) { *out << shape.name; }

class RefinedShape : public testing::TestWithParam<Shape> {};

TEST_P(RefinedShape, HasLessErrorEachTime) {
  const MeshPtr mesh = finish(GetParam().draft());
  const SourceSet sources = mixed_sources(*mesh);
  // Measured: 0.5 to 0.75 for fast marching, which is of first order, the exact distances having
  // kinks; up to 0.92 for heat, which is told the distances around sources also where faces are
  // large; wavefronts begin near exact, and what they do not notice stays.
  constexpr double kFactor = 0.95, kNotNoticed = 3e-5;
  for (const MethodKind kind :
       {MethodKind::kHeat, MethodKind::kFastMarching, MethodKind::kWavefront}) {
    const double once = mean_error(mesh, sources, kind, 0);
    const double twice = mean_error(mesh, sources, kind, 1);
    EXPECT_LT(twice, std::max(kFactor * once, kNotNoticed)) << to_text(kind);
    EXPECT_LT(mean_error(mesh, sources, kind, 2), std::max(kFactor * twice, kNotNoticed))
        << to_text(kind);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, RefinedShape,
                         testing::Values(Shape{"Sphere", [] { return sphere(2); }},
                                         Shape{"Torus", [] { return torus(24, 12, 0.4); }},
                                         Shape{"Jittered",
                                               [] { return jittered_plane(14, 0.3, 5); }}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Refined, ExactDistancesStayTheSameWithSourcesOfAllKinds) {
  const MeshPtr mesh = finish(torus(16, 8, 0.4));
  SourceSet sources = mixed_sources(*mesh);
  sources.offsets = {0.2, 0, 0.1};
  const QueryOptions nearest{.nearest = true};
  const auto coarse = answer(mesh, sources, options_of(MethodKind::kExact, 0), nearest);
  const auto fine = answer(mesh, sources, options_of(MethodKind::kExact, 2), nearest);
  ASSERT_EQ(fine.distances.size(), coarse.distances.size());
  constexpr double kExact = 1e-9;  // of windows over many faces more
  for (std::size_t v = 0; v < coarse.distances.size(); ++v) {
    EXPECT_NEAR(fine.distances[v], coarse.distances[v], kExact);
  }
  Index same = 0;
  for (std::size_t v = 0; v < coarse.distances.size(); ++v) {
    same += fine.nearest_source[v] == coarse.nearest_source[v];
  }
  EXPECT_GE(same, mesh->vertex_count() - 2) << "but where two sources are equally near";
}

class RefinedZoo : public testing::TestWithParam<ZooMesh> {};

TEST_P(RefinedZoo, ReachesWhatTheMeshReaches) {
  const MeshPtr mesh = GetParam().mesh();
  const SourceSet source = SourceSet::of_vertices({mesh->faces()[0][0]});
  for (const MethodKind kind : {MethodKind::kHeat, MethodKind::kWavefront}) {
    const auto coarse = build_method(mesh, options_of(kind, 0));
    const auto fine = build_method(mesh, options_of(kind, 1));
    ASSERT_EQ(bool(coarse), bool(fine));
    if (!coarse) continue;
    const auto a = (*coarse)->solve(source), b = (*fine)->solve(source);
    ASSERT_EQ(bool(a), bool(b));
    if (!a) continue;
    ASSERT_EQ(b->distances.size(), a->distances.size());
    for (std::size_t v = 0; v < a->distances.size(); ++v) {
      EXPECT_EQ(std::isfinite(a->distances[v]), std::isfinite(b->distances[v])) << v;
      EXPECT_FALSE(std::isnan(b->distances[v])) << v;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, RefinedZoo, testing::ValuesIn(zoo()), zoo_name);

TEST(Refined, RefusesWhatIsNotOnTheMeshInItsNumbers) {
  const MeshPtr mesh = finish(sphere(1));  // 42 vertices, 80 faces
  const auto method = build_method(mesh, options_of(MethodKind::kHeat, 1));
  ASSERT_TRUE(method);
  const auto refused = [&](const SourceSet& set, const std::string& words) {
    const auto none = (*method)->solve(set);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::kBadInput);
    EXPECT_NE(sentence(none.error()).find(words), std::string::npos) << none.error().message;
  };
  refused({}, "no source");
  refused(SourceSet::of_vertices({42}), "vertices are 0 to 41");
  SourceSet set;
  set.points = {SurfacePoint::in_face(80, {1, 0, 0})};
  refused(set, "faces are 0 to 79");
  set.points = {SurfacePoint::in_face(9, {0.5, 0.2, 0})};
  refused(set, "face 9");
  MethodOptions pinned = options_of(MethodKind::kHeat, 1);
  pinned.constraint = {ConstraintMode::kPinVertex, 42, 0};
  EXPECT_FALSE(build_method(mesh, pinned));
  EXPECT_FALSE(build_method(mesh, options_of(MethodKind::kHeat, 40)));
  EXPECT_FALSE(build_method(mesh, options_of(MethodKind::kExact, -1)));
}

TEST(Refined, HasFieldsAndFiguresAndSharesFactorsWithItsNeighbour) {
  const MeshPtr mesh = finish(sphere(2));
  MethodOptions options = options_of(MethodKind::kHeat, 1);
  const auto method = build_method(mesh, options);
  ASSERT_TRUE(method);
  EXPECT_GT((*method)->timing().operators, 0);
  EXPECT_GT((*method)->memory_mb(), 0);
  ASSERT_NE((*method)->heat(), nullptr);
  const SourceSet source = SourceSet::of_vertices({3});
  const auto fields = (*method)->solve(source, {.fields = true});
  ASSERT_TRUE(fields);
  EXPECT_EQ(fields->heat.size(), static_cast<std::size_t>(mesh->vertex_count()));
  EXPECT_EQ(fields->log_heat.size(), static_cast<std::size_t>(mesh->vertex_count()));

  options.time_step.factor = 3;
  const auto near = build_method_sharing(mesh, options, method->get());
  ASSERT_TRUE(near) << near.error().message;
  EXPECT_EQ((*near)->timing().operators, 0) << "taken over";
  const auto d = (*near)->solve(source);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->distances, answer(mesh, source, options).distances);
  options.refine = 0;
  const auto plain = build_method_sharing(mesh, options, method->get());
  ASSERT_TRUE(plain);
  EXPECT_EQ((*plain)->solve(source)->distances, answer(mesh, source, options).distances);
}

TEST(Refined, IsAnotherMethod) {
  for (const MethodKind kind : {MethodKind::kHeat, MethodKind::kExact}) {
    EXPECT_FALSE(same_method(options_of(kind, 0), options_of(kind, 1)));
    EXPECT_TRUE(same_method(options_of(kind, 1), options_of(kind, 1)));
  }
}

class WeldedMethod : public testing::TestWithParam<int> {};

TEST_P(WeldedMethod, GivesMergedVerticesTheDistanceOfTheWholeSurface) {
  const Draft whole = sphere(2);
  Draft cut;
  std::vector<Index> of_whole;
  for (const Face& face : whole.faces) {
    Face own;
    for (int k = 0; k < 3; ++k) {
      own[k] = cut.add(whole.positions[face[k]]);
      of_whole.push_back(face[k]);
    }
    cut.faces.push_back(own);
  }
  auto welded = weld(*finish(cut), 0);
  ASSERT_TRUE(welded);
  const auto mesh = std::make_shared<const TriangleMesh>(std::move(welded->mesh));
  const Index merged = mesh->vertex_count() - 1;  // the last corner is no first one
  ASSERT_NE(mesh->standing_for(merged), merged);
  for (const std::string& name : all_names<MethodKind>()) {
    MethodOptions options = options_of(*parse<MethodKind>(name), GetParam());
    options.constraint = {ConstraintMode::kPinVertex, merged, 0};
    const auto d = answer(mesh, SourceSet::of_vertices({merged}), options).distances;
    options.constraint.pin_vertex = of_whole[static_cast<std::size_t>(merged)];
    const auto expected =
        answer(finish(whole), SourceSet::of_vertices({options.constraint.pin_vertex}), options);
    ASSERT_EQ(d.size(), of_whole.size());
    constexpr double kOrder = 1e-9;  // faces in the same order, vertices in another
    for (std::size_t v = 0; v < d.size(); ++v) {
      EXPECT_NEAR(d[v], expected.distances[static_cast<std::size_t>(of_whole[v])], kOrder);
    }
  }
}

TEST_P(WeldedMethod, NumbersTheNearestSourcesAsTheyWereGiven) {
  Draft sheets = plane_grid(4, 4, 4, 4);
  append(sheets, transformed(sheets, 1, Vec3(4, 0, 0), false));
  auto welded = weld(*finish(sheets), 0);
  ASSERT_TRUE(welded);
  ASSERT_EQ(welded->mesh.standing_for(25), 4);
  SourceSet sources = SourceSet::of_vertices({20});
  sources.edges = {{3, 4}, {25, 26}, {48, 49}};  // the first two touch on the welded mesh alone
  ASSERT_EQ(source_groups(sources).count, 4);
  const auto nearest =
      answer(std::make_shared<const TriangleMesh>(std::move(welded->mesh)), sources,
             options_of(MethodKind::kWavefront, GetParam()), {.nearest = true})
          .nearest_source;
  ASSERT_EQ(nearest.size(), 50U);
  EXPECT_EQ(nearest[20], 0);
  for (const Index v : {3, 4, 25, 26}) EXPECT_EQ(nearest[static_cast<std::size_t>(v)], 1) << v;
  EXPECT_EQ(nearest[48], 3);
  EXPECT_EQ(nearest[49], 3);
}

INSTANTIATE_TEST_SUITE_P(Refine, WeldedMethod, testing::Values(0, 1));

}  // namespace
}  // namespace geotherm::test
