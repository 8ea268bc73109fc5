// SPDX-License-Identifier: MIT
#include "solver/geometry/polygon_flips.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"
#include "solver/geometry/delaunay.h"
#include "solver/geometry/intrinsic_mesh.h"

namespace geotherm {
namespace {

/// Minimum faces per thread.
constexpr std::int64_t kFanGrain = 1 << 12;

/// Triangles are flat whose longest side is shorter than the two others by less than this share of
/// it: the rounding of lengths would decide their angles.
constexpr double kFlatFan = 1e-5;

bool is_flat_triangle(const std::array<double, 3>& l) {
  const double longest = std::ranges::max(l);
  return !(l[0] + l[1] + l[2] - 2 * longest > kFlatFan * longest);
}

/// The triangles at the virtual vertices of polygons, as one intrinsic mesh: triangle c is that of
/// cell c. The virtual vertex of face i has the number V + i. Faces that stay as they are have
/// triangles without twins.
class FanMesh {
 public:
  FanMesh(const CellComplex& given, double unit, int threads)
      : given_(given), unit_(unit), threads_(threads) {
    const auto count = static_cast<std::size_t>(given.cell_count());
    for (std::size_t c = 0; c < count; ++c) {
      if (c == 0 || given.numbers[c] != given.numbers[c - 1]) {
        first_.push_back(static_cast<Index>(c));
      }
    }
    first_.push_back(static_cast<Index>(count));
    mesh_.faces.assign(count, Face{0, 0, 0});
    mesh_.lengths.assign(count, {1, 1, 1});
    mesh_.twin.assign(3 * count, kNoSide);
    takes_part_.assign(static_cast<std::size_t>(face_count()), 0);
    parallel_for(threads, face_count(), kFanGrain, [this](std::int64_t begin, std::int64_t end) {
      std::vector<Vec3> at;
      for (std::int64_t f = begin; f < end; ++f) lay_fan(static_cast<Index>(f), at);
    });
    join_faces();
  }

  Index face_count() const { return static_cast<Index>(first_.size()) - 1; }
  IntrinsicMesh& mesh() { return mesh_; }

  /// The cells after these flips; null where a triangle has lost its height to rounding.
  std::shared_ptr<const FlippedPolygons> cells_after(std::span<const Edit> flips) const {
    auto out = std::make_shared<FlippedPolygons>();
    std::vector<char> touched(mesh_.faces.size(), 0);
    for (const Edit& flip : flips) touched[flip.f] = touched[flip.g] = 1;
    CellComplex& cells = out->cells;
    cells.dimension = given_.dimension;
    cells.widths = given_.widths;
    cells.numbers = given_.numbers;
    cells.positions = given_.positions;
    cells.on_boundary = given_.on_boundary;
    cells.lengths_are_straight = given_.lengths_are_straight;
    cells.measures = given_.measures;
    cells.start.reserve(given_.start.size());
    cells.corners.reserve(given_.corners.size());
    cells.gradients.reserve(given_.gradients.size());
    cells.start.push_back(0);
    out->triangle_of_cell.assign(mesh_.faces.size(), kNoIndex);
    out->virtual_of_cell.assign(mesh_.faces.size(), kNoIndex);
    std::vector<Index> hidden(static_cast<std::size_t>(face_count()), kNoIndex);
    for (Index f = 0; f < face_count(); ++f) {
      const auto begin = touched.begin() + first_[f], end = touched.begin() + first_[f + 1];
      if (std::find(begin, end, 1) == end) continue;
      std::fill(begin, end, 1);
      if (first_[f + 1] - first_[f] == 1) continue;  // a triangle has no virtual vertex
      hidden[f] = static_cast<Index>(cells.positions.size());
      std::fill(out->virtual_of_cell.begin() + first_[f],
                out->virtual_of_cell.begin() + first_[f + 1], hidden[f]);
      cells.positions.push_back(given_.virtual_vertices[first_[f]]);
    }
    cells.vertices = static_cast<Index>(cells.positions.size());
    if (!cells.on_boundary.empty()) cells.on_boundary.resize(cells.positions.size(), 0);
    for (Index c = 0; c < mesh_.face_count(); ++c) {
      if (touched[c] == 0) {
        copy_cell(c, cells);
        continue;
      }
      Face triangle = mesh_.faces[c];
      for (Index& v : triangle) v = v < given_.vertices ? v : hidden[v - given_.vertices];
      if (!add_triangle(c, triangle, cells)) return nullptr;
      out->triangle_of_cell[c] = static_cast<Index>(out->triangles.size());
      out->triangles.push_back(triangle);
      out->lengths.push_back(mesh_.lengths[c]);
    }
    return out;
  }

 private:
  double length(const Vec3& a, const Vec3& b) const { return ((b - a) / unit_).norm(); }

