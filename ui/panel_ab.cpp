// SPDX-License-Identifier: MIT
#include <imgui.h>

#include "app/explore/settings.h"
#include "app/text.h"
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
  if (draw_button(frame, "keep", "Keep as B", is_possible(frame, Action::kKeep), width)) {
    perform(frame, Action::kKeep);
  }
  draw_tip(frame, "Keeps the present settings as B (k), to compare others with.");
  ImGui::SameLine();
  if (draw_button(frame, "swap", "Swap", kept, width)) perform(frame, Action::kSwap);
  ImGui::SameLine();
  if (draw_button(frame, "forget", "Forget B", kept, width)) perform(frame, Action::kForget);
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
  draw_settings(frame);
  draw_difference(frame);
}

}  // namespace geotherm::ui
