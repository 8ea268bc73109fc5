// SPDX-License-Identifier: MIT
#include <cstdint>
#include <string>

#include "geotherm/domains.h"
#include "solver/core/text.h"
#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/format_writers.h"
#include "solver/mesh/io/vtk_writer.h"
#include "solver/mesh/output_file.h"

namespace geotherm {
namespace {

struct GridData {
  std::span<const double> distances;
  std::span<const Index> nearest;
  std::span<const DataField> fields;
};

/// An array of the grid's shape, its last axis x; nearest sources are one more axis behind it.
std::string grid_npy_bytes(const Grid& grid, const GridData& data) {
  std::vector<std::uint64_t> shape;
  for (int e = grid.three_axes || grid.size[2] > 1 ? 2 : 1; e >= 0; --e) {
    shape.push_back(static_cast<std::uint64_t>(grid.size[static_cast<std::size_t>(e)]));
  }
  if (!data.nearest.empty()) shape.push_back(2);
  std::string bytes = io::npy_header("<f8", shape);
  bytes.reserve(bytes.size() + sizeof(double) * (data.distances.size() + data.nearest.size()));
  for (std::size_t v = 0; v < data.distances.size(); ++v) {
    io::append_little(bytes, data.distances[v]);
    if (!data.nearest.empty()) io::append_little(bytes, static_cast<double>(data.nearest[v]));
  }
  return bytes;
}

/// VTK's XML image. Axes that run backwards are turned by the matrix Direction.
std::string vti_bytes(const Grid& grid, const GridData& data) {
  std::string extent, origin, spacing, direction;
  for (std::size_t e = 0; e < 3; ++e) {
    const std::string space = e > 0 ? " " : "";
    extent += space + "0 " + std::to_string(grid.size[e] - 1);
    origin += space + number_text(grid.origin[static_cast<Eigen::Index>(e)]);
    spacing += space + number_text(std::abs(grid.spacing[e]));
    for (std::size_t f = 0; f < 3; ++f) {
      const char* const along = grid.spacing[e] < 0 ? "-1" : "1";
      direction += (direction.empty() ? "" : " ") + std::string(e == f ? along : "0");
    }
  }
  const std::string attributes = " WholeExtent=\"" + extent + "\" Origin=\"" + origin +
                                 "\" Spacing=\"" + spacing + "\" Direction=\"" + direction + '"';
  return io::vtk_bytes("ImageData", attributes, "Extent=\"" + extent + '"',
                       [&](io::VtkWriter& file) {
                         file.text("<PointData Scalars=\"distance\">\n");
                         file.answers(data.distances, data.nearest);
                         for (const DataField& field : data.fields) {
                           file.array<double>(field.name, std::span<const double>(field.values));
                         }
                         file.text("</PointData>\n<CellData/>\n");
                       });
}

/// Whether the numbers have a value for each sample, and the file a place for them.
Result<void> check_grid_values(const std::string& path, const Grid& grid, const GridData& data) {
  const auto samples = static_cast<std::size_t>(grid.sample_count());
  std::size_t wrong = data.distances.size();
  if (wrong == samples && !data.nearest.empty()) wrong = data.nearest.size();
  for (const DataField& field : data.fields) {
    if (wrong == samples) wrong = field.values.size();
    if (field.place != DataField::Place::kVertices || io::written_extension(path) == ".npy") {
      return Error{ErrorCode::kNotAvailable,
                   io::printable(path) + ": there is no place for the field \"" +
                       io::printable(field.name) + '"',
                   {"write .vti"}};
    }
  }
  if (wrong == samples) return {};
  return Error{ErrorCode::kBadInput, io::printable(path) + ": " + std::to_string(wrong) +
                                         " values for " + std::to_string(samples) + " samples"};
}

}  // namespace

Result<void> check_grid_distances_path(const std::string& path) {
  return check_written(path, ".csv .npy .vti", " for a grid");
}

Result<void> write_distances(const std::string& path, const Grid& grid,
                             std::span<const double> distances, std::span<const Index> nearest,
                             std::span<const DataField> fields) {
  if (auto known = check_grid_distances_path(path); !known) return known;
  const GridData data{distances, nearest, fields};
  if (auto fits = check_grid_values(path, grid, data); !fits) return fits;
  const std::string extension = io::written_extension(path);
  return write_made(path, [&] {
    if (extension == ".vti") return vti_bytes(grid, data);
    if (extension == ".npy") return grid_npy_bytes(grid, data);
    return io::csv_bytes(distances, nearest, fields);
  });
}

}  // namespace geotherm
