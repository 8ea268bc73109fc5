// SPDX-License-Identifier: MIT
#include "app/study/study_run.h"

#include <algorithm>
#include <cmath>

#include "app/progress_bar.h"
#include "app/session/model_solver.h"
#include "app/told.h"
#include "geotherm/accuracy.h"
#include "geotherm/heat_method.h"

namespace geotherm::app {
namespace {

constexpr TimeRule kRules[] = {TimeRule::kMeanEdge, TimeRule::kMeanFaceArea};

/// One method after the other: the solver makes each from the last one, so that factors are shared
/// where only the constraint changes.
class Sweeper {
 public:
  Sweeper(const Model& model, const StudyTask& task, const std::vector<double>& better)
      : solver_({.mesh = model.mesh}), sources_{task.sources, {}}, better_(better) {
    for (const double e : better) {
      if (std::isfinite(e)) range_ = std::max(range_, e);
    }
  }

  double range() const { return range_; }

  void add(const MethodOptions& options, Study& study) {
    StudyRow row;
    row.rule = options.time_step.rule;
    row.factor = options.time_step.factor;
    row.boundary = options.boundary;
    row.constraint = options.constraint.mode;
    const auto answer = solver_.solve(options, sources_, {{.quality = false}});
    if (answer) {
      measure(*answer, row);
    } else {
      row.message = told(answer.error());
    }
    study.rows.push_back(std::move(row));
  }

 private:
  void measure(const Answer& answer, StudyRow& row) const {
    row.t = answer.method->heat()->t();
    row.unit_t = answer.method->heat()->relative_t();
    const DistanceError error = distance_error(answer.result.distances, better_);
    if (error.worst == kNoIndex) return;
    row.mean_error = error.mean_relative;
    row.max_error = error.max_of_range;
    if (range_ > 0) row.source_distance = answer.result.quality.max_source_distance / range_;
  }

  ModelSolver solver_;
  ResolvedSources sources_;
  const std::vector<double>& better_;
  double range_ = 0;
};

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

Result<Study> sweep(const Model& model, const StudyTask& task, const Progress& progress) {
  if (!task.sources.offsets.empty()) {
    return Error{ErrorCode::kBadInput,
                 "the heat method takes no offsets of sources; leave out what follows the @"};
  }
  Study study;
  study.reference = reference_for(MethodKind::kHeat, model.mesh->face_count());
  const auto reference =
      solve_reference(model.mesh, study.reference, {&task.sources, 1}, task.options.threads,
                      nullptr, with_prefix(part_of(progress, 0.0, 0.1), "reference: "));
  if (!reference) return about_model(model.name, reference.error());

  study.mean_edge = task.mean_edge;
  Sweeper sweeper(model, task, reference->distances.front());
  study.largest_distance = sweeper.range();
  const std::vector<Constraint> constraints = study_constraints();
  const std::size_t total =
      std::size(kRules) * task.factors.size() * task.boundaries.size() * constraints.size();
  MethodOptions options = task.options;
  for (const TimeRule rule : kRules) {
    for (const double factor : task.factors) {
      for (const BoundaryRule boundary : task.boundaries) {
        for (const Constraint& constraint : constraints) {
          const double done = static_cast<double>(study.rows.size()) / static_cast<double>(total);
          if (!report(progress, "sweep", 0.1 + 0.9 * done)) return cancelled_error();
          options.time_step = {rule, factor, 0};
          options.boundary = boundary;
          options.constraint = constraint;
          sweeper.add(options, study);
        }
      }
    }
  }
  const auto failed = [](const StudyRow& row) { return !row.mean_error; };
  if (std::ranges::all_of(study.rows, failed) && !study.rows.front().message.empty()) {
    return Error{ErrorCode::kNumericalFailure,
                 "no answer could be had: " + study.rows.front().message};
  }
  return study;
}

}  // namespace geotherm::app
