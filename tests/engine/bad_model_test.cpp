// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "engine/scene/colours.h"
#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

struct Case {
  std::string name;
  Model model;
  bool seen;  ///< whether there is anything to see
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

std::vector<Case> cases() {
  Model without_area = plane_model(3, 3);
  for (auto& p : without_area.positions) p = {p.x, p.x, p.x};
  Model one_point = plane_model(2, 2);
  for (auto& p : one_point.positions) p = {0.1F, 0.2F, 0.3F};
  Model needles = plane_model(50, 1);
  for (auto& p : needles.positions) p.x *= 0.001F;
  Model repeated = plane_model(3, 3);
  for (auto& face : repeated.faces) {
    if (face[0] % 2 == 0) face[1] = face[0];
  }
  Model with_loose_vertices = plane_model(3, 3);
  with_loose_vertices.positions.insert(with_loose_vertices.positions.end(), 5, glm::vec3(0));
  Model twice = plane_model(3, 3);
  append(twice, plane_model(3, 3));  // the same faces again
  return {{"AllFacesWithoutArea", without_area, false},
          {"AllVerticesAtOnePoint", one_point, false},
          {"OneTriangle", {{{-0.9F, -0.4F, 0}, {0.9F, -0.4F, 0}, {0, 0.9F, 0}}, {{0, 1, 2}}}, true},
          {"Needles", needles, true},
          {"RepeatedCorners", repeated, true},
          {"LooseVertices", with_loose_vertices, true},
          {"EveryFaceTwice", twice, true}};
}

class BadModel : public GpuTest, public testing::WithParamInterface<Case> {};

TEST_P(BadModel, IsDrawnAllTheSame) {
  Stage stage(device(), GetParam().model, 4);
  stage.look({.azimuth = 10, .elevation = 10});
  stage.scene.light = Light::kThreePoint;
  const std::vector<glm::vec3> field(stage.model.faces.size(), glm::vec3(0.7F, 0.7F, 0));
  must(stage.renderer.set_arrows(field, field));
  stage.scene.arrows.primary = stage.scene.arrows.secondary = true;
  const Marker marker{stage.model.positions[0], stage.model.positions[1]};
  must(stage.renderer.set_markers({&marker, 1}));
  for (const bool smooth : {false, true}) {
    for (const bool wire : {false, true}) {
      stage.scene.surface.smooth = smooth;
      stage.scene.surface.wire = wire;
      stage.paint(stage.model.values([](const glm::vec3& p) { return p.x; }));
      stage.scene.surface.line_spacing = 0.1F;
      (void)stage.draw();
    }
  }
  stage.scene.markers.visible = false;
  const Image image = stage.draw();
  EXPECT_EQ(darkness_in(image, inner(image)).mean > 0, GetParam().seen);
}

INSTANTIATE_TEST_SUITE_P(All, BadModel, testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

class OddData : public GpuTest {};

TEST_F(OddData, OfNoValueAtAllIsGrey) {
  Stage stage(device(), plane_model(3, 3));
  stage.paint(std::vector<float>(stage.model.positions.size(), kNoValue));
  stage.scene.surface.line_spacing = 0.1F;
  const glm::vec3 colour = colour_at(stage.draw(), 160, 120);
  EXPECT_TRUE(colour.r == colour.g && colour.g == colour.b);
}

TEST_F(OddData, BeforeAnyValuesIsGrey) {
  Stage stage(device(), plane_model(3, 3));
  stage.scene.surface.paint = Paint::kMap;
  const glm::vec3 colour = colour_at(stage.draw(), 160, 120);
  EXPECT_TRUE(colour.r == colour.g && colour.g == colour.b);
}

TEST_F(OddData, WithARangeOfNoWidthHasTheLowestColour) {
  Stage stage(device(), plane_model(3, 3));
  const std::vector<float> zeros(stage.model.positions.size(), 0.0F);
  stage.paint(zeros, 0, 0);
  EXPECT_LE(
      difference(colour_at(stage.draw(), 160, 120), engine::colour_at(colour_maps().front(), 0)),
      0.01F);
}

TEST_F(OddData, OutsideTheRangeHasTheColourOfItsEnd) {
  Stage stage(device(), plane_model(1, 1));
  stage.paint(stage.model.values([](const glm::vec3& p) { return p.x > 0 ? 1e18F : -1e18F; }), 0,
              1);
  const Image image = stage.draw();
  EXPECT_LE(difference(colour_at(image, 30, 120), engine::colour_at(colour_maps().front(), 0)),
            0.01F);
  EXPECT_LE(difference(colour_at(image, 290, 120), engine::colour_at(colour_maps().front(), 1)),
            0.01F);
}

TEST_F(OddData, OfASpacingThatIsTooSmallDarkensEvenly) {
  Stage stage(device(), plane_model(1, 1));
  stage.draw_lines(stage.model.values([](const glm::vec3& p) { return p.x + 1; }), 1e-30F);
  EXPECT_LE(darkness_in(stage.draw(), {{20, 20}, {300, 220}}).deviation, 0.01);
}

TEST_F(OddData, OfACameraInsideTheModelShowsItsInside) {
  Stage stage(device(), model_of(sphere(3)), 4);
  stage.scene.light = Light::kThreePoint;
  Camera& camera = stage.scene.camera;
  stage.look({.azimuth = 0, .elevation = 0});
  camera.view = glm::mat4(1);  // the eye at the origin
  constexpr float kNear = 0.01F, kFar = 3;
  camera.projection[2][2] = kNear / (kFar - kNear);
  camera.projection[3][2] = kNear * kFar / (kFar - kNear);
  const Marker marker{{0, 0, 0.99F}, {0, 0, -0.99F}};
  must(stage.renderer.set_markers({&marker, 1}));
  const std::vector<glm::vec3> field(stage.model.faces.size(), glm::vec3(0, 1, 0));
  must(stage.renderer.set_arrows(field, {}));
  stage.scene.arrows.primary = true;
  stage.scene.surface.wire = true;
  stage.scene.background = {1, 1, 1, 0};
  const Image image = stage.draw();
  int holes = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) holes += image.at(x, y)[3] < 255 ? 1 : 0;
  }
  EXPECT_EQ(holes, 0);
}

TEST_F(OddData, OfAnEmptyModelIsBackground) {
  Stage stage(device(), plane_model(1, 1));
  must(stage.renderer.set_surface({}));
  must(stage.renderer.set_arrows({}, {}));
  must(stage.renderer.set_markers({}));
  EXPECT_EQ(darkness_in(stage.draw(), {{0, 0}, {320, 240}}).mean, 0);
}

}  // namespace
}  // namespace geotherm::test
