// SPDX-License-Identifier: MIT
#include "engine/vulkan/device_state.h"
#include "engine/vulkan/vulkan.h"
#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

constexpr std::uint64_t kMiB = 1U << 20U;

class DeviceMemory : public GpuTest {};

/// Takes the rest of a device's memory as long as it lives: next to nothing is left.
std::vector<std::unique_ptr<OffscreenTarget>> fill_memory(const Device& device) {
  std::vector<std::unique_ptr<OffscreenTarget>> targets;
  for (const int side : {512, 128, 32}) {
    while (auto target = OffscreenTarget::build(device, {side, side})) {
      targets.push_back(*std::move(target));
    }
  }
  return targets;
}

TEST_F(DeviceMemory, ThatEndsIsAnErrorWithFiguresAndLeavesTheModel) {
  const Device small = must(Device::open(validated(4 * kMiB)));
  {
    Stage stage(small, plane_model(10, 10));
    const Image before = stage.draw();
    const Model large = plane_model(400, 300);
    const Result<void> failed = stage.renderer.set_surface(large.geometry());
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().code, ErrorCode::kOutOfMemory);
    EXPECT_NE(failed.error().message.find("4 MB"), std::string::npos) << failed.error().message;
    EXPECT_EQ(settings_of(failed.error().hint), (std::vector<SettingHint>{{"samples", {"1"}}}));
    EXPECT_EQ(stage.draw().pixels, before.pixels);
    // Values and arrows are still those of the earlier model.
    Stage other(device(), plane_model(10, 10));
    const std::vector<glm::vec3> field(other.model.faces.size(), glm::vec3(1, 0, 0));
    for (Stage* either : {&stage, &other}) {
      must(either->renderer.set_arrows(field, {}));
      either->scene.arrows.primary = true;
      either->paint(either->model.values([](const glm::vec3& p) { return p.x; }));
    }
    EXPECT_EQ(stage.draw().pixels, other.draw().pixels);
    stage.scene = {};
    stage.scene.light = Light::kNone;
    stage.look(kFromFront);

    const Camera camera = stage.scene.camera;
    stage.look(kFromFront, {2000, 2000});
    const auto picture = draw_picture(small, stage.renderer, stage.scene);
    ASSERT_FALSE(picture);
    EXPECT_EQ(picture.error().code, ErrorCode::kOutOfMemory);
    stage.scene.camera = camera;
    EXPECT_EQ(stage.draw().pixels, before.pixels);
  }
  EXPECT_EQ(small.memory_used(), 0U);
  EXPECT_LE(small.peak_memory(), 4 * kMiB);
  for (const std::string& message : small.validation_messages()) ADD_FAILURE() << message;
}

TEST_F(DeviceMemory, ThatEndsWhileTheModelMovesLeavesItWhereItWas) {
  const Device small = must(Device::open(validated(8 * kMiB)));
  for (const bool has_moved : {false, true}) {
    Stage stage(small, plane_model(100, 100));
    stage.scene.light = Light::kThreePoint;
    if (has_moved) must(stage.renderer.move_surface(stage.model.positions));
    const Image before = stage.draw();
    Model folded = stage.model;  // along an edge, which becomes a crease and has vertices twice
    for (glm::vec3& p : folded.positions) p = {std::min(p.x, 0.0F), p.y, std::min(-p.x, 0.0F)};
    auto rest = fill_memory(small);
    for (int i = 0; i < 2; ++i) {
      const Result<void> moved = stage.renderer.move_surface(folded.positions);
      ASSERT_FALSE(moved) << has_moved << i;
      EXPECT_EQ(moved.error().code, ErrorCode::kOutOfMemory);
    }
    rest.clear();
    EXPECT_EQ(stage.draw().pixels, before.pixels);
    must(stage.renderer.move_surface(folded.positions));
    Stage other(device(), folded);
    other.scene = stage.scene;
    EXPECT_EQ(stage.draw().pixels, other.draw().pixels);
    EXPECT_NE(stage.draw().pixels, before.pixels);
  }
  for (const std::string& message : small.validation_messages()) ADD_FAILURE() << message;
}

TEST_F(DeviceMemory, ThatEndsForLinesIsAnErrorUntilItSuffices) {
  const Device small = must(Device::open(validated(8 * kMiB)));
  {
    Stage stage(small, plane_model(2, 2));
    const auto target = must(OffscreenTarget::build(small, glm::ivec2(kSmallPicture)));
    must(stage.renderer.render(*target, stage.scene));
    std::vector<glm::vec3> zigzag;
    for (int i = 0; i < 1000; ++i) {
      zigzag.emplace_back(-0.7F + 0.0014F * static_cast<float>(i), i % 2 == 0 ? -0.3F : 0.3F, 0.1F);
    }
    const Polyline line{zigzag, {0.9F, 0.1F, 0.1F}};
    must(stage.renderer.set_lines({&line, 1}));
    auto rest = fill_memory(small);
    for (int i = 0; i < 2; ++i) {
      const Result<void> drawn = stage.renderer.render(*target, stage.scene);
      ASSERT_FALSE(drawn) << i;
      EXPECT_EQ(drawn.error().code, ErrorCode::kOutOfMemory);
    }
    stage.scene.lines.visible = false;
    must(stage.renderer.render(*target, stage.scene));
    stage.scene.lines.visible = true;
    rest.clear();
    Stage other(device(), stage.model);
    must(other.renderer.set_lines({&line, 1}));
    EXPECT_EQ(stage.draw().pixels, other.draw().pixels);
  }
  for (const std::string& message : small.validation_messages()) ADD_FAILURE() << message;
}

