// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/machine.h"
#include "app/text.h"
#include "ui/panels.h"
#include "ui/query_plot.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

struct Stage {
  const char* name;
  double ms;
  const char* help;
};

/// A time with a bar behind it: its share of `whole`.
void draw_stage(Frame& frame, const Stage& stage, double whole) {
  if (whole > 0) draw_share(frame, stage.ms / whole);
  draw_value(frame, stage.name, app::milliseconds(stage.ms), "ms", stage.help);
}

void draw_setup(Frame& frame, const app::Answer& answer) {
  const SetupTiming& setup = answer.setup;
  draw_heading(frame, "Set-up");
  const double whole = std::max(setup.setup, 1e-9);
  draw_stage(frame,
             {"operators", setup.operators, "Cleaning, Delaunay flips, renumbering, assembly."},
             whole);
  draw_stage(frame, {"analyze", setup.analyze, "Ordering and symbolic analysis."}, whole);
  draw_stage(frame, {"factorize", setup.factorize, "Both numeric factorisations."}, whole);
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
