// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <algorithm>
#include <optional>

#include "app/explore/settings.h"
#include "app/mesh_words.h"
#include "app/method_words.h"
#include "app/text.h"
#include "ui/number.h"
#include "ui/panels.h"
#include "ui/setting_rows.h"
#include "ui/widgets.h"
#include "ui/work_row.h"

namespace geotherm::ui {
namespace {

constexpr double kLeastFactor = 0.01, kMostFactor = 1000;  ///< of the slider

/// The choice of a setting whose text is NAME or NAME:VALUE. `value` gives what follows a name.
template <class Value>
void draw_named_choice(Frame& frame, std::string_view name, std::string_view label,
                       std::string_view tip, Value value) {
  const app::Setting* setting = app::find_setting(name);
  if (!setting) return;
  std::vector<std::string> names;
  for (const std::string& each : setting->values()) names.push_back(name_part(each));
  draw_label(frame, label, std::string(setting->help) + "\n" + std::string(tip));
  const auto chosen = draw_choice(frame, name, name_part(setting->get(frame.state())), names);
  if (chosen) frame.set(name, *chosen + value(*chosen));
}

/// The t that the present settings mean, as far as it is known without solving: with several
/// components each has its own, and refined faces are not there yet.
std::optional<double> time_now(const Frame& frame) {
  const MethodOptions& options = frame.state().options;
  if (!frame.model() || frame.model()->mesh.components != 1 || options.refine != 0) return {};
  const app::Answer* answer = frame.answer();
  const HeatMethod* const heat = answer ? answer->method->heat() : nullptr;
  if (heat && heat->grading() != 1) return {};  // only a set-up tells
  return app::diffusion_time(options.time_step, frame.model()->mesh);
}

/// That t, or else the one of the answer, rounded so that it can be read.
std::string rounded_time(const Frame& frame) {
  const app::Answer* answer = frame.answer();
  const HeatMethod* const heat = answer ? answer->method->heat() : nullptr;
  const double other = heat ? heat->t() : 0.01;
  return app::significant(time_now(frame).value_or(other), 4);
}

void draw_factor(Frame& frame) {
  draw_label(
      frame, "factor m",
      "m of t = m h\u00b2 or t = m A/F. Around 1 is right for most meshes; larger smooths the "
      "distances, smaller costs accuracy on coarse meshes.");
  const double current = frame.state().options.time_step.factor;
  const float width = ImGui::GetContentRegionAvail().x;
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  double factor = current;
  ImGui::SetNextItemWidth(width * 0.6F - gap);
  if (ImGui::SliderScalar("##slider", ImGuiDataType_Double, &factor, &kLeastFactor, &kMostFactor,
                          "", ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoInput)) {
    const std::string text = app::significant(factor, 3);
    if (app::number_in<double>(text) != current) frame.set("time-factor", text);
  }
  frame.mark("time-factor slider");
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (const auto typed = draw_field(frame, "time-factor", exact(current))) {
    frame.set("time-factor", *typed);
  }
}

void draw_time(Frame& frame) {
  draw_named_choice(frame, "time-step", "time rule",
                    "mean-edge: t = m h\u00b2; mean-face-area: t = m A/F; absolute: t itself.",
                    [&frame](const std::string& name) {
                      return name == "absolute" ? ":" + rounded_time(frame) : std::string();
                    });
  const TimeStep& step = frame.state().options.time_step;
  if (step.rule == TimeRule::kAbsolute) {
    draw_label(frame, "t", "Diffusion time, model units squared.");
    if (const auto typed = draw_field(frame, "absolute", exact(step.absolute))) {
      frame.set("time-step", "absolute:" + *typed);
    }
  } else {
    draw_factor(frame);
  }
  if (!frame.model()) return;
  if (const auto t = time_now(frame)) {
    draw_value(frame, "t now", app::significant(*t), "",
               "Diffusion time that these settings mean, model units squared.");
  }
  const app::Answer* answer = frame.answer();
  if (const HeatMethod* heat = answer ? answer->method->heat() : nullptr) {
    draw_value(
        frame, "t of the answer", app::significant(heat->t()), "",
        "Diffusion time that the distances shown were computed with, of the component with most "
        "faces.",
        frame.session.stale() ? frame.colours().warning : frame.colours().text);
  }
}

void draw_constraint(Frame& frame) {
  draw_named_choice(
      frame, "constraint", "constraint",
      "pin-sources: \u03c6 = 0 on every source; pin-vertex: on one vertex; penalty: a "
      "number on the diagonal; conserve-energy: the total of \u03c6 is fixed; "
      "pseudo-inverse: the smallest solution.",
      [](const std::string& name) {
        return name == "penalty" ? std::string(":10") : std::string();
      });
  const std::string text = setting_text(frame, "constraint");
  const std::string name = name_part(text);
  if (name == "penalty") {
    draw_label(frame, "value", "On the diagonal of the last row.");
    if (const auto typed = draw_field(frame, "penalty", value_part(text))) {
      frame.set("constraint", "penalty:" + *typed);
    }
  }
  if (name == "pin-vertex") {
    draw_label(frame, "vertex", "Held at 0 in its component; empty: one is chosen.");
    if (const auto typed = draw_field(frame, "pin", value_part(text), "chosen")) {
      frame.set("constraint", typed->empty() ? name : name + ":" + *typed);
    }
  }
}

/// The backend that was asked for, and the one at work where that is another.
void draw_backend(Frame& frame) {
  draw_setting_choice(frame, "backend", "backend");
  const app::Answer* answer = frame.answer();
  if (answer && answer->method->heat() && answer->result.backend != answer->options.backend) {
    draw_value(frame, "at work", answer->result.backend, "",
               "The backend that was asked for failed; the log says why.", frame.colours().warning);
  }
}

/// What backends may take, and what follows where they fail.
void draw_limits(Frame& frame) {
  draw_setting_field(frame, "threads", "threads");
  draw_setting_field(frame, "memory-limit", "memory limit", "",
                     "Most that factors may take, MB; free: what the machine has left.");
  draw_setting_flag(frame, "strict", "no other backend where one fails");
}

void draw_failure(Frame& frame) {
  const std::string& failure = frame.session.failure();
  if (failure.empty()) return;
  draw_note(failure, frame.colours().error);
  if (draw_button(frame, "undo failure", "Undo the change", frame.session.can_undo())) {
    frame.send(app::command::Undo{});
  }
}

std::string laplacian_tip(const Frame& frame) {
  std::string tip =
      "auto flips edges where weights would be negative, on the tufted cover where edges have "
      "three faces, and inserts vertices (refined) where faces are too large or the border is "
      "obtuse; cotan takes the mesh as it is.";
  const app::Answer* answer = frame.answer();
  if (const HeatMethod* heat = answer ? answer->method->heat() : nullptr) {
    tip += "\nNow: " + app::laplacian_name(*heat) + ", " +
           app::counted(heat->flips(), "flip", "flips");
    if (heat->refinement().points > 0) tip += ", " + app::refinement_in_words(heat->refinement());
    tip += ".";
  }
  return tip;
}

/// What is done to the mesh first, whatever the method.
void draw_mesh_settings(Frame& frame) {
  draw_setting_choice(frame, "refine", "refine",
                      "Each time there are four times as many faces to solve on, and less "
                      "error; the distances shown are those at the model's own vertices.");
  draw_setting_field(frame, "weld", "weld", "off",
                     "Closes cracks: such as 1e-5, or 0 where vertices are equal; off: none.");
  draw_setting_choice(frame, "format", "file format", "auto: what the name's extension says.");
}

}  // namespace

void draw_solver_panel(Frame& frame) {
  if (!draw_section(frame, "Solver")) return;
  draw_work_row(frame);
  draw_failure(frame);
  draw_setting_choice(
      frame, "method", "method",
      "heat: the heat method; wavefront, wavefront-fine: near exact; fast-marching: "
      "the classic; exact: slow, and the truth.");
  if (frame.state().options.method != MethodKind::kHeat) {
    draw_setting_field(frame, "threads", "threads");
    return draw_mesh_settings(frame);
  }
  draw_backend(frame);
  draw_time(frame);
  draw_constraint(frame);
  draw_setting_choice(frame, "heat", "heat",
                      "unit: 1 on every source; diffuse: weighted with the source's area; hold: "
                      "u = 1 held on the sources.");
  draw_setting_choice(frame, "boundary", "boundary",
                      "neumann: no heat leaves; dirichlet: u = 0 on the border; average: the mean "
                      "of both.");
  draw_setting_choice(frame, "laplacian", "Laplacian", laplacian_tip(frame));
  draw_setting_choice(frame, "variant", "variant",
                      "corrected: this program's; classic: as first published.");
  draw_limits(frame);
  draw_mesh_settings(frame);
  draw_setting_choice(frame, "precision", "precision",
                      "compact: factors at half the size where the backend can; refined: the same, "
                      "and each solve made accurate by another; full: factors in double.");
}

}  // namespace geotherm::ui
