// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "app/solve_figures.h"
#include "app/source_spec.h"
#include "geotherm/error.h"
#include "geotherm/progress.h"

namespace geotherm::app {

/// Distances on a loaded model, and everything there is to say about them. What the library finds
/// wrong with the mesh is a failure of the work, kBadFile, not of the command line. With
/// QueryOptions::nearest the nearest sources are there whatever the method. The distances are held
/// against better ones as `check` says: SolveFigures::error, a warning where they are poor. Errors:
/// those of resolve_sources and build_method, kNumericalFailure (OnPoor::kFail), kCancelled.
Result<SolveFigures> solve_model(Model model, const MethodOptions& options,
                                 const std::vector<Source>& sources, const QueryOptions& query,
                                 const CheckSettings& check, const Progress& progress = {});

}  // namespace geotherm::app
