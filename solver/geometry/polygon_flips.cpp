// SPDX-License-Identifier: MIT
#include "solver/geometry/polygon_flips.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/core/sorting.h"
#include "solver/geometry/delaunay.h"
#include "solver/geometry/intrinsic_refinement.h"
#include "solver/geometry/polygon_fans.h"

namespace geotherm {
namespace {

/// Vertices are inserted up to as many as there are, and on small meshes up to so many more.
constexpr Index kFewInsertedInFans = 1000;

double mean_side(const std::array<double, 3>& l) { return (l[0] + l[1] + l[2]) / 3; }

/// Triangles are flipped where the cotangents at an edge among them have a sum below this: near to
/// 0 the elimination of the virtual vertices does better. Chosen on the meshes of docs/domains.md.
constexpr double kFlipped = -0.3;

/// `from_virtual`: the vertices from there on are virtual. Between triangles without one, as on
/// triangle meshes, all are flipped.
bool is_bad(const IntrinsicMesh& mesh, Index from_virtual, Side side) {
  const Side twin = mesh.twin[side];
  const auto has_virtual = [&](Side at) {
    return std::ranges::max(mesh.faces[face_of(at)]) >= from_virtual;
  };
  const double sum = opposite_cotangent(mesh.lengths[face_of(side)], corner_of(side)) +
                     opposite_cotangent(mesh.lengths[face_of(twin)], corner_of(twin));
  return sum < (has_virtual(side) || has_virtual(twin) ? kFlipped : 0);
}

/// Triangles that flips join form a region, and regions with a bad edge are flipped: which ones
/// those are does not depend on the order of the flips. `sides`: non_delaunay_sides().
Result<std::vector<Edit>> flip_bad_regions(IntrinsicMesh& mesh, Index from_virtual,
                                           std::vector<Side> sides, const Progress& progress) {
  IntrinsicMesh all = mesh;
  const auto flips = flip_to_delaunay(all, sides, progress);
  if (!flips) return flips.error();
  DisjointSets regions(mesh.faces.size());
  for (const Edit& flip : *flips) regions.join(flip.f, flip.g);
  std::vector<char> is_bad_region(mesh.faces.size(), 0);
  for (const Side side : sides) {
    if (is_bad(mesh, from_virtual, side)) is_bad_region[regions.root(face_of(side))] = 1;
  }
  const auto left_out =
      std::erase_if(sides, [&](Side side) { return !is_bad_region[regions.root(face_of(side))]; });
  if (left_out > 0) return flip_to_delaunay(mesh, std::move(sides), progress);
  mesh = std::move(all);
  return flips;
}

/// Edits the triangles of polygons, and makes cells of what they are then. Inserted vertices have
/// numbers from V + F on.
class PolygonFlipper {
 public:
  PolygonFlipper(const CellComplex& given, double unit, int threads)
      : given_(given), unit_(unit), threads_(threads), fans_(build_fans(given, unit, threads)) {}

