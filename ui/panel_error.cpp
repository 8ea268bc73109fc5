// SPDX-License-Identifier: MIT
#include <imgui.h>

#include "app/answer_check.h"
#include "app/text.h"
#include "app/told.h"
#include "ui/action.h"
#include "ui/error_plot.h"
#include "ui/panels.h"
#include "ui/setting_rows.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

void draw_figures(Frame& frame, const AccuracyReport& report) {
  if (!report.measured) return draw_note(app::told(report), frame.colours().dim);
  const DistanceError& e = report.figures;
  draw_value(frame, "against", to_text(report.reference), "",
             "The more accurate method; solved once for these sources.");
  draw_value(frame, "mean error", app::percent(e.mean_relative), "",
             "Mean of |d \u2212 d_exact| / d_exact over the vertices.");
  draw_value(frame, "largest error", app::percent(e.max_of_range), "",
             "Largest |d \u2212 d_exact|, as a share of the largest distance.");
  draw_value(frame, "bias", app::significant(e.mean_signed, 3), "",
             "Mean of d \u2212 d_exact, model units: below 0, distances are too short.");
  if (e.worst != kNoIndex) {
    draw_value(frame, "worst vertex", std::to_string(e.worst), "",
               "Where the error is largest: " + app::significant(e.max, 3) + " model units.");
  }
  draw_error_plot(frame, report.histogram);
  draw_note(app::told(report), report.is_poor() ? frame.colours().warning : frame.colours().dim);
}

/// Figures of a vertex are shown at a face that has it.
std::optional<app::FacePoint> point_at(const TriangleMesh& mesh, Index vertex) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Face& face = mesh.faces()[f];
    for (int k = 0; k < 3; ++k) {
      if (face[k] != vertex) continue;
      app::FacePoint point{f};
      point.weights[static_cast<std::size_t>(k)] = 1;
      return point;
    }
  }
  return std::nullopt;
}

}  // namespace

void draw_error_panel(Frame& frame) {
  if (!draw_section(frame, "Exact error", false)) return;
  draw_setting(frame, *app::find_setting("check"));
  const app::Answer* answer = frame.answer();
  if (!answer || !answer->error) {
    return draw_dim(frame, frame.state().check == app::Check::kOff
                               ? "Holds the distances against a more accurate method, live."
                               : "Not known yet: distances are checked when they rest.");
  }
  draw_figures(frame, *answer->error);
  const float width = button_width(2);
  if (draw_button(frame, "show", "Show", true, width)) perform(frame, Action::kExactError);
  draw_tip(frame, "The error in colours (8).");
  ImGui::SameLine();
  const Index worst = answer->error->figures.worst;
  if (draw_button(frame, "worst", "Go to worst", worst != kNoIndex, width)) {
    const TriangleMesh& mesh = *frame.model()->model.mesh;
    const Vec3& at = mesh.positions()[worst];
    frame.send(app::command::Pick{point_at(mesh, worst)});
    frame.send(app::command::Centre{at.x(), at.y(), at.z()});
  }
  draw_tip(frame, "Picks the vertex with the largest error and turns about it.");
}

}  // namespace geotherm::ui
