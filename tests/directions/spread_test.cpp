// SPDX-License-Identifier: MIT
// What the vector heat method makes of numbers of any size, of contradictions, of parts of a mesh
// in which nothing is given, and of borders opposite obtuse angles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "geotherm/directions.h"
#include "geotherm/heat_method.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

constexpr double kParallel = 1e-8;

std::shared_ptr<const VectorHeat> spread_on(const MeshPtr& mesh,
                                            const SpreadOptions& options = {}) {
  auto built = VectorHeat::build(mesh, options);
  EXPECT_TRUE(built) << built.error().message;
  return *built;
}

/// Nothing hangs on the unit of what is given: powers of two change no digit.
TEST(Transport, ScalesWithTheVectors) {
  const auto heat = spread_on(finish(sphere(2)));
  const std::vector<TangentVector> vectors = {{3, 1.5, 0.25}, {70, -0.5, 1}};
  const auto one = heat->transport(vectors);
  ASSERT_TRUE(one);
  for (const int exponent : {-900, -60, 60, 900}) {
    std::vector<TangentVector> scaled = vectors;
    for (TangentVector& v : scaled) {
      v.x = std::ldexp(v.x, exponent);
      v.y = std::ldexp(v.y, exponent);
    }
    const auto other = heat->transport(scaled);
    ASSERT_TRUE(other);
    for (std::size_t v = 0; v < one->components.size(); ++v) {
      for (int k = 0; k < 2; ++k) {
        EXPECT_EQ(other->components[v][k], std::ldexp(one->components[v][k], exponent)) << v;
      }
    }
  }
}

TEST(Extend, ScalesWithTheValuesUpToTheLargestDoubles) {
  const auto heat = spread_on(finish(sphere(2)));
  const std::vector<Index> vertices = {3, 70};
  const auto one = heat->extend(vertices, std::vector<double>{1.5, -1});
  ASSERT_TRUE(one);
  for (const int exponent : {-1000, 1023}) {
    const double unit = std::ldexp(1.0, exponent);
    const auto other = heat->extend(vertices, std::vector<double>{1.5 * unit, -unit});
    ASSERT_TRUE(other);
    for (std::size_t v = 0; v < one->values.size(); ++v) {
      EXPECT_EQ(other->values[v], std::ldexp(one->values[v], exponent)) << v;
    }
  }
}

/// In models as large or small as doubles can be as well.
TEST(Transport, HasNumbersInModelsOfAnyUnit) {
  for (const double size : {1e-300, 1e300}) {
    const auto heat = spread_on(finish(plane_grid(5, 5, size, size)));
    const auto found = heat->transport(std::vector<TangentVector>{{0, 1, 0}});
    ASSERT_TRUE(found) << found.error().message;
    for (const Vec3& vector : found->vectors) {
      EXPECT_NEAR((vector - Vec3::UnitX()).norm(), 0, kParallel) << size;
    }
  }
}

/// On the plane vectors stay parallel, in whichever frame they are written.
TEST(Transport, ComponentsOfMergedVerticesAreInTheirFrames) {
  const Draft plane = jittered_plane(8, 0.2, 3);
  Draft soup;
  for (const Face& face : plane.faces) {
    const Index first = soup.vertex_count();
    for (const Index v : face) soup.positions.push_back(plane.positions[v]);
    soup.faces.push_back({first, first + 1, first + 2});
  }
  const auto welded = weld(*finish(soup), 0);
  ASSERT_TRUE(welded);
  ASSERT_GT(welded->merged, 0);
  const auto heat = spread_on(std::make_shared<const TriangleMesh>(welded->mesh));
  const auto found = heat->transport(std::vector<TangentVector>{{0, 1, 0}});
  const auto frames = heat->frames();
  ASSERT_TRUE(found && frames);
  for (std::size_t v = 0; v < frames->size(); ++v) {
    const TangentFrame& frame = (*frames)[v];
    const auto [x, y] = found->components[v];
    EXPECT_NEAR((x * frame.e1 + y * frame.e2 - frames->front().e1).norm(), 0, kParallel) << v;
  }
}

TEST(Spread, ByATimeInWhichTheMassDrownsNamesTheTime) {
  const MeshPtr mesh = finish(jittered_plane(20, 0.2, 3));
  int refused = 0;
  for (const double factor : {1e18, 1e20, 1e30, 1e100}) {
    const auto heat = VectorHeat::build(mesh, {"native", factor, 1});
    const auto found = heat ? (*heat)->transport(std::vector<TangentVector>{{0, 1, 0}})
                            : Result<Spread>(heat.error());
    if (found) continue;
    ++refused;
    EXPECT_EQ(found.error().code, ErrorCode::kNumericalFailure);
    const std::string said = sentence(found.error());
    EXPECT_NE(said.find("lower time-factor"), std::string::npos) << said;
    EXPECT_EQ(said.find("laplacian"), std::string::npos) << said;
  }
  EXPECT_GT(refused, 0);
}

