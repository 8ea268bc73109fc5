// SPDX-License-Identifier: MIT
// In builds without the engine, instead of engine_drawing.cpp.
#include "app/picture/drawing.h"

namespace geotherm::app {
namespace {

Error no_renderer() {
  return {ErrorCode::kNoDevice,
          "this build has no renderer",
          {"configure it with -DGEOTHERM_BUILD_ENGINE=ON"}};
}

class NoDrawing final : public Drawing {
 public:
  std::vector<std::string> colour_maps() const override { return {"red-blue"}; }
  Result<Colours> colours(const std::string&) const override { return no_renderer(); }
  Result<std::vector<DrawingDevice>> devices() override { return no_renderer(); }
  Result<DrawingDevice> open(const PictureSettings&) override { return no_renderer(); }
  Result<void> draw(const PictureData&, const PictureSettings&, const TakeFrame&, DrawAs) override {
    return no_renderer();
  }
  Result<void> draw_cells(const std::vector<PictureData>&, int, const PictureSettings&,
                          const TakeFrame&, DrawAs) override {
    return no_renderer();
  }
  Result<std::string> scene_file(SceneFormat, const PictureData&, const PictureSettings&,
                                 const std::vector<FileText>&) override {
    return no_renderer();
  }
};

}  // namespace

std::unique_ptr<Drawing> make_drawing() { return std::make_unique<NoDrawing>(); }

}  // namespace geotherm::app
