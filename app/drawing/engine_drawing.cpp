// SPDX-License-Identifier: MIT
// Drawing by the engine: the one place where pictures and the renderer meet.
#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <string>

#include "app/drawing/picture_scene.h"
#include "app/drawing/scene_files.h"
#include "app/picture/cut_picture.h"
#include "app/picture/drawing.h"
#include "app/picture/picture_settings.h"
#include "app/text/text.h"
#include "engine/device.h"
#include "engine/renderer.h"
#include "solver/core/memory.h"

namespace geotherm::app {
namespace {

/// Drivers end the process where their memory ends. What they take is address space above all: the
/// software device compiles its shaders, on threads of its own.
Result<void> check_address_space() {
  constexpr std::int64_t kMegabyte = 1 << 20, kNeeded = 1200 * kMegabyte;
  const std::optional<std::int64_t> left = free_address_space();
  if (!left || *left >= kNeeded) return {};
  return Error{ErrorCode::kOutOfMemory,
               "drawing needs " + std::to_string(kNeeded / kMegabyte) +
                   " MB of address space, and this process may take only " +
                   std::to_string(std::max<std::int64_t>(*left, 0) / kMegabyte) + " MB more",
               {"raise its limit (ulimit -v)"}};
}

class EngineDrawing final : public Drawing {
 public:
  std::vector<std::string> colour_maps() const override {
    std::vector<std::string> names;
    for (const engine::ColourMap& map : engine::colour_maps()) names.emplace_back(map.name);
    return names;
  }

  Result<Colours> colours(const std::string& name) const override {
    const engine::ColourMap* map = engine::find_colour_map(name);
    if (map == nullptr) {
      return Error{ErrorCode::kNotAvailable,
                   "there is no colour map '" + one_line(name) + "'",
                   {"there are " + joined(colour_maps())}};
    }
    Colours bytes;
    for (const glm::vec4& colour : engine::colour_table(*map)) {
      const auto byte = [](float x) { return static_cast<std::uint8_t>(std::lround(x * 255.0F)); };
      bytes.push_back({byte(colour.r), byte(colour.g), byte(colour.b)});
    }
    return bytes;
  }

  Result<std::vector<DrawingDevice>> devices() override {
    if (auto room = check_address_space(); !room) return room.error();
    const auto found = engine::list_devices();
    if (!found) return found.error();
    std::vector<DrawingDevice> out;
    for (const engine::DeviceInfo& info : *found) out.push_back(to_drawing_device(info));
    return out;
  }

  Result<DrawingDevice> open(const PictureSettings& settings) override {
    // Two devices at once would take twice the address space.
    if (!device_ || device_name_ != settings.device) {
      if (auto opened = open_device(settings.device); !opened) return opened.error();
    }
    if (!renderer_ || samples_ != settings.samples) {
      renderer_.reset();
      auto renderer = engine::Renderer::build(*device_, settings.samples);
      if (!renderer) return renderer.error();
      renderer_ = *std::move(renderer);
      samples_ = settings.samples;
    }
    return to_drawing_device(device_->info());
  }

  Result<void> draw(const PictureData& data, const PictureSettings& settings,
                    const TakeFrame& frame) override {
    if (!renderer_) return Error{ErrorCode::kNoDevice, "no device has been opened to draw on"};
    const std::vector<glm::vec3> positions = scene_vectors(data.positions);
    if (is_cut(data, settings)) {
      const PictureData cut = cut_picture(data, settings).data;
      const std::vector<glm::vec3> places = scene_vectors(cut.positions);
      if (auto done = upload_picture(*renderer_, cut, settings, places); !done) return done;
    } else if (auto done = upload_picture(*renderer_, data, settings, positions); !done) {
      return done;
    }
    const PictureScale scale = picture_scale(data, settings);
    const glm::vec2 extent(settings.width, settings.height);
    const engine::LegendLayout layout = engine::lay_out(legend_of(data, settings, scale), extent);
    engine::Scene scene = scene_of(data, settings, scale);
    const std::vector<glm::vec3> framed = scene_vectors(data.framed);
    const std::vector<glm::vec3>& fitted = framed.empty() ? positions : framed;
    for (int i = 0; i < frame_count(settings); ++i) {
      scene.camera = camera_of(data, frame_camera(settings, i), fitted, extent, layout.insets);
      auto image = engine::draw_picture(*device_, *renderer_, scene, layout.overlay);
      if (!image) {
        if (image.error().code == ErrorCode::kNoDevice) close();  // lost: the next is another one
        return image.error();
      }
      const DrawnPicture picture{image->width, image->height, std::move(image->pixels)};
      if (auto taken = frame(i, picture); !taken) return taken;
    }
    return {};
  }

  Result<std::string> scene_file(SceneFormat format, const PictureData& data,
                                 const PictureSettings& settings,
                                 const std::vector<FileText>& texts) override {
    std::optional<PictureData> cut;
    if (is_cut(data, settings)) cut = cut_picture(data, settings).data;
    const PictureData& shown = cut ? *cut : data;
    try {
      return format == SceneFormat::kGlb ? glb_file(shown, data, settings, texts)
                                         : page_file(shown, data, settings, texts);
    } catch (const std::bad_alloc&) {
      return Error{ErrorCode::kOutOfMemory,
                   "not enough memory to write " + std::to_string(data.faces.size()) + " faces"};
    }
  }

 private:
  void close() {
    renderer_.reset();  // before the device that it draws on
    device_.reset();
  }

  Result<void> open_device(const std::string& name) {
    close();
    if (auto room = check_address_space(); !room) return room;
    engine::DeviceOptions options;
    options.name = name;
    auto device = engine::Device::open(options);
    if (!device) return device.error();
    device_ = *std::move(device);
    device_name_ = name;
    return {};
  }

  std::string device_name_;  ///< as it was asked for
  int samples_ = 0;
  // In the order of creation; the renderer goes before the device.
  std::optional<engine::Device> device_;
  std::optional<engine::Renderer> renderer_;
};

}  // namespace

std::unique_ptr<Drawing> make_drawing() { return std::make_unique<EngineDrawing>(); }

}  // namespace geotherm::app
