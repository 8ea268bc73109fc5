// SPDX-License-Identifier: MIT
#include "engine/scene/colours.h"
#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

/// Two squares, one behind the other; seen from the front the second one is nearer.
Model two_squares(float far, float near) {
  Model model = square_model(0.4F, far);
  append(model, square_model(0.4F, near));
  return model;
}

class Depth : public GpuTest, public testing::WithParamInterface<bool> {};

TEST_P(Depth, ShowsTheNearerOneWhateverTheOrder) {
  for (const bool far_first : {true, false}) {
    for (const float gap : {0.6F, 0.001F}) {
      const float far = -gap / 2;
      Stage stage(device(), far_first ? two_squares(far, -far) : two_squares(-far, far));
      const auto values = stage.model.values([](const glm::vec3& p) { return p.z > 0; });
      for (const float azimuth : {0.0F, 180.0F}) {
        stage.look({.azimuth = azimuth, .elevation = 0, .orthographic = GetParam()});
        stage.paint(values);
        const glm::vec3 expected =
            engine::colour_at(colour_maps().front(), azimuth == 0 ? 1.0F : 0.0F);
        EXPECT_LE(difference(colour_at(stage.draw(), 160, 120), expected), 0.01F)
            << far_first << " " << gap << " " << azimuth;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Depth, testing::Bool(), [](const auto& test) {
  return std::string(test.param ? "Orthographic" : "Perspective");
});

class Hidden : public GpuTest {};

TEST_F(Hidden, ArrowsDoNotShowThrough) {
  Stage stage(device(), two_squares(-0.4F, 0.4F));
  stage.look({.azimuth = 0, .elevation = 0});
  stage.scene.arrows.primary = true;
  const glm::vec3 right(1, 0, 0);
  const glm::vec3 none(0);
  const Box box{{60, 20}, {260, 220}};
  const double bare = darkness_in(stage.draw(), box).deviation;
  must(stage.renderer.set_arrows(std::vector{right, right, none, none}, {}));
  EXPECT_EQ(darkness_in(stage.draw(), box).deviation, bare);
  must(stage.renderer.set_arrows(std::vector{none, none, right, right}, {}));
  EXPECT_GT(darkness_in(stage.draw(), box).deviation, bare + 0.01);
}

TEST_F(Hidden, MarkersShowFaintly) {
  Stage stage(device(), two_squares(-0.4F, 0.4F));
  stage.scene.markers.colour = stage.scene.markers.rim = glm::vec3(0);
  stage.scene.surface.colour = glm::vec3(1);
  const auto dark_at_marker = [&](float z) {
    const Marker marker{{0.1F, 0.1F, z}, {0.1F, 0.1F, z}};
    must(stage.renderer.set_markers({&marker, 1}));
    const glm::vec3 at = stage.scene.camera.project(marker.from);
    return darkness(stage.draw(), static_cast<int>(at.x), static_cast<int>(at.y));
  };
  const double in_front = dark_at_marker(0.4F);
  const double behind = dark_at_marker(-0.4F);
  EXPECT_GT(in_front, 0.99);
  EXPECT_GT(behind, 0.4);
  EXPECT_LT(behind, 0.7);
}

}  // namespace
}  // namespace geotherm::test
