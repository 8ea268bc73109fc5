// SPDX-License-Identifier: MIT
#include <cstdint>
#include <new>
#include <string>

#include "geotherm/domains.h"
#include "solver/core/text.h"
#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/io/format_writers.h"
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

/// VTK's XML image; the arrays are appended raw, with 64-bit lengths. Axes that run backwards are
/// turned by the matrix Direction.
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
  std::uint64_t offset = 0;
  const auto array = [&offset](const std::string& type, const std::string& name,
                               std::uint64_t bytes) {
    std::string tag = "<DataArray type=\"" + type + "\" Name=\"" + name +
                      "\" format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
    offset += sizeof(std::uint64_t) + bytes;
    return tag;
  };
  const std::uint64_t count = data.distances.size();
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<ImageData WholeExtent=\"" +
      extent + "\" Origin=\"" + origin + "\" Spacing=\"" + spacing + "\" Direction=\"" + direction +
      "\">\n<Piece Extent=\"" + extent + "\">\n<PointData Scalars=\"distance\">\n" +
      array("Float64", "distance", count * sizeof(double));
  if (!data.nearest.empty()) text += array("Int32", "nearest_source", count * sizeof(Index));
  for (const DataField& field : data.fields) {
    text += array("Float64", field.name, count * sizeof(double));
  }
  text += "</PointData>\n<CellData/>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_";
  text.reserve(text.size() + offset + 64);
  const auto append = [&text](std::span<const double> values) {
    io::append_little(text, std::uint64_t{values.size() * sizeof(double)});
    for (const double each : values) io::append_little(text, each);
  };
  append(data.distances);
  if (!data.nearest.empty()) {
    io::append_little(text, std::uint64_t{count * sizeof(Index)});
    for (const Index each : data.nearest) io::append_little(text, each);
  }
  for (const DataField& field : data.fields) append(field.values);
  return text + "\n</AppendedData>\n</VTKFile>\n";
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
  const std::string extension = io::written_extension(path);
  if (extension == ".csv" || extension == ".npy" || extension == ".vti") return {};
  return Error{
      ErrorCode::kNotAvailable,
      io::printable(path) + ": unknown extension \"" + io::printable(extension) + "\" for a grid",
      {"there are .csv .npy .vti"}};
}

Result<void> write_distances(const std::string& path, const Grid& grid,
                             std::span<const double> distances, std::span<const Index> nearest,
                             std::span<const DataField> fields) try {
  if (auto known = check_grid_distances_path(path); !known) return known;
  const GridData data{distances, nearest, fields};
  if (auto fits = check_grid_values(path, grid, data); !fits) return fits;
  const std::string extension = io::written_extension(path);
  if (extension == ".vti") return write_file(path, vti_bytes(grid, data));
  if (extension == ".npy") return write_file(path, grid_npy_bytes(grid, data));
  return write_file(path, io::csv_bytes(distances, nearest, fields));
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory, io::printable(path) + ": not enough memory to write it"};
}

}  // namespace geotherm
