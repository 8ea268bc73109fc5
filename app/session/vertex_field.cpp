// SPDX-License-Identifier: MIT
#include "app/session/vertex_field.h"

#include <algorithm>
#include <utility>

#include "app/picture/direction_picture.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/text.h"
#include "solver/grid/io/raw_grid.h"
#include "solver/mesh/io/input_file.h"

namespace geotherm::app {
namespace {

/// A log map has distance, direction, x and y; of vectors x, y and z come first, and transport adds
/// components and frames.
constexpr std::size_t kLogMap = 4, kVectors = 3, kTransported = 11;

std::vector<double> column_of(const VertexField& field, std::size_t k) {
  std::vector<double> out;
  for (std::size_t i = k; i < field.values.size(); i += field.columns) {
    out.push_back(field.values[i]);
  }
  return out;
}

}  // namespace

Result<VertexField> read_vertex_field(const std::string& path, const Model& model) {
  if (auto surface = refuse_space(model, "values of vertices are drawn"); !surface) {
    return surface.error();
  }
  auto file = io::FileBytes::read(path);
  if (!file) return file.error();
  const std::string name = io::printable(path);
  auto table =
      io::guarded_read(name, "values", file->bytes().size(),
                       [&]() -> Result<io::NpyTable> { return io::read_npy_table(file->bytes()); });
  if (!table) return table.error();
  const auto vertices = static_cast<std::size_t>(model.mesh->vertex_count());
  const std::size_t rows = table->values.size() / std::max<std::size_t>(table->columns, 1);
  if (rows != vertices) {
    return Error{ErrorCode::kBadInput,
                 name + " has " + grouped(rows) + " values and " + one_line(model.name) + " " +
                     grouped(vertices) + " vertices",
                 {"give one a vertex"}};
  }
  for (const std::size_t known : {std::size_t{1}, kVectors, kLogMap, kTransported}) {
    if (table->columns == known) return VertexField{known, std::move(table->values)};
  }
  return Error{
      ErrorCode::kBadInput,
      name + " has " + grouped(table->columns) + " columns",
      {"give 1 (values), 3 or " + std::to_string(kTransported) + " (vectors) or 4 (a log map)"}};
}

Result<void> show_field(PictureData& data, const TriangleMesh& mesh, const VertexField& field) {
  if (field.columns == 1) {
    add_field(data, field.values);
    return {};
  }
  if (field.columns == kLogMap) {
    return add_log_map(data, mesh, column_of(field, 0), column_of(field, 2), column_of(field, 3));
  }
  std::vector<Vec3> vectors;
  for (std::size_t i = 0; i < field.values.size(); i += field.columns) {
    vectors.emplace_back(field.values[i], field.values[i + 1], field.values[i + 2]);
  }
  add_vectors(data, mesh, vectors);
  return {};
}

}  // namespace geotherm::app
