// SPDX-License-Identifier: MIT
#include "ui/canvas.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "ui/frame.h"
#include "ui/source_edit.h"

namespace geotherm::ui {
namespace {

constexpr float kStill = 4;             ///< pixels at scale 1 within which a press is a click
constexpr float kReach = 9;             ///< pixels at scale 1 from the middle of a source
constexpr float kBrushStep = 5;         ///< pixels at scale 1 between points of a curve
constexpr double kTurnPerHeight = 220;  ///< degrees for a drag across the picture
constexpr double kZoomPerHeight = 3.5;  ///< logarithm of the zoom for a drag across it
constexpr double kZoomPerNotch = 1.15;
constexpr std::size_t kMaxPlaces = 20000;  ///< of more, none can be aimed at
constexpr int kMaxRings = 300;             ///< about sources; more cover each other and the model
constexpr double kOffersUndo = 12;         ///< seconds
constexpr double kHidden = 0.02;  ///< of the model's size: a place that far behind is not seen

constexpr const char* kButtons[] = {"Left", "Right", "Middle"};

double canvas_height(const Frame& frame) { return std::max(1.0F, frame.ui.places.canvas.height); }

bool is_over_canvas(const Frame& frame) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const Rect& canvas = frame.ui.places.canvas;
  return !ImGui::GetIO().WantCaptureMouse && mouse.x >= canvas.x && mouse.y >= canvas.y &&
         mouse.x < canvas.x + canvas.width && mouse.y < canvas.y + canvas.height;
}

/// The surface under a pixel, on the model that is shown; nothing before it is described.
std::optional<SurfacePoint> surface_at(const Frame& frame, float x, float y) {
  const MeshReport* const mesh = frame.mesh();
  if (!mesh) return std::nullopt;
  auto point = frame.canvas.surface_at(x, y);
  // The picture may be one frame behind.
  const bool fits = point && (point->is_vertex() ? point->vertex < mesh->vertices
                                                 : point->face >= 0 && point->face < mesh->faces);
  return fits ? point : std::nullopt;
}

/// With as many digits as a pixel can mean: sources inside are named by where they are.
Vec3 rounded(const Vec3& position, const Vec3& size) {
  constexpr double kDigits = 6;
  const double tens = std::pow(10, kDigits - std::floor(std::log10(size.maxCoeff())));
  if (!std::isnormal(tens)) return position;
  return (position * tens).array().round() / tens + 0.0;  // no -0
}

std::optional<InsidePoint> inside_at(const Frame& frame, float x, float y) {
  const MeshReport* const mesh = frame.mesh();
  if (!mesh) return std::nullopt;
  auto inside = frame.canvas.inside_at(x, y);
  if (inside) inside->position = rounded(inside->position, mesh->box_max - mesh->box_min);
  return inside;
}

/// What is in front under a pixel: where it is, model units, and how it is called as a source.
struct Front {
  Vec3 position;
  app::SourceSpec source;
};
std::optional<Front> front_at(const Frame& frame, float x, float y) {
  if (const auto point = surface_at(frame, x, y)) {
    return Front{position_at(*frame.model()->model.mesh, *point), source_at(*point)};
  }
  const auto inside = inside_at(frame, x, y);
  if (!inside) return std::nullopt;
  return Front{inside->position, app::SpacePoint{inside->position}};
}

}  // namespace

bool is_hidden(const Frame& frame, const Vec3& place, std::array<float, 2> seen_at) {
  const auto front = front_at(frame, seen_at[0], seen_at[1]);
  if (!front) return false;
  const Vec3 size = frame.mesh()->box_max - frame.mesh()->box_min;
  return (front->position - place).norm() > kHidden * size.norm();
}

std::optional<std::size_t> place_at(const Frame& frame, float x, float y, bool hidden) {
  if (!frame.model() || frame.explored().places.size() > kMaxPlaces) return std::nullopt;
  std::optional<std::size_t> nearest;
  float least = frame.px(kReach);
  const auto& places = frame.explored().places;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!is_movable(frame.explored(), places[i])) continue;
    const auto seen = frame.canvas.place_of(places[i].position);
    if (!seen) continue;
    const float distance = std::hypot((*seen)[0] - x, (*seen)[1] - y);
    if (distance > least || (!hidden && is_hidden(frame, places[i].position, *seen))) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

