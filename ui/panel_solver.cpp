// SPDX-License-Identifier: MIT
#include "app/session/settings.h"

#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <optional>

#include "app/session/machine.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "ui/frame.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

constexpr double kMinFactor = 0.01, kMaxFactor = 1000;  ///< of the slider

/// The choice of a setting whose texts are NAME or NAME:VALUE, among these.
void draw_named_choice(Frame& frame, const app::Setting& setting,
                       const std::vector<std::string>& texts) {
  std::vector<std::string> names;
  for (const std::string& text : texts) names.push_back(name_part(text));
  draw_setting_label(frame, setting);
  const std::string now = name_part(setting.get(frame.state()));
  if (const auto chosen = draw_choice(frame, setting.name, now, names)) {
    frame.set(setting.name, *std::ranges::find(texts, *chosen, name_part));
  }
}

/// The t that the present settings mean, as far as it is known without solving: with several
/// components each has its own, and refined faces are not there yet.
std::optional<double> time_now(const Frame& frame) {
  const MethodOptions& options = frame.state().options;
  if (!frame.model() || options.refine != 0) return {};
  const app::Answer* answer = frame.answer();
  const HeatMethod* const heat = answer ? answer->method->heat() : nullptr;
  if (frame.model()->model.space) return app::time_in_space(options.time_step, heat);
  const MeshReport* const mesh = frame.mesh();
  if (!mesh || mesh->components != 1) return {};
  if (heat && heat->grading() != 1) return {};  // only a set-up tells
  return app::time_on_mesh(options.time_step, *mesh);
}

/// That t, or else the one of the answer, rounded so that it can be read.
std::string rounded_time(const Frame& frame) {
  const app::Answer* answer = frame.answer();
  const HeatMethod* const heat = answer ? answer->method->heat() : nullptr;
  const double other = heat ? heat->t() : 0.01;
  return app::significant(time_now(frame).value_or(other), 4);
}

void draw_factor(Frame& frame) {
  draw_setting_label(frame, *app::find_setting("time-factor"));
  const double factor = frame.state().options.time_step.factor;
  const auto chosen = draw_slider_row(frame, "time-factor", factor, kMinFactor, kMaxFactor,
                                      ImGuiSliderFlags_Logarithmic);
  if (chosen) frame.set("time-factor", *chosen);
}

/// The error over m for the sources that are shown, worked out while this is open.
void draw_error_over_factor(Frame& frame) {
  const app::Answer* answer = frame.answer();
  const bool heat = answer != nullptr && answer->method->heat() != nullptr;
  if (!heat || frame.state().options.time_step.rule == TimeRule::kAbsolute) return;
  if (!draw_more(frame, "Error over m")) return;
  const app::SessionStudy& study = frame.session.error_study();
  frame.out.study = !study.cancelled;
  const double factor = frame.state().options.time_step.factor;
  if (const auto chosen = draw_study_plot(frame, study, factor)) {
    frame.set("time-factor", app::significant(*chosen, 3));
  }
  if (!study.failure.empty()) return draw_note(study.failure, frame.colours().error);
  if (study.cancelled) {
    draw_dim(frame, "Stopped before all factors were tried.");
    frame.out.study =
        draw_button(frame, "study again", "Begin again", true, ImGui::GetContentRegionAvail().x);
  } else if (!study.running && frame.session.stale()) {
    return draw_dim(frame, "The distances come first.");
  } else if (study.points.size() < 2) {
    return draw_dim(frame, "The error is being worked out.");
  }
  if (study.points.empty()) return;
  const auto best = std::ranges::min_element(study.points, {},
                                             [](const auto& point) { return point.mean_error; });
  draw_value(frame, "least error",
             percent_text(best->mean_error) + " at m = " + app::significant(best->factor, 3), "",
             "Mean error against a more accurate method, among the factors that were tried.");
}

