// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "app/answer_check.h"
#include "app/chart.h"
#include "app/study/study_report.h"
#include "app/text.h"
#include "geotherm/options.h"

namespace geotherm::app {
namespace {

using chart::Panel;
using chart::Series;

std::string tick_percent(double error) { return significant(100 * error, 2) + " %"; }

/// No powers of ten in letters where digits are as short.
std::string tick_number(double value) {
  return value >= 1 && value < 1e5 ? grouped(std::llround(value)) : significant(value, 2);
}

/// A class of the style sheet: a colour, and dashes, so that curves that lie on each other can be
/// told apart.
std::string kind_of(std::size_t colour, std::size_t dashes) {
  return "k" + std::to_string(colour) + " d" + std::to_string(dashes);
}

/// The curve of the rows that `belongs` takes.
template <class Belongs, class X>
Series series_of(const Study& study, std::string name, std::string kind, Belongs belongs, X x) {
  Series series{.kind = std::move(kind), .name = std::move(name)};
  for (const StudyRow& row : study.rows) {
    if (!belongs(row) || !row.mean_error) continue;
    series.joined.push_back({x(row), *row.mean_error, chart::Mark::kSmallDot});
  }
  std::ranges::sort(series.joined, {}, &chart::Point::x);
  return series;
}

Panel panel_of(std::string title, std::string x_label) {
  return {std::move(title), std::move(x_label), tick_number, tick_percent, {}, {}, 1};
}

/// One curve for each time rule and boundary rule, with the default constraint.
template <class X>
Panel rules_panel(const Study& study, std::string title, std::string x_label, X x) {
  Panel panel = panel_of(std::move(title), std::move(x_label));
  std::size_t colour = 0;
  for (const TimeRule rule : {TimeRule::kMeanEdge, TimeRule::kMeanFaceArea}) {
    std::size_t dashes = 0;
    for (const BoundaryRule boundary :
         {BoundaryRule::kNeumann, BoundaryRule::kDirichlet, BoundaryRule::kAverage}) {
      const auto belongs = [&](const StudyRow& row) {
        return row.rule == rule && row.boundary == boundary &&
               row.constraint == ConstraintMode::kPinSources;
      };
      const std::string kind = kind_of(colour, dashes++);
      if (std::ranges::none_of(study.rows, belongs)) continue;
      panel.series.push_back(series_of(
          study, to_text(TimeStep{rule, 1, 0}) + ", " + to_text(boundary), kind, belongs, x));
    }
    ++colour;
  }
  return panel;
}

Panel constraints_panel(const Study& study) {
  Panel panel = panel_of("Constraint modes, mean-edge", "time factor m");
  std::size_t i = 0;
  for (const Constraint& constraint : study_constraints()) {
    const auto belongs = [&](const StudyRow& row) {
      return row.rule == TimeRule::kMeanEdge && row.boundary == BoundaryRule::kNeumann &&
             row.constraint == constraint.mode;
    };
    panel.series.push_back(series_of(study, to_text(constraint), kind_of(i, i), belongs,
                                     [](const StudyRow& row) { return row.factor; }));
    ++i;
  }
  return panel;
}

}  // namespace

std::string study_svg(const std::string& model, const Study& study) {
  constexpr double kWidth = 290, kHeight = 250, kLeft = 62, kTop = 110, kStep = 370;
  std::vector<Panel> panels = {
      rules_panel(study, "Both time rules over m", "time factor m",
                  [](const StudyRow& row) { return row.factor; }),
      rules_panel(study, "The same over t: one curve", "t / h\u00b2, h the mean edge length",
                  [](const StudyRow& row) { return row.unit_t; }),
      constraints_panel(study)};
  std::vector<double> errors;
  for (const StudyRow& row : study.rows) errors.push_back(row.mean_error.value_or(0));
  const StudyRow* best = best_row(study);
  const std::string found = best == nullptr
                                ? ""
                                : "; least: " + percent(*best->mean_error) +
                                      " at t = " + significant(best->unit_t, 3) + " h\u00b2";
  std::string body =
      chart::text(kLeft, 36, "start", "head",
                  "Mean error of the heat method on " + one_line(model)) +
      chart::text(kLeft, 60, "start", "soft", "against " + to_text(study.reference) + found);
  double left = kLeft;
  for (Panel& panel : panels) {
    panel.y_values = errors;
    body += panel_svg(panel, {left, kTop, kWidth, kHeight});
    left += kStep;
  }
  return chart::page(1110, 560, body);
}

}  // namespace geotherm::app
