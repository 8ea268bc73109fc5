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

struct SourceOnEdge {
  std::int64_t from, to;  ///< the ends of the edge
  std::int64_t number;
  Vec3 place;
};

/// The triangles of one face, in which sources may become corners.
struct FaceTriangles {
  struct Triangle {
    std::array<std::int64_t, 3> corners;
    std::array<Vec3, 3> at;
  };
  std::vector<Triangle> triangles;
  bool are_the_face = true;  ///< they do not overlap, and leave nothing of it out

  /// Makes a corner of a point: of the triangle that it is in, or of those at an edge that it is
  /// on. False where it is at a corner. `on_edges`: takes it, where it is on one.
  bool insert(std::int64_t number, const Vec3& place, std::vector<SourceOnEdge>& on_edges) {
    constexpr double kOnEdge = 1e-6;
    const Triangle* best = nullptr;
    std::array<double, 3> weights{-kUnreached, -kUnreached, -kUnreached};
    for (const Triangle& triangle : triangles) {
      const std::array<double, 3> each = weights_in(triangle, place);
      if (!(std::ranges::min(each) > std::ranges::min(weights))) continue;
      best = &triangle;
      weights = each;
    }
    const auto beside = std::ranges::count_if(weights, [](double w) { return w < kOnEdge; });
    if (best == nullptr || beside > 1) return false;
    if (beside == 1) {
      const auto k = static_cast<int>(std::ranges::min_element(weights) - weights.begin());
      on_edges.push_back(
          {best->corners[next_corner(k)], best->corners[previous_corner(k)], number, place});
      split(on_edges.back());
      return true;
    }
    const Triangle old = *best;
    triangles.erase(triangles.begin() + (best - triangles.data()));
    for (int k = 0; k < 3; ++k) triangles.push_back(with_corner(old, k, number, place));
    return true;
  }

  /// Makes a corner of a source in the triangles at its edge.
  void split(const SourceOnEdge& source) {
    std::vector<Triangle> out;
    for (const Triangle& triangle : triangles) {
      const auto is_end = [&](std::int64_t corner) {
        return corner == source.from || corner == source.to;
      };
      if (std::ranges::count_if(triangle.corners, is_end) != 2) {
        out.push_back(triangle);
        continue;
      }
      for (int k = 0; k < 3; ++k) {
        if (is_end(triangle.corners[k])) {
          out.push_back(with_corner(triangle, k, source.number, source.place));
        }
      }
    }
    triangles = std::move(out);
  }

 private:
  /// Barycentric coordinates of the nearest point of a triangle's plane; none where it is flat.
  static std::array<double, 3> weights_in(const Triangle& triangle, const Vec3& place) {
    const auto& at = triangle.at;
    const Vec3 normal = (at[1] - at[0]).cross(at[2] - at[0]);
    std::array<double, 3> out;
    for (int k = 0; k < 3; ++k) {
      const Vec3& from = at[next_corner(k)];
      const Vec3& to = at[previous_corner(k)];
      out[k] = (to - from).cross(place - from).dot(normal) / normal.squaredNorm();
    }
    return out;
  }
  static Triangle with_corner(Triangle out, int k, std::int64_t number, const Vec3& place) {
    out.corners[k] = number;
    out.at[k] = place;
    return out;
  }
};

