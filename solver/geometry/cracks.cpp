// SPDX-License-Identifier: MIT
#include "solver/geometry/cracks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "solver/geometry/clean_faces.h"
#include "solver/geometry/intrinsic_mesh.h"
#include "solver/mesh/merge_close.h"

namespace geotherm {
namespace {

/// Of the mean edge: nothing, the rounding of 32-bit floats and of printed digits, a sloppy export.
constexpr double kShares[] = {0, 1e-6, 1e-4, 1e-2};

using Ends = std::array<Index, 2>;

std::vector<Ends> border_of(const EdgeTable& edges) {
  std::vector<Ends> border;
  for (Index e = 0; e < edges.edge_count(); ++e) {
    if (edges.sides(e).size() == 1) border.push_back({edges.low(e), edges.high(e)});
  }
  return border;
}

/// How many edges lie on another one. Precondition: the ends of each are sorted.
Index count_shared(std::vector<Ends> edges) {
  std::ranges::sort(edges);
  Index shared = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool before = i > 0 && edges[i - 1] == edges[i];
    shared += before || (i + 1 < edges.size() && edges[i + 1] == edges[i]);
  }
  return shared;
}

double one_digit_up(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)));
  return std::isnormal(unit) ? std::ceil(x / unit) * unit : x;
}

class Seeker {
 public:
  explicit Seeker(const TriangleMesh& mesh)
      : mesh_(mesh), clean_(clean_faces(mesh)), border_(border_of(clean_.edges)) {
    for (const Ends& edge : border_) vertices_.insert(vertices_.end(), edge.begin(), edge.end());
    std::ranges::sort(vertices_);
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    for (const Index v : vertices_) points_.push_back(mesh.positions()[v]);
    same_as_.resize(static_cast<std::size_t>(mesh.vertex_count()));
  }

  CrackReport run() {
    CrackReport best;
    best.border_edges = static_cast<Index>(border_.size());
    const double mean = mean_edge_length(mesh_.positions(), clean_.edges);
    if (border_.empty() || !std::isfinite(mean)) return best;
    for (const double share : kShares) {
      const double distance = share > 0 ? one_digit_up(share * mean) : 0;
      const Index merged = merge(distance);
      if (collapses()) break;
      const Index closed = count_closed();
      if (closed > best.closed_edges) best = {merged, distance, best.border_edges, closed};
    }
    return best;
  }

 private:
  Index merge(double distance) {
    for (Index v = 0; v < mesh_.vertex_count(); ++v) same_as_[v] = v;
    const std::vector<Index> lowest = merge_close(points_, distance);
    Index merged = 0;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      same_as_[vertices_[i]] = vertices_[lowest[i]];
      merged += vertices_[lowest[i]] != vertices_[i];
    }
    return merged;
  }

  bool collapses() const {
    return std::ranges::any_of(clean_.faces, [this](const Face& face) {
      const Index a = same_as_[face[0]], b = same_as_[face[1]], c = same_as_[face[2]];
      return a == b || b == c || c == a;
    });
  }

  Index count_closed() const {
    std::vector<Ends> edges = border_;
    for (Ends& edge : edges) {
      for (Index& end : edge) end = same_as_[end];
      std::ranges::sort(edge);
    }
    return count_shared(std::move(edges));
  }

  const TriangleMesh& mesh_;
  CleanFaces clean_;
  std::vector<Ends> border_;
  std::vector<Index> vertices_, same_as_;
  std::vector<Vec3> points_;
};

}  // namespace

CrackReport find_cracks(const TriangleMesh& mesh) { return Seeker(mesh).run(); }

}  // namespace geotherm
