// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <unordered_set>
#include <utility>

#include "solver/geometry/delaunay.h"
#include "solver/geometry/polygon_fans.h"
#include "solver/heat/cell_domain.h"
#include "solver/heat/face_triangles.h"
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

/// Sources inside faces or on their sides, not at corners.
using InsidePoints = std::vector<const CellPoint*>;

/// The triangles around the sources of one component: those of faces, and those that were flipped.
/// With sources inside faces they are those of faces alone, since nothing tells in which of the
/// flipped ones a point of a face lies. Corners have the numbers of their rows; after these come
/// virtual vertices, by faces, and sources inside faces.
class NearPolygons {
 public:
  NearPolygons(const CellDomain& domain, const SourceAnchors& anchors, const InsidePoints& inside,
               Index component)
      : domain_(domain),
        mesh_(*domain.mesh),
        given_(*domain.given),
        walks_given_(domain.flipped != nullptr && !inside.empty()) {
    for (const auto& anchor : anchors.anchors) {
      if (mesh_.components.of[anchor.row] != component) continue;
      if (walks_given_ && domain.vertex_of_row[anchor.row] >= domain.input_vertices) continue;
      seeds_.push_back({anchor.row, anchor.offset});
      places_.push_back(place_of(anchor.row));
    }
    std::int64_t number = domain_.size() + std::int64_t{given_.numbers.back()} + 1;
    for (const CellPoint* point : inside) add_point(*point, number++);
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
      for (const Index cell : cells_at(rows[i])) {
        const Index given = walks_given_ ? cell : mesh_.given_cell[cell];
        if (const Index triangle = flipped_triangle(given); triangle != kNoIndex) {
          if (!seen_triangles.insert(triangle).second) continue;
          std::ranges::for_each(mesh_.corners_of(cell), see);
          out.faces.push_back(near_face(triangle));
          continue;
        }
        if (!seen_faces.insert(given_.numbers[given]).second) continue;
        const std::vector<Index> corners = domain_.rows_of_given(given);
        std::ranges::for_each(corners, see);
        add_face(given, corners, faces);
      }
    }
    const std::vector<NearFace> made = faces.flip();
    out.faces.insert(out.faces.end(), made.begin(), made.end());
    return out;
  }

 private:
  Vec3 place_of(Index row) const { return domain_.place_of(row) / domain_.unit; }
  /// Numbers of `mesh`, or of what was given.
  std::span<const Index> cells_at(Index row) const {
    return walks_given_ ? domain_.faces_at.at(domain_.vertex_of_row[row]) : mesh_.cells_at.at(row);
  }
  Index flipped_triangle(Index given) const {
    if (!domain_.flipped || walks_given_) return kNoIndex;
    return domain_.flipped->triangle_of_cell[given];
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

  /// A source inside a face becomes a corner of its triangles; where it cannot, the straight line
  /// to the face's virtual vertex is known.
  void add_point(const CellPoint& point, std::int64_t number) {
    const Index given = domain_.find_cell(point.cell);
    const std::vector<Index> rows = domain_.rows_of_given(given);
    Vec3 place = Vec3::Zero();
    for (std::size_t k = 0; k < rows.size(); ++k) place += point.weights[k] * place_of(rows[k]);
    FaceTriangles& face = with_sources_[given_.numbers[given]];
    if (face.size() == 0) face = triangles_of(given, rows);
    const std::size_t before = on_sides_.size();
    if (face.insert(number, place, on_sides_)) {
      seeds_.push_back({number, 0});
      places_.push_back(place);
      if (on_sides_.size() == before) return;
      for (auto& [other_number, other] : with_sources_) {
        if (&other != &face) other.split(on_sides_.back());
      }
    } else if (!is_cut(given_, given)) {
      seeds_.push_back({number_of_virtual(given), (virtual_vertex(given) - place).norm()});
    }
  }

  /// The triangles of a face, split at the sources that other faces have on their sides.
  FaceTriangles triangles_of(Index given, std::span<const Index> rows) {
    FaceTriangles out = own_triangles_of(given, rows);
    for (const SourceOnSide& source : on_sides_) out.split(source);
    return out;
  }
  FaceTriangles own_triangles_of(Index given, std::span<const Index> rows) {
    FaceTriangles out;
    std::vector<Vec3> at;
    std::ranges::transform(rows, std::back_inserter(at),
                           [this](Index row) { return place_of(row); });
    if (is_cut(given_, given)) {
      const Index number = given_.numbers[given];
      for (Index cell = domain_.find_cell(number);
           cell < given_.cell_count() && given_.numbers[cell] == number; ++cell) {
        const auto three = cut_corners(given_, cell);
        overlap_ |= three.empty();
        if (three.empty()) continue;
        const std::size_t a = three[0], b = three[1], c = three[2];
        out.add({rows[a], rows[b], rows[c]}, {at[a], at[b], at[c]});
      }
      return out;
    }
    const Vec3 apex = virtual_vertex(given);
    overlap_ |= !sees_all_sides(at, apex);
    for (std::size_t k = 0; k < at.size(); ++k) {
      const std::size_t next = (k + 1) % at.size();
      out.add({rows[k], rows[next], number_of_virtual(given)}, {at[k], at[next], apex});
    }
    return out;
  }

  void add_face(Index given, std::span<const Index> rows, FlippedFaces& faces) {
    const auto found = with_sources_.find(given_.numbers[given]);
    const FaceTriangles face =
        found != with_sources_.end() ? found->second : triangles_of(given, rows);
    for (std::size_t t = 0; t < face.size(); ++t) {
      const auto& at = face.at(t);
      faces.add(face.corners(t), side_lengths(at[0], at[1], at[2]));
    }
  }

  const CellDomain& domain_;
  const CellMesh& mesh_;
  const CellComplex& given_;
  std::vector<NearDistance> seeds_;
  std::vector<Vec3> places_;  ///< of the anchors and of sources inside faces
  std::vector<SourceOnSide> on_sides_;
  std::map<Index, FaceTriangles> with_sources_;  ///< of faces that hold some, by their numbers
  bool walks_given_;                             ///< over faces, in place of flipped triangles
  bool overlap_ = false;
};

}  // namespace

std::vector<NearVertex> near_polygons(const CellDomain& domain, const SourceAnchors& anchors) {
  std::vector<NearVertex> out;
  const CellComplex& given = *domain.given;
  if (given.virtual_vertices.empty() || !given.lengths_are_straight) return out;
  std::map<Index, InsidePoints> inside;  // of each component
  for (const CellPoint& point : anchors.cell_points) {
    if (std::ranges::find(point.weights, 1.0) != point.weights.end()) continue;
    const Index corner = given.corners_of(domain.find_cell(point.cell)).front();
    inside[domain.mesh->components.of[domain.row_of_vertex[corner]]].push_back(&point);
  }
  for (const Index component : anchors.components) {
    const ComponentSize& size = domain.component_sizes[component];
    const std::size_t count =
        near_count(anchors.source_count(domain.parts_of_rows(), component), size.cells);
    if (count == 0) continue;
    NearPolygons near(domain, anchors, inside[component], component);
    const auto found = march_around(near.seeds(), count, size.mean_edge,
                                    [&near](double reach) { return near.within(reach); });
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