void CanvasInput::draw(Frame& frame) {
  const ImGuiIO& io = ImGui::GetIO();
  hovered_.reset();
  hovered_inside_.reset();
  const bool over = is_over_canvas(frame);
  if (over && button_ < 0) {
    for (int button = 0; button < 3 && button_ < 0; ++button) {
      if (io.MouseClicked[button]) begin(frame, button);
    }
  }
  if (button_ >= 0) follow(frame);
  if (button_ >= 0 && !io.MouseDown[button_]) end(frame);
  if (over && io.MouseWheel != 0) zoom_with_wheel(frame);
  if (over) hovered_ = surface_at(frame, io.MousePos.x, io.MousePos.y);
  if (over && !hovered_) hovered_inside_ = inside_at(frame, io.MousePos.x, io.MousePos.y);
  pointed_.reset();
  if (over && !action_ && button_ < 0) {
    pointed_ = place_at(frame, io.MousePos.x, io.MousePos.y);
    if (!pointed_) pointed_ = place_at(frame, io.MousePos.x, io.MousePos.y, true);
  }
  draw_source_marks(frame);
  if (over || action_) draw_marks(frame);
}

std::optional<std::size_t> CanvasInput::pointed(const Frame& frame) const {
  if (pointed_ || !chosen_) return pointed_;
  const auto& places = frame.explored().places;
  const auto at = std::ranges::find(places, *chosen_, &app::SourcePlace::position);
  if (at == places.end()) return std::nullopt;
  return static_cast<std::size_t>(at - places.begin());
}

void CanvasInput::begin(Frame& frame, int button) {
  const ImGuiIO& io = ImGui::GetIO();
  button_ = button;
  press_ = last_ = {io.MousePos.x, io.MousePos.y};
  modifiers_ = {io.KeyCtrl, io.KeyShift, io.KeyAlt};
  double_click_ = io.MouseDoubleClicked[button];
  action_.reset();
  moved_to_.reset();
  painted_.reset();
  entry_ = -1;
  const bool plain = !modifiers_.ctrl && !modifiers_.shift && !modifiers_.alt;
  // Places belong to what is shown; while other sources are on their way, they cannot be taken.
  const bool settled = frame.explored().sources == frame.state().sources;
  place_.reset();
  if (button == 0 && plain && tool == Tool::kSource && settled) {
    place_ = place_at(frame, press_.x, press_.y);
  }
  if (button == 0) begin_with_tool(frame);
}

/// At once: a touch of the brush is a source, too.
void CanvasInput::begin_with_tool(Frame& frame) {
  if (tool == Tool::kBrush) {
    action_ = mouse_action(modifiers_, "Left drag with the brush");
    if (!action_) return;
    paint(frame, press_);
    if (!painted_) action_.reset();
  } else if (tool == Tool::kSculpt) {
    action_ = mouse_action(modifiers_, "Left drag while sculpting");
    const auto touch = action_ ? sculpt_tool(*action_, frame.ui.sculpt.tool) : std::nullopt;
    if (!touch || !stroke_.begin(frame, *touch, press_.x, press_.y)) action_.reset();
  }
}

void CanvasInput::follow(Frame& frame) {
  const ImGuiIO& io = ImGui::GetIO();
  const Mouse now{io.MousePos.x, io.MousePos.y};
  if (!ImGui::IsMousePosValid(&io.MousePos)) return;
  if (!action_) {
    if (std::hypot(now.x - press_.x, now.y - press_.y) <= frame.px(kStill)) return;
    if (place_) action_ = mouse_action(modifiers_, "Left drag of a source");
    if (!action_) action_ = mouse_action(modifiers_, std::string(kButtons[button_]) + " drag");
    if (!action_) return;
  }
  if (now.x == last_.x && now.y == last_.y) return;
  drag(frame, last_, now);
  last_ = now;
}