void draw_time(Frame& frame, const app::Setting& setting) {
  std::vector<std::string> rules = setting.values();
  for (std::string& rule : rules) {
    if (!value_part(rule).empty()) rule = name_part(rule) + ":" + rounded_time(frame);
  }
  draw_named_choice(frame, setting, rules);
  const TimeStep& step = frame.state().options.time_step;
  if (step.rule == TimeRule::kAbsolute) {
    draw_label(frame, "t", "Diffusion time, model units squared.");
    if (const auto typed = draw_field(frame, "absolute", number_text(step.absolute))) {
      frame.set("time-step", "absolute:" + *typed);
    }
  } else {
    draw_factor(frame);
    draw_error_over_factor(frame);
  }
  if (!frame.model()) return;
  const auto t = time_now(frame);
  const app::Answer* answer = frame.answer();
  const HeatMethod* heat = answer ? answer->method->heat() : nullptr;
  // The same number once.
  if (t && !(heat && app::significant(*t) == app::significant(heat->t()))) {
    draw_value(frame, "t now", app::significant(*t), "",
               "Diffusion time that these settings mean, model units squared.");
  }
  if (heat != nullptr) {
    draw_value(
        frame, "t of the answer", app::significant(heat->t()), "",
        "Diffusion time that the distances shown were computed with, of the component with most "
        "faces.",
        frame.session.stale() ? frame.colours().warning : frame.colours().text);
  }
}

void draw_constraint(Frame& frame, const app::Setting& setting) {
  draw_named_choice(frame, setting, setting.values());
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
void draw_backend(Frame& frame, const app::Setting& setting) {
  draw_setting(frame, setting);
  const app::Answer* answer = frame.answer();
  if (answer && answer->method->heat() && answer->result.backend != answer->options.backend) {
    draw_value(frame, "at work", answer->result.backend, "",
               "The backend that was asked for failed; the log says why.", frame.colours().warning);
  }
}

void draw_failure(Frame& frame) {
  const std::string& failure = frame.session.failure();
  if (failure.empty()) return;
  // Over the picture it is said as well, for a while: once is enough.
  const bool said = std::ranges::any_of(
      frame.ui.notices, [&](const Notice& notice) { return notice.text == failure; });
  if (!said) draw_note(failure, frame.colours().error);
  if (draw_button(frame, "undo failure", "Undo the change", frame.session.can_undo())) {
    frame.send(app::command::Undo{});
  }
}

/// What the answer's triangulation is.
std::string triangulation_now(const Frame& frame) {
  const app::Answer* answer = frame.answer();
  const HeatMethod* const heat = answer ? answer->method->heat() : nullptr;
  if (heat == nullptr) return {};
  std::string text =
      "Now: " + app::laplacian_name(*heat) + ", " + app::counted(heat->flips(), "flip", "flips");
  if (heat->refinement().points > 0) text += ", " + app::refinement_in_words(heat->refinement());
  return text + ".";
}

/// Says what each choice costs before it is made.
void draw_refine(Frame& frame, const app::Setting& setting) {
  draw_setting_label(frame, setting);
  std::vector<std::string> labels;
  for (const std::string& value : setting.values()) {
    const int times = app::number_in<int>(value).value_or(0);
    const bool said = times > 0 && frame.model() && !frame.model()->model.space;
    labels.push_back(
        said ? value + ": " + app::refined_in_words(frame.model()->model.mesh->face_count(), times)
             : value);
  }
  const std::string now = setting.get(frame.state());
  const auto chosen = draw_choice(frame, setting.name, now, labels);
  if (chosen && name_part(*chosen) != now) frame.set(setting.name, name_part(*chosen));
  if (frame.state().options.refine > 0 && frame.model()) {
    const Index faces = frame.model()->model.mesh->face_count();
    draw_value(frame, "solved on", app::refined_in_words(faces, frame.state().options.refine), "",
               "Each face is cut into four so often.");
  }
}

/// The row of a setting, and what belongs to it.
void draw_row(Frame& frame, const app::Setting& setting) {
  if (setting.name == "backend") return draw_backend(frame, setting);
  if (setting.name == "time-step") return draw_time(frame, setting);
  if (setting.name == "time-factor") return;  // with the time step
  if (setting.name == "refine") return draw_refine(frame, setting);
  if (setting.name == "constraint") return draw_constraint(frame, setting);
  if (setting.name == "laplacian") return draw_setting(frame, setting, triangulation_now(frame));
  draw_setting(frame, setting);
}

void draw_rows(Frame& frame, bool usual) {
  const bool heat = frame.state().options.method == MethodKind::kHeat;
  for (const app::Setting& setting : app::settings()) {
    if (!setting.of_method() || (!heat && setting.of_heat)) continue;
    if (setting.usual == usual) draw_row(frame, setting);
  }
}

}  // namespace

void draw_solver_panel(Frame& frame) {
  if (!draw_section(frame, "Solver")) return;
  draw_work_row(frame);
  draw_failure(frame);
  draw_rows(frame, true);
  if (draw_more(frame, "Advanced settings")) draw_rows(frame, false);
}

