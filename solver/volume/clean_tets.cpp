// SPDX-License-Identifier: MIT
#include "solver/volume/clean_tets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/core/sorting.h"
#include "solver/core/text.h"

namespace geotherm {
namespace {

/// The edges from corner 0 in units of the longest of all six edges.
struct TetEdges {
  std::array<Vec3, 3> from_first;
  double unit;  ///< 0: all corners are at one place, and the edges have no value

  TetEdges(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3)
      : from_first{p1 - p0, p2 - p0, p3 - p0}, unit(0) {
    auto& [a, b, c] = from_first;
    // Half of the differences of huge coordinates fits where the differences do not.
    if (!a.allFinite() || !b.allFinite() || !c.allFinite()) {
      from_first = {0.5 * p1 - 0.5 * p0, 0.5 * p2 - 0.5 * p0, 0.5 * p3 - 0.5 * p0};
      scale_ = 2;
    }
    for (const Vec3& edge : from_first) unit = std::max(unit, edge.cwiseAbs().maxCoeff());
    if (!(unit > 0)) return;
    for (Vec3& edge : from_first) edge /= unit;
    double longest = 0;
    for (const Vec3& edge : {a, b, c, Vec3(b - a), Vec3(c - b), Vec3(a - c)}) {
      longest = std::max(longest, edge.norm());
    }
    for (Vec3& edge : from_first) edge /= longest;
    unit *= longest * scale_;
  }

 private:
  double scale_ = 1;
};

}  // namespace

TetGradient tet_gradient(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3) {
  const Vec3 none = Vec3::Zero();
  const TetGradient flat{{none, none, none, none}, 0};
  const TetEdges edges(p0, p1, p2, p3);
  if (!(edges.unit > 0)) return flat;
  const auto& [a, b, c] = edges.from_first;
  // Twice the faces' areas times their normals: each over the determinant is a gradient.
  const std::array<Vec3, 3> normals = {b.cross(c), c.cross(a), a.cross(b)};
  const double det = a.dot(normals[0]);
  double largest = (b - a).cross(c - a).norm();
  for (const Vec3& normal : normals) largest = std::max(largest, normal.norm());
  // The least height stands on the largest face.
  if (!(std::abs(det) >= kFlatHeight * largest) || !(largest > 0)) return flat;
  TetGradient out = flat;
  for (std::size_t k = 0; k < 3; ++k) {
    out.gradients[k + 1] = normals[k] / det / edges.unit;
    out.gradients[0] -= out.gradients[k + 1];
  }
  out.volume = std::abs(det) / 6 * edges.unit * edges.unit * edges.unit;
  return out.volume > 0 && std::isfinite(out.volume) ? out : flat;
}

double height_in_edges(const TetMesh& mesh, const Tet& tet, const TetGradient& element) {
  const std::span<const Vec3> positions = mesh.positions();
  double steepest = 0, shortest = kUnreached;
  for (std::size_t k = 0; k < 4; ++k) {
    steepest = std::max(steepest, element.gradients[k].stableNorm());
    for (std::size_t j = 0; j < k; ++j) {
      shortest = std::min(shortest, (positions[tet[k]] - positions[tet[j]]).stableNorm());
    }
  }
  return 1 / (steepest * shortest);
}

double orientation_of(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3) {
  const TetEdges edges(p0, p1, p2, p3);
  if (!(edges.unit > 0)) return 0;
  const auto& [a, b, c] = edges.from_first;
  return a.dot(b.cross(c));
}

std::vector<TetFault> find_tet_faults(const TetMesh& mesh) {
  const std::span<const Tet> tets = mesh.tets();
  std::vector<TetFault> fault(tets.size(), TetFault::kNone);
  std::vector<Tet> sorted(tets.begin(), tets.end());
  for (std::size_t t = 0; t < tets.size(); ++t) {
    std::ranges::sort(sorted[t]);
    if (std::ranges::adjacent_find(sorted[t]) != sorted[t].end()) {
      fault[t] = TetFault::kRepeatedCorner;
    }
  }
  // Tets with the same lowest corner stand together; few are compared with each other.
  const RawVector<Index> order =
      sorted_by_key(tets.size(), static_cast<std::size_t>(mesh.vertex_count()), 1,
                    [&sorted](std::size_t t) { return sorted[t][0]; });
  std::vector<Index> group;
  for (std::size_t begin = 0; begin < order.size();) {
    const Index lowest = sorted[order[begin]][0];
    group.clear();
    for (; begin < order.size() && sorted[order[begin]][0] == lowest; ++begin) {
      if (fault[order[begin]] == TetFault::kNone) group.push_back(order[begin]);
    }
    std::ranges::sort(group, [&sorted](Index s, Index t) {
      return sorted[s] != sorted[t] ? sorted[s] < sorted[t] : s < t;
    });
    for (std::size_t i = 1; i < group.size(); ++i) {
      if (sorted[group[i]] == sorted[group[i - 1]]) fault[group[i]] = TetFault::kDuplicate;
    }
  }
  return fault;
}

CleanTets clean_tets(const TetMesh& mesh) {
  enum class Use : std::uint8_t { kNone, kLost, kKept };
  const std::vector<TetFault> fault = find_tet_faults(mesh);
  std::vector<Use> use(mesh.positions().size(), Use::kNone);
  CleanTets clean;
  clean.tets.reserve(mesh.tets().size());
  clean.original.reserve(mesh.tets().size());
  for (Index t = 0; t < mesh.tet_count(); ++t) {
    Tet tet = mesh.tets()[t];
    const auto at = [&](int k) -> const Vec3& { return mesh.positions()[tet[k]]; };
    for (const Index v : tet) use[v] = std::max(use[v], Use::kLost);
    if (fault[t] != TetFault::kNone) {
      ++(fault[t] == TetFault::kDuplicate ? clean.duplicate : clean.repeated_corner);
      continue;
    }
    if (!(tet_gradient(at(0), at(1), at(2), at(3)).volume > 0)) {
      ++clean.flat;
      continue;
    }
    if (orientation_of(at(0), at(1), at(2), at(3)) < 0) {
      std::swap(tet[2], tet[3]);
      ++clean.turned;
    }
    for (const Index v : tet) use[v] = Use::kKept;
    clean.tets.push_back(tet);
    clean.original.push_back(t);
  }
  clean.lost_vertices = static_cast<Index>(std::ranges::count(use, Use::kLost));
  clean.unused_vertices = static_cast<Index>(std::ranges::count(use, Use::kNone));
  return clean;
}

std::vector<std::string> CleanTets::notes() const {
  std::vector<std::string> notes;
  const auto say = [&notes](Index count, const char* one, const char* many, const char* what) {
    if (count == 0) return;
    notes.push_back(counted_text(static_cast<std::size_t>(count), one, many) + ' ' + what);
  };
  const auto left_out = [&say](Index count, const char* why) {
    say(count, "tetrahedron", "tetrahedra", why);
  };
  left_out(repeated_corner, "with a repeated corner left out");
  left_out(duplicate, "that stood there before left out");
  left_out(flat, "without volume left out");
  say(lost_vertices, "vertex", "vertices", "in none of the tetrahedra that are left");
  say(unused_vertices, "vertex", "vertices", "in no tetrahedron");
  return notes;
}

}  // namespace geotherm
