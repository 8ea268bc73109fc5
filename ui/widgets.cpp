// SPDX-License-Identifier: MIT
#include "ui/widgets.h"

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/text/text.h"
#include "ui/frame.h"

namespace geotherm::ui {
namespace {

constexpr float kLabelShare = 0.36F;  ///< of a row's width
constexpr float kTipWidth = 320;      ///< pixels at scale 1

float label_width(const Frame& frame) {
  const float row = ImGui::GetWindowContentRegionMax().x - ImGui::GetWindowContentRegionMin().x;
  return std::min(row * kLabelShare, frame.px(110));
}

std::string id_of(const Frame& frame, std::string_view key) {
  return "##" + frame.section + "/" + std::string(key);
}

ImVec2 size_of(std::string_view text) {
  return ImGui::CalcTextSize(text.data(), text.data() + text.size());
}

void draw_text(std::string_view text) {
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
}

/// The text with an ellipsis where it is wider than `width`.
std::string cut_to(const std::string& text, float width) {
  if (size_of(text).x <= width) return text;
  const std::string dots = "\u2026";
  std::string front = text;
  while (!front.empty() && size_of(front + dots).x > width) {
    while (!front.empty() && (static_cast<unsigned char>(front.back()) & 0xc0U) == 0x80) {
      front.pop_back();
    }
    if (!front.empty()) front.pop_back();
  }
  return front + dots;
}

void show_tip(const Frame& frame, std::string_view text) {
  if (text.empty()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(frame.px(kTipWidth));
  draw_text(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace

void Frame::mark(std::string_view key) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  ui.items[section + "/" + std::string(key)] = {low.x, low.y, high.x - low.x, high.y - low.y};
}

bool begin_bar(const char* name, const Rect& place, ImVec2 padding, ImGuiWindowFlags flags) {
  if (place.width < 1 || place.height < 1) return false;
  ImGui::SetNextWindowPos({place.x, place.y});
  ImGui::SetNextWindowSize({place.width, place.height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoScrollWithMouse |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | flags);
  ImGui::PopStyleVar();
  return true;
}

void begin_floating(Frame& frame, const char* name, ImVec2 at, ImVec2 pivot) {
  ImGui::SetNextWindowPos(at, ImGuiCond_Always, pivot);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, frame.px(6));
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PopStyleVar();
}

bool draw_section(Frame& frame, const char* name, bool open_at_first) {
  frame.section = name;
  auto& open = frame.ui.layout.open;
  const auto known = open.find(name);
  const bool was_open = known == open.end() ? open_at_first : known->second;
  ImGui::Dummy({0, frame.px(1)});
  ImGui::SetNextItemOpen(was_open);
  ImGui::PushStyleColor(ImGuiCol_Header, frame.colours().header);
  ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 0);
  const bool is_open = ImGui::CollapsingHeader(name);
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  frame.mark("");
  if (is_open != was_open) open[name] = is_open;
  if (frame.ui.seeks > 0 && frame.ui.sought == name) {
    --frame.ui.seeks;
    ImGui::SetScrollHereY(0);
    frame.ui.awake = std::max(frame.ui.awake, 2);
  }
  return is_open;
}

bool draw_more(Frame& frame, const char* name) {
  auto& open = frame.ui.layout.open;
  const auto known = open.find(name);
  const bool was_open = known != open.end() && known->second;
  ImGui::SetNextItemOpen(was_open);
  ImGui::PushStyleColor(ImGuiCol_Text, frame.colours().accent);
  const bool is_open = ImGui::TreeNodeEx(
      name, ImGuiTreeNodeFlags_NoTreePushOnOpen | ImGuiTreeNodeFlags_SpanAvailWidth);
  ImGui::PopStyleColor();
  frame.mark(name);
  if (is_open != was_open) open[name] = is_open;
  return is_open;
}

void draw_share(Frame& frame, double share) {
  if (!(share > 0.002)) return;
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float before = frame.px(4);  // so that no letter stands on the edge
  const float width =
      (ImGui::GetContentRegionAvail().x + 2 * before) * static_cast<float>(std::min(share, 1.0));
  ImGui::GetWindowDrawList()->AddRectFilled(
      {low.x - before, low.y}, {low.x - before + width, low.y + ImGui::GetTextLineHeight()},
      packed(faded(frame.colours().accent, 0.25F)), frame.px(2));
}

void draw_heading(Frame& frame, const char* text) {
  ImGui::Dummy({0, frame.px(2)});
  ImGui::PushStyleColor(ImGuiCol_Text, frame.colours().accent);
  ImGui::TextUnformatted(text);
  ImGui::PopStyleColor();
}

void draw_tip(Frame& frame, std::string_view text) {
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) show_tip(frame, text);
}

void draw_label(Frame& frame, std::string_view label, std::string_view help) {
  const float begin = ImGui::GetCursorPosX();
  const float width = label_width(frame);
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, frame.colours().dim);
  draw_text(cut_to(std::string(label), width - frame.px(4)));
  ImGui::PopStyleColor();
  draw_tip(frame, help);
  ImGui::SameLine(begin + width);
  ImGui::SetNextItemWidth(-FLT_MIN);
}

void draw_value(Frame& frame, std::string_view label, std::string_view value, std::string_view unit,
                std::string_view help, const ImVec4& colour) {
  const float begin = ImGui::GetCursorPosX();
  const float right = begin + ImGui::GetContentRegionAvail().x;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::PushStyleColor(ImGuiCol_Text, frame.colours().dim);
  draw_text(label);
  const float after = begin + size_of(label).x + frame.px(10);
  const float space = unit.empty() ? 0 : frame.px(4);
  const float unit_width = size_of(unit).x;
  const std::string whole(value);
  const std::string shown = cut_to(whole, right - unit_width - space - after);
  ImGui::SameLine(std::max(after, right - unit_width - space - size_of(shown).x));
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  draw_text(shown);
  ImGui::PopStyleColor();
  if (!unit.empty()) {
    ImGui::SameLine(right - unit_width);
    draw_text(unit);
  }
  ImGui::PopStyleColor();
  const float bottom = corner.y + ImGui::GetTextLineHeight();
  if (ImGui::IsWindowHovered() &&
      ImGui::IsMouseHoveringRect(corner, {corner.x + right - begin, bottom})) {
    const std::string help_below = help.empty() ? "" : "\n" + std::string(help);
    show_tip(frame, shown == whole ? std::string(help) : whole + help_below);
  }
}

void draw_value(Frame& frame, std::string_view label, std::string_view value, std::string_view unit,
                std::string_view help) {
  draw_value(frame, label, value, unit, help, frame.colours().text);
}

void draw_note(std::string_view text, const ImVec4& colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::PushTextWrapPos(0);
  draw_text(text);
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void draw_dim(Frame& frame, std::string_view text) { draw_note(text, frame.colours().dim); }

bool draw_button(Frame& frame, std::string_view key, const char* label, bool possible,
                 float width) {
  ImGui::BeginDisabled(!possible);
  const bool pressed = ImGui::Button((label + id_of(frame, key)).c_str(), {width, 0});
  ImGui::EndDisabled();
  frame.mark(key);
  return pressed;
}

float button_width(int count) {
  const float gaps = ImGui::GetStyle().ItemSpacing.x * static_cast<float>(count - 1);
  return std::floor((ImGui::GetContentRegionAvail().x - gaps) / static_cast<float>(count));
}

bool draw_checkbox(Frame& frame, std::string_view key, const char* label, bool& on) {
  const bool changed = ImGui::Checkbox((label + id_of(frame, key)).c_str(), &on);
  frame.mark(key);
  return changed;
}

bool draw_toggle(Frame& frame, const Segment& segment, float width) {
  if (segment.on) {
    ImGui::PushStyleColor(ImGuiCol_Button, frame.colours().selected);
    ImGui::PushStyleColor(ImGuiCol_Border, frame.colours().accent);
  }
  const bool pressed = draw_button(frame, segment.key, segment.label, segment.possible, width);
  if (segment.on) ImGui::PopStyleColor(2);
  return pressed;
}

int draw_segments(Frame& frame, std::initializer_list<Segment> segments) {
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {frame.px(2), ImGui::GetStyle().ItemSpacing.y});
  const float width = button_width(static_cast<int>(segments.size()));
  int chosen = -1, index = 0;
  for (const Segment& segment : segments) {
    if (index > 0) ImGui::SameLine();
    if (draw_toggle(frame, segment, width)) chosen = index;
    ++index;
  }
  ImGui::PopStyleVar();
  return chosen;
}

std::optional<std::string> draw_choice(Frame& frame, std::string_view key,
                                       const std::string& current,
                                       std::span<const std::string> values) {
  std::optional<std::string> chosen;
  const bool open = ImGui::BeginCombo(id_of(frame, key).c_str(), current.c_str());
  frame.mark(key);
  if (!open) return chosen;
  for (const std::string& value : values) {
    const bool is_current = value == current;
    if (ImGui::Selectable(value.c_str(), is_current)) chosen = value;
    frame.mark(std::string(key) + "=" + value);
    if (is_current) ImGui::SetItemDefaultFocus();
  }
  ImGui::EndCombo();
  if (chosen == current) chosen.reset();
  return chosen;
}

std::optional<std::string> draw_field(Frame& frame, std::string_view key,
                                      const std::string& current, const char* hint) {
  const std::string name = id_of(frame, key);
  const ImGuiID id = ImGui::GetID(name.c_str());
  UiState& ui = frame.ui;
  // What was typed into a field that was hidden since is of no use: its setting may be another.
  const int now = ImGui::GetFrameCount();
  const auto is_here = [&](const TextEdit& edit) { return edit.id == id && now - edit.seen <= 1; };
  TextEdit* const edit = is_here(ui.edit) ? &ui.edit : is_here(ui.left) ? &ui.left : nullptr;
  std::string text = edit ? edit->text : current;
  // Another item that took over before this one was drawn leaves `text` as it was typed; Escape
  // puts back what ImGui had at the beginning, and that is no change.
  ImGui::InputTextWithHint(name.c_str(), hint, &text, ImGuiInputTextFlags_AutoSelectAll);
  frame.mark(key);
  if (ImGui::IsItemActive()) {
    TextEdit typed{id, edit ? edit->start : current, text, now};
    if (edit != &ui.edit) ui.left = std::move(ui.edit);
    ui.edit = std::move(typed);
    return std::nullopt;
  }
  if (!edit) return std::nullopt;
  const std::string start = std::exchange(*edit, {}).start;
  const std::string typed(app::trimmed(text));
  return typed == start ? std::nullopt : std::optional(typed);
}

void draw_action(Frame& frame, std::string_view key, const char* label, Action action,
                 std::string_view tip, float width) {
  const Segment segment{key, label, is_on(frame, action), is_possible(frame, action)};
  if (draw_toggle(frame, segment, width)) perform(frame, action);
  draw_tip(frame, tip);
}

std::optional<std::string> draw_slider_row(Frame& frame, std::string_view key, double current,
                                           double low, double high, ImGuiSliderFlags flags) {
  const float width = ImGui::GetContentRegionAvail().x;
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  std::optional<std::string> chosen;
  double moved = current;
  ImGui::SetNextItemWidth(width * 0.6F - gap);
  if (ImGui::SliderScalar(("##slider " + std::string(key)).c_str(), ImGuiDataType_Double, &moved,
                          &low, &high, "", flags | ImGuiSliderFlags_NoInput)) {
    const std::string text = app::significant(moved, 3);
    if (app::number_in<double>(text) != current) chosen = text;
  }
  frame.mark(std::string(key) + " slider");
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (const auto typed = draw_field(frame, key, number_text(current))) chosen = typed;
  return chosen;
}

}  // namespace geotherm::ui
