// SPDX-License-Identifier: MIT
#include "app/session/settings.h"

#include <imgui.h>
#include <algorithm>
#include <utility>

#include "app/session/check.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "ui/action.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

/// The options in which A and B differ, side by side.
void draw_settings(Frame& frame) {
  app::ViewerState kept = frame.state();
  kept.options = *frame.state().kept;
  bool any = false;
  for (const app::Setting& setting : app::settings()) {
    if (!setting.of_method()) continue;
    const std::string a = setting.get(frame.state()), b = setting.get(kept);
    if (a == b) continue;
    any = true;
    draw_value(frame, setting.name, a + "  |  " + b, "", setting.help);
  }
  if (!any) draw_dim(frame, "A and B have the same settings: change one of them in the solver.");
}

void draw_difference(Frame& frame) {
  const auto& difference = frame.explored().difference;
  if (!difference) return;
  if (difference->most == 0) return draw_dim(frame, "Both answers are equal, to the last bit.");
  const auto in_words = [&](double value) {
    const std::string text = app::significant(value);
    if (!(difference->largest > 0)) return text;
    return text + "  (" + app::significant(100 * value / difference->largest, 3) + " %)";
  };
  const char* help =
      "Of |d_A \u2212 d_B| over all vertices: model units, and relative to the largest distance of "
      "A.";
  draw_value(frame, "largest", in_words(difference->most), "", help);
  draw_value(frame, "mean", in_words(difference->mean), "", help);
}

}  // namespace

void draw_ab_panel(Frame& frame) {
  if (!draw_section(frame, "A and B")) return;
  const app::ViewerState& state = frame.state();
  const bool kept = state.kept.has_value();
  const float width = button_width(3);
  draw_action(frame, "keep", "Keep as B", Action::kKeep,
              "Keeps the present settings as B (k), to compare others with.", width);
  ImGui::SameLine();
  draw_action(frame, "swap", "Swap", Action::kSwap,
              "Makes B what the solver panel changes. While B is shown it stays in sight, as A.",
              width);
  ImGui::SameLine();
  draw_action(frame, "forget", "Forget B", Action::kForget, "", width);
  if (!kept) {
    return draw_dim(frame,
                    "Keep these settings as B, then change them: both answers stay at hand.");
  }
  const int chosen = draw_segments(
      frame, {{"show a", "A", state.shown == app::Shown::kA},
              {"show b", "B", state.shown == app::Shown::kB},
              {"show difference", "A \u2212 B", state.shown == app::Shown::kDifference}});
  constexpr app::Shown kShown[] = {app::Shown::kA, app::Shown::kB, app::Shown::kDifference};
  if (chosen >= 0) frame.send(app::command::Show{kShown[chosen]});
  draw_dim(frame, "The solver panel changes A.");
  draw_settings(frame);
  draw_difference(frame);
}

