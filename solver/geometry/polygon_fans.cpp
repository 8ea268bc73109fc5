// SPDX-License-Identifier: MIT
#include "solver/geometry/polygon_fans.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"
#include "solver/geometry/tufted_cover.h"

namespace geotherm {
namespace {

/// Minimum faces per thread.
constexpr std::int64_t kFanGrain = 1 << 12;

/// `vertices`: above all corners.
CleanFaces as_clean_faces(Index vertices, const std::vector<Face>& faces, int threads) {
  CleanFaces out;
  out.faces = faces;
  out.edges = EdgeTable(vertices, faces, threads);
  return out;
}

void join_sides(IntrinsicMesh& mesh, Side a, Side b) {
  mesh.twin[a] = b;
  mesh.twin[b] = a;
}

class FanBuilder {
 public:
  FanBuilder(const CellComplex& given, double unit, int threads, PolygonFans& out)
      : given_(given), unit_(unit), threads_(threads), out_(out), mesh_(out.mesh) {}

  void number_faces() {
    const Index count = given_.cell_count();
    for (Index c = 0; c < count; ++c) {
      if (c == 0 || given_.numbers[c] != given_.numbers[c - 1]) out_.first_cell.push_back(c);
    }
    faces_ = static_cast<Index>(out_.first_cell.size());
    out_.first_cell.push_back(count);
  }

  /// First at the places of their cells, then one after the other.
  void lay_triangles() {
    const auto count = static_cast<std::size_t>(given_.cell_count());
    mesh_.faces.resize(count);
    mesh_.lengths.resize(count);
    std::vector<char> whole(static_cast<std::size_t>(faces_), 0);
    parallel_for(threads_, faces_, kFanGrain, [&](std::int64_t begin, std::int64_t end) {
      std::vector<Vec3> at;
      for (std::int64_t f = begin; f < end; ++f) {
        whole[f] = lay_triangles_of(static_cast<Index>(f), at) ? 1 : 0;
      }
    });
    Index kept = 0;
    for (Index f = 0; f < faces_; ++f) {
      out_.first.push_back(kept);
      for (Index c = out_.first_cell[f]; c < out_.first_cell[f + 1] && whole[f] != 0; ++c, ++kept) {
        mesh_.faces[kept] = mesh_.faces[c];
        mesh_.lengths[kept] = mesh_.lengths[c];
      }
    }
    out_.first.push_back(kept);
    mesh_.faces.resize(static_cast<std::size_t>(kept));
    mesh_.lengths.resize(static_cast<std::size_t>(kept));
    mesh_.twin.assign(3 * mesh_.faces.size(), kNoSide);
  }

  void join_within_faces() {
    for (Index f = 0; f < faces_; ++f) {
      const Index begin = out_.first[f], count = out_.first[f + 1] - begin;
      if (is_cut(given_, out_.first_cell[f])) {
        for (Side side = 3 * begin; side < 3 * (begin + count); ++side) {
          const Side twin = side_of_cut(f, second_of(side), first_of(side));
          if (twin != kNoSide) join_sides(mesh_, side, twin);
        }
        continue;
      }
      for (Index i = 0; i < count; ++i) {
        join_sides(mesh_, 3 * (begin + i) + 1, 3 * (begin + (i + 1) % count) + 2);
      }
    }
  }

  /// Sides of two faces that run against each other are one edge; a lone one is on the boundary.
  void join_faces() {
    const auto emit = [this](std::size_t f, const auto& put) {
      const auto corners = given_.corners_of(out_.first_cell[f]);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Index from = corners[i], to = corners[(i + 1) % corners.size()];
        const auto face = static_cast<Index>(f);
        Side side = kNoSide;
        if (is_cut(given_, out_.first_cell[face])) {
          side = side_of_cut(face, from, to);
        } else if (out_.has_triangles(face)) {
          side = 3 * (out_.first[face] + static_cast<Index>(i));
        }
        put(std::min(from, to), OuterSide{std::max(from, to), side, from < to});
      }
    };
    std::vector<std::uint32_t> start;
    auto sides =
        counting_sort<OuterSide>(static_cast<std::size_t>(faces_),
                                 static_cast<std::size_t>(given_.vertices), threads_, emit, start);
    for (std::size_t v = 0; v + 1 < start.size(); ++v) {
      OuterSide *at = sides.data() + start[v], *const end = sides.data() + start[v + 1];
      std::sort(at, end, [](const OuterSide& a, const OuterSide& b) { return a.high < b.high; });
      for (OuterSide* next = at; at != end; at = next) {
        while (next != end && next->high == at->high) ++next;
        if (next - at > 1) join_edge({at, next});
      }
    }
  }

 private:
  /// A side of a face at the lower of its ends.
  struct OuterSide {
    Index high = kNoIndex;
    Side side = kNoSide;  ///< kNoSide: of a face without triangles
    bool runs_up = false;
  };

  double length(const Vec3& a, const Vec3& b) const { return ((b - a) / unit_).norm(); }

  Index first_of(Side side) const { return mesh_.faces[face_of(side)][corner_of(side)]; }
  Index second_of(Side side) const {
    return mesh_.faces[face_of(side)][next_corner(corner_of(side))];
  }

  /// The side of the triangles of a face that was cut which runs so; kNoSide: there is none.
  Side side_of_cut(Index f, Index from, Index to) const {
    for (Side side = 3 * out_.first[f]; side < 3 * out_.first[f + 1]; ++side) {
      if (first_of(side) == from && second_of(side) == to) return side;
    }
    return kNoSide;
  }

