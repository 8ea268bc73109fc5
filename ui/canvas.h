// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>

#include "app/session/command.h"
#include "app/session/explored.h"
#include "ui/interface.h"
#include "ui/key_map.h"

// The picture's side of the window: the mouse on it, its menu, and what floats over it.
namespace geotherm::ui {

struct Frame;

/// Sends what a click on a point of the surface does. Precondition: a model is shown.
void send_point_command(Frame& frame, MouseAction action, const SurfacePoint& point);

/// The same for a point inside, where it means something: sources and the centre.
void send_inside_command(Frame& frame, MouseAction action, const Vec3& position);

/// The menu of a point, at the pointer; without one it has the entries that need none.
void open_canvas_menu(Frame& frame, const std::optional<SurfacePoint>& point);
void draw_canvas_menu(Frame& frame);

/// What floats over the picture: the hint where there is no model, which of A and B is shown, and
/// the picked point.
void draw_canvas_overlay(Frame& frame);

/// Makes notices of the failures that the log has gained, and keeps for the status bar which file
/// was written.
void take_notices(Frame& frame);

/// What take_notices() and clicks have to say, for a while. `below`: what else lies at the lower
/// edge of the picture, pixels.
void draw_notices(Frame& frame, float below);

/// What the sculpting brush does on a stroke of the mouse; nothing where that is another one.
std::optional<app::SculptTool> sculpt_tool(MouseAction action, app::SculptTool chosen);

/// A stroke of the sculpting brush: touches at even steps along the way of the mouse.
class SculptStroke {
 public:
  /// False: there is no surface at the pixel.
  bool begin(Frame& frame, app::SculptTool tool, float x, float y);
  void go_on(Frame& frame, float x, float y);

 private:
  float x_ = 0, y_ = 0;  ///< of the last touch
  float step_ = 1;       ///< pixels
};

/// Pixels that a touch at this point would move; 0: none.
float sculpt_ring(const Frame& frame, const std::optional<SurfacePoint>& hovered);

/// The tools of the sculpting brush, over the picture while it is on.
void draw_sculpt_bar(Frame& frame);

/// Play, step, loop and scrub, over the picture while there is a sequence. How far that reaches up
/// from the lower edge of the picture, pixels.
float draw_timeline(Frame& frame);

/// Sends the next frame when the one that is shown has its distances and its time is over. True:
/// it is not over yet.
bool play(Frame& frame);

/// What the left button does on the picture.
enum class Tool { kView, kSource, kBrush, kPath, kPick, kSculpt };

/// The tools, and what a click of the chosen one does, above the picture.
void draw_toolbar(Frame& frame);

/// Offers the present sources back, for a while, by a button over the picture.
void offer_sources(Frame& frame, std::string text);

/// The source whose name in the list was clicked last, while it is there.
std::optional<int> chosen_entry(const Frame& frame);

/// Removes a source of the list. One that is several places can be had back by a click.
void remove_entry(Frame& frame, int entry);

/// A source as people call it: "vertex 17", "5 random".
std::string short_name(const app::SourceSpec& source);

/// The mouse on the picture: one stroke from press to release at a time.
class CanvasInput {
 public:
  /// Turns what the mouse did since the last frame into commands, and marks what it points at.
  void draw(Frame& frame);

  /// A drag goes on.
  bool is_dragging() const { return action_.has_value(); }
  /// What lies under the pointer while it is over the picture.
  const std::optional<SurfacePoint>& hovered() const { return hovered_; }
  const std::optional<InsidePoint>& hovered_inside() const { return hovered_inside_; }

  Tool tool = Tool::kSource;

  /// The number in Explored::places of what the pointer is at (hidden ones where no other is), or
  /// else of what was clicked last.
  std::optional<std::size_t> pointed(const Frame& frame) const;

  /// Before a click sets one source in place of all: where they are several, they can be had back.
  void set_source(Frame& frame);

 private:
  struct Mouse {
    float x = 0, y = 0;
  };
  void begin(Frame& frame, int button);
  void follow(Frame& frame);
  void end(Frame& frame);
  void drag(Frame& frame, Mouse from, Mouse to);
  void move_source(Frame& frame, Mouse to);
  void paint(Frame& frame, Mouse to);
  void click(Frame& frame);
  void begin_with_tool(Frame& frame);
  void give_back_sources(Frame& frame);
  void zoom_with_wheel(Frame& frame);
  void draw_marks(Frame& frame) const;
  void draw_source_marks(Frame& frame) const;

  int button_ = -1;  ///< that holds the stroke; negative: none does
  Mouse press_, last_;
  Modifiers modifiers_;  ///< at the press
  bool double_click_ = false;
  std::optional<MouseAction> action_;   ///< of the drag, once it is one
  std::optional<std::size_t> place_;    ///< of Explored::places, under the press
  std::optional<std::size_t> pointed_;  ///< of Explored::places, under the pointer
  std::optional<Vec3> chosen_;          ///< where the source is that was clicked
  int entry_ = -1;                      ///< the source that is moved
  std::optional<app::SourceSpec> moved_to_;
  SculptStroke stroke_;
  std::optional<Mouse> painted_;  ///< where the curve has its last point
  std::optional<SurfacePoint> hovered_;
  std::optional<InsidePoint> hovered_inside_;
  /// The sources before the last click set another one, for a double click.
  std::optional<std::vector<app::SourceSpec>> before_click_;
};

/// Whether the surface hides a place from the eye. Precondition: a model is shown.
bool is_hidden(const Frame& frame, const Vec3& place, std::array<float, 2> seen_at);

/// The place that a pixel shows within reach of the mouse, the nearest of them. `hidden`: also of
/// those that the surface hides.
std::optional<std::size_t> place_at(const Frame& frame, float x, float y, bool hidden = false);

}  // namespace geotherm::ui