TEST(Spread, RefusesTwoDifferentThingsAtOneVertex) {
  const auto heat = spread_on(finish(plane_grid(3, 3, 1, 1)));
  const auto vectors = heat->transport(std::vector<TangentVector>{{5, 1, 0}, {5, 2, 0}});
  ASSERT_FALSE(vectors);
  EXPECT_NE(vectors.error().message.find("vertex 5"), std::string::npos);
  const auto values = heat->extend(std::vector<Index>{5, 5}, std::vector<double>{1, 2});
  ASSERT_FALSE(values);
  EXPECT_NE(values.error().message.find("vertex 5"), std::string::npos);
  EXPECT_TRUE(heat->extend(std::vector<Index>{5, 5}, std::vector<double>{2, 2}));
}

TEST(Spread, SaysHowManyVerticesHaveNoAnswer) {
  Draft draft = plane_grid(3, 3, 1, 1);
  const Draft other = draft;
  for (const Face& f : other.faces) draft.faces.push_back({f[0] + 16, f[1] + 16, f[2] + 16});
  draft.positions.insert(draft.positions.end(), other.positions.begin(), other.positions.end());
  draft.positions.push_back(Vec3(9, 9, 9));  // in no face
  const auto heat = spread_on(finish(draft));
  const auto vectors = heat->transport(std::vector<TangentVector>{{5, 1, 0}});
  const auto values = heat->extend(std::vector<Index>{5}, std::vector<double>{1});
  ASSERT_TRUE(vectors && values);
  for (const Spread* spread : {&*vectors, &*values}) {
    ASSERT_EQ(spread->warnings.size(), 2U);
    EXPECT_TRUE(spread->warnings[0].message.starts_with("1 vertex belongs to no face"));
    EXPECT_TRUE(spread->warnings[1].message.starts_with("16 vertices lie in components without"));
  }
  const auto both = heat->extend(std::vector<Index>{5, 20}, std::vector<double>{1, 2});
  ASSERT_TRUE(both);
  EXPECT_EQ(both->warnings.size(), 1U) << "every component has a value";
}

/// Border edges opposite obtuse angles have negative weights, and heat by these is negative; so
/// vertices are inserted there, which no answer has.
class SpreadOnDelaunay : public testing::TestWithParam<Index> {
 protected:
  static constexpr unsigned kSeeds = 5;

  static MeshPtr plane(unsigned seed) {
    const MeshPtr mesh = finish(random_delaunay(GetParam(), seed));
    const auto method = HeatMethod::build(mesh);
    EXPECT_TRUE(method);
    EXPECT_GT(method->refinement().points, 0) << seed;
    return mesh;
  }
};

TEST_P(SpreadOnDelaunay, PlanesKeepsVectorsParallel) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const MeshPtr mesh = plane(seed);
    for (const char* backend : {"", "cg"}) {
      const auto heat = spread_on(mesh, {backend, 1, 0});
      const Index source = mesh->vertex_count() / 3;
      const auto found = heat->transport(std::vector<TangentVector>{{source, 0.6, -0.8}});
      const auto frames = heat->frames();
      ASSERT_TRUE(found && frames) << sentence(found.error());
      EXPECT_TRUE(found->warnings.empty()) << sentence(found->warnings.front());
      EXPECT_EQ(std::ssize(found->vectors), mesh->vertex_count());
      EXPECT_EQ(std::ssize(found->components), mesh->vertex_count());
      EXPECT_EQ(std::ssize(*frames), mesh->vertex_count());
      const Vec3 want = 0.6 * (*frames)[source].e1 - 0.8 * (*frames)[source].e2;
      for (const Vec3& vector : found->vectors) {
        EXPECT_NEAR((vector - want).norm(), 0, kParallel) << backend << ", seed " << seed;
      }
    }
  }
}

