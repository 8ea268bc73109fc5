// SPDX-License-Identifier: MIT
#include "geotherm/path.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "solver/geometry/clean_faces.h"
#include "solver/path/within_memory.h"

namespace geotherm {
namespace {

/// A level crosses a face from one side to another, with what is above it on the left.
struct Crossing {
  Index face;
  Index from, to;  // edges
};

/// What links the crossings of one level: for each edge, those with an end there.
constexpr int kNoPiece = -1;

class LevelSets {
 public:
  LevelSets(const TriangleMesh& mesh, std::span<const double> values,
            std::span<const double> levels)
      : mesh_(mesh), values_(values), levels_(levels), clean_(clean_faces(mesh)) {
    edge_at_.resize(3 * clean_.faces.size());
    for (Index e = 0; e < clean_.edges.edge_count(); ++e) {
      for (const Side side : clean_.edges.sides(e)) edge_at_[side] = e;
    }
    at_edge_.assign(static_cast<std::size_t>(clean_.edges.edge_count()), {kNoPiece, kNoPiece});
  }

  /// All crossings, before trace(). False: the progress said stop.
  bool collect(const Progress& progress) {
    constexpr std::size_t kAskEvery = 1U << 10;  // faces, each of which all levels may cross
    first_.assign(levels_.size() + 1, 0);
    for (const Face& face : clean_.faces) {
      const auto [low, high] = levels_of(face);
      for (std::size_t level = low; level < high; ++level) ++first_[level + 1];
    }
    for (std::size_t level = 0; level < levels_.size(); ++level) first_[level + 1] += first_[level];
    crossings_.resize(first_.back());
    std::vector<std::size_t> cursor(first_.begin(), first_.end() - 1);
    for (std::size_t f = 0; f < clean_.faces.size(); ++f) {
      if (f % kAskEvery == 0 && !report(progress, "isolines", 0)) return false;
      const auto [low, high] = levels_of(clean_.faces[f]);
      for (std::size_t level = low; level < high; ++level) {
        crossings_[cursor[level]++] = crossing(static_cast<Index>(f), levels_[level]);
      }
    }
    return true;
  }

  /// Lines of one level.
  void trace(std::size_t level, std::vector<Isoline>& out) {
    const std::span<const Crossing> all = at(level);
    for (std::size_t i = 0; i < all.size(); ++i) {
      attach(all[i].from, static_cast<int>(i));
      attach(all[i].to, static_cast<int>(i));
    }
    used_.assign(all.size(), 0);
    for (const bool open : {true, false}) {  // what is left after the open ones is closed
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (used_[i] || (open && next(i, all[i].from) != kNoPiece)) continue;
        add_line(level, i, all[i].from, out);
      }
      for (std::size_t i = 0; i < all.size() && open; ++i) {  // the wrong way round, on a Moebius
        if (!used_[i] && next(i, all[i].to) == kNoPiece) add_line(level, i, all[i].to, out);
      }
    }
    for (const Crossing& each : all) {
      at_edge_[each.from] = at_edge_[each.to] = {kNoPiece, kNoPiece};
    }
  }

 private:
  std::span<const Crossing> at(std::size_t level) const {
    return {crossings_.data() + first_[level], crossings_.data() + first_[level + 1]};
  }

  /// Levels that a face crosses, as numbers [low, high): above its least value, up to its largest.
  std::pair<std::size_t, std::size_t> levels_of(const Face& face) const {
    const auto [low, high] = std::minmax({values_[face[0]], values_[face[1]], values_[face[2]]});
    if (!std::isfinite(values_[face[0]] * 0 + values_[face[1]] * 0 + values_[face[2]] * 0)) {
      return {0, 0};
    }
    const auto number = [this](double value) {
      return static_cast<std::size_t>(std::ranges::upper_bound(levels_, value) - levels_.begin());
    };
    return {number(low), number(high)};
  }

  /// Values equal to the level count as above it.
  Crossing crossing(Index f, double level) const {
    Crossing out{f, kNoIndex, kNoIndex};
    for (int k = 0; k < 3; ++k) {
      const Face& face = clean_.faces[f];
      const bool here = values_[face[k]] >= level, there = values_[face[next_corner(k)]] >= level;
      if (here && !there) out.to = edge_at_[3 * f + k];
      if (!here && there) out.from = edge_at_[3 * f + k];
    }
    return out;
  }

