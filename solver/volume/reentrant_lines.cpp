// SPDX-License-Identifier: MIT
#include "solver/volume/reentrant_lines.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/core/sorting.h"

namespace geotherm {
namespace {

/// What tets fill around an edge.
struct Filled {
  Index to;
  double angle = 0;
  Vec3 inward = Vec3::Zero();  ///< the sum of all directions into the tets
  Index rim = 0;  ///< exclusive or of their other corners: 0 inside, where each has two

  /// A tet at the edge from a to b, between the sides to c and d.
  void add(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 along = (b - a).normalized();
    const Vec3 to_c = (c - a - (c - a).dot(along) * along).normalized();
    const Vec3 to_d = (d - a - (d - a).dot(along) * along).normalized();
    const double between = std::atan2(to_c.cross(to_d).norm(), to_c.dot(to_d));
    angle += between;
    inward += 2 * std::sin(between / 2) * (to_c + to_d).normalized();
  }
};

struct ReentrantEdge {
  Index from, to;
  Vec3 inward;
};

void append_edges_at(Index v, std::span<const Vec3> at, std::span<const Tet> tets,
                     const CellTable& around, std::vector<ReentrantEdge>& edges) {
  constexpr double kBends = 0.35, kRoundOff = 1e-3, kPi = std::numbers::pi;
  std::vector<Filled> filled;
  const auto each_edge = [&](const auto& body) {
    for (const Index t : around.at(v)) {
      const Tet& tet = tets[static_cast<std::size_t>(t)];
      for (const Index w : tet) {
        if (w <= v) continue;
        std::array<Index, 2> others{};
        std::size_t count = 0;
        for (const Index u : tet) {
          if (u != v && u != w) others[count++] = u;
        }
        auto known = std::ranges::find(filled, w, &Filled::to);
        if (known == filled.end()) known = filled.insert(known, {w});
        body(*known, others);
      }
    }
  };
  each_edge([](Filled& f, const auto& others) { f.rim ^= others[0] ^ others[1]; });
  each_edge([&](Filled& f, const auto& others) {
    if (f.rim != 0) f.add(at[v], at[f.to], at[others[0]], at[others[1]]);
  });
  for (const Filled& f : filled) {
    if (f.rim != 0 && f.angle > kPi + kBends && f.angle < 2 * kPi - kRoundOff)
      edges.push_back({v, f.to, f.inward.normalized()});
  }
}

}  // namespace

std::span<const ReentrantLines::End> ReentrantLines::at(Index vertex) const {
  const auto range = std::ranges::equal_range(vertices, vertex, {}, &End::vertex);
  return {range.begin(), range.end()};
}

ReentrantLines reentrant_lines(std::span<const Vec3> positions, std::span<const Tet> tets,
                               const CellTable& around) {
  constexpr double kStraight = 1e-6;  // sine of the angle between edges of one line
  std::vector<ReentrantEdge> edges;
  for (Index v = 0; v < std::ssize(positions); ++v) {
    append_edges_at(v, positions, tets, around, edges);
  }
  ReentrantLines out;
  std::vector<ReentrantLines::End> ends;  // `line`: an edge
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    directions.push_back((positions[edges[i].to] - positions[edges[i].from]).normalized());
    for (const Index v : {edges[i].from, edges[i].to}) ends.push_back({v, static_cast<Index>(i)});
  }
  std::ranges::sort(ends, {}, [](const auto& end) { return std::pair(end.vertex, end.line); });
  DisjointSets same_line(edges.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t k = i + 1; k < ends.size() && ends[k].vertex == ends[i].vertex; ++k) {
      const Index one = ends[i].line, other = ends[k].line;
      if (!(directions[one].cross(directions[other]).norm() > kStraight))
        same_line.join(one, other);
    }
  }
  std::vector<Index> line_of(edges.size(), kNoIndex);
  for (auto& [vertex, edge] : ends) {
    const Index one = same_line.root(edge);
    if (line_of[one] == kNoIndex) {
      line_of[one] = static_cast<Index>(out.lines.size());
      out.lines.push_back({positions[edges[one].from], directions[one], edges[one].inward});
    }
    out.vertices.push_back({vertex, line_of[one]});
  }
  const auto same = [](const ReentrantLines::End& a, const ReentrantLines::End& b) {
    return a.vertex == b.vertex && a.line == b.line;
  };
  std::ranges::sort(out.vertices, {},
                    [](const auto& end) { return std::pair(end.vertex, end.line); });
  out.vertices.erase(std::unique(out.vertices.begin(), out.vertices.end(), same),
                     out.vertices.end());
  return out;
}

}  // namespace geotherm