void CanvasInput::drag(Frame& frame, Mouse from, Mouse to) {
  const double right = (to.x - from.x) / canvas_height(frame);
  const double up = (from.y - to.y) / canvas_height(frame);
  switch (*action_) {
    case MouseAction::kOrbit:  // what is grabbed follows the hand: the eye goes the other way
      return frame.send(app::command::Orbit{-right * kTurnPerHeight, -up * kTurnPerHeight});
    case MouseAction::kZoom:
      return frame.send(app::command::Zoom{std::exp(up * kZoomPerHeight), 0, 0});
    case MouseAction::kPan:
      return frame.send(app::command::Pan{right, up});
    case MouseAction::kMoveSource:
      return move_source(frame, to);
    case MouseAction::kPaint:
      return paint(frame, to);
    case MouseAction::kSculpt:
    case MouseAction::kSculptBack:
    case MouseAction::kSculptSmooth:
      return stroke_.go_on(frame, to.x, to.y);
    default:
      return;
  }
}

void CanvasInput::move_source(Frame& frame, Mouse to) {
  auto front = front_at(frame, to.x, to.y);
  if (!front) return;  // it waits where it was until the pointer is back
  if (entry_ < 0) {
    const app::Explored& explored = frame.explored();
    if (*place_ >= explored.places.size()) return;
    entry_ = explored.places[*place_].entry;
    if (!explored.places[*place_].alone) {
      Apart apart = taken_apart(explored, *place_);
      entry_ = apart.entry;
      frame.send(app::command::SetSources{std::move(apart.sources)});
    }
  }
  if (front->source == moved_to_) return;
  moved_to_ = front->source;
  frame.send(app::command::MoveSource{entry_, std::move(front->source)});
}

/// Points at even steps along the way of the mouse: between pixels that follow each other at once a
/// line would be as ragged as they are.
void CanvasInput::paint(Frame& frame, Mouse to) {
  if (!painted_) {
    const auto point = surface_at(frame, to.x, to.y);
    if (!point || point->is_vertex()) return;
    painted_ = to;
    return frame.send(app::command::AddSources{{app::SurfaceCurve{{short_point(*point)}}}});
  }
  const float step = frame.px(kBrushStep);
  app::command::ExtendCurve more;
  for (float left = std::hypot(to.x - painted_->x, to.y - painted_->y); left >= step;
       left -= step) {
    painted_->x += (to.x - painted_->x) * step / left;
    painted_->y += (to.y - painted_->y) * step / left;
    const auto point = surface_at(frame, painted_->x, painted_->y);
    if (point && !point->is_vertex()) more.points.push_back(short_point(*point));
  }
  if (!more.points.empty()) frame.send(std::move(more));
}

void CanvasInput::end(Frame& frame) {
  if (!action_) click(frame);
  button_ = -1;
  action_.reset();
  place_.reset();
}

void CanvasInput::click(Frame& frame) {
  const std::string button = kButtons[button_];
  auto action = mouse_action(modifiers_, button + " click");
  if (tool == Tool::kPath || tool == Tool::kPick || tool == Tool::kView) {
    const char* const with = tool == Tool::kPath   ? " click with the path tool"
                             : tool == Tool::kPick ? " click with the pick tool"
                                                   : " click with the view tool";
    if (action == MouseAction::kSetSource) action = mouse_action(modifiers_, button + with);
  }
  if (double_click_) {
    if (const auto twice = mouse_action(modifiers_, button + " double click")) action = twice;
  }
  if (!action || !frame.model()) return;
  const auto point = surface_at(frame, press_.x, press_.y);
  if (*action == MouseAction::kMenu) return open_canvas_menu(frame, point);
  const auto front = front_at(frame, press_.x, press_.y);
  if (!front) return;
  if (*action == MouseAction::kCentre) give_back_sources(frame);
  before_click_.reset();
  if (*action == MouseAction::kSetSource && place_) {
    const std::vector<app::SourcePlace>& places = frame.explored().places;
    if (*place_ < places.size()) chosen_ = places[*place_].position;  // else it went since
    return;
  }
  if (*action == MouseAction::kSetSource) set_source(frame);
  if (point) return send_point_command(frame, *action, *point);
  send_inside_command(frame, *action, front->position);
}

