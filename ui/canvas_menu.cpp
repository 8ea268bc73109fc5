// SPDX-License-Identifier: MIT
#include "ui/canvas.h"

#include <imgui.h>

#include "ui/frame.h"
#include "ui/panels.h"
#include "ui/source_edit.h"

namespace geotherm::ui {
namespace {

constexpr const char* kMenu = "point menu";

/// An entry that stands for a stroke of the mouse.
void draw_stroke(Frame& frame, const char* label, MouseAction action) {
  const bool possible = frame.ui.menu_point.has_value() &&
                        (action != MouseAction::kRemoveSource || !frame.explored().places.empty());
  std::string stroke;
  for (const MouseBinding& binding : mouse_bindings()) {
    if (binding.action == action) stroke = binding.stroke;
  }
  if (ImGui::MenuItem(label, stroke.c_str(), false, possible)) {
    if (action == MouseAction::kSetSource) frame.ui.input.set_source(frame);
    send_point_command(frame, action, *frame.ui.menu_point);
  }
  frame.mark(label);
}

}  // namespace

void send_point_command(Frame& frame, MouseAction action, const SurfacePoint& point) {
  const TriangleMesh& mesh = *frame.model()->model.mesh;
  switch (action) {
    case MouseAction::kSetSource:
      return frame.send(app::command::SetSources{{source_at(point)}});
    case MouseAction::kAddSource:
      return frame.send(app::command::AddSources{{source_at(point)}});
    case MouseAction::kPick:
      if (point.is_vertex()) return;  // the pointer is always on a face
      return frame.send(app::command::Pick{app::FacePoint{point.face, point.weights}});
    case MouseAction::kTarget:
      return frame.send(app::command::Target{source_at(point)});
    default:
      return send_inside_command(frame, action, position_at(mesh, point));
  }
}

void send_inside_command(Frame& frame, MouseAction action, const Vec3& position) {
  const app::SourceSpec source = app::SpacePoint{position};
  switch (action) {
    case MouseAction::kSetSource:
      return frame.send(app::command::SetSources{{source}});
    case MouseAction::kAddSource:
      return frame.send(app::command::AddSources{{source}});
    case MouseAction::kRemoveSource:
      // Places belong to what is shown: while other sources are on their way, none can be named.
      if (frame.explored().sources != frame.state().sources) return;
      if (const auto place = nearest_place(frame.explored(), position)) {
        frame.send(removal(frame.explored(), *place));
      }
      return;
    case MouseAction::kCentre:
      return frame.send(app::command::Centre{position.x(), position.y(), position.z()});
    default:
      return;
  }
}

void open_canvas_menu(Frame& frame, const std::optional<SurfacePoint>& point) {
  frame.ui.menu_point = point;
  frame.ui.menu_mesh = frame.model()->model.mesh;
  frame.ui.ask_menu = true;
}

void draw_canvas_menu(Frame& frame) {
  frame.section = "point menu";
  if (frame.ui.ask_menu) ImGui::OpenPopup(kMenu);
  frame.ui.ask_menu = false;
  if (!ImGui::BeginPopup(kMenu)) return frame.ui.menu_mesh.reset();
  // A model may have been opened since: its faces are others. One that moves keeps them.
  const bool same = frame.model() &&
                    frame.ui.menu_mesh->faces().data() == frame.model()->model.mesh->faces().data();
  if (!same) frame.ui.menu_point.reset();
  draw_stroke(frame, "Source here", MouseAction::kSetSource);
  draw_stroke(frame, "Add a source here", MouseAction::kAddSource);
  draw_stroke(frame, "Remove the nearest source", MouseAction::kRemoveSource);
  ImGui::Separator();
  draw_stroke(frame, "Show figures here", MouseAction::kPick);
  draw_stroke(frame, "Paths from here", MouseAction::kTarget);
  draw_stroke(frame, "Turn about this point", MouseAction::kCentre);
  ImGui::Separator();
  draw_menu_action(frame, "Whole model", Action::kFrame);
  draw_menu_action(frame, "Rotate", Action::kRotate);
  draw_menu_action(frame, "Brush", Action::kBrush);
  draw_menu_action(frame, "Sculpt", Action::kSculpt);
  draw_menu_action(frame, "Clear sources", Action::kClearSources);
  ImGui::EndPopup();
}

}  // namespace geotherm::ui
