// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/session/model.h"
#include "geotherm/error.h"
#include "geotherm/progress.h"

namespace geotherm::app {

/// The model in a file, a pipe or standard input (kStandardInput) by what it holds, or is taken
/// for. It is opened once. Errors: those of load_model().
Result<Model> read_model(const std::string& path, const ModelReading& reading,
                         const Progress& progress);

}  // namespace geotherm::app
