// SPDX-License-Identifier: MIT
#include <algorithm>
#include <functional>
#include <queue>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "solver/heat/cell_domain.h"
#include "solver/volume/tet_update.h"

namespace geotherm {
namespace {

/// How far from a source the near field reaches, in mean widths of the cells.
constexpr double kTetReach = 3;
/// With more sources each has less of the volume to itself, and all of them cost as much as heat.
constexpr std::size_t kMaxNearSources = 64;

/// The vertices from which the sources of one set are seen along straight lines.
class NearTets {
 public:
  explicit NearTets(const CellDomain& domain) : domain_(domain), mesh_(*domain.mesh) {}

  /// Adds the vertices that a source is seen from. `rows` see it: the vertex that it is, or the
  /// corners of the tet that it lies in.
  void look_from(const Vec3& source, std::span<const Index> rows) {
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::unordered_set<Index> seen;
    const double reach = kTetReach * domain_.unit *
                         domain_.component_sizes[mesh_.components.of[rows.front()]].mean_edge;
    const auto see = [&](Index row) {
      const double line = (place_of(row) - source).norm();
      seen.insert(row);
      queue.emplace(line, row);
      const auto [at, is_new] = lines_.try_emplace(row, line);
      if (!is_new) at->second = std::min(at->second, line);
    };
    std::ranges::for_each(rows, see);
    while (!queue.empty()) {
      const Index row = queue.top().second;
      queue.pop();
      for (const Index cell : mesh_.cells_at.at(row)) {
        const auto corners = mesh_.corners_of(cell);
        for (std::size_t k = 0; k < 4; ++k) {
          if (seen.contains(corners[k])) continue;
          const Vec3 to_source = source - place_of(corners[k]);
          if (to_source.norm() <= reach && passes(corners, k, to_source, seen)) see(corners[k]);
        }
      }
    }
  }

  /// The tets all of whose corners see a source, ascending; none where their gradients are not
  /// those of tets at these places.
  std::vector<NearCell> cells() const {
    std::vector<NearCell> out;
    for (const auto& line : lines_) {
      const Index row = line.first;
      for (const Index cell : mesh_.cells_at.at(row)) {
        const auto corners = mesh_.corners_of(cell);
        const bool whole = std::ranges::all_of(
            corners, [&](Index corner) { return corner >= row && lines_.contains(corner); });
        if (!whole) continue;
        if (!lies_in_space(cell)) return {};
        NearCell& near = out.emplace_back(NearCell{cell, {}});
        std::ranges::transform(corners, near.distances.begin(),
                               [&](Index corner) { return lines_.at(corner) / domain_.unit; });
      }
    }
    std::ranges::sort(out, {}, &NearCell::cell);
    return out;
  }

  const Vec3& place_of(Index row) const {
    return domain_.given->positions[domain_.vertex_of_row[row]];
  }

 private:
  /// Whether the line from corner k leaves its tet between corners that see the source.
  bool passes(std::span<const Index> corners, std::size_t k, const Vec3& to_source,
              const std::unordered_set<Index>& seen) const {
    std::array<Vec3, 3> face;
    for (std::size_t i = 0; i < 3; ++i) {
      face[i] = place_of(corners[(k + 1 + i) % 4]) - place_of(corners[k]);
    }
    const FaceCrossing crossing = cross_face(face, to_source);
    if (!crossing.crosses) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      if (crossing.weights[i] > 0 && !seen.contains(corners[(k + 1 + i) % 4])) return false;
    }
    return true;
  }

  bool lies_in_space(Index cell) const {
    constexpr double kRoundOff = 1e-6, kOfProduct = 64 * 2.2e-16;
    const double* at = mesh_.gradients_of(cell);
    const auto corners = mesh_.corners_of(cell);
    Eigen::Matrix3d product = Eigen::Matrix3d::Zero();
    double steepest = 0;  // flat tets have gradients whose digits cancel
    for (const Index row : corners) {
      const Vec3 edge = (place_of(row) - place_of(corners.front())) / domain_.unit;
      const Eigen::Map<const Vec3> gradient(at);
      product += edge * gradient.transpose();
      steepest = std::max(steepest, edge.norm() * gradient.norm());
      at += 3;
    }
    return (product - Eigen::Matrix3d::Identity()).norm() <
           kRoundOff + kOfProduct * steepest * steepest;
  }

  const CellDomain& domain_;
  const CellMesh& mesh_;
  std::unordered_map<Index, double> lines_;  ///< of each row that sees a source, the least one
};

}  // namespace

std::vector<NearCell> near_tets(const CellDomain& domain, const SourceAnchors& anchors) {
  const CellMesh& mesh = *domain.mesh;
  if (!mesh.is_of_tets || domain.given->positions.empty()) return {};
  const auto vertices =
      std::ranges::count_if(anchors.anchors, [](const auto& anchor) { return anchor.offset == 0; });
  const std::size_t sources = static_cast<std::size_t>(vertices) + anchors.cell_points.size();
  if (sources > kMaxNearSources) return {};
  NearTets near(domain);
  for (const auto& anchor : anchors.anchors) {
    if (anchor.offset == 0) near.look_from(near.place_of(anchor.row), {&anchor.row, 1});
  }
  for (const CellPoint& point : anchors.cell_points) {
    const auto rows = mesh.corners_of(domain.cell_of_given[domain.find_cell(point.cell)]);
    Vec3 place = Vec3::Zero();
    for (std::size_t k = 0; k < rows.size(); ++k) {
      place += point.weights[k] * near.place_of(rows[k]);
    }
    near.look_from(place, rows);
  }
  return near.cells();
}

}  // namespace geotherm