  /// Lines end at edges with one face and with more than two.
  void attach(Index edge, int crossing) {
    if (clean_.edges.sides(edge).size() != 2) return;
    auto& [first, second] = at_edge_[edge];
    (first == kNoPiece ? first : second) = crossing;
  }

  int next(std::size_t crossing, Index edge) const {
    const auto& [first, second] = at_edge_[edge];
    return first == static_cast<int>(crossing) ? second : first;
  }

  void add_line(std::size_t level, std::size_t first, Index start, std::vector<Isoline>& out) {
    Isoline line{levels_[level], {}};
    std::vector<SurfacePoint>& points = line.path.points;
    Index edge = start;
    std::size_t at_crossing = first;
    points.push_back(point(edge, at(level)[first].face, levels_[level]));
    while (true) {
      used_[at_crossing] = 1;
      const Crossing& c = at(level)[at_crossing];
      edge = edge == c.from ? c.to : c.from;
      append(line.path, point(edge, c.face, levels_[level]), c.face);
      const int following = next(at_crossing, edge);
      if (following == kNoPiece || used_[static_cast<std::size_t>(following)]) break;
      at_crossing = static_cast<std::size_t>(following);
    }
    line.path.closed = edge == start;
    if (points.size() < 2) return;  // a peak that the level touches
    line.path.length = length_of(mesh_, points);
    out.push_back(std::move(line));
  }

  /// Appends a point unless it is the vertex that the path has just come to.
  void append(SurfacePath& path, const SurfacePoint& point, Index clean_face) const {
    const SurfacePoint& last = path.points.back();
    if (point.is_vertex() && last.vertex == point.vertex) return;
    path.points.push_back(point);
    path.faces.push_back(clean_.original[clean_face]);
  }

  SurfacePoint point(Index edge, Index clean_face, double level) const {
    const Index low = clean_.edges.low(edge), high = clean_.edges.high(edge);
    const double a = values_[low] / 2, b = values_[high] / 2;  // whose difference is in range
    const double share = std::clamp((level / 2 - a) / (b - a), 0.0, 1.0);
    if (share == 0) return SurfacePoint::at_vertex(low);
    if (share == 1) return SurfacePoint::at_vertex(high);
    const Index original = clean_.original[clean_face];
    SurfacePoint out = SurfacePoint::in_face(original, {});
    for (std::size_t k = 0; k < 3; ++k) {
      if (mesh_.faces()[original][k] == low) out.weights[k] = 1 - share;
      if (mesh_.faces()[original][k] == high) out.weights[k] = share;
    }
    return out;
  }

  const TriangleMesh& mesh_;
  std::span<const double> values_, levels_;
  CleanFaces clean_;
  std::vector<Index> edge_at_;
  std::vector<Crossing> crossings_;  // by level, then by face
  std::vector<std::size_t> first_;   // of each level
  std::vector<std::array<int, 2>> at_edge_;
  std::vector<char> used_;
};

Result<std::vector<Isoline>> all_isolines(const TriangleMesh& mesh, std::span<const double> values,
                                          std::span<const double> levels,
                                          const Progress& progress) {
  assert(values.size() == static_cast<std::size_t>(mesh.vertex_count()));
  assert(std::ranges::is_sorted(levels));
  std::vector<Isoline> lines;
  LevelSets sets(mesh, values, levels);
  if (!sets.collect(progress)) return cancelled_error();
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double done = static_cast<double>(level) / static_cast<double>(levels.size());
    if (!report(progress, "isolines", done)) return cancelled_error();
    sets.trace(level, lines);
  }
  std::ranges::stable_sort(lines, [](const Isoline& a, const Isoline& b) {
    return std::tuple(a.value, -a.path.length) < std::tuple(b.value, -b.path.length);
  });
  return lines;
}

}  // namespace

Result<std::vector<Isoline>> find_isolines(const TriangleMesh& mesh, std::span<const double> values,
                                           std::span<const double> levels,
                                           const Progress& progress) {
  return within_memory("a level set", mesh, progress,
                       [&](const Progress& watched) -> Result<std::vector<Isoline>> {
                         return all_isolines(mesh, values, levels, watched);
                       });
}

}  // namespace geotherm
