// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "app/answer_check.h"
#include "app/markup.h"
#include "app/study/log_plot.h"
#include "app/study/study_report.h"
#include "app/text.h"
#include "geotherm/options.h"

namespace geotherm::app {
namespace {

constexpr const char* kStyle = R"(
text { font: 12px system-ui, "Helvetica Neue", Arial, sans-serif; fill: #1c2733 }
.soft { fill: #66758a } .title { font-weight: 600; font-size: 13px } .head { font-size: 18px;
  font-weight: 600 } .grid { stroke: #e3e8ee } .one { stroke: #9aa7b5; stroke-dasharray: 3 3 }
.curve { fill: none; stroke-width: 1.8 }
)";

constexpr const char* kRuleColours[] = {"#2a6fb0", "#d9711c"};  // mean-edge, mean-face-area
constexpr const char* kConstraintColours[] = {"#2a6fb0", "#2f9e62", "#8a5bd0", "#d9a514",
                                              "#c0392b"};

/// By boundary rule, and by constraint so that curves that lie on each other can be told apart.
constexpr const char* kDashes[] = {"", "7 4", "2 3", "9 3 2 3", "1 5"};

/// The curve of the rows that `belongs` takes.
template <class Belongs, class X>
Curve curve_of(const Study& study, std::string name, std::string colour, std::string dashes,
               Belongs belongs, X x) {
  Curve curve{std::move(name), std::move(colour), std::move(dashes), {}};
  for (const StudyRow& row : study.rows) {
    if (!belongs(row) || !row.mean_error || !(*row.mean_error > 0)) continue;
    curve.points.emplace_back(x(row), *row.mean_error);
  }
  std::ranges::sort(curve.points);
  return curve;
}

/// One curve for each time rule and boundary rule, with the default constraint.
template <class X>
LogPlot rules_plot(const Study& study, std::string title, std::string x_label, X x) {
  LogPlot plot{std::move(title), std::move(x_label), 0, 0, {}};
  for (const TimeRule rule : {TimeRule::kMeanEdge, TimeRule::kMeanFaceArea}) {
    for (const BoundaryRule boundary :
         {BoundaryRule::kNeumann, BoundaryRule::kDirichlet, BoundaryRule::kAverage}) {
      const auto belongs = [&](const StudyRow& row) {
        return row.rule == rule && row.boundary == boundary &&
               row.constraint == ConstraintMode::kPinSources;
      };
      if (std::ranges::none_of(study.rows, belongs)) continue;
      plot.curves.push_back(curve_of(
          study, to_text(TimeStep{rule, 1, 0}) + ", " + to_text(boundary),
          kRuleColours[static_cast<int>(rule)], kDashes[static_cast<int>(boundary)], belongs, x));
    }
  }
  return plot;
}

LogPlot constraints_plot(const Study& study) {
  LogPlot plot{"Constraint modes, mean-edge", "time factor m", 0, 0, {}};
  std::size_t i = 0;
  for (const Constraint& constraint : study_constraints()) {
    const auto belongs = [&](const StudyRow& row) {
      return row.rule == TimeRule::kMeanEdge && row.boundary == BoundaryRule::kNeumann &&
             row.constraint == constraint.mode;
    };
    plot.curves.push_back(curve_of(study, to_text(constraint), kConstraintColours[i], kDashes[i],
                                   belongs, [](const StudyRow& row) { return row.factor; }));
    ++i;
  }
  return plot;
}

/// The same range of errors in all plots: whole steps of 1, 2 and 5 around what there is.
void share_range(std::vector<LogPlot>& plots) {
  double low = 0, high = 0;
  for (const LogPlot& plot : plots) {
    for (const Curve& curve : plot.curves) {
      for (const auto& [unused, y] : curve.points) {
        low = low > 0 ? std::min(low, y) : y;
        high = std::max(high, y);
      }
    }
  }
  if (!(low > 0)) low = high = 0.01;
  for (LogPlot& plot : plots) {
    plot.y_low = low / 1.5;
    plot.y_high = std::max(high * 1.5, low * 3);
  }
}

}  // namespace

std::string study_svg(const std::string& model, const Study& study) {
  constexpr double kWidth = 290, kHeight = 250, kLeft = 62, kTop = 110, kStep = 370;
  std::vector<LogPlot> plots = {
      rules_plot(study, "Both time rules over m", "time factor m",
                 [](const StudyRow& row) { return row.factor; }),
      rules_plot(study, "The same over t: one curve", "t / h\u00b2, h the mean edge length",
                 [](const StudyRow& row) { return row.unit_t; }),
      constraints_plot(study)};
  share_range(plots);
  std::string body;
  for (std::size_t i = 0; i < plots.size(); ++i) {
    body += plot_svg(plots[i], kLeft + kStep * static_cast<double>(i), kTop, kWidth, kHeight);
  }
  const StudyRow* best = best_row(study);
  const std::string found = best == nullptr
                                ? ""
                                : "; least: " + percent(*best->mean_error) +
                                      " at t = " + significant(best->unit_t, 3) + " h\u00b2";
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1110 540\" width=\"1110\" "
         "height=\"540\">\n<style>" +
         std::string(kStyle) +
         "</style>\n<rect width=\"1110\" height=\"540\" fill=\"#ffffff\"/>\n" +
         "<text class=\"head\" x=\"62\" y=\"36\">Mean error of the heat method on " +
         escaped(one_line(model)) + "</text>\n<text class=\"soft\" x=\"62\" y=\"58\">against " +
         to_text(study.reference) + found + "</text>\n" + body + "</svg>\n";
}

}  // namespace geotherm::app
