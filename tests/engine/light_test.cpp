// SPDX-License-Identifier: MIT
#include <cmath>
#include <optional>
#include <set>

#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

class Lit : public GpuTest, public testing::WithParamInterface<Light> {};

TEST_P(Lit, BackSidesAreAsBrightAsFronts) {
  Model back = plane_model(3, 3);
  for (auto& face : back.faces) std::swap(face[0], face[1]);
  for (const bool smooth : {false, true}) {
    Stage front_stage(device(), plane_model(3, 3));
    Stage back_stage(device(), back);
    for (Stage* stage : {&front_stage, &back_stage}) {
      stage->scene.light = GetParam();
      stage->scene.surface.smooth = smooth;
      stage->look({.azimuth = 40, .elevation = 10});
    }
    const Image image = front_stage.draw();
    EXPECT_LE(different_pixels(image, back_stage.draw(), 1), 0.001) << smooth;
    EXPECT_GT(darkness_in(image, {{150, 110}, {170, 130}}).mean, 0.05);
  }
}

TEST_P(Lit, FlatIsConstantInEachFace) {
  Stage stage(device(), model_of(sphere(1)));
  stage.scene.light = GetParam();
  stage.scene.surface.smooth = false;
  stage.look({.azimuth = 20, .elevation = 15});
  const Image image = stage.draw();
  std::vector<std::optional<glm::vec3>> colours(stage.model.faces.size());
  std::set<int> shades;
  for (int y = 0; y < image.height; y += 2) {
    for (int x = 0; x < image.width; x += 2) {
      const auto seen = hit(stage.model, stage.scene.camera, x, y);
      if (!seen || glm::min(glm::min(seen->weights.x, seen->weights.y), seen->weights.z) < 0.03) {
        continue;
      }
      const glm::vec3 colour = colour_at(image, x, y);
      auto& first = colours[seen->face];
      if (!first) first = colour;
      EXPECT_LE(difference(colour, *first), 1.5F / 255) << seen->face;
      shades.insert(static_cast<int>(image.at(x, y)[0]));
    }
  }
  EXPECT_GE(shades.size(), 10U);  // and differs from face to face
}

TEST_P(Lit, SmoothHasNoStepsAcrossEdges) {
  Stage stage(device(), model_of(sphere(3)));
  stage.scene.light = GetParam();
  const auto largest_step = [&](bool smooth) {
    stage.scene.surface.smooth = smooth;
    const Image image = stage.draw();
    float largest = 0;
    for (int y = 60; y < 180; ++y) {  // within the disc
      for (int x = 100; x < 220; ++x) {
        largest = std::max({largest, difference(colour_at(image, x, y), colour_at(image, x + 1, y)),
                            difference(colour_at(image, x, y), colour_at(image, x, y + 1))});
      }
    }
    return largest;
  };
  EXPECT_LE(largest_step(true), 4.0F / 255);
  EXPECT_GE(largest_step(false), 8.0F / 255);
}

TEST_P(Lit, SidesOfACubeAreEvenWhenSmooth) {
  Stage stage(device(), cube_model(0.5F));
  stage.scene.light = GetParam();
  stage.look({.azimuth = 35, .elevation = 25});
  const Image smooth = stage.draw();
  stage.scene.surface.smooth = false;
  EXPECT_LE(different_pixels(smooth, stage.draw(), 1), 0.005);
}

TEST_P(Lit, OrientationOfNeighboursMakesNoDifference) {
  Model turned = model_of(sphere(2));
  for (std::size_t f = 0; f < turned.faces.size(); f += 3) {
    std::swap(turned.faces[f][0], turned.faces[f][1]);
  }
  Stage stage(device(), model_of(sphere(2)));
  Stage other(device(), turned);
  stage.scene.light = other.scene.light = GetParam();
  EXPECT_LE(different_pixels(stage.draw(), other.draw(), 2), 0.002);
}

TEST_P(Lit, NothingIsBlackOrBurntOut) {
  Stage stage(device(), model_of(sphere(4)));
  stage.scene.light = GetParam();
  const Image image = stage.draw();
  float least = 1;
  int full = 0;
  int seen = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const glm::vec2 p(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      const glm::vec3 centre = stage.scene.camera.project({0, 0, 0});
      if (glm::distance(p, glm::vec2(centre)) > 110) continue;
      ++seen;
      least = std::min(least, colour_at(image, x, y).r);
      full += image.at(x, y)[0] == 255;
    }
  }
  EXPECT_GT(least, 0.15F);
  EXPECT_EQ(full, 0);
  EXPECT_GT(seen, 10000);
}

/// What docs/rendering.md says of the form's share of the light.
float form_of(float openness, float facing) {
  const float outline = 1 - std::min(facing / 0.45F, 1.0F);
  return (1 - 0.65F * (1 - openness)) * (1 - 0.35F * outline * outline);
}

