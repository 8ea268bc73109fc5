// SPDX-License-Identifier: MIT
#include "ui/panels.h"

#include <imgui.h>
#include <algorithm>
#include <cmath>

#include "app/text/text.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

constexpr float kErrorHeight = 74;  ///< pixels at scale 1

/// The ends of the range under the plot.
void draw_ends(Frame& frame, const std::string& low, const std::string& high) {
  const float left = ImGui::GetCursorPosX();
  const float room = ImGui::GetContentRegionAvail().x;
  ImGui::PushStyleColor(ImGuiCol_Text, frame.colours().dim);
  ImGui::TextUnformatted(low.c_str());
  ImGui::SameLine(left + room - ImGui::CalcTextSize(high.c_str()).x);
  ImGui::TextUnformatted(high.c_str());
  ImGui::PopStyleColor();
}

}  // namespace

void draw_error_plot(Frame& frame, const ErrorHistogram& histogram) {
  const std::size_t bins = histogram.count.size();
  const Index most = bins > 0 ? *std::ranges::max_element(histogram.count) : 0;
  if (most == 0) return;
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 size(std::max(1.0F, ImGui::GetContentRegionAvail().x), frame.px(kErrorHeight));
  ImGui::InvisibleButton("##error plot", size);
  frame.mark("plot");
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float pad = frame.px(4);
  list->AddRectFilled(low, {low.x + size.x, low.y + size.y}, packed(frame.colours().frame),
                      frame.px(4));
  const float column = (size.x - 2 * pad) / static_cast<float>(bins);
  const float bottom = low.y + size.y - pad;
  const double width = (histogram.high - histogram.low) / static_cast<double>(bins);
  for (std::size_t i = 0; i < bins; ++i) {
    // The root makes the few vertices that are far off visible beside the many that are not.
    const auto share = static_cast<float>(
        std::sqrt(static_cast<double>(histogram.count[i]) / static_cast<double>(most)));
    const float x = low.x + pad + column * static_cast<float>(i);
    const double middle = histogram.low + width * (static_cast<double>(i) + 0.5);
    list->AddRectFilled({x, bottom - share * (size.y - 2 * pad)},
                        {x + std::max(1.0F, column - frame.px(1)), bottom},
                        packed(frame.colours().series[middle < 0 ? 2 : 1]));
    const float mouse = ImGui::GetIO().MousePos.x;
    if (ImGui::IsItemHovered() && mouse >= x && mouse < x + column) {
      ImGui::SetTooltip("%s: error %s to %s",
                        app::counted(histogram.count[i], "vertex", "vertices").c_str(),
                        app::significant(middle - width / 2, 3).c_str(),
                        app::significant(middle + width / 2, 3).c_str());
    }
  }
  if (histogram.low < 0 && histogram.high > 0) {
    const auto share = static_cast<float>(-histogram.low / (histogram.high - histogram.low));
    const float x = low.x + pad + share * (size.x - 2 * pad);
    list->AddLine({x, low.y + pad}, {x, bottom}, packed(frame.colours().text), frame.px(1));
  }
  draw_ends(frame, app::significant(histogram.low, 3), app::significant(histogram.high, 3));
}

namespace {

constexpr float kStudyHeight = 80;  ///< pixels at scale 1

}  // namespace

std::optional<double> draw_study_plot(Frame& frame, const app::SessionStudy& study, double factor) {
  if (study.points.size() < 2) return std::nullopt;
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 size(std::max(1.0F, ImGui::GetContentRegionAvail().x), frame.px(kStudyHeight));
  const bool clicked = ImGui::InvisibleButton("##study plot", size);
  frame.mark("study plot");
  const auto [least, most] =
      std::ranges::minmax(study.points, {}, [](const auto& point) { return point.mean_error; });
  const double first = std::log(study.points.front().factor);
  const double last = std::log(study.points.back().factor);
  const double bottom = std::log(std::max(least.mean_error, 1e-12) / 1.2);
  const double top = std::log(std::max(most.mean_error, 1e-12) * 1.2);
  const float pad = frame.px(6);
  const auto at = [&](double m, double error) {
    const double x = (std::log(m) - first) / (last - first);
    const double y = (std::log(std::max(error, 1e-12)) - bottom) / (top - bottom);
    return ImVec2(low.x + pad + static_cast<float>(x) * (size.x - 2 * pad),
                  low.y + size.y - pad - static_cast<float>(y) * (size.y - 2 * pad));
  };
  ImDrawList* list = ImGui::GetWindowDrawList();
  const Palette& p = frame.colours();
  const ImVec2 high(low.x + size.x, low.y + size.y);
  list->AddRectFilled(low, high, packed(p.frame), frame.px(4));
  const float here = std::clamp(at(factor, 1).x, low.x, high.x);
  list->AddLine({here, low.y}, {here, high.y}, packed(p.dim), frame.px(1));
  const app::SessionStudy::Point* nearest = nullptr;
  float reach = 0;
  for (std::size_t i = 0; i < study.points.size(); ++i) {
    const auto& point = study.points[i];
    const ImVec2 place = at(point.factor, point.mean_error);
    if (i > 0) {
      const auto& before = study.points[i - 1];
      list->AddLine(at(before.factor, before.mean_error), place, packed(p.series[1]), frame.px(2));
    }
    list->AddCircleFilled(place, frame.px(2.5F), packed(p.series[1]));
    const float away = std::abs(place.x - ImGui::GetIO().MousePos.x);
    if (nearest == nullptr || away < reach) {
      nearest = &point;
      reach = away;
    }
  }
  if (ImGui::IsItemHovered()) {
    draw_tip(frame, "m = " + app::significant(nearest->factor, 3) + ": mean error " +
                        percent_text(nearest->mean_error) + ". A click takes this factor.");
  }
  const float line = ImGui::GetTextLineHeight();
  list->AddText({low.x + pad, low.y + frame.px(1)}, packed(p.dim),
                percent_text(most.mean_error).c_str());
  list->AddText({low.x + pad, high.y - line - frame.px(1)}, packed(p.dim),
                percent_text(least.mean_error).c_str());
  draw_ends(frame, "m = " + app::significant(study.points.front().factor, 3),
            app::significant(study.points.back().factor, 3));
  return clicked ? std::optional(nearest->factor) : std::nullopt;
}

