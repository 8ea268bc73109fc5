// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/session/machine.h"
#include "app/session/model.h"
#include "geotherm/build_method.h"
#include "geotherm/sources.h"

namespace geotherm::app {

/// Queries of which the error is measured, at most: better answers take seconds each.
inline constexpr std::size_t kErrorQueries = 3;

/// One solver on one model. What could not be measured is empty.
struct CompareRow {
  std::string model;
  Index vertices = 0, faces = 0;
  std::optional<Index> cells;  ///< of a space, whose drawn faces are `faces`
  MethodKind method = MethodKind::kHeat;
  std::string backend;  ///< of the heat method; empty for another one
  std::optional<double> setup_ms;
  std::optional<double> query_ms_median, query_ms_min, query_ms_max;
  std::optional<double> batch_query_ms;  ///< a source set, 16 in one call
  std::optional<double> factor_mb;
  /// Since the backend began where the system lets the peak be reset, else of the whole process;
  /// the mesh and what earlier backends left behind count as well.
  std::optional<double> peak_rss_mb;
  std::optional<double> max_difference, mean_difference;
  /// Against a more accurate method: the mean relative error, and the largest one as a share of the
  /// largest distance. Empty where there is none, or this is it.
  std::optional<double> mean_error, max_error;
  MethodKind error_reference = MethodKind::kExact;
  std::size_t error_queries = 0;  ///< of the first so many queries; 0: no error was measured
  std::string status;             ///< "ok", or the kind of failure
  Warning note;                   ///< why something is missing; may stand beside "ok"

  /// The backend, or the name of another method.
  std::string name() const { return method == MethodKind::kHeat ? backend : to_text(method); }
};

struct CompareTask {
  std::vector<MethodOptions> solvers;  ///< in the order of the rows
  std::string reference;               ///< the solver_name() of one of them
  std::vector<SourceSet> queries;      ///< each one query; the first answers are compared
  std::vector<SourceSet> batch;        ///< solved in one call
};

/// Runs the task through each solver, one after the other. A failure is a row with its note.
/// Differences are those of the distances from the reference's, divided by its largest one: the
/// largest and the mean over the vertices of the first 10 queries. Errors are those of the first
/// kErrorQueries against the best method that fits the mesh (reference_for()). Iterative backends
/// answer as many queries as they can in about five seconds (one at least), and skip the batch
/// where it would take longer; `note` says so. The only error: kCancelled.
Result<std::vector<CompareRow>> compare_backends(const Model& model, const CompareTask& task,
                                                 const Progress& progress = {});

/// One heading, one row a backend and model, then the messages.
std::string compare_table(const Machine& machine, std::span<const CompareRow> rows);

/// The keys of a row as heading; an empty field where there is no figure.
std::string compare_csv(std::span<const CompareRow> rows);

/// {"machine", "rows"}; null where there is no figure.
std::string compare_json(const Machine& machine, std::span<const CompareRow> rows);

/// A page that needs nothing else: the table, and bars of set-up and query on a logarithmic scale.
std::string compare_html(const Machine& machine, std::span<const CompareRow> rows);

/// What `text` names, separated by commas: backends of the heat method, other methods, or `all` for
/// all backends; each once. The options are those of `base` otherwise. Errors: kNotAvailable, with
/// the names there are.
Result<std::vector<MethodOptions>> solvers_named(const std::string& text,
                                                 const MethodOptions& base);

}  // namespace geotherm::app