/// The triangles between the sides and the virtual vertices of the faces at the sources of one
/// component, and those around them that were flipped; with sources inside faces all of them from
/// before they were flipped, where it is known which of them those are in. Corners are numbered by
/// rows, virtual vertices that are no rows after them by faces, then sources inside faces.
class NearPolygons {
 public:
  NearPolygons(const CellDomain& domain, const SourceAnchors& anchors, Index component)
      : domain_(domain), mesh_(*domain.mesh), given_(*domain.given) {
    const auto is_inside = [&](const CellPoint& point) {
      const Index corner = given_.corners_of(domain.find_cell(point.cell)).front();
      return mesh_.components.of[domain.row_of_vertex[corner]] == component &&
             std::ranges::find(point.weights, 1.0) == point.weights.end();
    };
    walks_over_flipped_ =
        domain.flipped != nullptr && std::ranges::none_of(anchors.cell_points, is_inside);
    for (const auto& anchor : anchors.anchors) {
      if (mesh_.components.of[anchor.row] != component) continue;
      if (!walks_over_flipped_ && !is_given(anchor.row)) continue;
      seeds_.push_back({anchor.row, anchor.offset});
      places_.push_back(place_of(anchor.row));
    }
    std::int64_t number = domain_.size() + std::int64_t{given_.cell_count()};
    for (const CellPoint& point : anchors.cell_points) {
      if (is_inside(point)) add_point(point, number++);
    }
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
        const Index given = walks_over_faces() ? cell : mesh_.given_cell[cell];
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
  bool is_given(Index row) const { return domain_.vertex_of_row[row] < domain_.input_vertices; }
  bool walks_over_faces() const { return domain_.flipped && !walks_over_flipped_; }
  /// By numbers of `mesh`, or with sources inside faces of flipped ones as given.
  std::span<const Index> cells_at(Index row) const {
    return walks_over_faces() ? domain_.faces_at.at(domain_.vertex_of_row[row])
                              : mesh_.cells_at.at(row);
  }
  Index flipped_triangle(Index given) const {
    return walks_over_flipped_ ? domain_.flipped->triangle_of_cell[given] : kNoIndex;
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
    if (face.triangles.empty()) face = triangles_of(given, rows);
    const std::size_t before = on_edges_.size();
    if (face.insert(number, place, on_edges_)) {
      seeds_.push_back({number, 0});
      places_.push_back(place);
      if (on_edges_.size() == before) return;
      for (auto& [other_number, other] : with_sources_) {
        if (&other != &face) other.split(on_edges_.back());
      }
    } else if (!is_cut(given_, given)) {
      seeds_.push_back({number_of_virtual(given), (virtual_vertex(given) - place).norm()});
    }
  }

  /// With the sources that are on the face's sides.
  FaceTriangles triangles_of(Index given, std::span<const Index> rows) const {
    FaceTriangles out = plain_triangles_of(given, rows);
    for (const SourceOnEdge& source : on_edges_) out.split(source);
    return out;
  }
  FaceTriangles plain_triangles_of(Index given, std::span<const Index> rows) const {
    FaceTriangles out;
    std::vector<Vec3> at;
    std::ranges::transform(rows, std::back_inserter(at),
                           [this](Index row) { return place_of(row); });
    if (is_cut(given_, given)) {
      const Index number = given_.numbers[given];
      for (Index cell = domain_.find_cell(number);
           cell < given_.cell_count() && given_.numbers[cell] == number; ++cell) {
        const auto three = cut_corners(given_, cell);
        out.are_the_face &= !three.empty();
        if (three.empty()) continue;
        const std::size_t a = three[0], b = three[1], c = three[2];
        out.triangles.push_back({{rows[a], rows[b], rows[c]}, {at[a], at[b], at[c]}});
      }
      return out;
    }
    const Vec3 apex = virtual_vertex(given);
    out.are_the_face = sees_all_sides(at, apex);
    for (std::size_t k = 0; k < at.size(); ++k) {
      const std::size_t next = (k + 1) % at.size();
      out.triangles.push_back(
          {{rows[k], rows[next], number_of_virtual(given)}, {at[k], at[next], apex}});
    }
    return out;
  }

  void add_face(Index given, std::span<const Index> rows, FlippedFaces& faces) {
    const auto found = with_sources_.find(given_.numbers[given]);
    const FaceTriangles face =
        found != with_sources_.end() ? found->second : triangles_of(given, rows);
    overlap_ |= !face.are_the_face;
    for (const auto& [corners, at] : face.triangles) {
      faces.add(corners, side_lengths(at[0], at[1], at[2]));
    }
  }

  const CellDomain& domain_;
  const CellMesh& mesh_;
  const CellComplex& given_;
  std::vector<NearDistance> seeds_;
  std::vector<Vec3> places_;  ///< of the anchors and of sources in faces
  std::vector<SourceOnEdge> on_edges_;
  std::map<Index, FaceTriangles> with_sources_;  ///< of faces that hold some, by their numbers
  bool walks_over_flipped_ = false;
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