namespace {

constexpr float kQueryHeight = 62;  ///< pixels at scale 1
constexpr float kColumn = 5;        ///< width of a query with its gap, pixels at scale 1

void draw_query_tip(const app::QueryRecord& query) {
  const QueryTiming& timing = query.timing;
  ImGui::BeginTooltip();
  ImGui::Text("%s: query %s ms", query.backend.c_str(), app::milliseconds(timing.query).c_str());
  ImGui::Text("diffuse %s, gradient %s, poisson %s", app::milliseconds(timing.diffuse).c_str(),
              app::milliseconds(timing.gradient).c_str(),
              app::milliseconds(timing.poisson).c_str());
  ImGui::EndTooltip();
}

void draw_legend(Frame& frame) {
  constexpr const char* kNames[] = {"diffuse", "gradient", "poisson"};
  const float side = frame.px(8);
  for (int i = 0; i < 3; ++i) {
    if (i > 0) ImGui::SameLine(0, frame.px(10));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float top = at.y + (ImGui::GetTextLineHeight() - side) / 2;
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + side, top + side},
                                              packed(frame.colours().series[i]), frame.px(2));
    ImGui::Dummy({side, 1});
    ImGui::SameLine(0, frame.px(4));
    ImGui::TextDisabled("%s", kNames[i]);
  }
}

}  // namespace

void draw_query_plot(Frame& frame) {
  const auto all = frame.session.queries();
  if (all.size() < 2) return;
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 size(std::max(1.0F, ImGui::GetContentRegionAvail().x), frame.px(kQueryHeight));
  ImGui::InvisibleButton("##queries", size);
  frame.mark("queries");
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float round = frame.px(4), pad = frame.px(4);
  list->AddRectFilled(low, {low.x + size.x, low.y + size.y}, packed(frame.colours().frame), round);

  const float column = frame.px(kColumn);
  const auto fit = static_cast<std::size_t>(std::max(1.0F, (size.x - 2 * pad) / column));
  const auto shown = all.last(std::min(fit, all.size()));
  double most = 0;
  for (const app::QueryRecord& query : shown) most = std::max(most, query.timing.query);
  if (!(most > 0)) return;
  const float top = low.y + pad + ImGui::GetTextLineHeight();
  const float bottom = low.y + size.y - pad;
  float x = low.x + size.x - pad - column * static_cast<float>(shown.size());
  const app::QueryRecord* pointed = nullptr;
  for (const app::QueryRecord& query : shown) {
    const double parts[] = {query.timing.diffuse, query.timing.gradient, query.timing.poisson};
    float y = bottom;
    for (int i = 0; i < 3; ++i) {
      const auto height = static_cast<float>(parts[i] / most) * (bottom - top);
      list->AddRectFilled({x, y - height}, {x + column - frame.px(1), y},
                          packed(frame.colours().series[i]));
      y -= height;
    }
    // A method that does not have these parts.
    const double rest = query.timing.query - parts[0] - parts[1] - parts[2];
    if (const auto height = static_cast<float>(rest / most) * (bottom - top); height > 1) {
      list->AddRectFilled({x, y - height}, {x + column - frame.px(1), y},
                          packed(frame.colours().accent));
    }
    const float mouse = ImGui::GetIO().MousePos.x;
    if (ImGui::IsItemHovered() && mouse >= x && mouse < x + column) pointed = &query;
    x += column;
  }
  const std::string scale = app::milliseconds(most) + " ms";
  list->AddText({low.x + pad, low.y + frame.px(1)}, packed(frame.colours().dim), scale.c_str());
  if (pointed) draw_query_tip(*pointed);
  draw_legend(frame);
}

}  // namespace geotherm::ui