  /// Flips and refines; false where nothing has to be flipped.
  Result<bool> edit(const Progress& progress, FlippedPolygons& out) {
    std::vector<Side> sides = non_delaunay_sides(mesh_, threads_);
    const auto bad = [this](Side side) { return is_bad(mesh_, given_.vertices, side); };
    if (std::ranges::none_of(sides, bad)) return false;
    find_parts(given_, fans_);
    std::vector<Vec3> places = given_.positions;
    for (Index f = 0; f < fans_.face_count(); ++f) {
      const Index first = fans_.first_cell[f];
      places.push_back(is_cut(given_, first) ? given_.positions[given_.corners_of(first).front()]
                                             : given_.virtual_vertices[first]);
    }
    if (cover_fans(places, fans_, threads_)) sides = non_delaunay_sides(mesh_, threads_);
    first_split_ = mesh_.face_count();
    auto flips = flip_bad_regions(mesh_, given_.vertices, std::move(sides), progress);
    if (!flips) return flips.error();
    edits_ = std::move(*flips);
    if (mollify(mesh_, Strictness::kInequalities, threads_) > 0) {
      flips =
          flip_bad_regions(mesh_, given_.vertices, non_delaunay_sides(mesh_, threads_), progress);
      if (!flips) return flips.error();
      edits_.insert(edits_.end(), flips->begin(), flips->end());
    }
    out.parts = fans_.parts;
    measure_widths(out);
    Components parts = fans_.parts;
    for (Index f = 0; f < fans_.face_count(); ++f) {
      const bool is_vertex = fans_.has_triangles(f) && !is_cut(given_, fans_.first_cell[f]);
      parts.of.push_back(is_vertex ? part_of(f) : kNoIndex);
    }
    auto refined = refine_triangulation(mesh_, edits_, parts, out.mean_width, places,
                                        given_.vertices + kFewInsertedInFans, threads_, progress);
    if (!refined) return refined.error();
    refinement_ = *std::move(refined);
    inserted_parts_.assign(parts.of.begin() + std::ssize(places), parts.of.end());
    out.grading = refinement_.grading;
    out.flips = static_cast<Index>(std::ranges::count(edits_, Edit::Kind::kFlip, &Edit::kind));
    out.inserted = refinement_;
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
    std::vector<Index> number_of_virtual(static_cast<std::size_t>(fans_.face_count()), kNoIndex);
    for (Index f = 0; f < fans_.face_count(); ++f) {
      if (!is_touched(f, touched) || is_cut(given_, fans_.first_cell[f])) continue;
      number_of_virtual[f] = static_cast<Index>(cells.positions.size());
      std::fill(out.virtual_of_cell.begin() + fans_.first_cell[f],
                out.virtual_of_cell.begin() + fans_.first_cell[f + 1], number_of_virtual[f]);
      cells.positions.push_back(given_.virtual_vertices[fans_.first_cell[f]]);
    }
    const Index first_inserted = static_cast<Index>(cells.positions.size());
    cells.positions.insert(cells.positions.end(), refinement_.positions.begin(),
                           refinement_.positions.end());
    cells.vertices = static_cast<Index>(cells.positions.size());
    cells.on_boundary.resize(static_cast<std::size_t>(first_inserted), 0);
    cells.on_boundary.insert(cells.on_boundary.end(), refinement_.on_boundary.begin(),
                             refinement_.on_boundary.end());
    const auto number_of = [&](Index v) {
      if (v < given_.vertices) return v;
      const Index face = v - given_.vertices;
      const Index faces = fans_.face_count();
      return face < faces ? number_of_virtual[face] : first_inserted + face - faces;
    };
    const auto add = [&](Index t) {
      const Face& face = mesh_.faces[t];
      const Face triangle = {number_of(face[0]), number_of(face[1]), number_of(face[2])};
      out.triangle_of_cell.push_back(static_cast<Index>(out.triangles.size()));
      out.triangles.push_back(triangle);
      out.lengths.push_back(mesh_.lengths[t]);
      const double share = is_covered(face[0]) ? 0.5 : 1;
      return add_triangle(triangle, mesh_.lengths[t], share, cells);
    };
    for (Index f = 0; f < fans_.face_count(); ++f) {
      for (Index c = fans_.first_cell[f]; c < fans_.first_cell[f + 1]; ++c) {
        if (!is_touched(f, touched)) {
          copy_cell(c, cells);
          out.triangle_of_cell.push_back(kNoIndex);
        } else if (!add(fans_.first[f] + c - fans_.first_cell[f])) {
          return false;
        }
      }
    }
    const Index fronts = fans_.first.back();
    for (Index t = 0; t < fronts && !mesh_.back.empty(); ++t) {
      if (touched[t] != 0 && mesh_.back[t] != kNoIndex && !add(mesh_.back[t])) return false;
    }
    for (Index t = first_split_; t < mesh_.face_count(); ++t) {
      if (!add(t)) return false;
    }
    return true;
  }

 private:
  Index part_of(Index face) const {
    return fans_.parts.of[given_.corners_of(fans_.first_cell[face]).front()];
  }

  /// Whether the part of a vertex is its tufted cover.
  bool is_covered(Index vertex) const {
    const Index face = vertex - given_.vertices, inserted = face - fans_.face_count();
    const Index part = face < 0       ? fans_.parts.of[vertex]
                       : inserted < 0 ? part_of(face)
                                      : inserted_parts_[inserted];
    return fans_.is_not_manifold[part] != 0;
  }

