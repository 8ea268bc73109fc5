// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/cli/viewer_window.h"
#include "app/picture/picture_settings.h"

namespace geotherm::test {

/// Draws pictures of one colour, remembers what it was asked for and fails on request.
class FakeDrawing final : public app::Drawing {
 public:
  std::vector<std::string> calls;  ///< "open", "draw", in their order
  std::optional<app::PictureSettings> opened, drawn;
  std::optional<app::PictureData> data;

  std::vector<app::DrawingDevice> there_are = {device("Fast GPU", true), device("Slow", false)};
  std::optional<Error> no_devices, no_open;
  int frames_until_lost = -1;  ///< below 0: never

  static app::DrawingDevice device(const std::string& name, bool chosen) {
    app::DrawingDevice out;
    out.name = name;
    out.kind = chosen ? "discrete GPU" : "software";
    out.driver = "driver of " + name;
    out.api = "Vulkan 1.3.0";
    out.memory_mb = 2048;
    out.chosen = chosen;
    out.software = !chosen;
    return out;
  }

  std::vector<std::string> colour_maps() const override { return {"red-blue", "viridis"}; }

  Result<Colours> colours(const std::string&) const override {
    return Colours{{255, 0, 0}, {0, 0, 255}};
  }

  Result<std::vector<app::DrawingDevice>> devices() override {
    if (no_devices) return *no_devices;
    return there_are;
  }

  Result<app::DrawingDevice> open(const app::PictureSettings& settings) override {
    calls.emplace_back("open");
    opened = settings;
    if (no_open) return *no_open;
    return there_are.front();
  }

  Result<void> draw(const app::PictureData& what, const app::PictureSettings& settings,
                    const TakeFrame& frame, app::DrawAs) override {
    calls.emplace_back("draw");
    data = what;
    drawn = settings;
    for (int i = 0; i < app::frame_count(settings); ++i) {
      if (i == frames_until_lost) return Error{ErrorCode::kNoDevice, "the device was lost"};
      app::DrawnPicture picture{settings.width, settings.height, {}};
      picture.pixels.assign(std::size_t{4} * static_cast<std::size_t>(settings.width) *
                                static_cast<std::size_t>(settings.height),
                            255);
      if (auto taken = frame(i, picture); !taken) return taken;
    }
    return {};
  }

  Result<void> draw_cells(const std::vector<app::PictureData>& cells, int,
                          const app::PictureSettings& settings, const TakeFrame& frame,
                          app::DrawAs as) override {
    return draw(cells.front(), settings, frame, as);
  }

  Result<std::string> scene_file(app::SceneFormat format, const app::PictureData& what,
                                 const app::PictureSettings& settings,
                                 const std::vector<app::FileText>&) override {
    calls.emplace_back(format == app::SceneFormat::kGlb ? "glb" : "page");
    data = what;
    drawn = settings;
    return std::string("a scene");
  }
};

/// A window that notes what it was to begin with.
class FakeWindow final : public app::ViewerWindow {
 public:
  std::optional<app::ViewerStart> started;
  std::optional<Error> failure;

  Result<void> run(const app::ViewerStart& start) override {
    started = start;
    if (failure) return *failure;
    return {};
  }
};

}  // namespace geotherm::test
