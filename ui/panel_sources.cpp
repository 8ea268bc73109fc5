// SPDX-License-Identifier: MIT
#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "app/session/wording.h"
#include "app/text/text.h"
#include "ui/action.h"
#include "ui/canvas.h"
#include "ui/panels.h"
#include "ui/source_edit.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

constexpr int kMaxRandom = 100000;
constexpr int kListLines = 6;  ///< of the list before it scrolls

/// "3, 99 512" -> "3,99,512": what people type as a list of vertices. Other texts stay.
std::string with_commas(const std::string& typed) {
  const bool is_list = !typed.empty() && std::all_of(typed.begin(), typed.end(), [](char c) {
    return (c >= '0' && c <= '9') || c == ',' || c == ' ';
  });
  if (!is_list) return typed;
  std::string list;
  for (const char c : typed) {
    if (c >= '0' && c <= '9') {
      list += c;
    } else if (!list.empty() && list.back() != ',') {
      list += ',';
    }
  }
  if (!list.empty() && list.back() == ',') list.pop_back();
  return list;
}

}  // namespace

std::optional<int> chosen_entry(const Frame& frame) {
  const auto& sources = frame.state().sources;
  if (!frame.ui.sources.chosen) return std::nullopt;
  const auto at = std::ranges::find(sources, *frame.ui.sources.chosen);
  if (at == sources.end()) return std::nullopt;
  return static_cast<int>(at - sources.begin());
}

void remove_entry(Frame& frame, int entry) {
  const auto several = std::ranges::count(frame.explored().places, entry, &app::SourcePlace::entry);
  if (several > 1) {
    offer_sources(frame, short_name(frame.state().sources[static_cast<std::size_t>(entry)]) +
                             ": removed, " + std::to_string(several) + " sources at once.");
  }
  frame.send(app::command::RemoveSource{entry});
}

namespace {

void draw_list(Frame& frame) {
  const auto& sources = frame.state().sources;
  const auto place = frame.ui.input.pointed(frame);
  const int lit = place ? frame.explored().places[*place].entry : chosen_entry(frame).value_or(-1);
  if (sources.empty()) {
    return draw_dim(frame, "No source: click on the model to set one.");
  }
  const float line = ImGui::GetFrameHeight();
  const float lines = static_cast<float>(std::min<std::size_t>(sources.size(), kListLines));
  ImGui::BeginChild("list", {0, lines * (line + ImGui::GetStyle().ItemSpacing.y)});
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(sources.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      ImGui::PushID(i);
      const app::SourceSpec& source = sources[static_cast<std::size_t>(i)];
      const std::string text = short_name(source);
      const float corner = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - line;
      ImGui::AlignTextToFramePadding();
      const ImVec2 low = ImGui::GetCursorScreenPos();
      if (i == lit) {
        ImGui::GetWindowDrawList()->AddRectFilled(
            low, {low.x + corner - ImGui::GetCursorPosX(), low.y + line},
            packed(frame.colours().selected), frame.px(3));
      }
      const float space = ImGui::GetStyle().ItemSpacing.x;
      ImGui::RenderTextEllipsis(ImGui::GetWindowDrawList(),
                                {low.x, low.y + ImGui::GetStyle().FramePadding.y},
                                {low.x + corner - ImGui::GetCursorPosX() - space, low.y + line},
                                low.x + corner - ImGui::GetCursorPosX() - space, low.x + corner,
                                text.c_str(), nullptr, nullptr);
      ImGui::Dummy({corner - ImGui::GetCursorPosX() - space, line});
      frame.mark("source " + std::to_string(i));
      if (ImGui::IsItemHovered()) frame.ui.sources.pointed = i;
      if (ImGui::IsItemClicked()) frame.ui.sources.chosen = source;
      draw_tip(frame, app::to_text(source));
      ImGui::SameLine(corner);
      const std::string key = "remove " + std::to_string(i);
      if (draw_button(frame, key, "\u00d7", true, line)) remove_entry(frame, i);
      draw_tip(frame, "Removes this source.");
      ImGui::PopID();
    }
  }
  ImGui::EndChild();
}

void draw_random(Frame& frame) {
  SourcesForm& form = frame.ui.sources;
  draw_label(frame, "random", "Sources at random vertices.");
  const float button = frame.px(38);
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - gap);
  ImGui::InputInt("##count", &form.count, 0, 0);
  frame.mark("count");
  form.count = std::clamp(form.count, 1, kMaxRandom);
  ImGui::SameLine();
  if (draw_button(frame, "set random", "set", frame.model(), button)) {
    frame.send(app::command::SetSources{{app::RandomVertices{form.count}}});
  }
  draw_tip(frame, "This many sources at random places, and no others.");
}

