// SPDX-License-Identifier: MIT
#include "app/cli/study.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "app/session/progress.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/accuracy.h"
#include "geotherm/options.h"

namespace geotherm::app {
namespace {

constexpr TimeRule kRules[] = {TimeRule::kMeanEdge, TimeRule::kMeanFaceArea};

/// What is solved with, in the order of the rows.
std::vector<MethodOptions> steps_of(const StudyTask& task) {
  std::vector<MethodOptions> steps;
  MethodOptions options = task.options;
  for (const TimeRule rule : kRules) {
    for (const double factor : task.factors) {
      for (const BoundaryRule boundary : task.boundaries) {
        for (const Constraint& constraint : study_constraints()) {
          options.time_step = {rule, factor, 0};
          options.boundary = boundary;
          options.constraint = constraint;
          steps.push_back(options);
        }
      }
    }
  }
  return steps;
}

std::string message_of(const StudyRow& row) {
  return row.failure ? to_text(*row.failure) : std::string();
}

}  // namespace

std::vector<Constraint> study_constraints() {
  std::vector<Constraint> all;
  for (const ConstraintMode mode :
       {ConstraintMode::kPinSources, ConstraintMode::kPinVertex, ConstraintMode::kConserveEnergy,
        ConstraintMode::kPseudoInverse, ConstraintMode::kPenalty}) {
    Constraint constraint;
    constraint.mode = mode;
    all.push_back(constraint);
  }
  return all;
}

std::vector<double> study_factors(double least, double most, int count) {
  // As many digits as tell neighbours apart, two at least.
  const double ratio = std::pow(most / least, 1.0 / (count - 1));
  const int digits = 2 + std::max(0, static_cast<int>(std::ceil(-std::log10(ratio - 1))));
  std::vector<double> factors = {least};
  for (int i = 1; i + 1 < count; ++i) {
    const double factor = least * std::pow(most / least, static_cast<double>(i) / (count - 1));
    const double unit = std::pow(10.0, std::floor(std::log10(factor)) + 1 - digits);
    const double rounded = std::round(factor / unit) * unit;
    if (rounded > factors.back() && rounded < most) factors.push_back(rounded);
  }
  factors.push_back(most);
  return factors;
}

Result<Study> study_of(const Model& model, const StudyTask& task, const Progress& progress) {
  if (!task.sources.offsets.empty()) {
    return Error{ErrorCode::kBadInput,
                 "the heat method takes no offsets of sources",
                 {"leave out what follows the @"}};
  }
  ModelSolver solver(unnamed(model));
  const auto reference = solver.reference(solver.reference_of(MethodKind::kHeat, {Check::kAuto}),
                                          {&task.sources, 1}, task.options.threads,
                                          with_prefix(part_of(progress, 0.0, 0.1), "reference: "));
  if (!reference) return about_model(model.name, reference.error());
  const std::vector<double>& better = reference->distances.front();
  Study study;
  study.reference = reference->method;
  study.mean_edge = task.mean_edge;
  study.largest_distance = summarize(better).max;
  const auto take = [&study](const StudyRow& row) {
    study.rows.push_back(row);
    return true;
  };
  const auto swept =
      sweep(solver, task.sources, steps_of(task), better, take, part_of(progress, 0.1, 1.0));
  if (!swept) return swept.error();
  const auto failed = [](const StudyRow& row) { return !row.mean_error; };
  if (std::ranges::all_of(study.rows, failed) && study.rows.front().failure) {
    return Error{ErrorCode::kNumericalFailure,
                 "no answer could be had: " + message_of(study.rows.front())};
  }
  const auto measured = std::ranges::find_if_not(study.rows, failed);
  if (model.space && measured != study.rows.end()) {  // the width of its cells
    study.mean_edge = std::sqrt(measured->t / measured->unit_t);
  }
  return study;
}

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
  return row != nullptr && row->mean_error ? percent_text(*row->mean_error) : "-";
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
                   row->max_error ? percent_text(*row->max_error) : "-",
                   row->source_distance ? percent_text(*row->source_distance) : "-"});
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
          {"message", message_of(row)}};
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
  text += '\n' + constraints_table(study) + "\nbest: " + percent_text(*best->mean_error) +
          " with " + words_of(*best) + ", t = " + significant(best->unit_t) + " h^2\n";
  std::set<std::string> messages;
  for (const StudyRow& row : study.rows) {
    if (row.failure && messages.insert(message_of(row)).second) {
      text += words_of(row) + ": " + one_line(message_of(row)) + '\n';
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
