// SPDX-License-Identifier: MIT
#include "geotherm/path.h"

#include <algorithm>
#include <new>
#include <utility>

#include "solver/core/text.h"
#include "solver/mesh/io/byte_order.h"
#include "solver/mesh/output_file.h"

namespace geotherm {
namespace {

using io::append_little;

/// Points of the line that differ: a closed one comes back to its first.
std::size_t point_count(const SurfacePath& path) {
  return path.points.size() - (path.closed && path.points.size() > 1 ? 1 : 0);
}

bool have_values(std::span<const Polyline> lines) {
  return std::ranges::any_of(lines, [](const Polyline& line) { return line.value.has_value(); });
}

void append_numbers(std::string& text, const Vec3& p, char between) {
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) text += between;
    text += number_text(p[axis]);
  }
}

/// Lines are written piece by piece: some programs (Blender) read the first two points of an
/// element alone.
std::string obj_bytes(const TriangleMesh& mesh, std::span<const Polyline> lines) {
  std::string text, elements;
  std::size_t first = 1;
  for (const Polyline& line : lines) {
    const std::size_t count = point_count(*line.path);
    for (std::size_t i = 0; i < count; ++i) {
      text += "v ";
      append_numbers(text, position_at(mesh, line.path->points[i]), ' ');
      text += '\n';
    }
    const std::size_t pieces = count > 1 ? count - (line.path->closed ? 0 : 1) : 0;
    for (std::size_t i = 0; i < pieces; ++i) {
      elements +=
          "l " + std::to_string(first + i) + ' ' + std::to_string(first + (i + 1) % count) + '\n';
    }
    if (count == 1) elements += "p " + std::to_string(first) + '\n';
    first += count;
  }
  return text + elements;
}

/// Arrays of one VTK piece, appended raw after the XML that says where each begins.
class VtpArrays {
 public:
  std::string declare(const std::string& attributes, std::uint64_t bytes) {
    const std::string start = std::to_string(data.size());
    append_little(data, bytes);
    return "<DataArray " + attributes + " format=\"appended\" offset=\"" + start + "\"/>\n";
  }
  std::string data;
};

std::string vtp_bytes(const TriangleMesh& mesh, std::span<const Polyline> lines) {
  std::uint64_t points = 0, entries = 0;
  for (const Polyline& line : lines) {
    points += point_count(*line.path);
    entries += line.path->points.size();
  }
  const std::uint64_t count = lines.size();
  VtpArrays arrays;
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
      std::to_string(points) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" + std::to_string(count) +
      "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n";
  xml += arrays.declare("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", 24 * points);
  for (const Polyline& line : lines) {
    for (std::size_t i = 0; i < point_count(*line.path); ++i) {
      const Vec3 p = position_at(mesh, line.path->points[i]);
      for (int axis = 0; axis < 3; ++axis) append_little(arrays.data, p[axis]);
    }
  }
  xml +=
      "</Points>\n<Lines>\n" + arrays.declare("type=\"Int64\" Name=\"connectivity\"", 8 * entries);
  std::int64_t first = 0;
  for (const Polyline& line : lines) {
    const auto distinct = static_cast<std::int64_t>(point_count(*line.path));
    for (std::size_t i = 0; i < line.path->points.size(); ++i) {
      append_little(arrays.data, first + static_cast<std::int64_t>(i) % distinct);
    }
    first += distinct;
  }
  xml += arrays.declare("type=\"Int64\" Name=\"offsets\"", 8 * count);
  std::int64_t end = 0;
  for (const Polyline& line : lines) {
    append_little(arrays.data, end += static_cast<std::int64_t>(line.path->points.size()));
  }
  xml += "</Lines>\n<CellData>\n" + arrays.declare("type=\"Float64\" Name=\"length\"", 8 * count);
  for (const Polyline& line : lines) append_little(arrays.data, line.path->length);
  xml += arrays.declare("type=\"Int32\" Name=\"closed\"", 4 * count);
  for (const Polyline& line : lines) {
    append_little(arrays.data, static_cast<std::int32_t>(line.path->closed));
  }
  if (have_values(lines)) {
    xml += arrays.declare("type=\"Float64\" Name=\"value\"", 8 * count);
    for (const Polyline& line : lines) append_little(arrays.data, line.value.value_or(0));
  }
  xml += "</CellData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  return xml + arrays.data + "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace

Result<void> check_polyline_path(const std::string& path) {
  const std::string extension = io::file_extension(path);
  if (extension == ".obj" || extension == ".csv" || extension == ".vtp") return {};
  return Error{ErrorCode::kNotAvailable,
               io::printable(path) + ": unknown extension \"" + io::printable(extension) + "\"",
               {"lines can be written as .obj .csv .vtp"}};
}

std::string polyline_csv(const TriangleMesh& mesh, std::span<const Polyline> lines) {
  const bool values = have_values(lines);
  std::string text = "line,point,x,y,z,face,b0,b1,b2";
  text += values ? ",value\n" : "\n";
  for (std::size_t line = 0; line < lines.size(); ++line) {
    const SurfacePath& path = *lines[line].path;
    const std::vector<SurfacePoint> places = points_in_faces(mesh, path);
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      const SurfacePoint& point = places[i];
      text += std::to_string(line) + ',' + std::to_string(i) + ',';
      append_numbers(text, position_at(mesh, path.points[i]), ',');
      text += ',' + std::to_string(point.face);
      for (const double weight : point.weights) text += ',' + number_text(weight);
      if (values) text += ',' + number_text(lines[line].value.value_or(0));
      text += '\n';
    }
  }
  return text;
}

Result<void> write_polylines(const std::string& path, const TriangleMesh& mesh,
                             std::span<const Polyline> lines) try {
  if (auto known = check_polyline_path(path); !known) return known;
  const std::string extension = io::file_extension(path);
  if (extension == ".obj") return write_file(path, obj_bytes(mesh, lines));
  if (extension == ".vtp") return write_file(path, vtp_bytes(mesh, lines));
  return write_file(path, polyline_csv(mesh, lines));
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory, io::printable(path) + ": not enough memory to write it"};
}

}  // namespace geotherm
