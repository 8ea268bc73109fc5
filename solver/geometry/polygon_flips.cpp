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
#include "solver/geometry/intrinsic_refinement.h"

namespace geotherm {
namespace {

/// Minimum faces per thread.
constexpr std::int64_t kFanGrain = 1 << 12;

/// Triangles are flat whose longest side is shorter than the two others by less than this share of
/// it: the rounding of lengths would decide their angles.
constexpr double kFlatFan = 1e-5;

/// Vertices are inserted up to as many as there are, and on small meshes up to so many more.
constexpr Index kFewInsertedInFans = 1000;

bool is_flat_triangle(const std::array<double, 3>& l) {
  const double longest = std::ranges::max(l);
  return !(l[0] + l[1] + l[2] - 2 * longest > kFlatFan * longest);
}

double mean_side(const std::array<double, 3>& l) { return (l[0] + l[1] + l[2]) / 3; }

/// The triangles at the virtual vertices of polygons, as one intrinsic mesh. The virtual vertex of
/// face i has the number V + i; inserted vertices have numbers from V + F on. Faces that stay as
/// they are have no triangles in it; a side at one of them is its own twin, which neither a flip
/// nor a split passes.
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
    lay_fans();
    join_within_faces();
    join_faces();
  }

  /// Flips and refines; false where nothing has to be flipped.
  Result<bool> edit(const Progress& progress, FlippedPolygons& out) {
    std::vector<Side> sides = non_delaunay_sides(mesh_, threads_);
    if (sides.empty()) return false;
    auto flips = flip_to_delaunay(mesh_, std::move(sides), progress);
    if (!flips) return flips.error();
    edits_ = std::move(*flips);
    find_parts(out.parts);
    measure_widths(out);
    Components parts = out.parts;
    std::vector<Vec3> places = given_.positions;
    for (Index f = 0; f < face_count(); ++f) {
      const auto fan = static_cast<std::size_t>(first_[f]);
      const bool is_vertex = takes_part_[f] != 0 && !is_triangle(f);
      parts.of.push_back(is_vertex ? parts.of[given_.corners_of(first_[f]).front()] : kNoIndex);
      places.push_back(given_.virtual_vertices[fan]);
    }
    auto refined = refine_triangulation(mesh_, edits_, parts, out.mean_width, places,
                                        given_.vertices + kFewInsertedInFans, threads_, progress);
    if (!refined) return refined.error();
    refinement_ = *std::move(refined);
    out.grading = refinement_.grading;
    return true;
  }

  /// The cells after that; false where a triangle has lost its height to rounding.
  bool make_cells(FlippedPolygons& out) const {
    const std::vector<char> touched = touched_triangles();
    CellComplex& cells = out.cells;
    cells.dimension = given_.dimension;
    cells.positions = given_.positions;
    cells.on_boundary = given_.on_boundary;
    cells.lengths_are_straight = given_.lengths_are_straight;
    cells.start.reserve(given_.start.size());
    cells.corners.reserve(given_.corners.size());
    cells.gradients.reserve(given_.gradients.size());
    cells.start.push_back(0);
    out.virtual_of_cell.assign(static_cast<std::size_t>(given_.cell_count()), kNoIndex);
    std::vector<Index> number_of_virtual(static_cast<std::size_t>(face_count()), kNoIndex);
    for (Index f = 0; f < face_count(); ++f) {
      if (!is_touched(f, touched) || is_triangle(f)) continue;
      number_of_virtual[f] = static_cast<Index>(cells.positions.size());
      std::fill(out.virtual_of_cell.begin() + first_[f],
                out.virtual_of_cell.begin() + first_[f + 1], number_of_virtual[f]);
      cells.positions.push_back(given_.virtual_vertices[first_[f]]);
    }
    const Index first_inserted = static_cast<Index>(cells.positions.size());
    cells.positions.insert(cells.positions.end(), refinement_.positions.begin(),
                           refinement_.positions.end());
    cells.vertices = static_cast<Index>(cells.positions.size());
    cells.on_boundary.resize(static_cast<std::size_t>(first_inserted), 0);
    cells.on_boundary.insert(cells.on_boundary.end(), refinement_.on_border.begin(),
                             refinement_.on_border.end());
    const auto number_of = [&](Index v) {
      if (v < given_.vertices) return v;
      const Index face = v - given_.vertices;
      return face < face_count() ? number_of_virtual[face] : first_inserted + face - face_count();
    };
    const auto add = [&](Index t) {
      const Face& face = mesh_.faces[t];
      const Face triangle = {number_of(face[0]), number_of(face[1]), number_of(face[2])};
      out.triangle_of_cell.push_back(static_cast<Index>(out.triangles.size()));
      out.triangles.push_back(triangle);
      out.lengths.push_back(mesh_.lengths[t]);
      return add_triangle(triangle, mesh_.lengths[t], cells);
    };
    for (Index f = 0; f < face_count(); ++f) {
      for (Index c = first_[f]; c < first_[f + 1]; ++c) {
        if (!is_touched(f, touched)) {
          copy_cell(c, cells);
          out.triangle_of_cell.push_back(kNoIndex);
        } else if (!add(fan_[f] + c - first_[f])) {
          return false;
        }
      }
    }
    for (Index t = fan_.back(); t < mesh_.face_count(); ++t) {
      if (!add(t)) return false;
    }
    return true;
  }

