// SPDX-License-Identifier: MIT
#include "app/window/scene_screen.h"

#include <cmath>
#include <utility>

#include "app/drawing/figure_shapes.h"
#include "app/drawing/picture_camera.h"
#include "app/drawing/picture_scene.h"
#include "app/session/explored.h"
#include "engine/renderer.h"

namespace geotherm::app {
namespace {

DrawnPicture to_drawn_picture(engine::Image image) {
  return {image.width, image.height, std::move(image.pixels)};
}

}  // namespace

PictureSettings PictureArea::shown(PictureSettings settings) const {
  settings.width = extent.x;
  settings.height = extent.y;
  if (line > 0 && !settings.text_size) {
    constexpr double kParts = 10;  // of a pixel
    settings.text_size = PaperLength{std::round(kParts * line / kLineOfEm) / kParts};
  }
  return settings;
}

SceneScreen::SceneScreen(engine::Device device, engine::Renderer renderer)
    : device_(std::move(device)), renderer_(std::move(renderer)) {}

Result<std::unique_ptr<SceneScreen>> SceneScreen::prepare(const engine::DeviceOptions& options) {
  auto device = engine::Device::open(options);
  if (!device) return device.error();
  auto renderer = engine::Renderer::build(*device);
  if (!renderer) return renderer.error();
  return std::unique_ptr<SceneScreen>(new SceneScreen(*std::move(device), *std::move(renderer)));
}

Result<std::unique_ptr<SceneScreen>> SceneScreen::open(engine::Window& window,
                                                       const engine::DeviceOptions& options) {
  engine::DeviceOptions for_window = options;
  for_window.window = &window;
  auto screen = prepare(for_window);
  if (!screen) return screen;
  auto target = engine::WindowTarget::build((*screen)->device_, window);
  if (!target) return target.error();
  (*screen)->window_target_ = *std::move(target);
  return screen;
}

Result<std::unique_ptr<SceneScreen>> SceneScreen::open_without_window(
    glm::ivec2 extent, const engine::DeviceOptions& options) {
  auto screen = prepare(options);
  if (!screen) return screen;
  auto target = engine::OffscreenTarget::build((*screen)->device_, extent);
  if (!target) return target.error();
  (*screen)->offscreen_target_ = *std::move(target);
  return screen;
}

Result<bool> SceneScreen::follow_window() {
  return window_target_ ? window_target_->follow_window() : Result<bool>(true);
}

glm::ivec2 SceneScreen::window_extent() const {
  return window_target_ ? window_target_->extent() : offscreen_target_->extent();
}

Result<void> SceneScreen::set_panel_font(const engine::PanelFont& font) {
  return renderer_.set_panel_font(font);
}

Result<void> SceneScreen::update_data(const Session& session) {
  const Explored& explored = session.explored();
  const ViewerState& state = session.state();
  if (!explored.model) return {};
  const Uploaded now{explored.version, state.shown, state.picture};
  if (refused_ && refused_->what == now) return refused_->why;
  refused_.reset();
  auto done = upload(explored, now);
  if (!done && done.error().code == ErrorCode::kOutOfMemory) refused_ = {now, done.error()};
  return done;
}

Result<void> SceneScreen::upload(const Explored& explored, const Uploaded& now) {
  if (base_ != explored.model->base) {
    const PictureData& next = *explored.model->base;
    std::vector<glm::vec3> positions = scene_vectors(next.positions);
    if (auto done = update_surface(next, positions); !done) return done;
    base_ = explored.model->base;
    data_ = *base_;
    cut_.reset();
    positions_ = std::move(positions);
    uploaded_.reset();
    seen_.reset();
    kept_.reset();
  }
  if (uploaded_ == now) return {};
  uploaded_.reset();
  laid_out_.reset();
  set_explored(data_, explored, now.shown, now.settings.view);
  if (auto done = upload_data(now.settings); !done) {
    data_ = *base_;  // of the answer only a part may be there: the model is drawn without
    seen_.reset();
    kept_.reset();
    return done;
  }
  uploaded_ = now;
  return {};
}

/// A surface that moves keeps its faces, one whose light has been found its places, too.
Result<void> SceneScreen::update_surface(const PictureData& next,
                                         const std::vector<glm::vec3>& positions) {
  if (!base_ || cut_ || base_->faces != next.faces) {
    return upload_surface(renderer_, next, positions);
  }
  const std::vector<engine::Openness> openness = scene_openness(next);
  return positions == positions_ ? renderer_.set_openness(openness)
                                 : renderer_.move_surface(positions, openness);
}

/// The surface stays on the device as it is, also one that is cut where the cut stays: it takes
/// milliseconds to cut, more to upload, and the most to make ready for rays.
Result<void> SceneScreen::upload_data(const PictureDataSettings& settings) {
  std::optional<CutPicture> cut;
  if (is_cut(data_, settings)) cut = cut_picture(data_, settings);
  const bool stays = cut && cut_ && cut_->data.faces == cut->data.faces &&
                     cut_->data.positions == cut->data.positions;
  if (!stays) cut_rays_.reset();
  if (!stays && (cut || cut_)) {
    auto done = cut ? upload_surface(renderer_, cut->data, scene_vectors(cut->data.positions))
                    : upload_surface(renderer_, data_, positions_);
    if (!done) return done;
  }
  cut_ = std::move(cut);  // its surface is what the device has
  return upload_answer(renderer_, cut_ ? cut_->data : data_, settings);
}

std::optional<RayHit> SceneScreen::hit_cut(const Vec3& origin, const Vec3& direction) const {
  if (!cut_rays_) {
    std::vector<Vec3> positions;
    for (const auto& [x, y, z] : cut_->data.positions) positions.emplace_back(x, y, z);
    std::vector<Face> faces;
    for (const auto& [a, b, c] : cut_->data.faces) {
      faces.push_back({static_cast<Index>(a), static_cast<Index>(b), static_cast<Index>(c)});
    }
    auto mesh = TriangleMesh::build(std::move(positions), std::move(faces));
    if (!mesh) return std::nullopt;  // nothing is left
    auto rays = RayTree::build(std::make_shared<const TriangleMesh>(*std::move(mesh)));
    if (!rays) return std::nullopt;
    cut_rays_ = *std::move(rays);
  }
  return cut_rays_->first_hit(origin, direction);
}

/// Letters cost milliseconds: what does not change is not laid out again.
void SceneScreen::update_legend(const PictureSettings& settings) {
  PictureSettings but_camera = settings;
  but_camera.camera = {};
  if (laid_out_ == but_camera) return;
  const PictureScale scale = picture_scale(data_, settings);
  legend_ = engine::lay_out(legend_of(data_, settings, scale), area_.extent);
  insets_ = insets_of(settings, legend_, area_.extent);
  laid_out_ = std::move(but_camera);
}

CameraSettings SceneScreen::tight_camera() const {
  const CameraSettings camera = seen_ ? seen_->settings.camera : CameraSettings();
  return app::tight_camera(data_, camera, positions_, area_.extent, insets_);
}

Result<void> SceneScreen::update(const Session& session, const PictureArea& area) {
  area_ = area;
  const auto done = update_data(session);
  if (!done && !refused_) return done;
  PictureSettings settings = area.shown(session.state().picture);
  if (!done && uploaded_) {  // what is there is laid out as what it was uploaded for
    PictureDataSettings& of_data = settings;
    of_data = uploaded_->settings;
  }
  samples_ = settings.samples;
  Seen now{uploaded_.value_or(Uploaded()), settings, area, window_extent()};
  if (seen_ == now) return done;
  seen_ = std::move(now);
  update_legend(settings);
  scene_ = scene_of(data_, settings, picture_scale(data_, settings));
  scene_.surface.visible = has_model();
  if (!uploaded_) {  // what lies on the surface may be of an earlier answer
    scene_.lines.visible = scene_.markers.visible = false;
    scene_.arrows.primary = scene_.arrows.secondary = false;
  }
  scene_.camera = camera_of(data_, settings.camera, positions_, area.extent, insets_);
  if (!has_model()) legend_ = {};
  return done;
}

Result<void> SceneScreen::draw(const engine::PanelDraw& panels, Detail detail) {
  if (!device_.info().software) detail = Detail::kFull;
  if (detail == Detail::kFewFaces && !kept_) detail = Detail::kOneSample;
  renderer_.set_samples(detail == Detail::kFull ? samples_ : 1);
  renderer_.set_coarse(detail == Detail::kFewFaces);
  drew_scene_ = !(kept_ && kept_ == seen_ && kept_detail_ <= detail);
  const engine::SceneUse use = drew_scene_ ? engine::SceneUse::kKeep : engine::SceneUse::kAgain;
  engine::Target* target = window_target_.get();
  if (window_target_) {
    window_target_->set_picture_corner(area_.corner);
  } else {
    offscreen_target_->set_origin(-area_.corner);
    target = offscreen_target_.get();
  }
  if (drew_scene_) kept_.reset();
  auto drawn = renderer_.render(*target, scene_, legend_.overlay, &panels, use);
  if (!drawn && drawn.error().code == ErrorCode::kOutOfMemory) {
    engine::Scene rest = scene_;  // with the panels, where the error is said
    rest.lines.visible = false;
    [[maybe_unused]] const auto again =
        renderer_.render(*target, rest, legend_.overlay, &panels, use);
  }
  if (drawn && drew_scene_) {
    kept_ = seen_;
    kept_detail_ = detail;
  }
  return drawn;
}

Result<void> SceneScreen::warm_up(const PictureSettings& settings) {
  if (std::exchange(warm_, true) || has_model()) return {};
  if (!window_target_ || !device_.info().software) return {};
  PictureData point;  // a face of which nothing is seen
  point.positions.resize(3);
  point.faces = {{0, 1, 2}};
  const auto positions = scene_vectors(point.positions);
  if (auto done = upload_surface(renderer_, point, positions); !done) return done;
  engine::Scene scene = scene_of(point, settings, picture_scale(point, settings));
  scene.camera = scene_.camera;
  renderer_.set_samples(1);
  return renderer_.render(*window_target_, scene);
}

Result<DrawnPicture> SceneScreen::picture(const PictureData& data, const PictureSettings& settings,
                                          DrawAs as) {
  renderer_.set_samples(settings.samples);
  renderer_.set_coarse(false);
  const PictureScale scale = picture_scale(data, settings);
  const glm::vec2 extent(settings.width, settings.height);
  const engine::LegendLayout legend = engine::lay_out(legend_of(data, settings, scale), extent);
  engine::Scene scene = scene_of(data, settings, scale);
  scene.camera =
      camera_of(data, settings.camera, positions_, extent, insets_of(settings, legend, extent));
  if (as == DrawAs::kPixels) {
    auto image = engine::draw_picture(device_, renderer_, scene, legend.overlay);
    if (!image) return image.error();
    return to_drawn_picture(*std::move(image));
  }
  const PictureData& shown = cut_ ? cut_->data : data;
  const auto shapes = FigureShapes::build(shown, scene.surface);
  if (!shapes) return shapes.error();
  auto rest = engine::draw_picture(device_, renderer_, FigureShapes::rest_of(scene));
  if (!rest) return rest.error();
  DrawnPicture picture = to_drawn_picture(*std::move(rest));
  picture.figure = std::make_shared<Figure>(shapes->of(shown, settings, scene, legend.overlay));
  return picture;
}

Result<DrawnPicture> SceneScreen::picture_of_window(glm::ivec2 extent,
                                                    const engine::PanelDraw& panels) {
  auto target = engine::OffscreenTarget::build(device_, extent);
  if (!target) return target.error();
  (*target)->set_origin(-area_.corner);
  renderer_.set_samples(samples_);
  renderer_.set_coarse(false);
  const auto drawn = renderer_.render(**target, scene_, legend_.overlay, &panels);
  if (!drawn) return drawn.error();
  engine::Image image;
  image.width = extent.x;
  image.height = extent.y;
  image.pixels.resize(4 * static_cast<std::size_t>(extent.x) * static_cast<std::size_t>(extent.y));
  (*target)->read(image, {0, 0}, extent);
  return to_drawn_picture(std::move(image));
}

DrawingDevice SceneScreen::device() const { return to_drawing_device(device_.info()); }

std::vector<std::string> SceneScreen::validation_messages() const {
  return device_.validation_messages();
}

}  // namespace geotherm::app
