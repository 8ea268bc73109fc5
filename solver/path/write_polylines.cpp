// SPDX-License-Identifier: MIT
#include "geotherm/path.h"

#include <algorithm>

#include "solver/core/text.h"
#include "solver/mesh/io/vtk_writer.h"
#include "solver/mesh/output_file.h"

namespace geotherm {
namespace {

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

std::string vtp_bytes(const TriangleMesh& mesh, std::span<const Polyline> lines) {
  std::uint64_t points = 0, entries = 0;
  for (const Polyline& line : lines) {
    points += point_count(*line.path);
    entries += line.path->points.size();
  }
  const std::uint64_t count = lines.size();
  const std::string piece = "NumberOfPoints=\"" + std::to_string(points) +
                            "\" NumberOfVerts=\"0\" NumberOfLines=\"" + std::to_string(count) +
                            "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\"";
  return io::vtk_bytes("PolyData", "", piece, [&](io::VtkWriter& file) {
    file.points(points, [&](const auto& use) {
      for (const Polyline& line : lines) {
        for (std::size_t i = 0; i < point_count(*line.path); ++i) {
          use(position_at(mesh, line.path->points[i]));
        }
      }
    });
    file.text("<Lines>\n");
    file.array<std::int64_t>("connectivity", entries, [&](const auto& put) {
      std::int64_t first = 0;
      for (const Polyline& line : lines) {
        const auto distinct = static_cast<std::int64_t>(point_count(*line.path));
        for (std::size_t i = 0; i < line.path->points.size(); ++i) {
          put(first + static_cast<std::int64_t>(i) % distinct);
        }
        first += distinct;
      }
    });
    file.array<std::int64_t>("offsets", count, [&](const auto& put) {
      std::int64_t end = 0;
      for (const Polyline& line : lines) put(end += std::ssize(line.path->points));
    });
    file.text("</Lines>\n<CellData>\n");
    file.array<double>("length", count, [&](const auto& put) {
      for (const Polyline& line : lines) put(line.path->length);
    });
    file.array<std::int32_t>("closed", count, [&](const auto& put) {
      for (const Polyline& line : lines) put(line.path->closed);
    });
    if (have_values(lines)) {
      file.array<double>("value", count, [&](const auto& put) {
        for (const Polyline& line : lines) put(line.value.value_or(0));
      });
    }
    file.text("</CellData>\n");
  });
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
                             std::span<const Polyline> lines) {
  if (auto known = check_polyline_path(path); !known) return known;
  const std::string extension = io::file_extension(path);
  return write_made(path, [&] {
    if (extension == ".obj") return obj_bytes(mesh, lines);
    if (extension == ".vtp") return vtp_bytes(mesh, lines);
    return polyline_csv(mesh, lines);
  });
}

}  // namespace geotherm