void draw_typed(Frame& frame) {
  SourcesForm& form = frame.ui.sources;
  draw_label(frame, "typed",
             "Vertex ids such as 3, 99, 512, or any source: random:5:7, boundary, "
             "face:12:0.2:0.3:0.5, xyz:0:1:0, curve:3,99.");
  const float button = frame.px(38);
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 2 * (button + gap));
  const bool enter = ImGui::InputTextWithHint("##ids", "3, 99, 512", &form.ids,
                                              ImGuiInputTextFlags_EnterReturnsTrue);
  frame.mark("ids");
  if (ImGui::IsItemEdited()) form.error.clear();
  const std::string spec = with_commas(std::string(app::trimmed(form.ids)));
  const bool possible = frame.model() && !spec.empty();
  ImGui::SameLine();
  const bool sets = (draw_button(frame, "set ids", "set", possible, button) || enter) && possible;
  ImGui::SameLine();
  const bool adds = draw_button(frame, "add ids", "add", possible, button);
  if (sets || adds) {
    const auto source = app::parse_source(spec);
    form.error = source ? "" : sentence(source.error());
    if (source && sets) frame.send(app::command::SetSources{{*source}});
    if (source && adds) frame.send(app::command::AddSources{{*source}});
  }
  if (!form.error.empty()) draw_note(form.error, frame.colours().error);
}

/// What the centre of the sources is, and where: of several points.
void draw_centre(Frame& frame) {
  const auto& kind = frame.state().centre;
  const SourceSet& set = frame.explored().set;
  const bool possible = set.points.size() > 1 && set.edges.empty() && set.segments.empty();
  if (!possible && !kind) return;
  draw_label(frame, "centre",
             "Of the sources: where the sum of squared distances is least (mean), or that of the "
             "distances (median), and the shortest paths from there.");
  const int clicked =
      draw_segments(frame, {{"centre none", "none", !kind, true},
                            {"centre mean", "mean", kind == CentreKind::kMean, possible},
                            {"centre median", "median", kind == CentreKind::kMedian, possible}});
  if (clicked == 0) frame.send(app::command::ShowCentre{});
  if (clicked > 0) frame.send(app::command::ShowCentre{static_cast<CentreKind>(clicked - 1)});
  if (const auto& failure = frame.explored().centre_failure; kind && failure) {
    draw_note(sentence(*failure), frame.colours().warning);
  }
  if (!kind || !frame.explored().centre) return;
  const Centre& centre = frame.explored().centre->centres.found.front();
  draw_value(frame, "energy", app::significant(centre.energy, 4), "",
             *kind == CentreKind::kMean ? "Mean of the squared distances to the sources."
                                        : "Mean of the distances to the sources.");
  draw_value(frame, "farthest", app::significant(std::ranges::max(centre.distances), 4), "",
             "Largest distance to a source, model units.");
}

/// A button of the grid below the fields.
struct SourceButton {
  const char* key;
  const char* label;
  Action action;
  const char* tip;
};
constexpr SourceButton kSourceButtons[] = {
    {"fewer", "\u2212 fewer", Action::kFewerSources, "One random source fewer (-)."},
    {"more", "+ more", Action::kMoreSources, "One more random source (+)."},
    {"shuffle", "shuffle", Action::kShuffleSources, "As many sources at new random places (h)."},
    {"boundary", "boundary", Action::kBoundarySource,
     "Distance from the whole boundary, where the model has one."},
    {"clear", "clear", Action::kClearSources, "No sources."},
    {"brush", "brush", Action::kBrush,
     "Drag over the model to paint a curve of sources (b); the right button rotates."},
};

}  // namespace

void draw_sources_panel(Frame& frame) {
  if (!draw_section(frame, "Sources")) return;
  draw_list(frame);
  draw_random(frame);
  draw_typed(frame);
  const float width = button_width(3);
  int column = 0;
  for (const SourceButton& button : kSourceButtons) {
    if (column++ % 3 != 0) ImGui::SameLine();
    draw_action(frame, button.key, button.label, button.action, button.tip, width);
  }
  draw_centre(frame);
}

}  // namespace geotherm::ui