/// Sphere from the front, dark on its left half; the same without its form.
TEST_P(Lit, FormDimsWhatIsClosedAndWhatTurnsAway) {
  const Model model = model_of(sphere(5));
  std::vector<Openness> openness;
  for (const glm::vec3& p : model.positions) {
    openness.push_back({p, p.x < 0 ? 0.25F : 1.0F, 1});
  }
  SurfaceGeometry geometry = model.geometry();
  geometry.openness = openness;
  for (const bool mapped : {false, true}) {
    Stage stage(device(), model);
    must(stage.renderer.set_surface(geometry));
    stage.scene.light = GetParam();
    if (mapped) stage.paint(model.values([](const glm::vec3& p) { return p.y; }), -3, 3);
    const Image plain = stage.draw();
    stage.scene.surface.form = true;
    const Image formed = stage.draw();
    for (const glm::vec2 at :
         {glm::vec2(-0.5F, 0.1F), {0.5F, 0.1F}, {0.2F, 0.94F}, {-0.3F, 0.9F}}) {
      const glm::vec3 n(at, std::sqrt(1 - glm::dot(at, at)));
      const glm::vec3 pixel = stage.scene.camera.project(n);
      const glm::vec3 before = colour_at(plain, pixel), after = colour_at(formed, pixel);
      const glm::vec3 ratio = after / before;
      const float form = form_of(at.x < 0 ? 0.25F : 1.0F, n.z);
      EXPECT_LE(std::abs(ratio.r - ratio.b), 0.03F) << "the hue is as it was";
      if (!mapped) {
        EXPECT_NEAR(ratio.g, form, 0.03F) << at.x << " " << at.y;
      } else {
        // Of the light three fifths may be missing, and of the colour only what light dims.
        EXPECT_GE(ratio.g, 0.4F + 0.6F * form - 0.02F) << at.x << " " << at.y;
        EXPECT_LE(ratio.g, 1.01F);
      }
    }
  }
}

/// As a viewer sets it: the picture of a model comes first, its light when it has been found.
TEST_P(Lit, LightThatIsSetLaterIsThatOfTheSurface) {
  const Model model = model_of(torus(400, 200, 0.4));  // a coarse surface stands for it, too
  std::vector<Openness> openness;
  for (const glm::vec3& p : model.positions) openness.push_back({p, p.x < 0 ? 0.25F : 1.0F, 1});
  SurfaceGeometry geometry = model.geometry();
  geometry.openness = openness;
  const std::vector<float> heights = model.values([](const glm::vec3& p) { return p.y; });
  const std::vector<float> of_faces(model.faces.size(), 0.5F);
  const auto set_all = [&](Stage& stage) {
    stage.scene.light = GetParam();
    stage.scene.surface.form = true;
    stage.paint(heights, -1, 1);
    must(stage.renderer.set_face_values(of_faces));
  };
  Stage at_once(device(), model);
  must(at_once.renderer.set_surface(geometry));
  set_all(at_once);
  Stage later(device(), model), moved(device(), model);
  must(moved.renderer.move_surface(model.positions));
  for (Stage* stage : {&later, &moved}) {
    set_all(*stage);
    stage->renderer.set_coarse(true);
    stage->draw();
    must(stage->renderer.set_openness(openness));
    for (const Paint paint : {Paint::kMap, Paint::kFaces}) {
      at_once.scene.surface.paint = stage->scene.surface.paint = paint;
      for (const bool coarse : {false, true}) {
        at_once.renderer.set_coarse(coarse);
        stage->renderer.set_coarse(coarse);
        EXPECT_EQ(stage->draw().pixels, at_once.draw().pixels)
            << (stage == &moved ? "moved, " : "") << (coarse ? "coarse, " : "")
            << (paint == Paint::kFaces ? "faces" : "values");
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Lit, testing::Values(Light::kHeadlight, Light::kThreePoint),
                         [](const auto& test) {
                           return std::string(test.param == Light::kHeadlight ? "Headlight"
                                                                              : "ThreePoints");
                         });

class NoLight : public GpuTest {};

TEST_F(NoLight, LeavesColoursAsTheyAre) {
  Stage stage(device(), model_of(sphere(3)));
  stage.scene.surface.colour = {0.2F, 0.4F, 0.6F};
  const Image image = stage.draw();
  EXPECT_EQ(image.at(160, 120)[0], 51);
  EXPECT_EQ(image.at(160, 120)[1], 102);
  EXPECT_EQ(image.at(160, 120)[2], 153);
  EXPECT_NEAR(darkness_in(image, {{120, 80}, {200, 160}}).deviation, 0, 1e-6);
}

TEST_F(NoLight, LeavesTheFormAway) {
  Stage stage(device(), model_of(sphere(3)));
  const Image bare = stage.draw();
  stage.scene.surface.form = true;
  EXPECT_EQ(stage.draw().pixels, bare.pixels);
}

}  // namespace
}  // namespace geotherm::test
