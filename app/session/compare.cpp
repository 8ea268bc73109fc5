// SPDX-License-Identifier: MIT
#include "app/session/compare.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "app/session/machine.h"
#include "app/session/model_solver.h"
#include "app/session/progress.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/accuracy.h"
#include "geotherm/backend.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

/// Milliseconds that an iterative backend, or the exact method, may spend on queries, and again on
/// the batch.
constexpr double kSlowBudget = 5000;

/// The faster one counts: the first has the system clear the memory that it asks for, which says
/// more of who comes first in the table than of the solver.
constexpr int kBatches = 2;

/// Answers that are kept for the differences; all of them would fill the memory with 20,000
/// queries.
constexpr std::size_t kCompared = 10;

using Answers = std::vector<std::vector<double>>;  // one a query, of the first ones

std::string status_name(ErrorCode code) {
  switch (code) {
    case ErrorCode::kBadInput:
    case ErrorCode::kBadFile:
      return "bad input";
    case ErrorCode::kNotAvailable:
      return "not available";
    case ErrorCode::kNumericalFailure:
      return "numerical failure";
    case ErrorCode::kBudgetEnded:
      return "budget ended";
    case ErrorCode::kOutOfMemory:
      return "out of memory";
    case ErrorCode::kCancelled:
      return "cancelled";
    case ErrorCode::kNoDevice:
      return "no device";
  }
  return "failed";
}

void fail(CompareRow& row, Error error) {
  row.status = status_name(error.code);
  error.subject.clear();  // the backend stands beside it
  row.note = warning_of(std::move(error));
}

void add_message(CompareRow& row, const std::string& text) {
  row.note.message += (row.note.message.empty() ? "" : "; ") + text;
}

double median(std::vector<double> values) {
  const std::size_t middle = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(middle),
                   values.end());
  if (values.size() % 2 == 1) return values[middle];
  return (values[middle] +
          *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(middle))) /
         2;
}

/// Works on one row; what fails ends the row only.
class Runner {
 public:
  Runner(const CompareTask& task, const Progress& progress) : task_(task), progress_(progress) {}

  Answers run(const Model& model, MethodOptions options, CompareRow& row) {
    options.strict = true;  // a row is about its own backend
    reset_peak_rss();
    ModelSolver solver(unnamed(model));
    const auto ready = solver.prepare(options, progress_);
    if (!ready) {
      fail(row, ready.error());
      return {};
    }
    const DistanceMethod& method = *ready->method;
    row.setup_ms = method.timing().setup;
    const auto backend = find_backend(row.backend);
    slow_ = (backend && (*backend)->iterative()) || options.method == MethodKind::kExact;
    Answers answers = ask_each(method, row);
    if (row.status == "ok") ask_batch(method, row);
    row.factor_mb = method.memory_mb();
    row.peak_rss_mb = peak_rss_mb();
    return answers;
  }

 private:
  Answers ask_each(const DistanceMethod& method, CompareRow& row) {
    Answers answers;
    std::vector<double> times;
    const Stopwatch watch;
    for (const SourceSet& query : task_.queries) {
      if (slow_ && !times.empty() && watch.milliseconds() > kSlowBudget) break;
      const double share =
          static_cast<double>(times.size()) / static_cast<double>(task_.queries.size());
      if (!report(progress_, "queries", share)) {
        fail(row, {ErrorCode::kCancelled, "cancelled"});
        return answers;
      }
      const auto within = [&](std::string_view, double) {
        return report(progress_, "queries", share);
      };
      auto result = method.solve(query, {.quality = false, .fields = false}, within);
      if (!result) {
        fail(row, result.error());
        return answers;
      }
      times.push_back(result->timing.query);
      if (answers.size() < kCompared) answers.push_back(std::move(result->distances));
    }
    row.query_ms_median = median(times);
    row.query_ms_min = *std::min_element(times.begin(), times.end());
    row.query_ms_max = *std::max_element(times.begin(), times.end());
    if (times.size() < task_.queries.size()) {
      add_message(row,
                  std::to_string(times.size()) + " of " +
                      counted(static_cast<std::int64_t>(task_.queries.size()), "query", "queries") +
                      ": a slow solver is given " + significant(kSlowBudget / 1000) + " s");
    }
    return answers;
  }

  void ask_batch(const DistanceMethod& method, CompareRow& row) {
    const auto count = static_cast<double>(task_.batch.size());
    if (slow_ && *row.query_ms_median * count > kSlowBudget) {
      add_message(row, "the batch was left out: " + std::to_string(task_.batch.size()) +
                           " queries would take " +
                           milliseconds(*row.query_ms_median * count / 1000) + " s");
      return;
    }
    for (int run = 0; run < kBatches; ++run) {
      const Stopwatch watch;
      const auto results =
          method.solve_each(task_.batch, {.quality = false, .fields = false}, progress_);
      if (!results) return fail(row, results.error());
      const double milliseconds = watch.milliseconds() / count;
      row.batch_query_ms = std::min(row.batch_query_ms.value_or(milliseconds), milliseconds);
      if (slow_) return;
    }
  }

  const CompareTask& task_;
  const Progress& progress_;
  bool slow_ = false;
};

