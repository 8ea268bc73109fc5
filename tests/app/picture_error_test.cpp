// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "app/picture/picture_data.h"
#include "app/picture/picture_scale.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

using app::kNoPictureValue;
using app::picture_of;
using app::picture_scale;
using app::PictureData;
using app::PictureScale;
using app::PictureSettings;

TEST(PictureError, KeepsItsSigns) {
  PictureData data;
  app::add_error(data, std::vector<double>{0, -2e-9, 4e-9, kUnreached, -kUnreached}, "error of d");
  EXPECT_EQ(data.values, (std::vector<float>{0, -0.5F, 1, kNoPictureValue, kNoPictureValue}));
  EXPECT_TRUE(data.is_signed);
  EXPECT_EQ(data.value_title, "error of d");
  app::add_difference(data, std::vector<double>{1, 0});
  EXPECT_NE(data.value_title, "error of d");
}

TEST(PictureLines, LieInTheSceneAsTheyDoOnTheMesh) {
  const MeshPtr mesh = finish(transformed(sphere(1), 1e9, Vec3(2e9, 0, -1e9), false));
  PictureData data = picture_of(*mesh);
  const std::vector<Vec3> points = {mesh->positions()[0], mesh->positions()[1]};
  app::add_line(data, points, "geodesic");
  app::add_line(data, points, "heat");
  ASSERT_EQ(data.lines.size(), 2U);
  ASSERT_EQ(data.lines[0].points.size(), 2U);
  constexpr float kSceneFloat = 1e-6F;  // of scene space, which has radius 1
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(data.lines[0].points[i][k], data.positions[i][k], kSceneFloat);
    }
  }
  EXPECT_EQ(data.lines[0].name, "geodesic");
  EXPECT_NE(data.lines[0].colour, data.lines[1].colour);
}

TEST(PictureError, HasZeroInTheMiddleAndNoIsolines) {
  PictureData data;
  app::add_error(data, std::vector<double>{-0.25, 0.5}, "error of d");
  PictureSettings settings;
  settings.view = app::View::kExactError;
  const PictureScale scale = picture_scale(data, settings);
  EXPECT_EQ(scale.min, -0.5);
  EXPECT_EQ(scale.max, 0.5);
  EXPECT_EQ(scale.spacing, 0);
  EXPECT_TRUE(scale.bar);
  EXPECT_EQ(app::colour_map_of(data, settings), "cool-warm");
  app::add_error(data, std::vector<double>{0, 0}, "error of d");
  EXPECT_EQ(picture_scale(data, settings).min, -1);
  EXPECT_EQ(picture_scale(data, settings).max, 1);
}

TEST(PictureRegions, HaveIsolinesAndNoBar) {
  PictureData data;
  app::add_distances(data, std::vector<double>{0, 4});
  data.nearest = {0, 1};
  PictureSettings settings;
  settings.view = app::View::kRegions;
  EXPECT_GT(picture_scale(data, settings).spacing, 0);
  EXPECT_FALSE(picture_scale(data, settings).bar);
}

}  // namespace
}  // namespace geotherm::test
