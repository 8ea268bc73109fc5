// SPDX-License-Identifier: MIT
#include "app/study/study_report.h"

#include <algorithm>
#include <set>

#include "app/answer_check.h"
#include "app/text.h"
#include "app/text_table.h"
#include "geotherm/options.h"

namespace geotherm::app {
namespace {

using Align = TextTable::Align;

constexpr double kRoundOff = 1e-6;

std::string rule_text(TimeRule rule) { return to_text(TimeStep{rule, 1, 0}); }

std::string constraint_name(ConstraintMode mode) {
  Constraint constraint;
  constraint.mode = mode;
  return to_text(constraint);
}

std::string words_of(const StudyRow& row) {
  return rule_text(row.rule) + ", m = " + significant(row.factor) + ", " + to_text(row.boundary) +
         ", " + constraint_name(row.constraint);
}

const StudyRow* find(const Study& study, TimeRule rule, double factor, BoundaryRule boundary,
                     ConstraintMode constraint) {
  for (const StudyRow& row : study.rows) {
    if (row.rule == rule && row.factor == factor && row.boundary == boundary &&
        row.constraint == constraint) {
      return &row;
    }
  }
  return nullptr;
}

std::string cell(const StudyRow* row) {
  return row != nullptr && row->mean_error ? percent(*row->mean_error) : "-";
}

/// The values that a part of the rows has, in their order.
template <class Of>
auto values_of(const Study& study, Of of) {
  std::vector<decltype(of(study.rows.front()))> values;
  for (const StudyRow& row : study.rows) {
    if (std::ranges::find(values, of(row)) == values.end()) values.push_back(of(row));
  }
  return values;
}

std::string factors_table(const Study& study) {
  const auto rules = values_of(study, [](const StudyRow& r) { return r.rule; });
  const auto boundaries = values_of(study, [](const StudyRow& r) { return r.boundary; });
  std::vector<TextTable::Column> columns = {{"m", Align::kRight}};
  for (const TimeRule rule : rules) {
    for (const BoundaryRule boundary : boundaries) {
      columns.push_back({rule_text(rule) + ", " + to_text(boundary), Align::kRight});
    }
  }
  TextTable table(columns);
  for (const double factor : values_of(study, [](const StudyRow& r) { return r.factor; })) {
    std::vector<std::string> cells = {significant(factor)};
    for (const TimeRule rule : rules) {
      for (const BoundaryRule boundary : boundaries) {
        cells.push_back(cell(find(study, rule, factor, boundary, ConstraintMode::kPinSources)));
      }
    }
    table.add_row(cells);
  }
  return table.text();
}

std::string constraints_table(const Study& study) {
  const StudyRow* best = best_row(study);
  TextTable table({{"constraint", Align::kLeft},
                   {"mean error", Align::kRight},
                   {"max error", Align::kRight},
                   {"|d| on a source", Align::kRight}});
  for (const Constraint& constraint : study_constraints()) {
    const StudyRow* row = find(study, best->rule, best->factor, best->boundary, constraint.mode);
    if (row == nullptr) continue;
    table.add_row({constraint_name(row->constraint), cell(row),
                   row->max_error ? percent(*row->max_error) : "-",
                   row->source_distance ? percent(*row->source_distance) : "-"});
  }
  return "at m = " + significant(best->factor) + ", " + rule_text(best->rule) + ", " +
         to_text(best->boundary) + ":\n" + table.text();
}

Json figure(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json row_json(const StudyRow& row) {
  return {{"time_step", rule_text(row.rule)},
          {"time_factor", row.factor},
          {"t", row.t},
          {"t_over_h2", row.unit_t},
          {"boundary", to_text(row.boundary)},
          {"constraint", constraint_name(row.constraint)},
          {"mean_relative", figure(row.mean_error)},
          {"max_of_range", figure(row.max_error)},
          {"source_distance_of_range", figure(row.source_distance)},
          {"message", row.message}};
}

}  // namespace

const StudyRow* best_row(const Study& study) {
  const StudyRow* best = nullptr;
  for (const StudyRow& row : study.rows) {
    if (!row.mean_error) continue;
    // What differs by round-off is as good: the first of them has the default constraint.
    if (best == nullptr || *row.mean_error < *best->mean_error * (1 - kRoundOff)) best = &row;
  }
  return best;
}

std::string study_table(const std::string& model, const Study& study) {
  std::string text = one_line(model) + ": mean error of the heat method against " +
                     to_text(study.reference) + ", constraint pin-sources\n\n" +
                     factors_table(study);
  const StudyRow* best = best_row(study);
  if (best == nullptr) return text + "\nno row has an error; see --json for the messages\n";
  text += '\n' + constraints_table(study) + "\nbest: " + percent(*best->mean_error) + " with " +
          words_of(*best) + ", t = " + significant(best->unit_t) + " h^2\n";
  std::set<std::string> messages;
  for (const StudyRow& row : study.rows) {
    if (!row.message.empty() && messages.insert(row.message).second) {
      text += words_of(row) + ": " + one_line(row.message) + '\n';
    }
  }
  return text;
}

Json study_json(const std::string& model, const SourceSet& sources, const Study& study) {
  Json rows = Json::array();
  for (const StudyRow& row : study.rows) rows.push_back(row_json(row));
  const StudyRow* best = best_row(study);
  return {{"model", model},
          {"sources", sources_json(sources)},
          {"reference", to_text(study.reference)},
          {"largest_distance", study.largest_distance},
          {"mean_edge_length", study.mean_edge},
          {"best", best == nullptr ? Json(nullptr) : row_json(*best)},
          {"rows", rows}};
}

}  // namespace geotherm::app
