// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

constexpr glm::vec3 kInside(1, 0.5F, 0);
constexpr glm::vec3 kRim(0, 0, 1);
constexpr float kRadius = 9;
constexpr float kPixelRounding = 1.5F / 255;

class Markers : public GpuTest {
 protected:
  static Stage stage_with(Model model, const Marker& marker) {
    Stage stage(device(), std::move(model));
    stage.scene.surface.colour = glm::vec3(1);
    stage.scene.markers.colour = kInside;
    stage.scene.markers.rim = kRim;
    stage.scene.markers.radius = kRadius;
    must(stage.renderer.set_markers({&marker, 1}));
    return stage;
  }
  static Marker point(const glm::vec3& p) { return {p, p}; }

  static void expect_colour(const Image& image, const glm::vec3& at, const glm::vec3& expected) {
    EXPECT_LE(difference(colour_at(image, at), expected), kPixelRounding) << at.x << " " << at.y;
  }
  /// Pixels that the markers cover, by coverage.
  static double covered(const Image& image) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) sum += 1 - image.at(x, y)[0] / 255.0;
    }
    return sum;  // red: 0 in the rim, 1 elsewhere
  }
};

TEST_F(Markers, AreDiscsWithARimAtTheirPoints) {
  const glm::vec3 place(0.31F, -0.17F, 0);
  Stage stage = stage_with(plane_model(2, 2), point(place));
  const Image image = stage.draw();
  const glm::vec3 centre = stage.scene.camera.project(place);
  for (int i = 0; i < 16; ++i) {
    const double angle = i * std::numbers::pi / 8;
    const glm::vec3 way(std::cos(angle), std::sin(angle), 0);
    expect_colour(image, centre + 0.4F * kRadius * way, kInside);
    expect_colour(image, centre + 0.84F * kRadius * way, kRim);
    expect_colour(image, centre + (kRadius + 2) * way, glm::vec3(1));
  }
  const double ring = std::numbers::pi * kRadius * kRadius * (1 - 0.68 * 0.68);
  EXPECT_NEAR(covered(image) / ring, 1, 0.03);
}

TEST_F(Markers, OfSegmentsAreHalfAsWideAndRoundAtBothEnds) {
  constexpr float kHalfWidth = kRadius / 2;
  const Marker segment{{-0.3F, -0.2F, 0}, {0.4F, 0.1F, 0}};
  Stage stage = stage_with(plane_model(2, 2), segment);
  const Image image = stage.draw();
  const glm::vec2 from(stage.scene.camera.project(segment.from));
  const glm::vec2 to(stage.scene.camera.project(segment.to));
  const glm::vec2 along = glm::normalize(to - from);
  const glm::vec2 across(-along.y, along.x);
  const auto at = [](const glm::vec2& p) { return glm::vec3(p, 0); };
  expect_colour(image, at((from + to) / 2.0F), kInside);
  for (const float side : {-1.0F, 1.0F}) {
    const glm::vec2 out = side * along;
    const glm::vec2 end = side < 0 ? from : to;
    expect_colour(image, at((from + to) / 2.0F + side * 0.87F * kHalfWidth * across), kRim);
    expect_colour(image, at((from + to) / 2.0F + side * (kHalfWidth + 2) * across), glm::vec3(1));
    expect_colour(image, at(end + 0.4F * kHalfWidth * out), kInside);
    expect_colour(image, at(end + 0.87F * kHalfWidth * out), kRim);
    expect_colour(image, at(end + (kHalfWidth + 2) * out), glm::vec3(1));
    // The corner that a straight end would fill.
    expect_colour(image, at(end + 0.88F * kHalfWidth * (out + across)), glm::vec3(1));
  }
}

TEST_F(Markers, OfACurveJoin) {
  const std::vector<glm::vec3> curve = {
      {-0.5F, 0, 0}, {-0.1F, 0.2F, 0}, {0, 0.2F, 0}, {0.4F, 0, 0}};
  std::vector<Marker> pieces;
  for (std::size_t i = 1; i < curve.size(); ++i) pieces.push_back({curve[i - 1], curve[i]});
  Stage stage = stage_with(plane_model(2, 2), pieces[0]);
  must(stage.renderer.set_markers(pieces));
  const Image image = stage.draw();
  for (const Marker& piece : pieces) {
    for (float t = 0; t <= 1; t += 0.05F) {
      expect_colour(image, stage.scene.camera.project(glm::mix(piece.from, piece.to, t)), kInside);
    }
  }
}

TEST_F(Markers, OfAHiddenCurveAreEvenlyFaint) {
  Model model = square_model(0.6F, 0);
  append(model, square_model(0.6F, 0.5F));
  const Marker first{{-0.4F, 0.1F, 0}, {0, 0.1F, 0}};
  const Marker second{{0, 0.1F, 0}, {0.4F, 0.1F, 0}};
  Stage stage = stage_with(model, first);
  must(stage.renderer.set_markers(std::vector{first, second}));
  const Image image = stage.draw();
  const auto colour = [&](float x) {
    return colour_at(image, stage.scene.camera.project({x, 0.1F, 0}));
  };
  EXPECT_GT(difference(colour(-0.3F), glm::vec3(1)), 0.1F);
  for (float x = -0.35F; x <= 0.35F; x += 0.01F) {
    EXPECT_LE(difference(colour(x), colour(-0.3F)), 0.12F) << x;  // one pixel may belong to both
  }
}

