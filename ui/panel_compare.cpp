// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <algorithm>

#include "app/explore/settings.h"
#include "app/text.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "ui/work_row.h"

namespace geotherm::ui {
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
  ImGui::TableSetupColumn("backend", 0, 1.5F);
  for (const char* name : {"MB", "batch", "max diff"}) ImGui::TableSetupColumn(name, 0, 1);
  ImGui::TableNextRow();
  ImGui::PushStyleColor(ImGuiCol_Text, frame.colours().dim);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted("backend");
  for (const char* name : {"MB", "batch", "max diff"}) draw_cell(name);
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
  if (!draw_section(frame, "Compare backends", false)) return;
  draw_choices(frame);
  const auto& compare = frame.session.compare();
  if (compare.rows.empty()) return;
  draw_bars(frame, "Set-up", &app::CompareRow::setup_ms);
  draw_bars(frame, "Query, median", &app::CompareRow::query_ms_median);
  draw_table(frame);
  for (const app::CompareRow& row : compare.rows) {
    if (row.message.empty()) continue;
    draw_note(row.name() + ": " + row.message,
              row.status == "ok" ? frame.colours().dim : frame.colours().error);
  }
}

}  // namespace geotherm::ui