void measure_difference(const Answers& answers, const Answers& reference, CompareRow& row) {
  double largest = 0, sum = 0, count = 0;
  for (std::size_t q = 0; q < std::min(answers.size(), reference.size()); ++q) {
    double scale = 0;
    for (const double d : reference[q]) {
      if (std::isfinite(d)) scale = std::max(scale, d);
    }
    for (std::size_t v = 0; v < reference[q].size(); ++v) {
      const double a = answers[q][v];
      const double b = reference[q][v];
      if (std::isfinite(a) != std::isfinite(b)) {
        row.status = status_name(ErrorCode::kNumericalFailure);
        add_message(row, "vertex " + std::to_string(v) + " of query " + std::to_string(q) +
                             " is reached by one backend and not by the other");
        return;
      }
      if (!std::isfinite(a)) continue;
      const double difference = scale > 0 ? std::abs(a - b) / scale : std::abs(a - b);
      largest = std::max(largest, difference);
      sum += difference;
      ++count;
    }
  }
  if (count == 0) return;
  row.max_difference = largest;
  row.mean_difference = sum / count;
}

void measure_error(const Answers& answers, const Answers& better, CompareRow& row) {
  const std::size_t count = std::min(answers.size(), better.size());
  const DistanceError error =
      joint_error(std::span(answers).first(count), std::span(better).first(count)).figures;
  if (error.worst == kNoIndex) return;
  row.mean_error = error.mean_relative;
  row.max_error = error.max_of_range;
  row.error_queries = count;
}

CompareRow empty_row(const Model& model, const MethodOptions& solver) {
  CompareRow row;
  row.model = model.name;
  row.vertices = model.mesh->vertex_count();
  row.faces = model.mesh->face_count();
  if (model.space) row.cells = model.space->cell_count();
  row.method = solver.method;
  if (solver.method == MethodKind::kHeat) row.backend = solver.backend;
  row.status = "ok";
  return row;
}

}  // namespace

Result<std::vector<CompareRow>> compare_backends(const Model& model, const CompareTask& task,
                                                 const Progress& progress) {
  std::vector<CompareRow> rows;
  // The reference first: only its answers are kept.
  std::vector<std::size_t> order;
  for (const MethodOptions& solver : task.solvers) {
    rows.push_back(empty_row(model, solver));
    order.push_back(order.size());
  }
  std::stable_partition(order.begin(), order.end(), [&](std::size_t i) {
    return solver_name(task.solvers[i]) == task.reference;
  });
  ModelSolver solver(model);
  const MethodKind best = solver.reference_of(MethodKind::kHeat, {Check::kAuto});
  const auto better = solver.reference(
      best, std::span(task.queries).first(std::min(task.queries.size(), kErrorQueries)),
      task.solvers.empty() ? 0 : task.solvers.front().threads,
      with_prefix(progress, model.name + ", errors: "));
  Answers reference;
  for (const std::size_t i : order) {
    CompareRow& row = rows[i];
    row.error_reference = best;
    const Progress named = with_prefix(progress, model.name + ", " + row.name() + ": ");
    Answers answers = Runner(task, named).run(model, task.solvers[i], row);
    if (row.status == "cancelled") return cancelled_error();
    if (row.status != "ok") continue;
    if (better && solver.is_better(best, row.method)) {
      measure_error(answers, better->distances, row);
    }
    const bool is_reference = row.name() == task.reference;
    if (is_reference) reference = std::move(answers);
    if (reference.empty()) {
      add_message(row, "no difference: the reference " + task.reference + " failed");
    } else {
      measure_difference(is_reference ? reference : answers, reference, row);
    }
  }
  return rows;
}

namespace {

Result<MethodOptions> solver_named(const std::string& name, const MethodOptions& base) {
  MethodOptions options = base;
  const auto method = parse<MethodKind>(name);
  if (method && *method != MethodKind::kHeat) {
    options.method = *method;
    return options;
  }
  const auto backend = find_backend(name);
  if (!backend) {
    std::vector<std::string> names = backend_names();
    for (const std::string& kind : all_names<MethodKind>()) {
      if (kind != to_text(MethodKind::kHeat)) names.push_back(kind);
    }
    Error error = backend.error();
    error.hint = {method ? "heat runs on a backend: name one of " + joined(backend_names())
                         : geotherm::known_words(name, names)};
    return error;
  }
  options.method = MethodKind::kHeat;
  options.backend = name;
  return options;
}

}  // namespace

Result<std::vector<MethodOptions>> solvers_named(const std::string& text,
                                                 const MethodOptions& base) {
  std::vector<MethodOptions> solvers;
  const auto add = [&](const std::string& name) -> Result<void> {
    auto solver = solver_named(name, base);
    if (!solver) return solver.error();
    const bool known = std::ranges::any_of(solvers, [&](const MethodOptions& other) {
      return solver_name(other) == solver_name(*solver);
    });
    if (!known) solvers.push_back(*std::move(solver));
    return {};
  };
  for (const std::string_view part : split(text, ',')) {
    const std::string name(trimmed(part));
    const std::vector<std::string> meant =
        name == "all" ? backend_names() : std::vector<std::string>{name};
    for (const std::string& each : meant) {
      if (auto added = add(each); !added) return added.error();
    }
  }
  return solvers;
}

}  // namespace geotherm::app