TEST_F(Markers, KeepTheirSizeOnScreen) {
  Stage stage = stage_with(plane_model(2, 2), point({0, 0, 0}));
  const double before = covered(stage.draw());
  Orbit orbit = kFromFront;
  orbit.zoom = 3;
  stage.look(orbit);
  EXPECT_NEAR(covered(stage.draw()), before, 2);
  stage.scene.pixel_scale = 2;
  EXPECT_NEAR(covered(stage.draw()), 4 * before, 0.04 * before);
}

/// A surface that is seen under this angle (degrees; 90: straight), in perspective or without.
class MarkerOnInclined : public Markers,
                         public testing::WithParamInterface<std::pair<float, bool>> {};

TEST_P(MarkerOnInclined, IsSeenWhole) {
  const auto [angle, orthographic] = GetParam();
  Stage stage = stage_with(plane_model(2, 2), point({0.1F, -0.1F, 0}));
  stage.look({.azimuth = 90 - angle, .elevation = 0, .orthographic = orthographic});
  const double ring = std::numbers::pi * kRadius * kRadius * (1 - 0.68 * 0.68);
  EXPECT_NEAR(covered(stage.draw()) / ring, 1, 0.05);
}

INSTANTIATE_TEST_SUITE_P(All, MarkerOnInclined,
                         testing::Values(std::pair(60.0F, false), std::pair(60.0F, true),
                                         std::pair(30.0F, false), std::pair(30.0F, true)),
                         [](const auto& test) {
                           return std::to_string(static_cast<int>(test.param.first)) +
                                  (test.param.second ? "Orthographic" : "Perspective");
                         });

TEST_F(Markers, StayVisibleOnSurfacesSeenEdgeOn) {
  for (const float angle : {0.0F, 2.0F, 10.0F}) {
    Stage stage = stage_with(plane_model(2, 2), point({0.1F, -0.1F, 0}));
    stage.look({.azimuth = 90 - angle, .elevation = 0});
    const double ring = std::numbers::pi * kRadius * kRadius * (1 - 0.68 * 0.68);
    EXPECT_GE(covered(stage.draw()) / ring, 0.5) << angle;
  }
}

TEST_F(Markers, OnTheFarSideOfASphereAreFaint) {
  Stage stage = stage_with(model_of(sphere(4)), point({0, 0.2F, -0.98F}));
  const glm::vec3 at = stage.scene.camera.project({0, 0.2F, -0.98F});
  const glm::vec3 colour = colour_at(stage.draw(), at);
  EXPECT_LT(difference(colour, glm::vec3(1)), 0.7F);
  EXPECT_GT(difference(colour, glm::vec3(1)), 0.3F);
}

TEST_F(Markers, OnTheFarSideOfAThinBodyAreFaint) {
  Model model = square_model(0.6F, 0);
  append(model, square_model(0.6F, 0.01F));
  Marker marker = point({0.1F, 0.1F, 0});
  const auto colour = [&](const glm::vec4& outward) {
    marker.outward = outward;
    Stage stage = stage_with(model, marker);
    return colour_at(stage.draw(), stage.scene.camera.project(marker.from));
  };
  const glm::vec3 faint = colour({0, 0, -1, 0});
  EXPECT_GT(difference(faint, kInside), 0.3F);
  EXPECT_GT(difference(faint, glm::vec3(1)), 0.1F);
  for (const glm::vec4& seen : {glm::vec4(0, 0, 1, 0), {0, 0, -0.5F, 0.6F}, {0, 0, 0, 2}}) {
    EXPECT_LE(difference(colour(seen), kInside), kPixelRounding) << seen.z << " " << seen.w;
  }
}

TEST_F(Markers, OnTheFarSideOfAThinBodyThatIsInclinedAreFaintAllOver) {
  constexpr float kThickness = 0.001F;
  Model model = square_model(0.6F, 0);
  append(model, square_model(0.6F, kThickness));
  Marker marker = point({0, 0, 0});
  marker.outward = {0, 0, -1, 0};
  for (const bool orthographic : {false, true}) {
    for (const float angle : {90.0F, 60.0F, 30.0F}) {
      Stage stage = stage_with(model, marker);
      stage.look({.azimuth = 90 - angle, .elevation = 0, .orthographic = orthographic});
      const Image image = stage.draw();
      const glm::vec3 centre = stage.scene.camera.project(marker.from);
      for (int i = 0; i < 16; ++i) {
        const double turn = i * std::numbers::pi / 8;
        const glm::vec3 way(std::cos(turn), std::sin(turn), 0);
        EXPECT_GT(difference(colour_at(image, centre + 0.4F * kRadius * way), kInside), 0.3F)
            << angle << " " << i;
      }
    }
  }
}

TEST_F(Markers, BehindTheEyeAreNotDrawn) {
  Stage stage = stage_with(plane_model(2, 2), {{0, 0, 20}, {0.2F, 0, 30}});
  stage.look({.azimuth = 0, .elevation = 0});
  EXPECT_LE(covered(stage.draw()), 1);
}

TEST_F(Markers, AreGoneWithTheirModel) {
  Stage stage = stage_with(plane_model(2, 2), point({0, 0, 0}));
  must(stage.renderer.set_surface(stage.model.geometry()));
  EXPECT_EQ(covered(stage.draw()), 0);
}

TEST_F(Markers, AreNotDrawnUnlessWanted) {
  Stage stage = stage_with(plane_model(2, 2), point({0, 0, 0}));
  stage.scene.markers.visible = false;
  EXPECT_EQ(covered(stage.draw()), 0);
}

}  // namespace
}  // namespace geotherm::test
