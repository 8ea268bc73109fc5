// SPDX-License-Identifier: MIT
#include "engine/scene/arrows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/engine/models.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;
using Place = ArrowPlaces::Place;

struct PlacedShape {
  std::string name;
  Model model;
};
void PrintTo(const PlacedShape& shape, std::ostream* out) { *out << shape.name; }

std::vector<PlacedShape> placed_shapes() {
  Model sheets = plane_model(30, 20);  // two sides of a thin sheet
  Model back = sheets;
  for (auto& p : back.positions) p.z = -0.001F;
  for (auto& f : back.faces) std::swap(f[0], f[1]);
  append(sheets, back);
  return {{"Plane", plane_model(40, 30)},
          {"Irregular", irregular_plane_model(30)},
          {"Sphere", model_of(sphere(4))},
          {"Torus", model_of(transformed(torus(80, 40, 0.4), 0.7, {0, 0, 0}, true))},
          {"ThinSheet", sheets},
          {"Cube", cube_model(0.5F)}};
}

class ArrowPlacesOn : public testing::TestWithParam<PlacedShape> {
 protected:
  const Model& model() const { return GetParam().model; }
};

TEST_P(ArrowPlacesOn, HoldEveryFaceOnce) {
  const ArrowPlaces all(model().geometry());
  std::set<std::uint32_t> faces;
  for (const Place& place : all.places()) faces.insert(place.face);
  EXPECT_EQ(all.places().size(), model().faces.size());
  EXPECT_EQ(faces.size(), model().faces.size());
}

TEST_P(ArrowPlacesOn, GrowCloserFromFirstToLast) {
  const ArrowPlaces all(model().geometry());
  EXPECT_TRUE(std::is_sorted(all.places().begin(), all.places().end(),
                             [](const Place& a, const Place& b) { return a.spacing > b.spacing; }));
}

/// The places with at least this spacing.
std::vector<Place> level(const ArrowPlaces& all, float spacing) {
  std::vector<Place> chosen;
  for (const Place& p : all.places()) {
    if (p.spacing >= spacing) chosen.push_back(p);
  }
  return chosen;
}

TEST_P(ArrowPlacesOn, KeepTheirSpacingOnEachSide) {
  const ArrowPlaces all(model().geometry());
  // The last level takes what is left, as close together as it is.
  const std::vector<Place> chosen = level(all, 1.5F * all.places().back().spacing);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (glm::dot(chosen[i].normal, chosen[j].normal) < 0) continue;
      EXPECT_GE(glm::distance(chosen[i].centre, chosen[j].centre), chosen[i].spacing * 0.9999F);
    }
  }
}

TEST_P(ArrowPlacesOn, LeaveNoLargeGaps) {
  const ArrowPlaces all(model().geometry());
  for (float spacing = 0.5F; spacing > 2 * all.places().back().spacing; spacing *= 0.7071F) {
    const std::vector<Place> chosen = level(all, spacing);
    double sum = 0;
    for (const Place& p : all.places()) {
      float nearest = 1e9F;
      for (const Place& q : chosen) {
        if (glm::dot(p.normal, q.normal) < 0) continue;
        nearest = std::min(nearest, glm::distance(p.centre, q.centre));
      }
      EXPECT_LE(nearest, 2.5F * spacing) << spacing;
      sum += nearest;
    }
    EXPECT_LE(sum / static_cast<double>(all.places().size()), 0.8 * spacing);
  }
}

TEST_P(ArrowPlacesOn, AreTheSameEveryTime) {
  const ArrowPlaces a(model().geometry());
  const ArrowPlaces b(model().geometry());
  ASSERT_EQ(a.places().size(), b.places().size());
  for (std::size_t i = 0; i < a.places().size(); ++i) {
    EXPECT_EQ(a.places()[i].face, b.places()[i].face);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ArrowPlacesOn, testing::ValuesIn(placed_shapes()),
                         [](const auto& test) { return test.param.name; });

TEST(ArrowPlaces, LeaveOutFacesWithoutArea) {
  Model model = plane_model(2, 2);
  model.faces.push_back({0, 0, 1});
  model.faces.push_back({0, 1, 2});  // corners of one line
  const ArrowPlaces all(model.geometry());
  EXPECT_EQ(all.places().size(), model.faces.size() - 2);
}

TEST(ArrowPlaces, AreNoneWithoutFaces) {
  EXPECT_TRUE(ArrowPlaces(SurfaceGeometry{}).places().empty());
}

TEST(ArrowPlaces, StandOnTheirFacesAlongTheirNormals) {
  const Model model = cube_model(0.5F);
  const ArrowPlaces all(model.geometry());
  for (const Place& place : all.places()) {
    EXPECT_NEAR(glm::length(place.normal), 1, 1e-6);
    EXPECT_NEAR(glm::dot(place.normal, place.centre), 0.5, 1e-6);
    EXPECT_NEAR(place.face_size, std::sqrt(0.5), 1e-6);
  }
}

}  // namespace
}  // namespace geotherm::test