 private:
  Index face_count() const { return static_cast<Index>(first_.size()) - 1; }
  bool is_triangle(Index f) const { return first_[f + 1] - first_[f] == 1; }
  double length(const Vec3& a, const Vec3& b) const { return ((b - a) / unit_).norm(); }

  /// The triangles of all faces that take part.
  void lay_fans() {
    const auto count = static_cast<std::size_t>(given_.cell_count());
    mesh_.faces.resize(count);
    mesh_.lengths.resize(count);
    takes_part_.assign(static_cast<std::size_t>(face_count()), 0);
    parallel_for(threads_, face_count(), kFanGrain, [this](std::int64_t begin, std::int64_t end) {
      std::vector<Vec3> at;
      for (std::int64_t f = begin; f < end; ++f) {
        takes_part_[f] = lay_fan(static_cast<Index>(f), at) ? 1 : 0;
      }
    });
    Index kept = 0;
    for (Index f = 0; f < face_count(); ++f) {
      fan_.push_back(kept);
      for (Index c = first_[f]; c < first_[f + 1] && takes_part_[f] != 0; ++c, ++kept) {
        mesh_.faces[kept] = mesh_.faces[c];
        mesh_.lengths[kept] = mesh_.lengths[c];
      }
    }
    fan_.push_back(kept);
    mesh_.faces.resize(static_cast<std::size_t>(kept));
    mesh_.lengths.resize(static_cast<std::size_t>(kept));
    mesh_.twin.assign(3 * mesh_.faces.size(), kNoSide);
  }

  /// The triangles of a face, at the places of its cells; false where they are not the face.
  bool lay_fan(Index f, std::vector<Vec3>& at) {
    const Index begin = first_[f], count = first_[f + 1] - begin;
    const auto corners = given_.corners_of(begin);
    const auto k = static_cast<Index>(corners.size());
    if (count != (k == 3 ? 1 : k)) return false;
    const std::vector<Vec3>& places = given_.positions;
    const Vec3& origin = places[corners.front()];
    const Vec3& apex = given_.virtual_vertices[begin];
    at.clear();
    for (const Index v : corners) at.push_back((places[v] - origin) / unit_);
    if (k > 3 && !sees_all_sides(at, (apex - origin) / unit_)) return false;
    for (Index i = 0; i < count; ++i) {
      const Index from = corners[i], to = corners[(i + 1) % k];
      const Vec3& third = k == 3 ? places[corners[2]] : apex;
      mesh_.faces[begin + i] = {from, to, k == 3 ? corners[2] : given_.vertices + f};
      mesh_.lengths[begin + i] = {length(places[from], places[to]), length(places[to], third),
                                  length(third, places[from])};
      if (is_flat_triangle(mesh_.lengths[begin + i])) return false;
    }
    return true;
  }

  void join(Side a, Side b) {
    mesh_.twin[a] = b;
    mesh_.twin[b] = a;
  }

  void join_within_faces() {
    for (Index f = 0; f < face_count(); ++f) {
      const Index count = fan_[f + 1] - fan_[f];
      for (Index i = 0; i < count && !is_triangle(f); ++i) {
        join(3 * (fan_[f] + i) + 1, 3 * (fan_[f] + (i + 1) % count) + 2);
      }
    }
  }

  /// A side of a face at the lower of its ends.
  struct OuterSide {
    Index high = kNoIndex;
    Side side = kNoSide;  ///< kNoSide: of a face that stays as it is
    bool runs_up = false;
  };

  /// Sides of two faces that run against each other are one edge; a lone one is on the boundary.
  void join_faces() {
    const auto emit = [this](std::size_t f, const auto& put) {
      const auto corners = given_.corners_of(first_[f]);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Index from = corners[i], to = corners[(i + 1) % corners.size()];
        const auto place = static_cast<Index>(i);
        const Side side = 3 * fan_[f] + (corners.size() == 3 ? place : 3 * place);
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
      for (OuterSide* next = at; at != end; at = next) {
        while (next != end && next->high == at->high) ++next;
        if (next - at == 1) continue;
        const bool is_edge = next - at == 2 && at[0].side != kNoSide && at[1].side != kNoSide &&
                             at[0].runs_up != at[1].runs_up;
        if (is_edge) join(at[0].side, at[1].side);
        for (; !is_edge && at != next; ++at) {
          if (at->side != kNoSide) mesh_.twin[at->side] = at->side;
        }
      }
    }
  }

