// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/core/progress.h"
#include "solver/core/result.h"
#include "solver/mesh/triangle_mesh.h"

namespace geotherm::app {

struct Model {
  std::string name;  ///< the file's name without folder and extension, or the bundled name
  std::string path;  ///< empty for a bundled model
  std::shared_ptr<const TriangleMesh> mesh;
  double load_ms = 0;              ///< reading or generating
  std::vector<std::string> notes;  ///< what reading had to do, one sentence each
};

/// `text`: a bundled model's name, else a path. Errors: kBadFile, kOutOfMemory, kCancelled.
Result<Model> load_model(const std::string& text, const Progress& progress = {});

bool is_bundled(std::string_view name);

}  // namespace geotherm::app
