// SPDX-License-Identifier: MIT
#include "engine/scene/colours.h"
#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

/// The picture's 8 bits and the map's steps both round.
constexpr float kColourRounding = 2.5F / 255;
constexpr glm::vec3 kGrey(0.62F);  ///< of what has no value

class FaceValues : public GpuTest {
 protected:
  FaceValues() : stage(device(), square_model(0.5F, 0)) {
    must(stage.renderer.set_colours(colour_table(map)));
    must(stage.renderer.set_values(std::vector<float>(4, 0.5F)));
    stage.scene.surface.paint = Paint::kFaces;
    stage.scene.surface.range_max = 4;
  }
  /// Near the middle of each corner of a face's triangle, where a mean of neighbours would show.
  void expect_colour(const Image& image, std::size_t face, const glm::vec3& expected) {
    const auto& corners = stage.model.faces[face];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = [&](std::size_t i) { return stage.model.positions[corners[(k + i) % 3]]; };
      const glm::vec3 place = 0.8F * at(0) + 0.1F * at(1) + 0.1F * at(2);
      const glm::vec3 seen = colour_at(image, stage.scene.camera.project(place));
      EXPECT_LE(difference(seen, expected), kColourRounding) << face << " " << k;
    }
  }
  glm::vec3 colour_of(float value) const { return engine::colour_at(map, value / 4); }

  const ColourMap& map = *find_colour_map("viridis");
  Stage stage;
};

TEST_F(FaceValues, AreFlatWithinEachFaceAndEndSharplyAtItsSides) {
  must(stage.renderer.set_face_values(std::vector<float>{1, 3}));
  const Image image = stage.draw();
  expect_colour(image, 0, colour_of(1));
  expect_colour(image, 1, colour_of(3));
  must(stage.renderer.set_face_values(std::vector<float>{3, kNoValue}));
  const Image later = stage.draw();
  expect_colour(later, 0, colour_of(3));
  expect_colour(later, 1, kGrey);
}

TEST_F(FaceValues, KeepTheEdgesAndShadesOfTheSurface) {
  Model sphere_model = model_of(sphere(2));
  Stage faces(device(), sphere_model), vertices(device(), sphere_model);
  for (Stage* each : {&faces, &vertices}) {
    each->scene.light = Light::kThreePoint;
    each->scene.surface.wire = true;
    must(each->renderer.set_colours(colour_table(map)));
    must(each->renderer.set_values(std::vector<float>(sphere_model.positions.size(), 1)));
    each->scene.surface.range_max = 4;
  }
  must(faces.renderer.set_face_values(std::vector<float>(sphere_model.faces.size(), 1)));
  faces.scene.surface.paint = Paint::kFaces;
  vertices.scene.surface.paint = Paint::kMap;
  EXPECT_EQ(different_pixels(faces.draw(), vertices.draw(), 1), 0);
}

TEST_F(FaceValues, AreGoneOnRequestAndWithTheirModel) {
  stage.scene.surface.colour = glm::vec3(1);
  must(stage.renderer.set_face_values(std::vector<float>{1, 3}));
  must(stage.renderer.set_face_values({}));
  expect_colour(stage.draw(), 0, glm::vec3(1));
  must(stage.renderer.set_face_values(std::vector<float>{1, 3}));
  must(stage.renderer.set_surface(stage.model.geometry()));
  expect_colour(stage.draw(), 0, glm::vec3(1));
}

}  // namespace
}  // namespace geotherm::test