void offer_sources(Frame& frame, std::string text) {
  Notice notice;
  notice.text = std::move(text);
  notice.kind = app::LogLine::Kind::kNote;
  notice.until = ImGui::GetTime() + kOffersUndo;
  notice.sources = frame.state().sources;
  std::erase_if(frame.ui.notices, [](const Notice& old) { return !old.sources.empty(); });
  frame.ui.notices.push_back(std::move(notice));
}

void CanvasInput::set_source(Frame& frame) {
  before_click_ = frame.state().sources;
  chosen_.reset();
  const std::size_t count = std::max(before_click_->size(), frame.explored().places.size());
  if (count < 2) return;
  offer_sources(frame, "The click has replaced " + std::to_string(count) +
                           " sources. With Shift it adds one to them.");
}

/// The first click of a double click has set a source that nobody wanted.
void CanvasInput::give_back_sources(Frame& frame) {
  if (!before_click_ || *before_click_ == frame.state().sources) return;
  std::erase_if(frame.ui.notices, [](const Notice& old) { return !old.sources.empty(); });
  if (before_click_->empty()) {
    frame.send(app::command::ClearSources{});
  } else {
    frame.send(app::command::SetSources{*before_click_});
  }
}

void CanvasInput::zoom_with_wheel(Frame& frame) {
  const ImGuiIO& io = ImGui::GetIO();
  if (mouse_action({io.KeyCtrl, io.KeyShift, io.KeyAlt}, "Wheel") != MouseAction::kWheelZoom)
    return;
  const auto centre = frame.canvas.lens_centre();
  frame.send(app::command::Zoom{std::pow(kZoomPerNotch, io.MouseWheel),
                                (io.MousePos.x - centre[0]) / canvas_height(frame),
                                (centre[1] - io.MousePos.y) / canvas_height(frame)});
}

void CanvasInput::draw_marks(Frame& frame) const {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const ImU32 accent = packed(frame.colours().accent);
  const ImU32 shade = packed({0, 0, 0, 0.5F});
  const auto ring = [&](ImVec2 at, float radius) {
    list->AddCircle(at, frame.px(radius), shade, 0, frame.px(3.5F));
    list->AddCircle(at, frame.px(radius), accent, 0, frame.px(1.8F));
  };
  if (tool == Tool::kBrush) return ring(mouse, 6);
  if (tool == Tool::kSculpt && (button_ < 0 || action_)) {
    return ring(mouse, std::max(3.0F, sculpt_ring(frame, hovered_) / frame.px(1)));
  }
  if (action_ || button_ >= 0 || !pointed_) return;
  ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
}

/// Rings about the source that is pointed at, and about those whose name in the list is.
void CanvasInput::draw_source_marks(Frame& frame) const {
  if (!frame.model() || frame.explored().places.size() > kMaxPlaces) return;
  const auto pointed_at = pointed(frame);
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const auto& places = frame.explored().places;
  std::optional<std::array<float, 2>> last;  // of a curve, one beside the other is enough
  int rings = 0;
  for (std::size_t i = 0; i < places.size() && rings < kMaxRings; ++i) {
    if (i != pointed_at && places[i].entry != frame.ui.sources.pointed) continue;
    const auto seen = frame.canvas.place_of(places[i].position);
    if (!seen) continue;
    const ImVec2 at((*seen)[0], (*seen)[1]);
    if (last && std::hypot(at.x - (*last)[0], at.y - (*last)[1]) < frame.px(2 * kReach)) continue;
    last = seen;
    ++rings;
    list->AddCircle(at, frame.px(kReach), packed({0, 0, 0, 0.5F}), 0, frame.px(3.5F));
    list->AddCircle(at, frame.px(kReach), packed(frame.colours().accent), 0, frame.px(1.8F));
  }
}

}  // namespace geotherm::ui
