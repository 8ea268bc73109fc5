// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "bench/measure.h"
#include "geotherm/mesh.h"

namespace geotherm::bench {

/// Reading of one OBJ file. Times are the least of several runs, in turns.
struct LoadRow {
  std::string mesh;
  Index faces = 0;
  double ms = kNotMeasured;
  double tinyobjloader_ms = kNotMeasured;  ///< not measured in a build without tinyobjloader
  std::string failure;                     ///< empty: none

  double ratio() const { return tinyobjloader_ms / ms; }
};

/// Writes the mesh to a temporary OBJ file with six decimals, as modellers export them, and reads
/// it `runs` times with each reader.
LoadRow measure_load(const std::string& name, const TriangleMesh& mesh, int runs);

}  // namespace geotherm::bench