TEST_F(DeviceMemory, ThatEndsForTheCoarseSurfaceHasTheModelDrawn) {
  const Device small = must(Device::open(validated(32 * kMiB)));
  {
    Stage stage(small, model_of(torus(400, 200, 0.4)));
    stage.scene.light = Light::kThreePoint;
    const glm::ivec2 extent(kSmallPicture);
    const auto target = must(OffscreenTarget::build(small, extent));
    const auto draw = [&](SceneUse use) {
      must(stage.renderer.render(*target, stage.scene, {}, nullptr, use));
      Image image{extent.x, extent.y, {}};
      image.pixels.resize(std::size_t{4} * extent.x * extent.y);
      target->read(image, {0, 0}, extent);
      return image.pixels;
    };
    const auto full = draw(SceneUse::kKeep);
    auto rest = fill_memory(small);
    EXPECT_EQ(draw(SceneUse::kAgain), full);
    stage.renderer.set_coarse(true);
    EXPECT_EQ(draw(SceneUse::kKeep), full);
    rest.clear();
    must(stage.renderer.set_surface(stage.model.geometry()));
    EXPECT_NE(draw(SceneUse::kKeep), full) << "another model is tried again";
  }
  for (const std::string& message : small.validation_messages()) ADD_FAILURE() << message;
}

TEST_F(DeviceMemory, IsNotWrittenBeyondABuffer) {
  const auto state = device().state();
  const Buffer buffer =
      state->upload(std::vector<std::byte>(64), vk::BufferUsageFlagBits::eVertexBuffer);
  state->update(buffer, std::vector<std::byte>(64));
  EXPECT_THROW(state->update(buffer, std::vector<std::byte>(65)), Failure);
}

TEST_F(DeviceMemory, ThatTheHostCannotSeeIsFilledThroughCopies) {
  DeviceOptions options = validated();
  options.staging = true;
  const Device hidden = must(Device::open(options));
  const auto drawn = [](const Device& on) {
    Stage stage(on, plane_model(10, 10));
    stage.paint(stage.model.values([](const glm::vec3& p) { return 0.5F + 0.4F * p.x; }));
    const Image first = stage.draw();
    stage.paint(stage.model.values([](const glm::vec3& p) { return 0.5F + 0.4F * p.y; }));
    const Image second = stage.draw();
    EXPECT_NE(first.pixels, second.pixels);
    return second;
  };
  EXPECT_EQ(drawn(hidden).pixels, drawn(device()).pixels);
  EXPECT_EQ(hidden.memory_used(), 0U);
  for (const std::string& message : hidden.validation_messages()) ADD_FAILURE() << message;
}

TEST_F(DeviceMemory, ThatEndsWhileDrawingLeavesTheRendererUsable) {
  // Enough for the target, not for four samples of the scene.
  const Device small = must(Device::open(validated(9 * kMiB)));
  {
    Stage stage(small, plane_model(2, 2), 4);
    const Image before = stage.draw();
    stage.look(kFromFront, {900, 900});
    ASSERT_FALSE(draw_picture(small, stage.renderer, stage.scene));
    stage.look(kFromFront);
    EXPECT_EQ(stage.draw().pixels, before.pixels);
  }
  for (const std::string& message : small.validation_messages()) ADD_FAILURE() << message;
}

TEST_F(DeviceMemory, IsGivenBackByTheRenderer) {
  const std::uint64_t before = device().memory_used();
  {
    Stage stage(device(), model_of(sphere(4)), 4);
    (void)stage.draw();
    EXPECT_GT(device().memory_used(), before);
  }
  EXPECT_EQ(device().memory_used(), before);
}

TEST_F(DeviceMemory, DoesNotGrowFromFrameToFrame) {
  Stage stage(device(), model_of(sphere(4)), 4);
  (void)stage.draw();
  const std::uint64_t after_one = device().memory_used();
  for (int i = 0; i < 5; ++i) {
    must(stage.renderer.set_surface(stage.model.geometry()));
    stage.paint(stage.model.values([](const glm::vec3& p) { return p.x; }));
    (void)stage.draw();
  }
  EXPECT_EQ(device().memory_used(), after_one);
}

TEST_F(DeviceMemory, SufficesForAMillionFacesSlow) {
  const Device fresh = must(Device::open(validated()));
  constexpr int kAround = 1050;
  Model model = model_of(transformed(torus(kAround, kAround / 2, 0.4), 0.7, {0, 0, 0}, true));
  ASSERT_GT(model.faces.size(), 1'100'000U);
  {
    Stage stage(fresh, std::move(model), 4);
    stage.look({}, {1280, 720});
    stage.scene.light = Light::kThreePoint;
    stage.scene.surface.wire = true;
    stage.scene.arrows.primary = true;
    const std::vector<glm::vec3> field(stage.model.faces.size(), glm::vec3(0, 1, 0));
    must(stage.renderer.set_arrows(field, {}));
    const Image image = stage.draw();
    EXPECT_GT(darkness_in(image, inner(image)).mean, 0.05);
  }
  EXPECT_LT(fresh.peak_memory(), 2048 * kMiB);
  EXPECT_LT(fresh.peak_memory(), 256 * kMiB);  // what it is about, twice
  for (const std::string& message : fresh.validation_messages()) ADD_FAILURE() << message;
}

}  // namespace
}  // namespace geotherm::test
