// SPDX-License-Identifier: MIT
// Drawing by the engine: the one place where pictures and the renderer meet.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <optional>
#include <string>

#include "app/drawing/figure_shapes.h"
#include "app/drawing/picture_camera.h"
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

/// The first of several data with what the legend has to say about all of them.
PictureData words_about(const std::vector<PictureData>& cells) {
  PictureData words = cells.front();
  for (const PictureData& cell : cells) {
    words.greatest_value = std::max(words.greatest_value, cell.greatest_value);
    words.smallest_value = std::min(words.smallest_value, cell.smallest_value);
    words.smallest_positive = std::min(words.smallest_positive, cell.smallest_positive);
    words.unreached = words.unreached || cell.unreached;
    if (&cell != &cells.front()) {
      words.lines.insert(words.lines.end(), cell.lines.begin(), cell.lines.end());
    }
  }
  return words;
}

class EngineDrawing final : public Drawing {
 public:
  std::vector<std::string> colour_maps() const override {
    std::vector<std::string> names;
    for (const engine::ColourMap& map : engine::colour_maps()) names.emplace_back(map.name);
    return names;
  }

  std::vector<std::string> missing_letters(const std::string& text) const override {
    std::vector<std::string> out;
    for (const std::string_view letter : engine::missing_letters(text)) {
      std::string_view rest = letter;
      char number[16];
      std::snprintf(number, sizeof number, " (U+%04X)",
                    static_cast<unsigned>(engine::take_letter(rest)));
      out.push_back('\'' + std::string(letter) + '\'' + number);
    }
    return out;
  }

