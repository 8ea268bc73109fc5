// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "app/error_check.h"

namespace geotherm::app {

/// Whether there is a cause worth looking for: distances of the heat method, less than good.
bool needs_cause(const ErrorReport& report, MethodKind checked);

/// Looks for the option to which most of the error is due (diagnose()), and says in the report's
/// verdict what it is, what it costs and how it is cured. Preconditions: needs_cause(); the report
/// is one of these distances, which are the answer of `options`, whose HeatMethod::relative_t() is
/// given. Errors: kCancelled.
Result<void> find_cause(ErrorReport& report, const std::shared_ptr<const TriangleMesh>& mesh,
                        const MethodOptions& options, double relative_t, const SourceSet& sources,
                        std::span<const double> distances, const Progress& progress);

}  // namespace geotherm::app