/// Values beyond the range would be put back into it with a warning.
TEST_P(SpreadOnDelaunay, PlanesExtendsValuesWithinTheirRange) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const MeshPtr mesh = plane(seed);
    const Index a = 1, b = mesh->vertex_count() - 2;
    for (const char* backend : {"", "cg"}) {
      const auto heat = spread_on(mesh, {backend, 1, 0});
      const auto found = heat->extend(std::vector<Index>{a, b}, std::vector<double>{0, 1});
      ASSERT_TRUE(found) << sentence(found.error());
      EXPECT_TRUE(found->warnings.empty()) << sentence(found->warnings.front());
      ASSERT_EQ(std::ssize(found->values), mesh->vertex_count());
      const auto positions = mesh->positions();
      for (Index v = 0; v < mesh->vertex_count(); ++v) {
        const double value = found->values[v];
        EXPECT_GE(value, 0) << backend << ", seed " << seed;
        EXPECT_LE(value, 1) << backend << ", seed " << seed;
        const double to_a = (positions[v] - positions[a]).norm(),
                     to_b = (positions[v] - positions[b]).norm();
        if (2 * to_a < to_b) {
          EXPECT_LT(value, 0.5) << v;
        } else if (2 * to_b < to_a) {
          EXPECT_GT(value, 0.5) << v;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, SpreadOnDelaunay, testing::Values(20, 60, 200, 1000));

/// A hundredth of the time reaches less far than faces at the border are wide. Directions are those
/// of the heat, whatever its sign.
TEST(Spread, ByATimeThatIsShortForTheBorderSaysSo) {
  int warned = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const auto heat = spread_on(finish(random_delaunay(40, seed)), {"native", 0.01, 1});
    const auto vectors = heat->transport(std::vector<TangentVector>{{0, 1, 0}});
    const auto values = heat->extend(std::vector<Index>{0, 20}, std::vector<double>{0, 1});
    ASSERT_TRUE(vectors && values);
    for (const Vec3& vector : vectors->vectors) {
      EXPECT_NEAR((vector - vectors->vectors.front()).norm(), 0, kParallel) << seed;
    }
    const auto [least, most] = std::ranges::minmax(values->values);
    EXPECT_GE(least, 0) << seed;
    EXPECT_LE(most, 1) << seed;
    for (const Spread* spread : {&*vectors, &*values}) {
      for (const Warning& warning : spread->warnings) {
        ++warned;
        const std::string said = sentence(warning);
        EXPECT_NE(said.find("of 40 vertices"), std::string::npos) << said;
        EXPECT_NE(said.find("raise time-factor"), std::string::npos) << said;
      }
    }
  }
  EXPECT_GT(warned, 0);
}

/// A sliver at the border is as high as 1e-5 of its side. Triangle inequalities that are made
/// strict would turn its angles by a hundredth.
TEST(Transport, KeepsVectorsParallelOverASliverAtTheBorder) {
  Draft draft;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1.1, 1, 0), Vec3(-0.2, 0.9, 0),
                        Vec3(0.4, 0.45, 0), Vec3(0.37, 2e-5, 0)}) {
    draft.add(p);
  }
  draft.faces = {{0, 1, 5}, {5, 1, 4}, {0, 5, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  const auto heat = spread_on(finish(draft));
  const auto found = heat->transport(std::vector<TangentVector>{{2, 1, 0}});
  ASSERT_TRUE(found);
  for (const Vec3& vector : found->vectors) {
    EXPECT_NEAR((vector - found->vectors[2]).norm(), 0, kParallel);
  }
}

/// Three zigzag strips along one line: each of its edges is opposite three obtuse angles.
TEST(Extend, StaysWithinTheRangeAtEdgesWithThreeFaces) {
  constexpr Index kEdges = 10;
  Draft draft;
  for (Index i = 0; i <= kEdges; ++i) draft.add(Vec3(i, 0, 0));
  for (int page = 0; page < 3; ++page) {
    const Index first = draft.vertex_count();
    for (Index i = 0; i < kEdges; ++i) {
      draft.add(Vec3(i + 0.5, 0.1 * std::cos(2.1 * page), 0.1 * std::sin(2.1 * page)));
      draft.faces.push_back({i, i + 1, first + i});
      if (i > 0) draft.faces.push_back({i, first + i, first + i - 1});
    }
  }
  const MeshPtr mesh = finish(draft);
  for (const char* backend : {"", "cg"}) {
    const auto found = spread_on(mesh, {backend, 1, 0})
                           ->extend(std::vector<Index>{1, kEdges - 2}, std::vector<double>{0, 1});
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->warnings.empty()) << sentence(found->warnings.front());
    for (const double value : found->values) {
      EXPECT_GT(value, 0) << backend;
      EXPECT_LT(value, 1) << backend;
    }
  }
}

}  // namespace
}  // namespace geotherm::test
