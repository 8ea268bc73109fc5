// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/load_model.h"
#include "solver/heat/heat_options.h"
#include "solver/mesh/surface_point.h"

namespace geotherm::app {

/// One backend on one model. What could not be measured is empty.
struct CompareRow {
  std::string model;
  Index vertices = 0, faces = 0;
  std::string backend;
  std::optional<double> setup_ms;
  std::optional<double> query_ms_median, query_ms_min, query_ms_max;
  std::optional<double> batch_query_ms;  ///< a source set, 16 in one call
  std::optional<double> factor_mb;
  /// Since the backend began where the system lets the peak be reset, else of the whole process;
  /// the mesh and what earlier backends left behind count as well.
  std::optional<double> peak_rss_mb;
  std::optional<double> max_difference, mean_difference;
  std::string status;   ///< "ok", or the kind of failure
  std::string message;  ///< why something is missing; may stand beside "ok"
};

struct CompareTask {
  HeatOptions options;                ///< but for the backend
  std::vector<std::string> backends;  ///< in the order of the rows
  std::string reference;              ///< one of them
  std::vector<SourceSet> queries;     ///< each one query; the first answers are compared
  std::vector<SourceSet> batch;       ///< solved in one call
};

/// Runs the task through each backend, one after the other. A failure is a row with its message.
/// Differences are those of the distances from the reference's, divided by its largest one: the
/// largest and the mean over the vertices of the first 10 queries. Iterative backends answer as
/// many queries as they can in about five seconds (one at least), and skip the batch where it would
/// take longer; `message` says so. The only error: kCancelled.
Result<std::vector<CompareRow>> compare_backends(const Model& model, const CompareTask& task,
                                                 const Progress& progress = {});

}  // namespace geotherm::app
