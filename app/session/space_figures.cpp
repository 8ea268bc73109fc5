// SPDX-License-Identifier: MIT
// What volumes and polygons are like, and what an answer is like in their cells.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/session/space.h"
#include "app/text/text.h"
#include "solver/core/sorting.h"
#include "solver/volume/clean_tets.h"

namespace geotherm::app {
namespace {

using Edge = std::array<Index, 2>;

/// The different edges among many, and in how many cells each is.
struct EdgeFigures {
  std::int64_t count = 0, once = 0, often = 0;  ///< in all, in one cell, in more than two
  double mean = 0, shortest = kUnreached, longest = 0;
};

EdgeFigures measure_edges(std::vector<Edge> edges, std::span<const Vec3> positions) {
  for (Edge& edge : edges) {
    if (edge[0] > edge[1]) std::swap(edge[0], edge[1]);
  }
  std::ranges::sort(edges);
  EdgeFigures out;
  for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
    while (next < edges.size() && edges[next] == edges[i]) ++next;
    out.once += next - i == 1 ? 1 : 0;
    out.often += next - i > 2 ? 1 : 0;
    const double length = (positions[edges[i][0]] - positions[edges[i][1]]).norm();
    out.mean += (length - out.mean) / static_cast<double>(++out.count);
    out.shortest = std::min(out.shortest, length);
    out.longest = std::max(out.longest, length);
  }
  return out;
}

void add_lengths(const EdgeFigures& edges, std::vector<SpaceFigure>& out) {
  out.push_back({"edge length",
                 "mean " + significant(edges.mean) + ", from " + significant(edges.shortest) +
                     " to " + significant(edges.longest),
                 "mean_edge_length", edges.mean});
  out.push_back({"", "", "shortest_edge", edges.shortest});
  out.push_back({"", "", "longest_edge", edges.longest});
}

/// The sets of the flagged vertices.
Index count_sets(DisjointSets& sets, const std::vector<char>& used) {
  Index count = 0;
  for (Index v = 0; v < std::ssize(used); ++v) count += used[v] != 0 && sets.root(v) == v ? 1 : 0;
  return count;
}

/// X of a cell by ln u at its corners; 0 where there is none.
Vec3 heat_direction(const Space& space, Index cell, std::vector<double>& log_heat) {
  const double largest = std::ranges::max(log_heat);
  if (!std::isfinite(largest)) return Vec3::Zero();
  // A factor that all corners share does not turn the gradient, and brings u back into range.
  for (double& u : log_heat) u = std::exp(u - largest);
  return -space.gradient_on(cell, log_heat).stableNormalized();
}

double value_in(const Space& space, QualityField field, const DistanceResult& answer, Index cell) {
  const std::vector<Index> corners = space.corners_of(cell);
  std::vector<double> distances, log_heat;
  for (const Index v : corners) {
    distances.push_back(answer.distances[v]);
    if (needs_heat(field)) log_heat.push_back(answer.log_heat[v]);
  }
  const bool reached = std::ranges::all_of(distances, [](double d) { return std::isfinite(d); });
  const Vec3 gradient = reached ? space.gradient_on(cell, distances) : Vec3(Vec3::Zero());
  const bool known = !gradient.isZero(0) && gradient.allFinite();
  if (field == QualityField::kEikonalError) {
    return known ? std::abs(gradient.norm() - 1) : kUnreached;
  }
  const Vec3 heat = heat_direction(space, cell, log_heat);
  if (field == QualityField::kLostGradients) return known && heat.isZero(0) ? 1 : 0;
  return angles_between({&heat, 1}, {&gradient, 1}).front();
}

}  // namespace

std::vector<double> cell_field(const Space& space, QualityField field, const DistanceResult& answer,
                               std::span<const Index> cells) {
  const double none = field == QualityField::kLostGradients ? 0 : kUnreached;
  std::vector<double> out;
  out.reserve(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool again = i > 0 && cells[i] == cells[i - 1];  // faces of one cell follow each other
    out.push_back(again                  ? out.back()
                  : cells[i] == kNoIndex ? none
                                         : value_in(space, field, answer, cells[i]));
  }
  return out;
}

