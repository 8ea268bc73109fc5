// SPDX-License-Identifier: MIT
#include "app/cli/path_report.h"

#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/text.h"

namespace geotherm::app {

Json points_json(const TriangleMesh& mesh, const SurfacePath& path) {
  Json points = Json::array(), faces = Json::array(), weights = Json::array();
  for (const Vec3& p : positions_of(mesh, path)) points.push_back(vector_json(p));
  for (const SurfacePoint& point : points_in_faces(mesh, path)) {
    faces.push_back(point.face);
    weights.push_back(point.weights);
  }
  return {{"points", std::move(points)},
          {"faces", std::move(faces)},
          {"barycentric", std::move(weights)}};
}

namespace {

Json line_json(const TriangleMesh& mesh, const FoundLine& line, PathField field) {
  Json json = {{"from", point_json(line.stops.front())}, {"to", point_json(line.stops.back())}};
  if (line.stops.size() > 2) {
    json["via"] = Json::array();
    for (std::size_t i = 1; i + 1 < line.stops.size(); ++i) {
      json["via"].push_back(point_json(line.stops[i]));
    }
  }
  json.update(
      {{"length", line.path.length}, {"field", to_text(field)}, {"closed", line.path.closed}});
  json.update(points_json(mesh, line.path));
  return json;
}

std::string point_in_words(const SurfacePoint& point) {
  return point.is_vertex() ? "vertex " + std::to_string(point.vertex)
                           : "a point in face " + std::to_string(point.face);
}

std::string line_in_words(const FoundLine& line) {
  std::string text =
      "from " + point_in_words(line.stops.front()) + " to " + point_in_words(line.stops.back());
  if (line.stops.size() > 2) {
    text += " via " + counted(static_cast<std::int64_t>(line.stops.size()) - 2, "point", "points");
  }
  return text + (line.path.closed ? " and back" : "");
}

}  // namespace

Json path_json(const PathFigures& figures) {
  const TriangleMesh& mesh = *figures.model.mesh;
  Json json = line_json(mesh, figures.paths.front(), figures.options.field);
  if (figures.paths.size() > 1) {
    json["paths"] = Json::array();
    for (const FoundLine& line : figures.paths) {
      json["paths"].push_back(line_json(mesh, line, figures.options.field));
    }
  }
  json.update(
      {{"model", brief_model_json(figures.model)},
       {"method", to_text(figures.method.method)},
       {"timing_ms",
        {{"load", figures.model.load_ms}, {"setup", figures.setup_ms}, {"path", figures.path_ms}}},
       {"warnings", to_text(figures.warnings)}});
  if (figures.error) json["error"] = error_json(*figures.error);
  return json;
}

namespace {

/// More paths become a table, a row each.
constexpr std::size_t kMaxInWords = 5;

/// 17, or face:12:0.2:0.3:0.5, as it would be typed.
std::string point_text(const SurfacePoint& point) {
  if (point.is_vertex()) return std::to_string(point.vertex);
  std::string text = "face:" + std::to_string(point.face);
  for (const double weight : point.weights) text += ':' + number_text(weight);
  return text;
}

std::string lengths_table(const PathFigures& figures) {
  using enum TextTable::Align;
  TextTable table({{"from", kRight}, {"to", kRight}, {"via", kRight}, {"length", kRight}});
  for (const FoundLine& line : figures.paths) {
    table.add_row({point_text(line.stops.front()), point_text(line.stops.back()),
                   std::to_string(line.stops.size() - 2), significant(line.path.length, 7)});
  }
  return table.text();
}

}  // namespace

std::string lengths_csv(const PathFigures& figures) {
  std::string text = "from,to,via,length\n";
  for (const FoundLine& line : figures.paths) {
    text += point_text(line.stops.front()) + ',' + point_text(line.stops.back()) + ',' +
            std::to_string(line.stops.size() - 2) + ',' + number_text(line.path.length) + '\n';
  }
  return text;
}

std::string path_table(const PathFigures& figures) {
  TextTable table({{"", TextTable::Align::kLeft}, {"", TextTable::Align::kLeft}});
  table.add_row({"model", brief_model_text(figures.model)});
  table.add_row({"field", to_text(figures.options.field) + ", led by distances of " +
                              to_text(figures.method.method)});
  if (figures.error && figures.error->measured) {
    table.add_row({"error", "of the distances: " + to_text(accuracy_line(*figures.error))});
  }
  table.add_row({"set-up", milliseconds(figures.setup_ms) + " ms"});
  table.add_row({"search", milliseconds(figures.path_ms) + " ms"});
  if (figures.paths.size() > kMaxInWords) return table.text() + '\n' + lengths_table(figures);
  for (const FoundLine& line : figures.paths) {
    const auto points = static_cast<std::int64_t>(line.path.points.size());
    table.add_row({"path", line_in_words(line)});
    table.add_row(
        {"length", significant(line.path.length, 7) + ", " + counted(points, "point", "points")});
  }
  return table.text();
}

}  // namespace geotherm::app
