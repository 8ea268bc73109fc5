// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/picture/picture_data.h"
#include "app/session/model.h"
#include "geotherm/error.h"

// Numbers of vertices from a file that pictures show in place of distances.
namespace geotherm::app {

/// Values, vectors or a log map of the vertices of a model.
struct VertexField {
  std::size_t columns = 1;     ///< 1: values; 3, or those of `transport`: vectors; 4: a log map
  std::vector<double> values;  ///< V x columns
};

/// Reads a .npy array. Errors: kBadFile, kBadInput (a space; other numbers of rows than vertices,
/// other columns).
Result<VertexField> read_vertex_field(const std::string& path, const Model& model);

/// Shows it. Errors: kOutOfMemory.
Result<void> show_field(PictureData& data, const TriangleMesh& mesh, const VertexField& field);

}  // namespace geotherm::app