namespace {

struct Stage {
  const char* name;
  double ms;
  const char* help;
  bool reused = false;  ///< of an earlier change: no part of this one's time
};

/// A time with a bar behind it: its share of `whole`.
void draw_stage(Frame& frame, const Stage& stage, double whole) {
  if (stage.reused) {
    const std::string help = std::string(stage.help) + " Kept from a change before this one.";
    return draw_value(frame, stage.name, "reused, " + app::milliseconds(stage.ms), "ms", help,
                      frame.colours().dim);
  }
  if (whole > 0) draw_share(frame, stage.ms / whole);
  draw_value(frame, stage.name, app::milliseconds(stage.ms), "ms", stage.help);
}

void draw_setup(Frame& frame, const app::Answer& answer) {
  const SetupTiming& setup = answer.setup;
  draw_heading(frame, "Set-up");
  // Stages that the last change has reused keep their times, which are no part of its own; what it
  // did are the last of them.
  constexpr double kAll = 0.98;  // the parts of a time add up to a little less than the whole
  const double late = setup.analyze + setup.factorize, all = setup.operators + late;
  const double whole = std::max(setup.setup, 1e-9);
  draw_stage(frame,
             {"operators", setup.operators, "Cleaning, Delaunay flips, renumbering, assembly.",
              setup.setup < kAll * all},
             whole);
  draw_stage(
      frame,
      {"analyze", setup.analyze, "Ordering and symbolic analysis.", setup.setup < kAll * late},
      whole);
  draw_stage(frame,
             {"factorize", setup.factorize, "Both numeric factorisations.",
              setup.setup < kAll * setup.factorize},
             whole);
  draw_stage(frame,
             {"set-up", setup.setup,
              "From mesh in memory to first query ready; after a change of settings what "
              "that change needed, since all else is kept."},
             0);
  // Where the change that led here needed no factorisation.
  if (std::abs(answer.setup_ms - setup.setup) > 0.05 * answer.setup_ms) {
    draw_stage(
        frame,
        {"last factorisation", answer.setup_ms, "The last set-up that these settings needed."}, 0);
  }
}

void draw_query(Frame& frame, const QueryTiming& query) {
  draw_heading(frame, "Query");
  const double whole = std::max(query.query, 1e-9);
  draw_stage(frame, {"diffuse", query.diffuse, "(A + t L) u = u\u2080"}, whole);
  draw_stage(frame,
             {"gradient", query.gradient, "X = \u2212\u2207u / |\u2207u|, and its divergence."},
             whole);
  draw_stage(frame, {"poisson", query.poisson, "L \u03c6 = div X"}, whole);
  draw_stage(frame, {"query", query.query, "From the source set to the distances."}, 0);
}

/// Asked for once a second: the system takes its time to answer.
double peak_mb(Frame& frame) {
  UiState& ui = frame.ui;
  if (ui.peak_read_at < 0 || ImGui::GetTime() - ui.peak_read_at >= 1) {
    ui.peak_mb = app::peak_rss_mb();
    ui.peak_read_at = ImGui::GetTime();
  }
  return ui.peak_mb;
}

}  // namespace

void draw_timing_panel(Frame& frame) {
  if (!draw_section(frame, "Timings")) return;
  if (!frame.model()) return draw_dim(frame, "No model is open.");
  draw_stage(frame, {"load", frame.model()->model.load_ms, "Reading or generating the model."}, 0);
  const app::Answer* answer = frame.answer();
  if (!answer) return draw_dim(frame, "No answer yet.");
  if (answer->method->heat() != nullptr) {
    draw_setup(frame, *answer);
    draw_query(frame, answer->result.timing);
  } else {
    draw_stage(frame, {"set-up", answer->setup.setup, "Flips and tables."}, 0);
    draw_stage(frame, {"query", answer->result.timing.query, "From the sources to the distances."},
               0);
  }
  draw_query_plot(frame);
  draw_heading(frame, "Memory");
  draw_value(frame, answer->method->heat() ? "factors" : "tables",
             app::significant(answer->method->memory_mb(), 3), "MB",
             "Of the answer that is shown.");
  draw_value(frame, "program, peak", app::grouped(static_cast<std::int64_t>(peak_mb(frame))), "MB",
             "The most that the program has held so far.");
}

}  // namespace geotherm::ui
