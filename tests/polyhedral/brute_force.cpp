// SPDX-License-Identifier: MIT
#include "tests/polyhedral/brute_force.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace geotherm::test {
namespace {

using Point2 = Eigen::Vector2d;

double cross(const Point2& a, const Point2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Lines that pass a corner this close (sine of the angle) reach it.
constexpr double kTouch = 1e-12;

/// A table of lengths, vertex to vertex.
using Table = std::vector<std::vector<double>>;

/// Shortest chains from one vertex, by the rule of Bellman.
std::vector<double> chains(const Table& lines, Index source) {
  const std::size_t n = lines.size();
  std::vector<double> d(n, kUnreached);
  d[source] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) {
        if (d[a] + lines[a][b] >= d[b]) continue;
        d[b] = d[a] + lines[a][b];
        changed = true;
      }
    }
  }
  return d;
}

Table edge_lengths(const TriangleMesh& mesh) {
  const auto n = static_cast<std::size_t>(mesh.vertex_count());
  Table table(n, std::vector<double>(n, kUnreached));
  for (const Face& face : mesh.faces()) {
    for (int k = 0; k < 3; ++k) {
      const Index a = face[k], b = face[(k + 1) % 3];
      table[a][b] = table[b][a] = (mesh.positions()[a] - mesh.positions()[b]).norm();
    }
  }
  return table;
}

/// All straight lines from one vertex.
class LinesFrom {
 public:
  LinesFrom(const TriangleMesh& mesh, const Table& edges, Index source, std::vector<double>& lines)
      : mesh_(mesh), edges_(edges), lines_(lines), visited_(mesh.faces().size(), 0) {
    for (const double d : chains(edges, source)) {
      if (std::isfinite(d)) longest_ = std::max(longest_, d);
    }
    for (std::size_t f = 0; f < visited_.size(); ++f) {
      for (int k = 0; k < 3; ++k) {
        if (mesh.faces()[f][k] == source) start(f, k);
      }
    }
  }

 private:
  void start(std::size_t f, int k) {
    const Index s = mesh_.faces()[f][k];
    const Index a = mesh_.faces()[f][(k + 1) % 3], b = mesh_.faces()[f][(k + 2) % 3];
    const Point2 at_a(edges_[s][a], 0);
    const Point2 at_b = third(Point2(0, 0), at_a, edges_[s][b], edges_[a][b]);
    visited_[f] = 1;
    go_on({a, b, at_a, at_b}, at_a, at_b);
    visited_[f] = 0;
  }

  /// Left of the way from p to q, at these distances from them.
  static Point2 third(const Point2& p, const Point2& q, double from_p, double from_q) {
    const double base = (q - p).norm();
    const double x = (base * base + from_p * from_p - from_q * from_q) / (2 * base);
    const double y = std::sqrt(std::max(from_p * from_p - x * x, 0.0));
    const Point2 along = (q - p) / base;
    return p + x * along + y * Point2(-along.y(), along.x());
  }

  /// An edge, seen from the source with a on the right.
  struct Gate {
    Index a, b;
    Point2 at_a, at_b;
  };

  /// Into all faces behind a gate with the lines between two directions.
  void go_on(const Gate& gate, const Point2& right, const Point2& left) {
    if (distance_to(gate, right, left) > longest_ * (1 + kTouch)) return;
    for (std::size_t f = 0; f < visited_.size(); ++f) {
      if (visited_[f] != 0) continue;
      const Face& face = mesh_.faces()[f];
      int apex = -1;
      for (int k = 0; k < 3; ++k) {
        const Index p = face[(k + 1) % 3], q = face[(k + 2) % 3];
        if ((p == gate.a && q == gate.b) || (p == gate.b && q == gate.a)) apex = face[k];
      }
      if (apex < 0) continue;
      visited_[f] = 1;
      enter(gate, apex, right, left);
      visited_[f] = 0;
    }
  }

  void enter(const Gate& gate, Index apex, const Point2& right, const Point2& left) {
    // Seen from b to a the far side is on the left.
    const Point2 at = third(gate.at_b, gate.at_a, edges_[gate.b][apex], edges_[gate.a][apex]);
    const double from_right = cross(right, at) / (right.norm() * at.norm());
    const double to_left = cross(at, left) / (left.norm() * at.norm());
    if (from_right >= -kTouch && to_left >= -kTouch) {
      lines_[apex] = std::min(lines_[apex], at.norm());
    }
    if (from_right > 0) {
      go_on({gate.a, apex, gate.at_a, at}, right, to_left > 0 ? at : left);
    }
    if (to_left > 0) {
      go_on({apex, gate.b, at, gate.at_b}, from_right > 0 ? at : right, left);
    }
  }

  /// Of the nearest place of the gate between two directions.
  static double distance_to(const Gate& gate, const Point2& right, const Point2& left) {
    const Point2 along = gate.at_b - gate.at_a;
    const auto place = [&](const Point2& direction) {
      return std::clamp(-cross(direction, gate.at_a) / cross(direction, along), 0.0, 1.0);
    };
    const double foot = -gate.at_a.dot(along) / along.squaredNorm();
    const double nearest = std::clamp(foot, place(right), std::max(place(right), place(left)));
    return (gate.at_a + nearest * along).norm();
  }

  const TriangleMesh& mesh_;
  const Table& edges_;
  std::vector<double>& lines_;
  std::vector<char> visited_;
  double longest_ = 0;
};

}  // namespace

std::vector<double> brute_force_distances(const TriangleMesh& mesh, Index source) {
  const Table edges = edge_lengths(mesh);
  Table lines = edges;
  for (std::size_t v = 0; v < lines.size(); ++v) {
    LinesFrom(mesh, edges, static_cast<Index>(v), lines[v]);
  }
  return chains(lines, source);
}

}  // namespace geotherm::test
