// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

constexpr double kHalfTurn = std::numbers::pi;

class Isolines : public GpuTest {
 protected:
  /// Lines `apart` pixels from each other across the direction `angle` (degrees) on the plane. No
  /// line lies at the left or lower edge.
  Stage plane_with_lines(double apart, double angle, Model model = plane_model(1, 1)) {
    Stage stage(device(), std::move(model));
    const float pixels = stage.scene.camera.pixels_per_unit;
    const auto a = static_cast<float>(glm::radians(angle));
    stage.draw_lines(stage.model.values([&](const glm::vec3& p) {
      const float along = p.x * std::cos(a) + p.y * std::sin(a) + 1;
      return along * pixels / static_cast<float>(apart) + 0.5F;
    }),
                     1);
    return stage;
  }
};

TEST_F(Isolines, LieWhereThePlaneHasMultiplesOfTheSpacing) {
  Stage stage(device(), plane_model(6, 4));
  const auto value = [](const glm::vec3& p) { return 1.3F * (p.x + 0.85F); };
  constexpr float kSpacing = 0.25F;
  stage.draw_lines(stage.model.values(value), kSpacing);
  const Image image = stage.draw();
  const auto runs = dark_runs(image, {0, 100}, {1, 0}, image.width);
  std::vector<double> expected;
  for (int i = 1;; ++i) {
    const float x = static_cast<float>(i) * kSpacing / 1.3F - 0.85F;
    if (x > 0.8F) break;
    expected.push_back(stage.scene.camera.project({x, 0, 0}).x - 0.5);  // middle of pixel 0: 0
  }
  ASSERT_EQ(runs.size(), expected.size());
  for (std::size_t i = 0; i < runs.size(); ++i) EXPECT_NEAR(runs[i].centre, expected[i], 0.1);
}

TEST_F(Isolines, LieAtChosenValuesAlone) {
  Stage stage(device(), plane_model(6, 4));
  const auto value = [](const glm::vec3& p) { return 1.3F * (p.x + 0.85F); };
  stage.draw_lines(stage.model.values(value), 0.25F);
  stage.scene.surface.levels = {0.3F, 0.5F, 1.6F};
  const Image image = stage.draw();
  const auto runs = dark_runs(image, {0, 100}, {1, 0}, image.width);
  ASSERT_EQ(runs.size(), 3U);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const float x = stage.scene.surface.levels[i] / 1.3F - 0.85F;
    EXPECT_NEAR(runs[i].centre, stage.scene.camera.project({x, 0, 0}).x - 0.5, 0.1);
    EXPECT_NEAR(runs[i].darkness, runs[0].darkness, 0.2) << "all as wide";
  }
}

TEST_F(Isolines, AreCirclesOfLatitudeForTheAngleFromThePole) {
  Stage stage(device(), model_of(sphere(4)));
  constexpr int kLines = 8;
  stage.draw_lines(stage.model.values([](const glm::vec3& p) { return std::acos(p.y); }),
                   static_cast<float>(kHalfTurn / kLines));
  const Image image = stage.draw();
  const int x = image.width / 2;
  const glm::ivec2 top(x, static_cast<int>(stage.scene.camera.project({0, 1, 0}).y) + 3);
  const auto runs = dark_runs(image, top, {0, 1}, image.height - 2 * top.y);
  ASSERT_EQ(runs.size(), kLines - 1);
  for (int i = 1; i < kLines; ++i) {
    const glm::vec3 on_line(0, std::cos(kHalfTurn * i / kLines), std::sin(kHalfTurn * i / kLines));
    EXPECT_NEAR(top.y + 0.5 + runs[static_cast<std::size_t>(i - 1)].centre,
                stage.scene.camera.project(on_line).y, 1);
  }
}

