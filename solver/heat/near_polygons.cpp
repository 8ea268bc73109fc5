// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_set>
#include <utility>

#include "solver/geometry/delaunay.h"
#include "solver/geometry/polygon_fans.h"
#include "solver/heat/cell_domain.h"
#include "solver/heat/near_march.h"

namespace geotherm {
namespace {

/// Triangles that are flipped to Delaunay.
class FlippedFaces {
 public:
  void add(const std::array<std::int64_t, 3>& corners, const std::array<double, 3>& lengths) {
    Face& face = mesh_.faces.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const auto [entry, is_new] =
          here_.try_emplace(corners[k], static_cast<Index>(numbers_.size()));
      if (is_new) numbers_.push_back(corners[k]);
      face[k] = entry->second;
    }
    mesh_.lengths.push_back(lengths);
  }

  std::vector<NearFace> flip() {
    join();
    (void)flip_to_delaunay(mesh_);  // fails where its progress ends it alone
    std::vector<NearFace> out;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const Face& face = mesh_.faces[f];
      out.push_back(
          {{numbers_[face[0]], numbers_[face[1]], numbers_[face[2]]}, lay_out(mesh_.lengths[f])});
    }
    return out;
  }

 private:
  /// Sides of two faces that run against each other are one edge, but where a face is flat.
  void join() {
    constexpr double kFlat = 1e-9;
    mesh_.twin.assign(3 * mesh_.faces.size(), kNoSide);
    std::map<std::pair<Index, Index>, std::vector<Side>> edges;
    for (Side side = 0; side < std::ssize(mesh_.twin); ++side) {
      edges[std::minmax(first_of(side), second_of(side))].push_back(side);
    }
    const auto is_flat = [this](Side side) {
      const auto& l = mesh_.lengths[face_of(side)];
      const double half = (l[0] + l[1] + l[2]) / 2;
      return !(half - std::ranges::max(l) > kFlat * half);
    };
    for (const auto& [ends, sides] : edges) {
      if (sides.size() != 2 || first_of(sides[0]) != second_of(sides[1])) continue;
      if (is_flat(sides[0]) || is_flat(sides[1])) continue;
      mesh_.twin[sides[0]] = sides[1];
      mesh_.twin[sides[1]] = sides[0];
    }
  }
  Index first_of(Side side) const { return mesh_.faces[face_of(side)][corner_of(side)]; }
  Index second_of(Side side) const {
    return mesh_.faces[face_of(side)][next_corner(corner_of(side))];
  }

  IntrinsicMesh mesh_;
  std::vector<std::int64_t> numbers_;   ///< of its vertices
  std::map<std::int64_t, Index> here_;  ///< the other way round
};

/// The triangles between the sides and the virtual vertices of the faces at the sources of one
/// component, and those around them that were flipped. Corners are numbered by rows, virtual
/// vertices that are no rows after them by faces.
class NearPolygons {
 public:
  NearPolygons(const CellDomain& domain, const SourceAnchors& anchors, Index component)
      : domain_(domain), mesh_(*domain.mesh), given_(*domain.given) {
    for (const auto& anchor : anchors.anchors) {
      if (mesh_.components.of[anchor.row] != component) continue;
      seeds_.push_back({anchor.row, anchor.offset});
      places_.push_back(place_of(anchor.row));
    }
    for (const CellPoint& point : anchors.cell_points) add_virtual_vertex(point, component);
  }

  std::span<const NearDistance> seeds() const { return seeds_; }
  /// Whether the triangles of some face that was asked for are not the face: it does not see all
  /// its sides from its virtual vertex, or was not cut into triangles either.
  bool overlap() const { return overlap_; }

  NearFaces within(double reach) {
    NearFaces out;
    out.are_all = true;
    FlippedFaces faces;
    std::vector<Index> rows;
    std::unordered_set<Index> seen_rows, seen_faces, seen_triangles;
    const auto see = [&](Index row) {
      if (seen_rows.insert(row).second) rows.push_back(row);
    };
    for (const NearDistance& seed : seeds_) {
      if (seed.vertex < domain_.size()) see(static_cast<Index>(seed.vertex));
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Vec3 place = place_of(rows[i]);
      const auto is_near = [&](const Vec3& source) { return (place - source).norm() <= reach; };
      if (std::ranges::none_of(places_, is_near)) {
        out.are_all = false;
        continue;
      }
      for (const Index cell : mesh_.cells_at.at(rows[i])) {
        const Index given = mesh_.given_cell[cell];
        if (const Index triangle = flipped_triangle(given); triangle != kNoIndex) {
          if (!seen_triangles.insert(triangle).second) continue;
          std::ranges::for_each(mesh_.corners_of(cell), see);
          out.faces.push_back(near_face(triangle));
          continue;
        }
        if (!seen_faces.insert(given_.numbers[given]).second) continue;
        std::ranges::for_each(mesh_.corners_of(cell), see);
        add_face(given, mesh_.corners_of(cell), faces);
      }
    }
    const std::vector<NearFace> made = faces.flip();
    out.faces.insert(out.faces.end(), made.begin(), made.end());
    return out;
  }

