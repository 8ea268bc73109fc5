// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "engine/scene/colours.h"
#include "geotherm/heat_method.h"
#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

double least(const glm::dvec3& weights) { return std::min({weights.x, weights.y, weights.z}); }

/// The picture's 8 bits and the map's steps (1/1024 of its range) both round.
constexpr float kColourTolerance = 2.5F / 255;

struct Colouring {
  const char* map;
  bool reversed;
  float min, max;
};

void PrintTo(const Colouring& c, std::ostream* out) { *out << c.map << (c.reversed ? "R" : ""); }

class SurfaceColours : public GpuTest, public testing::WithParamInterface<Colouring> {
 protected:
  /// Every seventh pixel of the model has the colour of the value there.
  void expect_colours(Stage& stage, std::span<const float> values) {
    const auto& [name, reversed, min, max] = GetParam();
    const ColourMap& map = *find_colour_map(name);
    must(stage.renderer.set_colours(colour_table(map, reversed)));
    stage.paint(values, min, max);
    const Image image = stage.draw();
    int compared = 0;
    for (int y = 0; y < image.height; y += 7) {
      for (int x = 0; x < image.width; x += 7) {
        const auto seen = hit(stage.model, stage.scene.camera, x, y);
        if (!seen || least(seen->weights) < 1e-3) continue;  // on an edge it may be either
        const auto value = static_cast<float>(value_at(stage.model, values, *seen));
        const glm::vec3 expected = engine::colour_at(map, (value - min) / (max - min), reversed);
        EXPECT_LE(difference(colour_at(image, x, y), expected), kColourTolerance)
            << x << " " << y << " value " << value;
        ++compared;
      }
    }
    EXPECT_GE(compared, 300);
  }
};

TEST_P(SurfaceColours, AreThoseOfALinearFieldOnThePlane) {
  Stage stage(device(), plane_model(4, 3));
  expect_colours(stage, stage.model.values(
                            [](const glm::vec3& p) { return 0.5F + 0.4F * p.x + 0.25F * p.y; }));
}

TEST_P(SurfaceColours, AreThoseOfDistancesOnTheSphere) {
  const Draft draft = sphere(3);
  const auto method = must(HeatMethod::build(finish(draft)));
  const auto result = must(method.solve(SourceSet::of_vertices({17})));
  std::vector<float> values;
  for (const double d : result.distances) values.push_back(static_cast<float>(d / 3.2));
  Stage stage(device(), model_of(draft));
  stage.look({.azimuth = 30, .elevation = 20});
  expect_colours(stage, values);
}

INSTANTIATE_TEST_SUITE_P(All, SurfaceColours,
                         testing::Values(Colouring{"red-blue", false, 0, 1},
                                         Colouring{"red-blue", true, 0, 1},
                                         Colouring{"viridis", false, 0.25F, 0.75F}),
                         [](const auto& test) {
                           return std::to_string(test.index) +
                                  (test.param.reversed ? "Reversed" : "");
                         });

class ColourPlaces : public GpuTest {};

TEST_F(ColourPlaces, OfBandsChangeAtTheirBordersAlone) {
  constexpr int kBands = 11;
  Stage stage(device(), plane_model(2, 2));
  const auto values = stage.model.values([](const glm::vec3& p) { return 0.5F + 0.01F * p.x; });
  stage.scene.surface.bands = kBands;
  stage.paint(values);  // a band is hundreds of pixels wide
  const ColourMap& map = colour_maps().front();
  must(stage.renderer.set_colours(colour_table(map)));
  for (const float max : {1.0F, 1.1F, 0.917F}) {  // the border at a few places
    stage.scene.surface.range_max = max;
    const Image image = stage.draw();
    int compared = 0;
    for (int x = 0; x < image.width; ++x) {
      const auto seen = hit(stage.model, stage.scene.camera, x, 100);
      if (!seen) continue;
      const double in_bands = kBands * value_at(stage.model, values, *seen) / max;
      if (std::abs(in_bands - std::round(in_bands)) < 1e-3) continue;
      const auto middle = static_cast<float>((std::floor(in_bands) + 0.5) / kBands);
      EXPECT_LE(difference(colour_at(image, x, 100), engine::colour_at(map, middle)),
                kColourTolerance)
          << x << " of " << max;
      ++compared;
    }
    EXPECT_GE(compared, 50);
  }
}

TEST_F(ColourPlaces, OfLogarithmsAreThoseOfTheValuesWithTheirOffset) {
  Stage stage(device(), plane_model(2, 2));
  const auto values = stage.model.values([](const glm::vec3& p) { return 4 + 2 * p.x + p.y; });
  stage.scene.surface.log = true;
  stage.paint(values, 1, 8);
  const Image whole = stage.draw();
  auto less = values;
  for (float& value : less) value -= 1;
  stage.scene.surface.log_offset = 1;
  stage.paint(less, 0, 7);
  EXPECT_EQ(different_pixels(whole, stage.draw(), 3), 0);
}

class Unreached : public GpuTest {};

TEST_F(Unreached, IsNeutralGrey) {
  Stage stage(device(), plane_model(2, 2));
  stage.paint(std::vector<float>(stage.model.positions.size(), kNoValue));
  const Image image = stage.draw();
  const glm::vec3 colour = colour_at(image, 160, 120);
  EXPECT_EQ(colour.r, colour.g);
  EXPECT_EQ(colour.g, colour.b);
  EXPECT_GT(colour.r, 0.3F);
  EXPECT_LT(colour.r, 0.9F);
  EXPECT_NEAR(darkness_in(image, inner(image, 20)).deviation, 0, 1e-6);
}

TEST_F(Unreached, IsGreyOnWholeFacesAndNowhereElse) {
  for (const int samples : {1, 4}) {
    Stage stage(device(), plane_model(8, 6), samples);
    const auto values =
        stage.model.values([](const glm::vec3& p) { return p.x > 0.1F ? kNoValue : 0.3F; });
    stage.paint(values);
    stage.scene.surface.line_spacing = 0.17F;  // no line where there is one value
    const Image image = stage.draw();
    const glm::vec3 known = engine::colour_at(colour_maps().front(), 0.3F);
    for (int y = 20; y < 220; y += 3) {
      for (int x = 20; x < 300; x += 3) {
        const auto seen = hit(stage.model, stage.scene.camera, x, y);
        if (!seen || least(seen->weights) < 0.05) continue;
        bool reached = true;
        for (const auto v : stage.model.faces[seen->face]) reached &= values[v] != kNoValue;
        const glm::vec3 colour = colour_at(image, x, y);
        if (reached) {
          EXPECT_LE(difference(colour, known), kColourTolerance) << x << " " << y;
        } else {
          EXPECT_TRUE(colour.r == colour.g && colour.g == colour.b) << x << " " << y;
        }
      }
    }
    // Nor between them: each pixel has one of the two colours or a mixture.
    const float grey = colour_at(image, 290, 120).r;
    for (int x = 20; x < 300; ++x) {
      const glm::vec3 colour = colour_at(image, x, 121);
      const glm::vec3 low = glm::min(known, glm::vec3(grey)) - kColourTolerance;
      const glm::vec3 high = glm::max(known, glm::vec3(grey)) + kColourTolerance;
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(colour, low)) &&
                  glm::all(glm::lessThanEqual(colour, high)))
          << x;
    }
  }
}

}  // namespace
}  // namespace geotherm::test
