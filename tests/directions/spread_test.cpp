// SPDX-License-Identifier: MIT
// What the vector heat method makes of numbers of any size, of contradictions, and of parts of a
// mesh in which nothing is given.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "geotherm/directions.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

constexpr double kParallel = 1e-8;

std::shared_ptr<const VectorHeat> spread_on(const MeshPtr& mesh) {
  auto built = VectorHeat::build(mesh);
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

}  // namespace
}  // namespace geotherm::test
