// SPDX-License-Identifier: MIT
#include "bench/benches.h"

#include <cmath>
#include <memory>
#include <optional>

#include "app/drawing/picture_camera.h"
#include "app/drawing/picture_scene.h"
#include "app/picture/picture_text.h"
#include "bench/bench_mesh.h"
#include "engine/renderer.h"
#include "engine/target.h"
#include "geotherm/heat_method.h"
#include "solver/core/stopwatch.h"

namespace geotherm::bench {
namespace {

using namespace geotherm::app;

constexpr glm::ivec2 kSize(1280, 720);

/// Frames of each view: more where they are short, as these are the noisier ones.
int runs_for(Index triangles) { return triangles < 500'000 ? 25 : 7; }

/// A solved model and its picture's scene, without legend.
struct Stage {
  PictureData data;
  std::vector<glm::vec3> positions;
};

Result<Stage> make_stage(Index triangles) {
  auto made = make_mesh("gargoyle", triangles);
  if (!made) return made.error();
  const auto mesh = std::make_shared<const TriangleMesh>(*std::move(made));
  const SourceSet source = SourceSet::of_vertices({17});
  const auto method = HeatMethod::build(mesh);
  if (!method) return method.error();
  const auto result = method->solve(source, {.quality = false, .fields = true});
  if (!result) return result.error();
  Stage stage;
  stage.data = picture_of(*mesh);
  add_sources(stage.data, *mesh, source);
  add_distances(stage.data, result->distances);
  add_fields(stage.data, *mesh, *result);
  stage.positions = scene_vectors(stage.data.positions);
  return stage;
}

/// Something that is timed: a view, or the replacement of the distances.
struct Task {
  RenderRow row;
  engine::Scene scene;
  std::optional<engine::Scene> form = {};  ///< the view shaded by its form
};

std::vector<Task> make_tasks(const Stage& stage, Index triangles, int samples) {
  PictureSettings settings;
  settings.width = kSize.x;
  settings.height = kSize.y;
  const auto scene_for = [&](View view, PictureShading shading) {
    settings.view = view;
    settings.shading = shading;
    engine::Scene scene = scene_of(stage.data, settings, picture_scale(stage.data, settings));
    scene.camera = camera_of({}, settings.camera, stage.positions, kSize, {});
    return scene;
  };
  std::vector<Task> tasks;
  const auto add = [&](const std::string& name, const engine::Scene& scene) {
    RenderRow row;
    row.view = name;
    row.triangles = triangles;
    row.samples = samples;
    tasks.push_back({row, scene});
  };
  // One colour, light, no markers: what views are compared with.
  add("fill", scene_for(View::kSmooth, PictureShading::kPlain));
  for (const View view : {View::kWireframe, View::kFlat, View::kSmooth, View::kSources,
                          View::kHeatGradient, View::kGradientError, View::kContours}) {
    add(to_text(view), scene_for(view, PictureShading::kPlain));
    tasks.back().form = scene_for(view, PictureShading::kForm);
  }
  add("update", tasks.front().scene);
  return tasks;
}

Result<double> time_task(const Task& task, const engine::Scene& scene, engine::Renderer& renderer,
                         engine::Target& target, const Stage& stage) {
  const Stopwatch watch;
  const auto done = task.row.view == "update" ? renderer.set_values(stage.data.values)
                                              : renderer.render(target, scene);
  if (!done) return done.error();
  return watch.milliseconds();
}

Result<void> measure_stage(RenderBench& bench, const engine::Device& device, const Stage& stage,
                           Index triangles, int samples) {
  auto renderer = engine::Renderer::build(device, samples);
  if (!renderer) return renderer.error();
  if (auto done = upload_picture(*renderer, stage.data, {}, stage.positions); !done) return done;
  auto target = engine::OffscreenTarget::build(device, kSize);
  if (!target) return target.error();
  std::vector<Task> tasks = make_tasks(stage, triangles, samples);
  for (int run = -1; run < runs_for(triangles); ++run) {  // the first compiles the shaders
    for (Task& task : tasks) {
      const auto measure = [&](const engine::Scene& scene, double& least) -> Result<void> {
        const auto ms = time_task(task, scene, *renderer, **target, stage);
        if (!ms) return ms.error();
        if (run >= 0) least = std::fmin(least, *ms);
        return {};
      };
      if (auto done = measure(task.scene, task.row.frame_ms); !done) return done;
      if (!task.form) continue;
      if (auto done = measure(*task.form, task.row.form_ms); !done) return done;
    }
  }
  for (Task& task : tasks) {
    task.row.fill_ms = tasks.front().row.frame_ms;
    bench.rows.push_back(std::move(task.row));
  }
  return {};
}

Result<void> measure_all(RenderBench& bench, const Say& say) {
  const auto device = engine::Device::open();
  if (!device) return device.error();
  bench.device = device->info().name;
  for (const Index triangles : {69'000, 262'000, 1'100'000}) {
    say("drawing " + std::to_string(triangles) + " triangles");
    const auto stage = make_stage(triangles);
    if (!stage) return stage.error();
    const auto faces = static_cast<Index>(stage->data.faces.size());
    for (const int samples : {1, 4}) {
      if (auto done = measure_stage(bench, *device, *stage, faces, samples); !done) return done;
    }
  }
  bench.peak_mb = static_cast<double>(device->peak_memory()) / (1024.0 * 1024.0);
  return {};
}

}  // namespace

RenderBench measure_render(const Say& say) {
  RenderBench bench;
  const auto done = measure_all(bench, say);
  if (!done) bench.failure = sentence(done.error());
  return bench;
}

}  // namespace geotherm::bench
