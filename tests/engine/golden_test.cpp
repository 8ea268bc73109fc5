// SPDX-License-Identifier: MIT
#include "tests/engine/golden.h"

#include <algorithm>
#include <cmath>

#include "bench/models/generate.h"
#include "engine/scene/colours.h"
#include "geotherm/heat_method.h"
#include "solver/geometry/face_gradient.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

/// A model with distances and both vector fields.
struct Solved {
  Model model;
  std::vector<float> values;  ///< 0 to 1
  std::vector<glm::vec3> heat, error;
  std::vector<std::int32_t> regions;  ///< bands of distance
  std::vector<float> margins;         ///< to the nearest other band
  std::vector<glm::vec3> path;        ///< down the distance, along edges
  Marker source;
};

/// Length of the second arrows for an angle of 1 between the fields: so that some can be seen.
constexpr double kErrorScale = 5;

/// From the vertex of the largest value along edges, always to the lowest neighbour.
std::vector<glm::vec3> steepest_edges(const Model& model, const std::vector<float>& values) {
  const auto end = std::max_element(values.begin(), values.end());
  auto at = static_cast<std::uint32_t>(end - values.begin());
  std::vector<glm::vec3> path;
  for (bool lower = true; lower;) {
    path.push_back(model.positions[at]);
    std::uint32_t next = at;
    for (const auto& face : model.faces) {
      if (std::find(face.begin(), face.end(), at) == face.end()) continue;
      for (const std::uint32_t v : face) next = values[v] < values[next] ? v : next;
    }
    lower = next != at;
    at = next;
  }
  return path;
}

Solved solve_bunny() {
  const auto mesh = std::make_shared<const TriangleMesh>(must(generate_model("bunny", 2000)));
  constexpr Index kSource = 300;
  const auto method = must(HeatMethod::build(mesh));
  const auto result = must(method.solve(SourceSet::of_vertices({kSource}), {.fields = true}));
  Solved solved;
  solved.model = fitted_model(mesh->positions(), mesh->faces());
  const double most = *std::max_element(result.distances.begin(), result.distances.end());
  for (const double d : result.distances) solved.values.push_back(static_cast<float>(d / most));
  const auto heat = face_gradients(*mesh, result.heat);
  const auto distance = face_gradients(*mesh, result.distances);
  for (std::size_t f = 0; f < heat.size(); ++f) {
    const Vec3 x = -heat[f].stableNormalized();
    const Vec3 g = distance[f].stableNormalized();
    const double angle = std::acos(std::clamp(x.dot(g), -1.0, 1.0));
    const Vec3 scaled = g * std::min(1.0, kErrorScale * angle);
    solved.heat.emplace_back(x.x(), x.y(), x.z());
    solved.error.emplace_back(scaled.x(), scaled.y(), scaled.z());
  }
  for (const float value : solved.values) {
    solved.regions.push_back(static_cast<std::int32_t>(value * 5));
    const float within = value * 5 - std::floor(value * 5);
    solved.margins.push_back(std::max(std::min(within, 1 - within), 1e-4F));
  }
  solved.path = steepest_edges(solved.model, solved.values);
  solved.source = {solved.model.positions[kSource], solved.model.positions[kSource]};
  return solved;
}

/// What the engine is to draw, and what may differ. Other instruction sets change the last bit here
/// and there; at the edges of lines, letters and arrows that is enough to change a pixel.
struct GoldenScene {
  std::string name;
  double share;
  void (*change)(Scene& scene);
};
void PrintTo(const GoldenScene& scene, std::ostream* out) { *out << scene.name; }

constexpr double kSurfaces = 0.005;
constexpr double kLines = 0.01;

