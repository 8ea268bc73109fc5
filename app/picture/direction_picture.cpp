// SPDX-License-Identifier: MIT
#include "app/picture/direction_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/mesh/connectivity.h"

namespace geotherm::app {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

/// Where the map is torn, its coordinates jump by far more than an edge is long: lines drawn across
/// would show nothing.
void leave_out_tears(const TriangleMesh& mesh, std::vector<double>& x, std::vector<double>& y) {
  constexpr double kTorn = 3;
  std::vector<char> torn(x.size(), 0);
  for (const Face& face : mesh.faces()) {
    for (int k = 0; k < 3; ++k) {
      const Index i = face[k], j = face[next_corner(k)];
      const double edge = (mesh.positions()[i] - mesh.positions()[j]).norm();
      if (std::hypot(x[i] - x[j], y[i] - y[j]) > kTorn * edge) torn[i] = torn[j] = 1;
    }
  }
  for (std::size_t v = 0; v < x.size(); ++v) {
    if (torn[v] != 0) x[v] = y[v] = kNowhere;
  }
}

}  // namespace

Result<std::vector<Isoline>> map_lines(const TriangleMesh& mesh, std::vector<double> x,
                                       std::vector<double> y, std::span<const double> angles,
                                       std::span<const double> levels) {
  leave_out_tears(mesh, x, y);
  std::vector<Isoline> lines;
  std::vector<double> along(x.size());
  for (const double angle : angles) {
    for (std::size_t v = 0; v < x.size(); ++v) {
      along[v] = x[v] * std::cos(angle) + y[v] * std::sin(angle);
    }
    auto found = find_isolines(mesh, along, levels);
    if (!found) return found;
    lines.insert(lines.end(), found->begin(), found->end());
  }
  return lines;
}

Result<void> add_log_map(PictureData& data, const TriangleMesh& mesh,
                         std::span<const double> distances, std::vector<double> x,
                         std::vector<double> y) {
  constexpr int kRays = 12;  // through the point, so twice as many from it
  std::vector<double> angles;
  for (int i = 0; i < kRays; ++i) angles.push_back(std::numbers::pi * i / kRays);
  const double zero = 0;
  const auto rays = map_lines(mesh, std::move(x), std::move(y), angles, {&zero, 1});
  if (!rays) return rays.error();
  add_distances(data, distances);
  const auto source = std::ranges::find(distances, 0.0);
  if (source != distances.end()) {  // else it lies within a face
    add_sources(data, mesh,
                SourceSet::of_vertices({static_cast<Index>(source - distances.begin())}));
  }
  for (const Isoline& ray : *rays) {
    add_line(data, positions_of(mesh, ray.path), "equal direction, every 15\u00b0");
  }
  return {};
}

void add_vectors(PictureData& data, const TriangleMesh& mesh, std::span<const Vec3> vectors) {
  std::vector<double> lengths;
  for (const Vec3& v : vectors) lengths.push_back(v.norm());
  add_field(data, lengths);
  data.smallest_value = 0;  // where their scale begins
  data.value_title = "length";
  std::vector<Vec3> of_faces;
  double longest = 0;
  for (const Face& face : mesh.faces()) {
    const auto at = mesh.positions();
    const Vec3 normal = (at[face[1]] - at[face[0]]).cross(at[face[2]] - at[face[0]]);
    const Vec3 up = normal.stableNormalized();
    const Vec3 sum = vectors[face[0]] + vectors[face[1]] + vectors[face[2]];
    const Vec3 flat = (sum - sum.dot(up) * up) / 3;
    of_faces.push_back(flat.allFinite() && !up.isZero(0) ? flat : Vec3(Vec3::Zero()));
    longest = std::max(longest, of_faces.back().norm());
  }
  data.heat_directions.clear();
  for (const Vec3& v : of_faces) {
    const Eigen::Vector3f share = (longest > 0 ? Vec3(v / longest) : v).cast<float>();
    data.heat_directions.push_back({share.x(), share.y(), share.z()});
  }
}

}  // namespace geotherm::app
