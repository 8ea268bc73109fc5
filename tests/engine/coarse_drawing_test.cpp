// SPDX-License-Identifier: MIT
// What makes large models quick: the coarse surface, and scenes that are kept.
#include <cmath>

#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

double share_of_difference(const Image& a, const Image& b, int tolerance) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    if (std::abs(int{a.pixels[i]} - int{b.pixels[i]}) > tolerance) ++different;
  }
  return static_cast<double>(different) / static_cast<double>(a.pixels.size());
}

class CoarseDrawing : public GpuTest {};

/// 160,000 faces of a torus, painted by height.
Stage large_stage(const Device& device) {
  Stage stage(device, model_of(torus(400, 200, 0.4)));
  std::vector<float> heights;
  for (const glm::vec3& p : stage.model.positions) heights.push_back(p.y);
  stage.paint(heights, -1, 1);
  return stage;
}

TEST_F(CoarseDrawing, LooksLikeTheSurfaceAndIsAnother) {
  Stage stage = large_stage(device());
  const Image full = stage.draw();
  stage.renderer.set_coarse(true);
  const Image coarse = stage.draw();
  EXPECT_NE(coarse.pixels, full.pixels);
  EXPECT_LT(share_of_difference(full, coarse, 24), 0.03);
  stage.renderer.set_coarse(false);
  EXPECT_EQ(stage.draw().pixels, full.pixels);
}

TEST_F(CoarseDrawing, FollowsValuesThatAreSetLater) {
  Stage stage = large_stage(device());
  stage.renderer.set_coarse(true);
  const Image before = stage.draw();
  must(stage.renderer.set_values(std::vector<float>(stage.model.positions.size(), 0.9F)));
  const Image after = stage.draw();
  EXPECT_GT(share_of_difference(before, after, 24), 0.1);
  stage.renderer.set_coarse(false);
  EXPECT_LT(share_of_difference(stage.draw(), after, 24), 0.03);
}

TEST_F(CoarseDrawing, HasTheColoursOfFaces) {
  Stage stage = large_stage(device());
  must(stage.renderer.set_face_values(std::vector<float>(stage.model.faces.size(), 0.3F)));
  stage.scene.surface.paint = Paint::kFaces;
  const Image full = stage.draw();
  stage.renderer.set_coarse(true);
  EXPECT_LT(share_of_difference(full, stage.draw(), 24), 0.03);
}

TEST_F(CoarseDrawing, LeavesSmallModelsAsTheyAre) {
  Stage stage(device(), model_of(torus(40, 20, 0.4)));
  const Image full = stage.draw();
  stage.renderer.set_coarse(true);
  EXPECT_EQ(stage.draw().pixels, full.pixels);
}

class KeptScene : public GpuTest {
 protected:
  /// A frame of the stage as a window draws it.
  static Image draw(Stage& stage, SceneUse use) {
    const glm::ivec2 extent(stage.scene.camera.extent);
    auto target = must(OffscreenTarget::build(stage.device, extent));
    must(stage.renderer.render(*target, stage.scene, some_text(), nullptr, use));
    Image image;
    image.width = extent.x;
    image.height = extent.y;
    image.pixels.resize(std::size_t{4} * extent.x * extent.y);
    target->read(image, {0, 0}, extent);
    return image;
  }
};

TEST_F(KeptScene, IsThePictureThatIsDrawnOnce) {
  for (const int samples : {1, 4}) {
    Stage stage = full_stage(device(), samples);
    const Image once = draw(stage, SceneUse::kOnce);
    EXPECT_EQ(draw(stage, SceneUse::kKeep).pixels, once.pixels);
    EXPECT_EQ(draw(stage, SceneUse::kAgain).pixels, once.pixels);
  }
}

TEST_F(KeptScene, IsNotDrawnAgain) {
  Stage stage = full_stage(device());
  const Image kept = draw(stage, SceneUse::kKeep);
  stage.scene.surface.visible = false;
  EXPECT_EQ(draw(stage, SceneUse::kAgain).pixels, kept.pixels);
  EXPECT_NE(draw(stage, SceneUse::kKeep).pixels, kept.pixels);
}

TEST_F(KeptScene, OfAnotherSizeIsDrawnAnew) {
  Stage stage = full_stage(device());
  (void)draw(stage, SceneUse::kKeep);
  stage.look({}, {200, 150});
  const Image once = draw(stage, SceneUse::kOnce);
  (void)draw(stage, SceneUse::kOnce);
  EXPECT_EQ(draw(stage, SceneUse::kAgain).pixels, once.pixels);
}

}  // namespace
}  // namespace geotherm::test