std::vector<SpaceFigure> TetSpace::figures() const {
  const CleanTets clean = clean_tets(*volume_);
  std::vector<SpaceFigure> out;
  const std::int64_t left_out = clean.flat + clean.repeated_corner + clean.duplicate;
  out.push_back({"tets",
                 grouped(cell_count()) + " (" + grouped(clean.flat) + " flat, " +
                     grouped(clean.repeated_corner) + " with a corner twice, " +
                     grouped(clean.duplicate) + " there twice)",
                 "left_out_tets", left_out});
  out.push_back({"", "", "flat_tets", std::int64_t{clean.flat}});
  std::vector<Edge> edges;
  edges.reserve(6 * clean.tets.size());
  double volume = 0, least_height = kUnreached;
  std::int64_t slivers = 0;
  for (const Tet& tet : clean.tets) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < i; ++k) edges.push_back({tet[i], tet[k]});
    }
    const auto p = volume_->positions();
    const TetGradient element = tet_gradient(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]);
    const double height = height_in_edges(*volume_, tet, element);
    volume += element.volume;
    least_height = std::min(least_height, height);
    if (height < kSliverHeight) ++slivers;
  }
  if (!clean.tets.empty()) {
    out.push_back({"slivers",
                   grouped(slivers) + " (height below a fifth of the shortest edge; the least is " +
                       significant(least_height) + " of it)",
                   "slivers", slivers});
    out.push_back({"", "", "least_height_in_shortest_edges", least_height});
  }
  const EdgeFigures lengths = measure_edges(std::move(edges), volume_->positions());
  out.push_back({"edges", grouped(lengths.count), "edges", lengths.count});
  const std::int64_t faces = std::ssize(border_.faces), vertices = std::ssize(border_.vertices);
  out.push_back({"border",
                 counted(faces, "face", "faces") + ", " + counted(vertices, "vertex", "vertices"),
                 "border_faces", faces});
  out.push_back({"", "", "border_vertices", vertices});
  add_lengths(lengths, out);
  out.push_back({"volume", significant(volume), "volume", volume});
  return out;
}

Index TetSpace::components() const {
  DisjointSets sets(volume_->positions().size());
  for (const Tet& tet : volume_->tets()) {
    for (std::size_t k = 1; k < 4; ++k) sets.join(tet[0], tet[k]);
  }
  return count_sets(sets, used());
}

Vec3 TetSpace::gradient_on(Index cell, std::span<const double> values) const {
  const Tet& tet = volume_->tets()[static_cast<std::size_t>(cell)];
  const auto p = volume_->positions();
  const TetGradient element = tet_gradient(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) sum += values[k] * element.gradients[k];
  return sum;
}

std::vector<SpaceFigure> PolygonSpace::figures() const {
  std::vector<Edge> edges;
  double area = 0;
  std::int64_t least = std::numeric_limits<std::int64_t>::max(), most = 0;
  for (Index c = 0; c < cells().cell_count(); ++c) {
    area += cells().measures[c];
    if (c > 0 && cells().numbers[c] == cells().numbers[c - 1]) continue;
    const auto corners = cells().corners_of(c);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      edges.push_back({corners[k], corners[(k + 1) % corners.size()]});
    }
    least = std::min<std::int64_t>(least, std::ssize(corners));
    most = std::max<std::int64_t>(most, std::ssize(corners));
  }
  const EdgeFigures lengths = measure_edges(std::move(edges), drawn()->positions());
  std::vector<SpaceFigure> out;
  out.push_back({"polygons",
                 grouped(cell_count()) + " of " + std::to_string(least) +
                     (most > least ? " to " + std::to_string(most) : "") + " corners",
                 "least_corners", least});
  out.push_back({"", "", "most_corners", most});
  out.push_back({"edges",
                 grouped(lengths.count) + " (" + grouped(lengths.once) + " boundary, " +
                     grouped(lengths.often) + " non-manifold)",
                 "edges", lengths.count});
  out.push_back({"", "", "boundary_edges", lengths.once});
  out.push_back({"", "", "nonmanifold_edges", lengths.often});
  add_lengths(lengths, out);
  out.push_back({"area", significant(area), "area", area});
  return out;
}

Index CellSpace::components() const {
  DisjointSets sets(used().size());
  for (Index c = 0; c < cells_->cell_count(); ++c) {
    const auto corners = cells_->corners_of(c);
    for (const Index v : corners) sets.join(corners.front(), v);
  }
  return count_sets(sets, used());
}

/// The mean over the polygon, which hangs on the values along its sides alone.
Vec3 PolygonSpace::gradient_on(Index cell, std::span<const double> values) const {
  const auto corners = cells().corners_of(place_of(cell));
  const auto at = [&](std::size_t k) { return cells().positions[corners[k % corners.size()]]; };
  Vec3 twice = Vec3::Zero(), sum = Vec3::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 side = at(k + 1) - at(k);
    twice += (at(k) - at(0)).cross(side);
    sum += (values[k] + values[(k + 1) % corners.size()]) / 2 * side;
  }
  return 2 * sum.cross(twice) / twice.squaredNorm();
}

}  // namespace geotherm::app
