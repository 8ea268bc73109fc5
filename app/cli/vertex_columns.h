// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/cli/cli_app.h"
#include "app/session/outputs.h"
#include "geotherm/error.h"
#include "geotherm/mesh.h"

// Files of several numbers for each vertex.
namespace geotherm::app {

/// Numbers of the vertices by what they are called there.
struct VertexColumn {
  std::string name;
  std::vector<double> values;  ///< V
};

/// Adds -o and --json. `what`: "vectors", for the help; `pictures`: .svg is one, too.
void add_column_options(CLI::App& command, std::vector<std::string>& outputs, std::string& json,
                        const std::string& what, bool pictures);

/// Errors: kNotAvailable (an ending), those of Outputs::expect().
Result<void> expect_columns(const std::vector<std::string>& outputs, const std::string& json,
                            bool pictures, Outputs& expected);

/// Writes .csv (vertex, then the columns; "-" into `standard_output`), .npy (V, or V x columns) or
/// .ply (the mesh with properties). Errors: kBadFile, kOutOfMemory.
Result<void> write_columns(const std::string& path, const TriangleMesh& mesh,
                           const std::vector<VertexColumn>& columns, Outputs& outputs,
                           std::string& standard_output);

}  // namespace geotherm::app
