// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/session.h"
#include "ui/layout.h"

// The panels and the key map. Reads the session, sends commands, owns nothing but how panels lie.
// Everything comes from the current ImGui context, so that tests can play mouse and keys.
namespace geotherm::ui {

/// A point inside a model that is cut open.
struct InsidePoint {
  Vec3 position = Vec3::Zero();  ///< model units
  std::optional<double> value;   ///< of what is shown, interpolated; none: not reached
};

/// The picture behind the panels.
class Canvas {
 public:
  virtual ~Canvas() = default;
  /// The surface under a pixel of the window.
  virtual std::optional<SurfacePoint> surface_at(float x, float y) const = 0;
  /// What a cut shows of the inside under a pixel; surface_at() has nothing there.
  virtual std::optional<InsidePoint> inside_at(float /*x*/, float /*y*/) const { return {}; }
  /// Where a point (model units) is seen, pixels of the window; nothing behind the eye.
  virtual std::optional<std::array<float, 2>> place_of(const Vec3& point) const = 0;
  /// What zooming scales about, pixels of the window.
  virtual std::array<float, 2> lens_centre() const = 0;
  /// What a title takes of the upper edge of the picture, pixels of the window.
  virtual float title_height() const { return 0; }
  /// The whole model as large as there is room for, seen from the present direction; nothing where
  /// none is drawn.
  virtual std::optional<app::command::Place> tight() const { return {}; }
  virtual double fps() const = 0;  ///< of the frames drawn of late
  virtual std::vector<std::string> colour_maps() const = 0;
  virtual std::string device() const = 0;  ///< in words, with "in software" where it is so
};

/// What a frame of the panels asks for.
struct FrameOutput {
  std::vector<app::Command> commands;
  bool dragging = false;   ///< camera, sources or surface move: draw fast
  bool animating = false;  ///< the next frame is to follow at once
  bool study = false;      ///< the error over m is looked at: Session::study
  bool cancel = false;     ///< the user asked to stop what runs: Session::cancel
};

class Interface {
 public:
  /// `font`: bytes of a TrueType file that outlive this; `scale`: of everything, 2 on HiDPI.
  /// Precondition: an ImGui context is current, and has its keys. Loads the font and sets the
  /// style.
  Interface(Layout layout, std::span<const std::byte> font, float scale);
  ~Interface();

  /// Another scale of letters and panels: ImGui's font image is made anew.
  void set_scale(float scale);
  float scale() const;

  /// All panels and what mouse and keys ask for, between ImGui::NewFrame and ImGui::Render.
  /// `for_file`: as a picture keeps them, without what is said for a while.
  FrameOutput draw(const app::Session& session, const Canvas& canvas, bool for_file = false);

  /// Where the panels leave room for the picture, as of the last draw().
  Rect canvas() const;
  /// Files that were dropped on the window: the first is opened.
  void drop(const std::vector<std::string>& files);
  /// How panels lie now, to be remembered.
  const Layout& layout() const;
  /// Where an item, "Section/key", was in the last draw(); nothing where it was not drawn.
  std::optional<Rect> place_of_item(std::string_view name) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace geotherm::ui