 private:
  Vec3 place_of(Index row) const { return domain_.place_of(row) / domain_.unit; }
  Index flipped_triangle(Index given) const {
    return domain_.flipped ? domain_.flipped->triangle_of_cell[given] : kNoIndex;
  }
  NearFace near_face(Index triangle) const {
    NearFace out{{}, lay_out(domain_.flipped->lengths[triangle])};
    std::ranges::transform(domain_.flipped->triangles[triangle], out.corners.begin(),
                           [this](Index v) { return domain_.row_of_vertex[v]; });
    return out;
  }
  Vec3 virtual_vertex(Index given) const { return given_.virtual_vertices[given] / domain_.unit; }
  std::int64_t number_of_virtual(Index given) const {
    return domain_.size() + static_cast<std::int64_t>(given_.numbers[given]);
  }

  /// The straight line to the virtual vertex of the face that a source is in, where that is no row.
  void add_virtual_vertex(const CellPoint& point, Index component) {
    const Index given = domain_.find_cell(point.cell);
    const std::vector<Index> rows = domain_.rows_of_given(given);
    const bool is_corner = std::ranges::find(point.weights, 1.0) != point.weights.end();
    if (mesh_.components.of[rows.front()] != component || is_corner) return;
    if (domain_.virtual_row(given) != kNoIndex || is_cut(given_, given)) return;
    Vec3 place = Vec3::Zero();
    for (std::size_t k = 0; k < rows.size(); ++k) place += point.weights[k] * place_of(rows[k]);
    seeds_.push_back({number_of_virtual(given), (virtual_vertex(given) - place).norm()});
  }

  void add_face(Index given, std::span<const Index> rows, FlippedFaces& faces) {
    std::vector<Vec3> at;
    std::ranges::transform(rows, std::back_inserter(at),
                           [this](Index row) { return place_of(row); });
    const auto add = [&faces](std::int64_t a, std::int64_t b, std::int64_t c, const Vec3& at_a,
                              const Vec3& at_b, const Vec3& at_c) {
      faces.add({a, b, c}, side_lengths(at_a, at_b, at_c));
    };
    if (is_cut(given_, given)) {
      const Index number = given_.numbers[given];
      for (Index cell = domain_.find_cell(number);
           cell < given_.cell_count() && given_.numbers[cell] == number; ++cell) {
        const auto three = cut_corners(given_, cell);
        overlap_ |= three.empty();
        if (three.empty()) continue;
        const std::size_t a = three[0], b = three[1], c = three[2];
        add(rows[a], rows[b], rows[c], at[a], at[b], at[c]);
      }
      return;
    }
    const Vec3 apex = virtual_vertex(given);
    overlap_ |= !sees_all_sides(at, apex);
    for (std::size_t k = 0; k < at.size(); ++k) {
      const std::size_t next = (k + 1) % at.size();
      add(rows[k], rows[next], number_of_virtual(given), at[k], at[next], apex);
    }
  }

  const CellDomain& domain_;
  const CellMesh& mesh_;
  const CellComplex& given_;
  std::vector<NearDistance> seeds_;
  std::vector<Vec3> places_;  ///< of the anchors
  bool overlap_ = false;
};

}  // namespace

std::vector<NearVertex> near_polygons(const CellDomain& domain, const SourceAnchors& anchors) {
  std::vector<NearVertex> out;
  if (domain.given->virtual_vertices.empty() || !domain.given->lengths_are_straight) return out;
  for (const Index component : anchors.components) {
    NearPolygons near(domain, anchors, component);
    const ComponentSize& size = domain.components[component];
    const auto found = march_around(
        near.seeds(),
        near_count(anchors.source_count(domain.parts_of_rows(), component), size.cells),
        size.mean_edge, [&near](double reach) { return near.within(reach); });
    if (near.overlap()) continue;
    for (const NearDistance& each : found) {
      const double share = share_of_heat(each.distance, found.back().distance);
      if (share == 1 || each.vertex >= domain.size()) continue;
      out.push_back({static_cast<Index>(each.vertex), each.distance, share});
    }
  }
  return out;
}

}  // namespace geotherm