namespace {

void draw_figures(Frame& frame, const AccuracyReport& report) {
  if (!report.measured) {
    // The bare option of the command line stands for the best method that fits the mesh.
    Hint advice = report.advice;
    for (auto& part : advice) {
      auto* const setting = std::get_if<SettingHint>(&part);
      if (setting != nullptr && setting->name == "check") setting->values = {"auto"};
    }
    return draw_advice(frame, sentence(report), advice, frame.colours().dim);
  }
  const DistanceError& e = report.figures;
  draw_value(frame, "against", to_text(report.reference), "",
             "The more accurate method; solved once for these sources.");
  draw_value(frame, "mean error", percent_text(e.mean_relative), "",
             "Mean of |d \u2212 d_exact| / d_exact over the vertices.");
  draw_value(frame, "largest error", percent_text(e.max_of_range), "",
             "Largest |d \u2212 d_exact|, as a share of the largest distance.");
  draw_value(frame, "bias", app::significant(e.mean_signed, 3), "",
             "Mean of d \u2212 d_exact, model units: below 0, distances are too short.");
  if (e.worst != kNoIndex) {
    draw_value(frame, "worst vertex", std::to_string(e.worst), "",
               "Where the error is largest: " + app::significant(e.max, 3) + " model units.");
  }
  draw_error_plot(frame, report.histogram);
  draw_advice(frame, sentence(report), report.advice,
              report.is_poor() ? frame.colours().warning : frame.colours().dim);
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
  if (!draw_section(frame, kErrorSection)) return;
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

namespace {

using Figure = std::optional<double> app::CompareRow::*;

std::string number_or_dash(const std::optional<double>& value, int digits = 3) {
  return value ? app::significant(*value, digits) : "\u2013";
}

void draw_choices(Frame& frame) {
  const app::Setting* backend = app::find_setting("backend");
  if (!backend) return;
  std::vector<std::string> chosen;
  const auto names = backend->values();
  for (const std::string& name : names) {
    bool on = !frame.ui.left_out.contains(name);
    if (draw_checkbox(frame, "with " + name, name.c_str(), on)) {
      if (on) {
        frame.ui.left_out.erase(name);
      } else {
        frame.ui.left_out.insert(name);
      }
    }
    if (on) chosen.push_back(name);
  }
  const bool running = frame.session.compare().running;
  const bool possible = frame.model() && !chosen.empty() && !running;
  if (draw_button(frame, "run", running ? "Running\u2026" : "Compare", possible,
                  ImGui::GetContentRegionAvail().x)) {
    const std::string which = chosen.size() == names.size() ? "all" : app::joined(chosen, ",");
    frame.send(app::command::Compare{which});
  }
  draw_tip(frame, "Runs the present work through each of these, one after the other.");
}

/// One figure of all backends as bars; the shortest is the best.
void draw_bars(Frame& frame, const char* title, Figure figure) {
  const auto& rows = frame.session.compare().rows;
  double most = 0;
  for (const app::CompareRow& row : rows) most = std::max(most, (row.*figure).value_or(0));
  if (!(most > 0)) return;
  draw_heading(frame, title);
  for (const app::CompareRow& row : rows) {
    if (!(row.*figure)) continue;
    draw_share(frame, *(row.*figure) / most);
    draw_value(frame, row.name(), app::milliseconds(*(row.*figure)), "ms");
  }
}

void draw_cell(const std::string& text) {
  ImGui::TableNextColumn();
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  const float room = ImGui::GetContentRegionAvail().x;
  if (room > width) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - width);
  ImGui::TextUnformatted(text.c_str());
}

void draw_table(Frame& frame) {
  const auto& compare = frame.session.compare();
  draw_heading(frame, "Figures");
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoSavedSettings;
  if (!ImGui::BeginTable("figures", 4, kFlags)) return;
  struct Column {
    const char *name, *help;
  };
  constexpr Column kColumns[] = {
      {"MB", "Memory of the factors."},
      {"batch, ms", "A source set, where 16 are solved for at once."},
      {"max diff", "The largest difference from the reference, of its largest distance."}};
  ImGui::TableSetupColumn("backend", 0, 1.5F);
  for (const Column& column : kColumns) ImGui::TableSetupColumn(column.name, 0, 1);
  ImGui::TableNextRow();
  ImGui::PushStyleColor(ImGuiCol_Text, frame.colours().dim);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted("backend");
  for (const Column& column : kColumns) {
    draw_cell(column.name);
    draw_tip(frame, column.help);
  }
  ImGui::PopStyleColor();
  for (const app::CompareRow& row : compare.rows) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const std::string name = row.name();
    ImGui::TextUnformatted(name.c_str());
    const std::string reference = row.name() == compare.reference ? " (the reference)" : "";
    draw_tip(frame, row.name() + reference + "\nstatus: " + row.status +
                        "\nfactors: " + number_or_dash(row.factor_mb) +
                        " MB\npeak memory: " + number_or_dash(row.peak_rss_mb) +
                        " MB\na source set of 16 at once: " + number_or_dash(row.batch_query_ms) +
                        " ms\nlargest difference: " + number_or_dash(row.max_difference) +
                        "\nmean difference: " + number_or_dash(row.mean_difference));
    draw_cell(number_or_dash(row.factor_mb));
    draw_cell(number_or_dash(row.batch_query_ms));
    draw_cell(row.name() == compare.reference ? "ref" : number_or_dash(row.max_difference, 2));
  }
  ImGui::EndTable();
}

}  // namespace

void draw_compare_panel(Frame& frame) {
  const bool open = draw_section(frame, kCompareSection, false);
  const auto& compare = frame.session.compare();
  UiState& ui = frame.ui;
  // It has come into sight when it was asked for, and does again when there is more to be seen.
  if (std::exchange(ui.compared, compare.rows.size()) < compare.rows.size()) {
    ui.sought = kCompareSection;
    ui.seeks = 2;
    ui.awake = std::max(ui.awake, 2);
  }
  if (!open) return;
  draw_choices(frame);
  if (compare.rows.empty()) return;
  draw_dim(frame, "Of " + compare.rows.front().model + ":");
  draw_bars(frame, "Set-up", &app::CompareRow::setup_ms);
  draw_bars(frame, "Query, median", &app::CompareRow::query_ms_median);
  draw_table(frame);
  for (const app::CompareRow& row : compare.rows) {
    if (row.note.message.empty()) continue;
    draw_note(row.name() + ": " + sentence(row.note),
              row.status == "ok" ? frame.colours().dim : frame.colours().error);
  }
}

}  // namespace geotherm::ui