  void find_parts(Components& out) const {
    DisjointSets sets(static_cast<std::size_t>(given_.vertices));
    std::vector<char> used(static_cast<std::size_t>(given_.vertices), 0);
    for (Index f = 0; f < face_count(); ++f) {
      const auto corners = given_.corners_of(first_[f]);
      for (const Index v : corners) {
        used[v] = 1;
        sets.join(corners.front(), v);
      }
    }
    out.of.assign(used.size(), kNoIndex);
    for (Index v = 0; v < given_.vertices; ++v) {
      if (used[v] == 0) continue;
      const Index root = sets.root(v);
      out.of[v] = root == v ? out.count++ : out.of[root];
    }
  }

  /// By the mean distances between two corners of the cells.
  void measure_widths(FlippedPolygons& out) const {
    const std::vector<char> touched = touched_triangles();
    out.mean_width.assign(static_cast<std::size_t>(out.parts.count), 0.0);
    std::vector<double> cells(out.mean_width.size(), 0.0);
    for (Index f = 0; f < face_count(); ++f) {
      const Index part = out.parts.of[given_.corners_of(first_[f]).front()];
      const bool flipped = is_touched(f, touched);
      for (Index c = first_[f]; c < first_[f + 1]; ++c) {
        out.mean_width[part] +=
            flipped ? mean_side(mesh_.lengths[fan_[f] + c - first_[f]]) : given_.widths[c] / unit_;
        ++cells[part];
      }
    }
    for (std::size_t part = 0; part < cells.size(); ++part) out.mean_width[part] /= cells[part];
  }

  std::vector<char> touched_triangles() const {
    std::vector<char> out(mesh_.faces.size(), 0);
    for (const Edit& edit : edits_) {
      out[edit.f] = out[edit.g] = 1;
      if (edit.kind == Edit::Kind::kFaceSplit) out[edit.g + 1] = 1;
    }
    return out;
  }

  bool is_touched(Index f, const std::vector<char>& touched) const {
    const auto end = touched.begin() + fan_[f + 1];
    return std::find(touched.begin() + fan_[f], end, 1) != end;
  }

  void copy_cell(Index c, CellComplex& cells) const {
    const auto corners = given_.corners_of(c);
    cells.corners.insert(cells.corners.end(), corners.begin(), corners.end());
    cells.start.push_back(std::ssize(cells.corners));
    const auto from = given_.gradients.begin() + 2 * given_.start[c];
    cells.gradients.insert(cells.gradients.end(), from, from + 2 * std::ssize(corners));
    cells.measures.push_back(given_.measures[c]);
    cells.widths.push_back(given_.widths[c]);
  }

  bool add_triangle(const Face& triangle, const std::array<double, 3>& lengths,
                    CellComplex& cells) const {
    const FaceLayout p = lay_out(lengths);
    const double across = 1 / p.height, along = 1 / p.base, lean = -p.x / (p.base * p.height);
    if (!(p.height > 0) || !std::isfinite(across) || !std::isfinite(lean)) { fprintf(stderr,"LOST %d %d %d  %g %g %g n %zu\n", triangle[0],triangle[1],triangle[2],lengths[0],lengths[1],lengths[2],mesh_.faces.size()); return false; }
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
    cells.measures.push_back(p.base * unit_ * (p.height * unit_) / 2);
    cells.widths.push_back(mean_side(lengths) * unit_);
    return true;
  }

  const CellComplex& given_;
  const double unit_;
  const int threads_;
  std::vector<Index> first_;      ///< cell of each face, and the number of cells
  std::vector<Index> fan_;        ///< triangle of each face, and how many there were at first
  std::vector<char> takes_part_;  ///< of each face
  IntrinsicMesh mesh_;
  std::vector<Edit> edits_;
  Refinement refinement_;
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

Result<std::shared_ptr<const FlippedPolygons>> flip_polygons(const CellComplex& given, double unit,
                                                             int threads,
                                                             const Progress& progress) {
  using Flipped = std::shared_ptr<const FlippedPolygons>;
  if (given.virtual_vertices.empty() || !given.lengths_are_straight) return Flipped();
  FanMesh fans(given, unit, threads);
  auto out = std::make_shared<FlippedPolygons>();
  const auto edited = fans.edit(progress, *out);
  if (!edited) return edited.error();
  if (!*edited || !fans.make_cells(*out)) return Flipped();
  return Flipped(std::move(out));
}

}  // namespace geotherm
