// SPDX-License-Identifier: MIT
#include "app/cli/scene_output.h"

#include <algorithm>
#include <array>

#include "app/picture/picture_scale.h"
#include "app/session/progress.h"
#include "app/text/text.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

/// Settings of pictures that have a meaning in a .glb file; a page has all but samples.
constexpr std::array<std::string_view, 11> kOfSurface = {
    "view",     "colour-map", "reverse",   "range", "light",       "slice",
    "slice-at", "peel",       "path-kind", "up",    "colour-scale"};

bool has_use(const Setting& setting, SceneFormat format) {
  if (format == SceneFormat::kPage) return setting.name != "samples";
  return std::ranges::find(kOfSurface, setting.name) != kOfSurface.end();
}

}  // namespace

std::optional<SceneFormat> scene_format(const std::string& path) {
  const std::string extension = io::file_extension(path);
  if (extension == ".glb") return SceneFormat::kGlb;
  if (extension == ".html") return SceneFormat::kPage;
  return std::nullopt;
}

void note_what_has_no_place(const SettingArguments& typed, SceneFormat format, View view,
                            const PictureData& data, std::vector<Warning>& warnings) {
  std::vector<std::string> unused;
  for (const Setting& setting : settings()) {
    if (!setting.of_picture() || !typed.has(setting.name) || has_use(setting, format)) continue;
    unused.push_back(std::string(setting.name));
  }
  const bool glb = format == SceneFormat::kGlb;
  if (glb && view == View::kWireframe) unused.emplace_back("the edges of this view");
  if (glb && view == View::kSources) unused.emplace_back("the marks of this view");
  if (glb && shows_arrows(view)) unused.emplace_back("the arrows of this view");
  if (glb && data.is_field && !data.heat_directions.empty()) unused.emplace_back("its arrows");
  if (unused.empty()) return;
  warnings.push_back({(glb ? "a .glb file holds the surface, its colours and values, and paths; it "
                             "has no place for "
                           : "a page is drawn by the browser, which decides about ") +
                      joined(unused)});
}

Result<void> write_scene(Drawing& drawing, SceneFormat format, const PictureData& data,
                         const Progress& progress, Outputs& outputs, PictureFigures& figures) {
  const std::string& path = figures.paths.front();
  if (!report(progress, "writing " + path, 0)) return cancelled_error();
  Stopwatch watch;
  auto bytes = drawing.scene_file(format, data, figures.settings, picture_texts(figures, 0));
  if (!bytes) return bytes.error();
  figures.draw_ms = watch.lap();
  figures.scene_bytes = bytes->size();
  std::string nowhere;
  auto written = outputs.write_text(path, *std::move(bytes), nowhere);
  figures.write_ms = watch.lap();
  return written;
}

}  // namespace geotherm::app
