// SPDX-License-Identifier: MIT
#include <cmath>

#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

class Wire : public GpuTest {
 protected:
  static void show_wire(Stage& stage, float width = 1) {
    stage.scene.surface.colour = glm::vec3(1);
    stage.scene.surface.wire = true;
    stage.scene.surface.wire_width = width;
    stage.scene.surface.wire_colour = glm::vec3(0);
  }
};

class WireWidth : public Wire, public testing::WithParamInterface<float> {};

TEST_P(WireWidth, CoversItsShareOfThePlane) {
  constexpr int kCells = 7;
  Stage stage(device(), plane_model(kCells, kCells));
  show_wire(stage, GetParam());
  const Image image = stage.draw();
  const double pixels = stage.scene.camera.pixels_per_unit;
  const double cell_x = 1.6 * pixels / kCells;
  const double cell_y = 1.2 * pixels / kCells;
  // Each cell has one edge of each direction to itself; of those on the border half is seen.
  const double length = kCells * kCells * (cell_x + cell_y + std::hypot(cell_x, cell_y));
  const double area = 1.6 * pixels * 1.2 * pixels;
  const double covered = darkness_in(image, inner(image)).mean * image.width * image.height / area;
  EXPECT_NEAR(covered / (length * GetParam() / area), 1, 0.1);  // 0.1: where edges cross
}

INSTANTIATE_TEST_SUITE_P(All, WireWidth, testing::Values(1.0F, 2.0F),
                         [](const auto& test) { return std::to_string(test.index); });

TEST_F(Wire, LiesOnEveryEdgeAndNotBetween) {
  Stage stage(device(), irregular_plane_model(6));
  Orbit orbit = kFromFront;
  orbit.zoom = 0.9F;  // with room around the outer edges
  stage.look(orbit);
  show_wire(stage, 1.5F);
  const Image image = stage.draw();
  for (const auto& face : stage.model.faces) {
    glm::vec3 middle(0);
    std::array<glm::vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = stage.model.positions[face[k]];
    for (const glm::vec3& p : corners) middle += p / 3.0F;
    EXPECT_LT(darkness(image, static_cast<int>(stage.scene.camera.project(middle).x),
                       static_cast<int>(stage.scene.camera.project(middle).y)),
              0.05);
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 on_edge = 0.5F * (corners[k] + corners[(k + 1) % 3]);
      const glm::vec3 at = stage.scene.camera.project(0.98F * on_edge + 0.02F * middle);
      // In the pixel that holds the edge or one beside it.
      double most = 0;
      for (int i = 0; i < 9; ++i) {
        const glm::ivec2 near = glm::ivec2(at) + glm::ivec2(i % 3 - 1, i / 3 - 1);
        most = std::max(most, darkness(image, near.x, near.y));
      }
      EXPECT_GT(most, 0.6);
    }
  }
}

TEST_F(Wire, FadesWhereTrianglesAreAFewPixelsHigh) {
  Stage stage(device(), plane_model(200, 150));  // cells of 1.6 pixels
  show_wire(stage);
  const Image image = stage.draw();
  EXPECT_LE(darkness_in(image, {{10, 10}, {310, 230}}).mean, 0.01);
}

TEST_F(Wire, IsDrawnOnBothSides) {
  Stage stage(device(), plane_model(5, 5));
  show_wire(stage);
  const double front = darkness_in(stage.draw(), {{5, 5}, {315, 235}}).mean;
  stage.look({.azimuth = 180, .elevation = 0, .orthographic = true});
  const double back = darkness_in(stage.draw(), {{5, 5}, {315, 235}}).mean;
  EXPECT_GT(front, 0.02);
  EXPECT_NEAR(back, front, 0.1 * front);
}

}  // namespace
}  // namespace geotherm::test