  /// False where the triangles are not the face.
  bool lay_triangles_of(Index f, std::vector<Vec3>& at) {
    const Index begin = out_.first_cell[f], count = out_.first_cell[f + 1] - begin;
    const auto corners = given_.corners_of(begin);
    const auto k = static_cast<Index>(corners.size());
    const std::vector<Vec3>& places = given_.positions;
    const Vec3& apex = given_.virtual_vertices[begin];
    const auto put = [&](Index cell, const Face& face, const Vec3& third) {
      mesh_.faces[cell] = face;
      mesh_.lengths[cell] = {length(places[face[0]], places[face[1]]),
                             length(places[face[1]], third), length(third, places[face[0]])};
    };
    if (is_cut(given_, begin)) {
      if (count != k - 2) return false;
      for (Index cell = begin; cell < begin + count; ++cell) {
        const auto three = cut_corners(given_, cell);
        if (three.empty()) return false;
        const Index third = corners[three[2]];
        put(cell, {corners[three[0]], corners[three[1]], third}, places[third]);
      }
      return true;
    }
    if (count != k) return false;
    const Vec3& origin = places[corners.front()];
    at.clear();
    for (const Index v : corners) at.push_back((places[v] - origin) / unit_);
    if (!sees_all_sides(at, (apex - origin) / unit_)) return false;
    for (Index i = 0; i < k; ++i) {
      put(begin + i, {corners[i], corners[(i + 1) % k], given_.vertices + f}, apex);
    }
    return true;
  }

  void join_edge(std::span<const OuterSide> sides) {
    const bool all =
        std::ranges::none_of(sides, [](const OuterSide& each) { return each.side == kNoSide; });
    if (all && sides.size() == 2 && sides[0].runs_up != sides[1].runs_up) {
      return join_sides(mesh_, sides[0].side, sides[1].side);
    }
    for (const OuterSide& each : sides) {
      if (each.side == kNoSide) continue;
      mesh_.twin[each.side] = each.side;
      (all ? out_.folds : out_.walls).push_back(each.side);
    }
  }

  const CellComplex& given_;
  const double unit_;
  const int threads_;
  PolygonFans& out_;
  IntrinsicMesh& mesh_;
  Index faces_ = 0;
};

}  // namespace

bool sees_all_sides(std::span<const Vec3> corners, const Vec3& virtual_vertex) {
  const auto twice = [&](std::size_t k) -> Vec3 {
    return (corners[k] - virtual_vertex).cross(corners[(k + 1) % corners.size()] - virtual_vertex);
  };
  Vec3 normal = Vec3::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k) normal += twice(k);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (!(normal.dot(twice(k)) > 0)) return false;
  }
  return true;
}

bool is_flat_triangle(const std::array<double, 3>& lengths) {
  const double longest = std::ranges::max(lengths);
  return !(lengths[0] + lengths[1] + lengths[2] - 2 * longest > kFlatTriangle * longest);
}

std::vector<std::size_t> cut_corners(const CellComplex& given, Index cell) {
  const std::size_t count = given.corners_of(cell).size();
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < count; ++k) {
    const double* const gradient = given.gradients.data() + 2 * (given.start[cell] + k);
    if (count == 3 || gradient[0] != 0 || gradient[1] != 0) out.push_back(k);
  }
  if (out.size() != 3) out.clear();
  return out;
}

PolygonFans build_fans(const CellComplex& given, double unit, int threads) {
  PolygonFans out;
  FanBuilder builder(given, unit, threads, out);
  builder.number_faces();
  builder.lay_triangles();
  builder.join_within_faces();
  builder.join_faces();
  mollify(out.mesh, Strictness::kHeights, threads);
  return out;
}

void find_parts(const CellComplex& given, PolygonFans& fans) {
  DisjointSets sets(static_cast<std::size_t>(given.vertices));
  std::vector<char> used(static_cast<std::size_t>(given.vertices), 0);
  for (Index f = 0; f < fans.face_count(); ++f) {
    const auto corners = given.corners_of(fans.first_cell[f]);
    for (const Index v : corners) {
      used[v] = 1;
      sets.join(corners.front(), v);
    }
  }
  fans.parts.of.assign(used.size(), kNoIndex);
  for (Index v = 0; v < given.vertices; ++v) {
    if (used[v] == 0) continue;
    const Index root = sets.root(v);
    fans.parts.of[v] = root == v ? fans.parts.count++ : fans.parts.of[root];
  }
  fans.is_not_manifold.assign(static_cast<std::size_t>(fans.parts.count), 0);
  for (const Side side : fans.folds) {
    fans.is_not_manifold[fans.parts.of[fans.mesh.faces[face_of(side)][corner_of(side)]]] = 1;
  }
}

bool cover_fans(std::span<const Vec3> places, PolygonFans& fans, int threads) {
  if (fans.folds.empty()) return false;
  IntrinsicMesh& mesh = fans.mesh;
  const CleanFaces clean = as_clean_faces(static_cast<Index>(places.size()), mesh.faces, threads);
  std::vector<char> doubled(mesh.faces.size());
  std::ranges::transform(mesh.faces, doubled.begin(), [&fans](const Face& face) {
    return fans.is_not_manifold[fans.parts.of[face[0]]];
  });
  make_tufted_cover(mesh, places, clean, doubled);
  for (const Side side : fans.walls) {
    mesh.twin[side] = side;
    const Index back = mesh.back[face_of(side)];
    if (back == kNoIndex) continue;
    const Side behind = 3 * back + 2 - corner_of(side);
    mesh.twin[behind] = behind;
  }
  return true;
}

}  // namespace geotherm