  std::vector<std::string> left_out(const PictureData& data,
                                    const PictureSettings& settings) const override {
    const bool sized = settings.text_size || settings.paper;
    const bool labelled = !settings.bar_label.empty() || !settings.units.empty();
    if (!sized && !labelled && settings.title.empty()) return {};
    const engine::Legend legend = legend_of(data, settings, picture_scale(data, settings));
    auto parts = engine::lay_out(legend, glm::vec2(settings.width, settings.height)).left_out;
    // Small pictures for screens have no legend, and nobody asked for one, but for these words.
    std::erase_if(parts, [&](const std::string& part) {
      if (part == engine::kTitlePart) return !sized && settings.title.empty();
      return !sized && !(part == engine::kBarPart && labelled);
    });
    return parts;
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
      if (!renderer) return closed_if_lost(renderer.error());
      renderer_ = *std::move(renderer);
      samples_ = settings.samples;
    }
    return to_drawing_device(device_->info());
  }

  Result<void> draw(const PictureData& data, const PictureSettings& settings,
                    const TakeFrame& frame, DrawAs as) override {
    if (!renderer_) return Error{ErrorCode::kNoDevice, "no device has been opened to draw on"};
    const std::vector<glm::vec3> positions = scene_vectors(data.positions);
    std::optional<CutPicture> cut;
    if (is_cut(data, settings)) cut = cut_picture(data, settings);
    const PictureData& shown = cut ? cut->data : data;
    const std::vector<glm::vec3> places = cut ? scene_vectors(shown.positions) : positions;
    if (auto done = upload_picture(*renderer_, shown, settings, places); !done) {
      return closed_if_lost(done.error());
    }
    const PictureScale scale = picture_scale(data, settings);
    const glm::vec2 extent(settings.width, settings.height);
    const engine::LegendLayout layout = engine::lay_out(legend_of(data, settings, scale), extent);
    const engine::Insets insets = insets_of(settings, layout, extent);
    engine::Scene scene = scene_of(data, settings, scale);
    std::optional<FigureShapes> shapes;
    if (as == DrawAs::kFigure) {
      auto built = FigureShapes::build(shown, scene.surface);
      if (!built) return built.error();
      shapes = *std::move(built);
    }
    const std::vector<glm::vec3> framed = scene_vectors(data.framed);
    const std::vector<glm::vec3>& fitted = framed.empty() ? positions : framed;
    for (int i = 0; i < frame_count(settings); ++i) {
      scene.camera = camera_of(data, frame_camera(settings, i), fitted, extent, insets);
      std::shared_ptr<const Figure> figure;
      if (shapes) {
        figure = std::make_shared<Figure>(shapes->of(shown, settings, scene, layout.overlay));
      }
      auto image = shapes ? engine::draw_picture(*device_, *renderer_, FigureShapes::rest_of(scene))
                          : engine::draw_picture(*device_, *renderer_, scene, layout.overlay);
      if (!image) return closed_if_lost(image.error());
      const DrawnPicture picture{image->width, image->height, std::move(image->pixels),
                                 std::move(figure)};
      if (auto taken = frame(i, picture); !taken) return taken;
    }
    return {};
  }

  Result<void> draw_cells(const std::vector<PictureData>& cells, int columns,
                          const PictureSettings& settings, const TakeFrame& frame,
                          DrawAs as) override {
    if (!renderer_) return Error{ErrorCode::kNoDevice, "no device has been opened to draw on"};
    for (int i = 0; i < frame_count(settings); ++i) {
      auto picture = draw_table(cells, columns, settings, i, as);
      if (!picture) return closed_if_lost(picture.error());
      if (auto taken = frame(i, *picture); !taken) return taken;
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
  /// One frame of cells: what is written about all of them, and each in its place.
  Result<DrawnPicture> draw_table(const std::vector<PictureData>& cells, int columns,
                                  const PictureSettings& settings, int frame, DrawAs as) {
    const PictureData words = words_about(cells);
    const PictureScale scale = picture_scale(words, settings);
    const glm::vec2 extent(settings.width, settings.height);
    engine::Legend legend = legend_of(words, settings, scale);
    legend.caption.clear();
    const engine::LegendLayout layout = engine::lay_out(legend, extent);
    engine::Scene blank;
    blank.background = scene_of(words, settings, scale).background;
    blank.surface.visible = blank.markers.visible = blank.lines.visible = false;
    blank.camera = engine::make_camera({}, {}, extent);
    const bool apart = as == DrawAs::kFigure;
    auto whole = engine::draw_picture(*device_, *renderer_, blank,
                                      apart ? engine::Overlay() : layout.overlay);
    if (!whole) return whole.error();
    auto figure = std::make_shared<Figure>();
    if (apart) *figure = FigureShapes().of(words, settings, blank, layout.overlay);

    const int rows = (static_cast<int>(cells.size()) + columns - 1) / columns;
    const glm::ivec2 corner(glm::ceil(glm::vec2(layout.insets.left, layout.insets.top)));
    const glm::ivec2 free =
        glm::ivec2(extent - glm::vec2(layout.insets.right, layout.insets.bottom)) - corner;
    if (free.x < columns || free.y < rows) {
      const auto pixels = [](int x, int y) {
        return std::to_string(std::max(x, 0)) + 'x' + std::to_string(std::max(y, 0));
      };
      return Error{ErrorCode::kBadInput,
                   "a picture of " + pixels(settings.width, settings.height) + " pixels has " +
                       pixels(free.x, free.y) + " of them for " + pixels(columns, rows) + " models",
                   {"ask for a larger ", SettingHint{"size"}, ", or for another layout"}};
    }
    PictureSettings one = settings;
    one.width = free.x / columns;
    one.height = free.y / rows;
    one.bar = false;
    one.title.clear();
    const glm::vec2 room(one.width, one.height);
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const std::vector<glm::vec3> positions = scene_vectors(cells[k].positions);
      std::optional<PictureData> cut;
      if (is_cut(cells[k], one)) cut = cut_picture(cells[k], one).data;
      const PictureData& shown = cut ? *cut : cells[k];
      const auto places = cut ? scene_vectors(cut->positions) : positions;
      if (auto done = upload_picture(*renderer_, shown, one, places); !done) return done.error();
      const PictureScale own = picture_scale(cells[k], one);  // the same, without a bar
      engine::Legend label = legend_of(cells[k], one, own);
      if (label.line_height <= 0) label.line_height = engine::usual_line(extent);
      const engine::LegendLayout below = engine::lay_out(label, room);
      engine::Scene scene = scene_of(cells[k], one, own);
      scene.camera =
          camera_of(cells[k], frame_camera(settings, frame), positions, room, below.insets);
      const int column = static_cast<int>(k) % columns, row = static_cast<int>(k) / columns;
      const glm::ivec2 place = corner + glm::ivec2(column * one.width, row * one.height);
      if (apart) {
        const auto shapes = FigureShapes::build(shown, scene.surface);
        if (!shapes) return shapes.error();
        const Eigen::Vector2d from(place.x, place.y);
        figure->append(shapes->of(shown, one, scene, below.overlay),
                       {from, from + Eigen::Vector2d(one.width, one.height)});
        scene = FigureShapes::rest_of(scene);
      }
      const auto image = engine::draw_picture(*device_, *renderer_, scene,
                                              apart ? engine::Overlay() : below.overlay);
      if (!image) return image.error();
      for (int y = 0; y < image->height; ++y) {
        const auto from = image->pixels.begin() + std::ptrdiff_t{4} * y * image->width;
        const auto to =
            whole->pixels.begin() + std::ptrdiff_t{4} * ((place.y + y) * whole->width + place.x);
        std::copy_n(from, std::ptrdiff_t{4} * image->width, to);
      }
    }
    DrawnPicture picture{whole->width, whole->height, std::move(whole->pixels)};
    if (apart) picture.figure = std::move(figure);
    return picture;
  }

  void close() {
    renderer_.reset();  // before the device that it draws on
    device_.reset();
  }

  /// The same error. A device that was lost does not come back: the next picture opens one anew.
  Error closed_if_lost(const Error& error) {
    if (error.code == ErrorCode::kNoDevice) close();
    return error;
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