  /// The triangles of a face, joined with each other, where they are the face.
  void lay_fan(Index f, std::vector<Vec3>& at) {
    const Index begin = first_[f], count = first_[f + 1] - begin;
    const auto corners = given_.corners_of(begin);
    const auto k = static_cast<Index>(corners.size());
    if (count != (k == 3 ? 1 : k)) return;
    const std::vector<Vec3>& places = given_.positions;
    const Vec3& origin = places[corners.front()];
    const Vec3& apex = given_.virtual_vertices[begin];
    at.clear();
    for (const Index v : corners) at.push_back((places[v] - origin) / unit_);
    if (k > 3 && !sees_all_sides(at, (apex - origin) / unit_)) return;
    for (Index i = 0; i < count; ++i) {
      const Index from = corners[i], to = corners[(i + 1) % k];
      const Vec3& third = k == 3 ? places[corners[2]] : apex;
      mesh_.faces[begin + i] = {from, to, k == 3 ? corners[2] : given_.vertices + f};
      mesh_.lengths[begin + i] = {length(places[from], places[to]), length(places[to], third),
                                  length(third, places[from])};
      if (is_flat_triangle(mesh_.lengths[begin + i])) return;
    }
    for (Index i = 0; i < count && k > 3; ++i) {
      const Side to_apex = 3 * (begin + i) + 1, from_apex = 3 * (begin + (i + 1) % k) + 2;
      mesh_.twin[to_apex] = from_apex;
      mesh_.twin[from_apex] = to_apex;
    }
    takes_part_[f] = 1;
  }

  /// A side of a face at the lower of its ends.
  struct OuterSide {
    Index high = kNoIndex;
    Side side = kNoSide;  ///< kNoSide: of a face that stays as it is
    bool runs_up = false;
  };

  /// Sides of two faces that run against each other are one edge.
  void join_faces() {
    const auto emit = [this](std::size_t f, const auto& put) {
      const Index begin = first_[f];
      const auto corners = given_.corners_of(begin);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Index from = corners[i], to = corners[(i + 1) % corners.size()];
        const auto place = static_cast<Index>(i);
        const Side side = corners.size() == 3 ? 3 * begin + place : 3 * (begin + place);
        put(std::min(from, to),
            OuterSide{std::max(from, to), takes_part_[f] != 0 ? side : kNoSide, from < to});
      }
    };
    std::vector<std::uint32_t> start;
    auto sides =
        counting_sort<OuterSide>(static_cast<std::size_t>(face_count()),
                                 static_cast<std::size_t>(given_.vertices), threads_, emit, start);
    for (std::size_t v = 0; v + 1 < start.size(); ++v) {
      OuterSide *at = sides.data() + start[v], *const end = sides.data() + start[v + 1];
      std::sort(at, end, [](const OuterSide& a, const OuterSide& b) { return a.high < b.high; });
      while (at != end) {
        OuterSide* next = at;
        while (next != end && next->high == at->high) ++next;
        if (next - at == 2 && at[0].side != kNoSide && at[1].side != kNoSide &&
            at[0].runs_up != at[1].runs_up) {
          mesh_.twin[at[0].side] = at[1].side;
          mesh_.twin[at[1].side] = at[0].side;
        }
        at = next;
      }
    }
  }

  void copy_cell(Index c, CellComplex& cells) const {
    const auto corners = given_.corners_of(c);
    cells.corners.insert(cells.corners.end(), corners.begin(), corners.end());
    cells.start.push_back(std::ssize(cells.corners));
    const auto from = given_.gradients.begin() + 2 * given_.start[c];
    cells.gradients.insert(cells.gradients.end(), from, from + 2 * std::ssize(corners));
  }

  bool add_triangle(Index c, const Face& triangle, CellComplex& cells) const {
    const FaceLayout p = lay_out(mesh_.lengths[c]);
    const double across = 1 / p.height, along = 1 / p.base, lean = -p.x / (p.base * p.height);
    if (!(p.height > 0) || !std::isfinite(across) || !std::isfinite(lean)) return false;
    const std::array<std::array<double, 2>, 3> of_corners = {
        {{-along, -lean - across}, {along, lean}, {0, across}}};
    const auto begin = cells.start.back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto same = std::find(cells.corners.begin() + begin, cells.corners.end(), triangle[k]);
      const auto place = same - cells.corners.begin();
      if (same == cells.corners.end()) {
        cells.corners.push_back(triangle[k]);
        cells.gradients.insert(cells.gradients.end(), {0, 0});
      }
      for (int e = 0; e < 2; ++e) cells.gradients[2 * place + e] += of_corners[k][e] / unit_;
    }
    cells.start.push_back(std::ssize(cells.corners));
    cells.measures[c] = p.base * unit_ * (p.height * unit_) / 2;
    return true;
  }

  const CellComplex& given_;
  const double unit_;
  const int threads_;
  std::vector<Index> first_;  ///< cell of each face, and the number of cells
  std::vector<char> takes_part_;
  IntrinsicMesh mesh_;
};

}  // namespace

bool sees_all_sides(std::span<const Vec3> corners, const Vec3& virtual_vertex) {
  const auto twice = [&](std::size_t k) {
    return (corners[k] - virtual_vertex)
        .cross(corners[(k + 1) % corners.size()] - virtual_vertex)
        .eval();
  };
  Vec3 normal = Vec3::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k) normal += twice(k);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (!(normal.dot(twice(k)) > 0)) return false;
  }
  return true;
}

Result<std::shared_ptr<const FlippedPolygons>> flip_polygons(const CellComplex& given, double unit,
                                                             int threads,
                                                             const Progress& progress) {
  using Flipped = std::shared_ptr<const FlippedPolygons>;
  if (given.virtual_vertices.empty() || !given.lengths_are_straight) return Flipped();
  FanMesh fans(given, unit, threads);
  std::vector<Side> sides = non_delaunay_sides(fans.mesh(), threads);
  if (sides.empty()) return Flipped();
  const auto flips = flip_to_delaunay(fans.mesh(), std::move(sides), progress);
  if (!flips) return flips.error();
  return fans.cells_after(*flips);
}

}  // namespace geotherm