TEST_F(Isolines, AreNotDrawnAtZero) {
  Stage stage(device(), plane_model(4, 2));
  stage.draw_lines(stage.model.values([](const glm::vec3& p) { return std::abs(p.x); }), 0.5F);
  const Image image = stage.draw();
  const auto runs = dark_runs(image, {2, 100}, {1, 0}, image.width - 4);
  ASSERT_EQ(runs.size(), 2U);
  const double left = stage.scene.camera.project({-0.5F, 0, 0}).x - 2.5;
  EXPECT_NEAR(runs[0].centre, left, 0.1);
  EXPECT_NEAR(runs[1].centre, image.width - 5 - left, 0.1);
}

class IsolineWidth : public Isolines, public testing::WithParamInterface<std::pair<int, int>> {};

TEST_P(IsolineWidth, IsTheSameOnScreenForEverySlopeAndDirection) {
  const auto [apart, angle] = GetParam();
  Stage stage = plane_with_lines(apart, angle);
  stage.scene.surface.line_width = 1.4F;
  const Image image = stage.draw();
  // Whole lines crossed by rows of pixels, which meet them under an angle.
  double width = 0;
  int lines = 0;
  for (int y = 20; y < 220; y += 5) {
    const auto runs = dark_runs(image, {15, y}, {1, 0}, image.width - 30);
    for (std::size_t i = 1; i + 1 < runs.size(); ++i) {
      width += runs[i].darkness * std::cos(glm::radians(static_cast<double>(angle)));
      ++lines;
    }
  }
  ASSERT_GE(lines, 40);
  EXPECT_NEAR(width / lines, 1.4, 0.1);
}

INSTANTIATE_TEST_SUITE_P(All, IsolineWidth,
                         testing::Values(std::pair(8, 0), std::pair(64, 0), std::pair(8, 30),
                                         std::pair(8, 45), std::pair(40, 45)),
                         [](const auto& test) {
                           return std::to_string(test.param.first) + "PixelsApartAt" +
                                  std::to_string(test.param.second);
                         });

TEST_F(Isolines, RunOnFromTriangleToTriangle) {
  Stage coarse = plane_with_lines(17, 25);
  Stage fine = plane_with_lines(17, 25, irregular_plane_model(12));
  fine.scene.camera = coarse.scene.camera;
  constexpr double kRoundingPixels = 0.002;  // single precision decides some pixels otherwise
  EXPECT_LE(different_pixels(coarse.draw(), fine.draw(), 4), kRoundingPixels);
}

class CloseIsolines : public Isolines, public testing::WithParamInterface<double> {};

TEST_P(CloseIsolines, FadeIntoTheirMean) {
  Stage stage = plane_with_lines(GetParam(), 20);
  const Image image = stage.draw();
  const Moments moments = darkness_in(image, inner(image, 12));
  constexpr double kFlat = 2.0 / 255;
  EXPECT_LE(moments.deviation, kFlat);
  constexpr double kDensest = 0.5;  // the colours below stay readable
  EXPECT_NEAR(moments.mean, std::min(stage.scene.surface.line_width / GetParam(), kDensest), 0.02);
}

INSTANTIATE_TEST_SUITE_P(All, CloseIsolines, testing::Values(2.4, 1.7, 0.4, 0.01),
                         [](const auto& test) { return std::to_string(test.index); });

TEST_F(Isolines, KeepTheirMeanWhileTheyFade) {
  for (const double apart : {3.0, 4.0, 6.0}) {
    Stage stage = plane_with_lines(apart, 20);
    const Image image = stage.draw();
    EXPECT_NEAR(darkness_in(image, inner(image, 12)).mean, stage.scene.surface.line_width / apart,
                0.02)
        << apart;
  }
}

TEST_F(Isolines, AreAbsentFromAConstant) {
  Stage stage(device(), plane_model(3, 3));
  stage.draw_lines(std::vector<float>(stage.model.positions.size(), 0.73F), 0.1F);
  EXPECT_EQ(darkness_in(stage.draw(), {{20, 20}, {300, 220}}).mean, 0);
}

}  // namespace
}  // namespace geotherm::test
