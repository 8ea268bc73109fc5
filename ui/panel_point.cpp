// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <cmath>

#include "app/text/text.h"
#include "ui/frame.h"
#include "ui/panels.h"
#include "ui/source_edit.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

std::string length_text(double value) {
  return std::isfinite(value) ? app::significant(value, 5) : "not reached";
}

void draw_position(Frame& frame, const Vec3& position) {
  draw_value(frame, "position",
             app::significant(position.x(), 4) + "  " + app::significant(position.y(), 4) + "  " +
                 app::significant(position.z(), 4),
             "", "x, y, z in model units.");
}

void draw_figures(Frame& frame, const SurfacePoint& point) {
  const app::PointFigures figures = app::figures_at(frame.explored(), frame.state().shown, point);
  draw_value(frame, "distance", figures.distance ? length_text(*figures.distance) : "\u2013", "",
             "Interpolated between the corners, straight to a source in the face; model units.");
  if (figures.difference) {
    draw_value(frame, "A \u2212 B", length_text(*figures.difference), "", "d_A \u2212 d_B here.");
  }
  if (figures.heat) {
    draw_value(frame, "heat u", app::significant(*figures.heat, 4), "",
               "Of the heat step, scaled so that its largest value is 1.");
  }
  draw_value(frame, "nearest vertex", number_text(figures.nearest_vertex), "",
             "Its number in the file, from 0.");
  if (!point.is_vertex()) {
    draw_value(frame, "face", number_text(point.face), "", "Its number in the file, from 0.");
    draw_value(frame, "barycentric",
               app::fixed(point.weights[0], 3) + "  " + app::fixed(point.weights[1], 3) + "  " +
                   app::fixed(point.weights[2], 3),
               "", "Weights of the face's corners.");
  }
  draw_position(frame, figures.position);
}

/// The figures of a point that a cut shows.
void draw_inside(Frame& frame, const InsidePoint& point) {
  const bool error = frame.state().picture.view == app::View::kExactError;
  const bool difference = frame.state().shown == app::Shown::kDifference;
  draw_value(frame,
             error        ? "error"
             : difference ? "A \u2212 B"
                          : "distance",
             point.value ? length_text(*point.value) : "\u2013", "",
             "On the cut, interpolated along the edges that it meets, model units.");
  draw_position(frame, point.position);
}

void draw_picked_point(Frame& frame) {
  draw_heading(frame, "Picked point");
  const auto& picked = frame.state().picked;
  const auto point =
      picked ? surface_point(*picked, frame.model()->model.mesh->face_count()) : std::nullopt;
  if (!point) return draw_dim(frame, "Ctrl+click on the model keeps the figures of a point here.");
  draw_figures(frame, *point);
  const std::string text = app::to_text(app::SourceSpec(*picked));
  const float width = button_width(3);
  if (draw_button(frame, "copy", "Copy", true, width)) ImGui::SetClipboardText(text.c_str());
  draw_tip(frame, "Copies the point as a source: " + text);
  ImGui::SameLine();
  if (draw_button(frame, "source", "Source", true, width)) {
    frame.send(app::command::SetSources{{*picked}});
  }
  draw_tip(frame, "The source is here.");
  ImGui::SameLine();
  if (draw_button(frame, "forget", "Forget", true, width)) {
    frame.send(app::command::Pick{std::nullopt});
  }
}

void draw_paths(Frame& frame) {
  if (!frame.state().target) return;
  draw_heading(frame, "Paths");
  for (const app::TargetPath& path : frame.explored().paths) {
    draw_value(frame, to_text(path.field), app::significant(path.path.length, 5), "",
               "Length from the nearest source to the target, model units.");
  }
  const auto& failure = frame.explored().path_failure;
  if (failure) draw_note(sentence(*failure), frame.colours().warning);
  if (draw_button(frame, "forget paths", "Forget paths")) {
    frame.send(app::command::Target{std::nullopt});
  }
}

}  // namespace

void draw_point_panel(Frame& frame) {
  if (!draw_section(frame, "Point")) return;
  if (!frame.model()) return draw_dim(frame, "No model is open.");
  draw_picked_point(frame);
  draw_paths(frame);
  draw_heading(frame, "Under the pointer");
  if (const auto& hovered = frame.ui.input.hovered()) {
    draw_figures(frame, *hovered);
  } else if (const auto& inside = frame.ui.input.hovered_inside()) {
    draw_inside(frame, *inside);
  } else {
    draw_dim(frame, "Point at the model.");
  }
}

}  // namespace geotherm::ui
