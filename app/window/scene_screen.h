// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include <memory>
#include <optional>

#include "app/picture/cut_picture.h"
#include "app/picture/drawing.h"
#include "app/session/explored.h"
#include "app/session/session.h"
#include "engine/overlay/overlay.h"
#include "engine/renderer.h"
#include "engine/target.h"
#include "engine/window/window_target.h"
#include "solver/mesh/ray_tree.h"

namespace geotherm::app {

/// Where the picture lies within the window, pixels of the window.
struct PictureArea {
  glm::ivec2 corner{0, 0}, extent{1, 1};
  float line = 0;  ///< height of a line of the panels' text; 0: letters suit the picture

  /// As large as it is here, and with letters as large as those of the panels where nothing else is
  /// said.
  PictureSettings shown(PictureSettings settings) const;

  bool operator==(const PictureArea&) const = default;
};

/// How well a frame is drawn, the best first. Devices that are no software draw all as the first.
enum class Detail {
  kFull,       ///< with the samples that the settings ask for
  kOneSample,  ///< a pixel
  kFewFaces    ///< the same, few faces for many; of a model that was seen before
};

/// Draws what a session shows, into a window and into pictures, with one renderer. Uploads what has
/// changed and nothing else. Errors: kNoDevice (also: the device was lost), kOutOfMemory.
class SceneScreen {
 public:
  /// `options.window`: where to.
  static Result<std::unique_ptr<SceneScreen>> open(engine::Window& window,
                                                   const engine::DeviceOptions& options);
  /// Draws into memory what a window of this size would show.
  static Result<std::unique_ptr<SceneScreen>> open_without_window(
      glm::ivec2 extent, const engine::DeviceOptions& options);

  /// Follows the window's size. False: nothing can be drawn into it now.
  Result<bool> follow_window();
  glm::ivec2 window_extent() const;

  Result<void> set_panel_font(const engine::PanelFont& font);

  /// Brings data and camera up to date with the session, for a picture of this size. Where the
  /// device's memory ends for the surface, the model that was there before stays; where it ends for
  /// the answer, the model is drawn without. Both are seen by the camera of now, and it is not
  /// tried again before something else is to be uploaded. Cost: what has changed since the last
  /// call.
  Result<void> update(const Session& session, const PictureArea& area);
  /// A scene that was drawn before, as well or better, is shown again. Where the device's memory
  /// ends for lines, all else is drawn, and that is the error.
  Result<void> draw(const engine::PanelDraw& panels, Detail detail);
  /// Whether the last draw() has drawn the scene and not only the panels over it.
  bool drew_scene() const { return drew_scene_; }

  /// While there is no model yet, has the device make ready the program that will draw its first
  /// picture, once: software takes a tenth of a second for it.
  Result<void> warm_up(const PictureSettings& settings);
  bool is_warm() const { return warm_; }

  /// A picture of what was brought up to date last, with other settings than those of the window.
  Result<DrawnPicture> picture(const PictureData& data, const PictureSettings& settings,
                               DrawAs as = DrawAs::kPixels);
  /// What draw() would show in a window of this size.
  Result<DrawnPicture> picture_of_window(glm::ivec2 extent, const engine::PanelDraw& panels);

  const PictureArea& area() const { return area_; }
  const engine::Camera& camera() const { return scene_.camera; }
  /// The camera of what was brought up to date last, without a centre of its own, zoomed and moved
  /// so that the model fills the picture. Cost: O(vertices).
  CameraSettings tight_camera() const;
  const PictureData& data() const { return data_; }
  /// Null where the whole model is drawn.
  const CutPicture* cut() const { return cut_ ? &*cut_ : nullptr; }
  /// What a ray in scene space meets first of what a cut leaves. Precondition: cut() is there.
  /// Cost: the first time after a change of the cut that of RayTree::build().
  std::optional<RayHit> hit_cut(const Vec3& origin, const Vec3& direction) const;
  const engine::Insets& insets() const { return insets_; }
  DrawingDevice device() const;
  std::vector<std::string> validation_messages() const;
  bool has_model() const { return base_ != nullptr; }
  /// False: the device had no memory for the surface of this model, and what is drawn is another.
  bool has_surface_of(const ExploredModel& model) const { return !refused_ || base_ == model.base; }

 private:
  SceneScreen(engine::Device device, engine::Renderer renderer);
  static Result<std::unique_ptr<SceneScreen>> prepare(const engine::DeviceOptions& options);
  struct Uploaded {
    std::uint64_t version = 0;
    Shown shown = Shown::kA;
    PictureDataSettings settings;
    bool operator==(const Uploaded&) const = default;
  };
  Result<void> update_data(const Session& session);
  Result<void> upload(const Explored& explored, const Uploaded& now);
  Result<void> update_surface(const PictureData& next, const std::vector<glm::vec3>& positions);
  Result<void> upload_data(const PictureDataSettings& settings);
  void update_legend(const PictureSettings& settings);

  // In the order of creation; the last go first.
  engine::Device device_;
  engine::Renderer renderer_;
  std::unique_ptr<engine::WindowTarget> window_target_;
  std::unique_ptr<engine::OffscreenTarget> offscreen_target_;

  // What has been uploaded.
  std::shared_ptr<const PictureData> base_;
  PictureData data_;
  std::vector<glm::vec3> positions_;
  std::optional<Uploaded> uploaded_;  ///< none: what is there is of another model, or not whole
  struct Refused {
    Uploaded what;
    Error why;
  };
  std::optional<Refused> refused_;  ///< what the device had no memory for
  std::optional<CutPicture> cut_;
  mutable std::optional<RayTree> cut_rays_;  ///< of cut_'s faces, made when a ray first asks

  std::optional<PictureSettings> laid_out_;  ///< what the legend was made for
  engine::LegendLayout legend_;
  engine::Insets insets_;
  engine::Scene scene_;
  PictureArea area_;
  int samples_ = 4;

  /// What the scene that is kept was drawn of.
  struct Seen {
    Uploaded uploaded;  ///< nothing: a model without answer
    PictureSettings settings;
    PictureArea area;
    glm::ivec2 window{0, 0};
    bool operator==(const Seen&) const = default;
  };
  std::optional<Seen> seen_, kept_;
  Detail kept_detail_ = Detail::kFull;
  bool drew_scene_ = false;
  bool warm_ = false;  ///< warm_up() was called
};

}  // namespace geotherm::app