  /// Sets the mean width of each part to the mean side of its triangles.
  void measure_widths(FlippedPolygons& out) const {
    const std::vector<char> touched = touched_triangles();
    out.mean_width.assign(static_cast<std::size_t>(out.parts.count), 0.0);
    std::vector<double> cells(out.mean_width.size(), 0.0);
    for (Index f = 0; f < fans_.face_count(); ++f) {
      const Index part = part_of(f);
      const bool flipped = is_touched(f, touched);
      for (Index c = fans_.first_cell[f]; c < fans_.first_cell[f + 1]; ++c) {
        out.mean_width[part] +=
            flipped ? mean_side(mesh_.lengths[fans_.first[f] + c - fans_.first_cell[f]])
                    : given_.widths[c] / unit_;
        ++cells[part];
      }
    }
    for (std::size_t part = 0; part < cells.size(); ++part) out.mean_width[part] /= cells[part];
  }

  /// 1 for all triangles of a face of which an edit has changed one, or the back of one.
  std::vector<char> touched_triangles() const {
    std::vector<char> out(mesh_.faces.size(), 0);
    for (const Edit& edit : edits_) {
      out[edit.f] = out[edit.g] = 1;
      if (edit.kind == Edit::Kind::kFaceSplit) out[edit.g + 1] = 1;
    }
    for (std::size_t t = 0; t < mesh_.back.size(); ++t) {
      if (mesh_.back[t] != kNoIndex) out[t] |= out[mesh_.back[t]];
    }
    for (Index f = 0; f < fans_.face_count(); ++f) {
      const auto begin = out.begin() + fans_.first[f], end = out.begin() + fans_.first[f + 1];
      if (std::find(begin, end, 1) != end) std::fill(begin, end, 1);
    }
    return out;
  }

  bool is_touched(Index f, const std::vector<char>& touched) const {
    return fans_.has_triangles(f) && touched[fans_.first[f]] != 0;
  }

  void copy_cell(Index c, CellComplex& cells) const {
    const auto corners = given_.corners_of(c);
    cells.corners.insert(cells.corners.end(), corners.begin(), corners.end());
    cells.start.push_back(std::ssize(cells.corners));
    const auto from = given_.gradients.begin() + 2 * given_.start[c];
    cells.gradients.insert(cells.gradients.end(), from, from + 2 * std::ssize(corners));
    if (given_.shares.empty()) {
      cells.shares.insert(cells.shares.end(), corners.size(),
                          1.0 / static_cast<double>(corners.size()));
    } else {
      const auto shares = given_.shares.begin() + given_.start[c];
      cells.shares.insert(cells.shares.end(), shares, shares + std::ssize(corners));
    }
    cells.measures.push_back(given_.measures[c]);
    cells.widths.push_back(given_.widths[c]);
  }

  bool add_triangle(const Face& triangle, const std::array<double, 3>& lengths, double share,
                    CellComplex& cells) const {
    const FaceLayout p = lay_out(lengths);
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
        cells.shares.push_back(0);
      }
      cells.shares[place] += 1.0 / 3;
      for (int e = 0; e < 2; ++e) cells.gradients[2 * place + e] += of_corners[k][e] / unit_;
    }
    cells.start.push_back(std::ssize(cells.corners));
    cells.measures.push_back(share * (p.base * unit_ * (p.height * unit_) / 2));
    cells.widths.push_back(mean_side(lengths) * unit_);
    return true;
  }

  const CellComplex& given_;
  const double unit_;
  const int threads_;
  PolygonFans fans_;
  IntrinsicMesh& mesh_ = fans_.mesh;
  std::vector<Edit> edits_;
  Refinement refinement_;
  std::vector<Index> inserted_parts_;  ///< of inserted vertices
  Index first_split_ = 0;              ///< triangles from here on are what splits have made
};

}  // namespace

Result<std::shared_ptr<const FlippedPolygons>> flip_polygons(const CellComplex& given, double unit,
                                                             int threads,
                                                             const Progress& progress) {
  using Flipped = std::shared_ptr<const FlippedPolygons>;
  if (given.virtual_vertices.empty() || !given.lengths_are_straight) return Flipped();
  PolygonFlipper flipper(given, unit, threads);
  auto out = std::make_shared<FlippedPolygons>();
  const auto edited = flipper.edit(progress, *out);
  if (!edited) return edited.error();
  if (!*edited || !flipper.make_cells(*out)) return Flipped();
  return Flipped(std::move(out));
}

}  // namespace geotherm