const std::vector<GoldenScene>& golden_scenes() {
  static const std::vector<GoldenScene> kScenes = {
      {"wireframe", kLines,
       [](Scene& s) {
         s.surface.wire = true;
         s.surface.smooth = false;
       }},
      {"flat", kSurfaces, [](Scene& s) { s.surface.smooth = false; }},
      {"smooth", kSurfaces, [](Scene&) {}},
      {"sources", kSurfaces, [](Scene& s) { s.markers.visible = true; }},
      {"heat-gradient", kLines, [](Scene& s) { s.markers.visible = s.arrows.primary = true; }},
      {"gradient-error", kLines,
       [](Scene& s) { s.markers.visible = s.arrows.primary = s.arrows.secondary = true; }},
      {"contours", kLines,
       [](Scene& s) {
         s.markers.visible = true;
         s.surface.paint = Paint::kMap;
         s.surface.line_spacing = 0.05F;
       }},
      {"log", kLines,  // the ends of the range, which are lines, lie within the surface
       [](Scene& s) {
         s.surface.paint = Paint::kMap;
         s.surface.log = true;
         s.surface.range_min = 0.1F;
         s.surface.range_max = 0.8F;
         s.surface.levels = {0.05F, 0.1F, 0.2F, 0.4F, 0.8F, 0.9F};
       }},
      {"lines", kLines,
       [](Scene& s) {
         s.markers.visible = s.lines.visible = true;
         s.surface.paint = Paint::kMap;
       }},
      {"regions", kLines,
       [](Scene& s) {
         s.markers.visible = true;
         s.surface.paint = Paint::kRegions;
         s.surface.line_spacing = 0.1F;
       }},
  };
  return kScenes;
}

class GoldenPicture : public GpuTest, public testing::WithParamInterface<GoldenScene> {};

TEST_P(GoldenPicture, LooksAsItDid) {
  Solved solved = solve_bunny();
  Stage stage(device(), std::move(solved.model), 4);
  must(stage.renderer.set_values(solved.values));
  must(stage.renderer.set_arrows(solved.heat, solved.error));
  must(stage.renderer.set_markers({&solved.source, 1}));
  const Polyline path{solved.path, {1, 0.84F, 0.1F}};
  must(stage.renderer.set_lines({&path, 1}));
  stage.scene.lines.visible = false;
  stage.look({});
  stage.scene.light = Light::kThreePoint;
  stage.scene.markers.visible = false;
  stage.scene.pixel_scale = 0.75F;
  GetParam().change(stage.scene);
  if (stage.scene.surface.paint == Paint::kRegions) {
    must(stage.renderer.set_regions(solved.regions, solved.margins));
    must(stage.renderer.set_colours(region_table()));
  }
  expect_golden(stage.draw(), GetParam().name, GetParam().share);
}

/// What stands around a model in bands whose range leaves something out at both ends.
Legend legend_of_bands() {
  Legend legend;
  legend.bar = true;
  constexpr int kBands = 4, kColours = 64;
  for (int i = 0; i <= kColours; ++i) {
    const float band = static_cast<float>(std::min(i * kBands / kColours, kBands - 1));
    legend.colours.emplace_back(0.2F + 0.2F * band, 0.5F, 0.9F - 0.2F * band);
  }
  legend.ticks = {{0, "0.5"}, {0.25F, "1"}, {0.5F, "1.5"}, {0.75F, "2"}, {1, "2.5"}};
  legend.lines = {0.25F, 0.5F, 0.75F};
  legend.title = "distance (mm)";
  legend.below = legend.above = true;
  legend.caption = "bunny";
  legend.keys = {{.label = "not reached", .patches = {glm::vec3(0.62F)}},
                 {.colour = {1, 0.84F, 0.1F}, .label = "geodesic", .rim = glm::vec3(0)}};
  return legend;
}

class GoldenLegend : public GpuTest, public testing::WithParamInterface<glm::vec2> {};

TEST_P(GoldenLegend, LooksAsItDid) {
  Solved solved = solve_bunny();
  Stage stage(device(), std::move(solved.model), 4);
  const LegendLayout layout = lay_out(legend_of_bands(), GetParam());
  stage.scene.light = Light::kThreePoint;
  stage.scene.camera = make_camera({}, stage.model.positions, GetParam(), layout.insets);
  const bool upright = GetParam().y > GetParam().x;
  expect_golden(stage.draw(layout.overlay), upright ? "legend-row" : "legend-column", kLines);
}

INSTANTIATE_TEST_SUITE_P(Shapes, GoldenLegend,
                         testing::Values(glm::vec2(320, 240), glm::vec2(240, 320)),
                         [](const auto& test) {
                           return std::string(test.param.y > test.param.x ? "Row" : "Column");
                         });

INSTANTIATE_TEST_SUITE_P(All, GoldenPicture, testing::ValuesIn(golden_scenes()),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace geotherm::test
