// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/model_reading.h"
#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/progress.h"

namespace geotherm::app {

struct Model {
  std::string name;  ///< the file's name without folder and extension, or the bundled name
  std::string path;  ///< empty for a bundled model, - for standard input
  std::shared_ptr<const TriangleMesh> mesh;
  double load_ms = 0;              ///< reading
  std::vector<std::string> notes;  ///< what reading had to do, one sentence each
};

/// `text`: a bundled model's name, kStandardInput, else a path. Errors: kBadInput (a format or a
/// distance that does not go with the model), kBadFile, kOutOfMemory, kCancelled.
Result<Model> load_model(const std::string& text, const ModelReading& reading = {},
                         const Progress& progress = {});

}  // namespace geotherm::app
