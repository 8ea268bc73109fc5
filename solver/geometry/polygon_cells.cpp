// SPDX-License-Identifier: MIT
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geotherm/domains.h"
#include "solver/core/text.h"
#include "solver/geometry/cell_mesh.h"
#include "solver/geometry/intrinsic_mesh.h"
#include "solver/geometry/polygon_fans.h"
#include "solver/mesh/io/raw_mesh.h"

namespace geotherm {
namespace {

/// A face of k corners has 2 k^2 numbers, and takes k^3 steps.
constexpr std::size_t kMaxCorners = 256;

/// The triangle between a side and the virtual vertex of its face, or one that a face was cut into.
struct FanTriangle {
  double area = 0;
  /// Gradients of the hat functions of the side's two ends and of the third corner, in the
  /// triangle's frame.
  Eigen::Vector2d from, to, apex;
};

/// The third corner lies `along` from the first end of the side, measured along the side, and
/// `height` away from the side.
FanTriangle triangle_on_side(double side, double along, double height) {
  return {side * height / 2,
          {-1 / side, (along / side - 1) / height},
          {1 / side, -along / (side * height)},
          {0, 1 / height}};
}

/// The sides of one that is nearly flat are lengthened, as mollify() does. In mean distances
/// between two corners of the face.
FanTriangle fan_triangle(const Vec3& from, const Vec3& to, const Vec3& apex) {
  std::array<double, 3> lengths = side_lengths(from, to, apex);
  if (is_flat_triangle(lengths)) {
    const double by = kFlatTriangle * (1 + std::ranges::max(lengths));
    for (double& length : lengths) length += by;
    const FaceLayout laid = lay_out(lengths);
    return triangle_on_side(laid.base, laid.x, laid.height);
  }
  const Vec3 side = (to - from) / lengths[0];
  const double along = side.dot(apex - from);
  return triangle_on_side(lengths[0], along, (apex - from - along * side).norm());
}

/// The point with the least sum of the squared areas of its triangles with the sides.
Vec3 virtual_vertex(std::span<const Vec3> corners) {
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  Vec3 right = Vec3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 side = corners[(i + 1) % corners.size()] - corners[i];
    const Eigen::Matrix3d across =
        side.squaredNorm() * Eigen::Matrix3d::Identity() - side * side.transpose();
    square += across;
    right += across * corners[i];
  }
  return inverse_along(square) * right;
}

/// What a face gives its corners: a cell for each triangle at its virtual vertex. The vertex's
/// value is the mean of the corners' that makes it harmonic on these triangles. Or a cell for each
/// triangle that it was cut into.
struct PolygonElement {
  double width = 0;  ///< mean side of the triangles that it was cut into, or mean_side_of_cuts()
  /// The virtual vertex; not finite: it was cut.
  Vec3 apex = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<double> areas;                ///< of each triangle; none: the face has no area
  std::vector<Eigen::Matrix2Xd> gradients;  ///< of each triangle: 2 x k
  /// The area that belongs to each corner: a third of each triangle at it. The third of the virtual
  /// vertex goes to all corners of the face in equal parts, since a mean's weights may be negative.
  std::vector<Eigen::VectorXd> shares;
};

/// Whether the triangles at the virtual vertex are the face, and none is nearly flat.
bool is_fan(std::span<const Vec3> at, const Vec3& apex) {
  if (!sees_all_sides(at, apex)) return false;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (is_flat_triangle(side_lengths(at[i], at[(i + 1) % at.size()], apex))) return false;
  }
  return true;
}

/// Flips the longest side of a triangle that is nearly flat, which another one of the face has as
/// well; false where there is no such.
bool flip_flat_triangle(const std::vector<Vec3>& at, std::vector<Face>& triangles, Face& flat) {
  std::size_t middle = 0;  // the corner across from the longest side
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double length = (at[flat[(k + 1) % 3]] - at[flat[(k + 2) % 3]]).norm();
    if (length > longest) middle = k;
    longest = std::max(longest, length);
  }
  const Index between = flat[middle], from = flat[(middle + 1) % 3], to = flat[(middle + 2) % 3];
  for (Face& other : triangles) {
    const auto has = [&other](Index corner) { return std::ranges::count(other, corner) > 0; };
    if (!has(from) || !has(to) || has(between)) continue;
    const Index across = other[0] + other[1] + other[2] - from - to;
    flat = {from, between, across};
    other = {between, to, across};
    std::ranges::sort(flat);
    std::ranges::sort(other);
    return true;
  }
  return false;
}

/// The triangles that triangulated() cuts a face into, by the places of their corners in it,
/// ascending. The longest sides of those that are nearly flat are flipped where that can be.
std::vector<Face> cut_into_triangles(const std::vector<Vec3>& positions,
                                     std::span<const Index> face, const std::vector<Vec3>& at,
                                     io::PolygonCutter& cutter) {
  std::vector<Face> out;
  for (std::size_t k = 2; k < face.size(); ++k) out.push_back({face[0], face[k - 1], face[k]});
  // Where the limit of its tests is reached, the fan stays, as in what is drawn.
  (void)cutter.triangulate(positions, out);
  for (Face& triangle : out) {
    for (Index& corner : triangle) {
      corner = static_cast<Index>(std::ranges::find(face, corner) - face.begin());
    }
    std::ranges::sort(triangle);
  }
  const auto flip_one = [&] {
    return std::ranges::any_of(out, [&](Face& triangle) {
      return is_flat_triangle(side_lengths(at[triangle[0]], at[triangle[1]], at[triangle[2]])) &&
             flip_flat_triangle(at, out, triangle);
    });
  };
  for (std::size_t flips = 0; flips < out.size() && flip_one(); ++flips) {
  }
  return out;
}

/// Mean side of the triangles when all diagonals from one corner cut the face, the mean of all its
/// corners: the same whichever corner its list begins with.
double mean_side_of_cuts(const std::vector<Vec3>& at) {
  const std::size_t k = at.size();
  double sides = 0, all = 0;
  for (std::size_t i = 0; i < k; ++i) {
    sides += (at[(i + 1) % k] - at[i]).norm();
    for (std::size_t j = 0; j < i; ++j) all += (at[i] - at[j]).norm();
  }
  // A diagonal is in two of the k ways to cut, and is a side of two triangles in each.
  const auto count = static_cast<double>(k);
  return (sides + 4 * (all - sides) / count) / (3 * (count - 2));
}

/// Preconditions: three corners or more, in range.
PolygonElement polygon_element(const std::vector<Vec3>& positions, std::span<const Index> face,
                               io::PolygonCutter& cutter) {
  const std::size_t k = face.size();
  PolygonElement out;
  std::vector<Vec3> at;
  double unit = 0;  // mean distance between two corners
  for (std::size_t i = 0; i < k; ++i) {
    at.push_back(positions[face[i]] - positions[face[0]]);
    for (std::size_t j = 0; j < i; ++j) unit += (at[i] - at[j]).norm();
  }
  unit /= static_cast<double>(k * (k - 1)) / 2;
  for (Vec3& corner : at) corner /= unit;
  const auto count = static_cast<Eigen::Index>(k);
  const auto put = [&](const FanTriangle& t, const Eigen::Matrix2Xd& gradient,
                       std::initializer_list<Index> corners) {
    out.gradients.emplace_back(gradient / unit);
    out.areas.push_back(t.area * unit * unit);
    const double rest = 1 - static_cast<double>(corners.size()) / 3;
    auto& shares =
        out.shares.emplace_back(Eigen::VectorXd::Constant(count, rest / static_cast<double>(k)));
    for (const Index corner : corners) shares[corner] += 1.0 / 3;
  };
  const Vec3 apex = k == 3 ? at[2] : virtual_vertex(at);
  const bool cut = k == 3 || !is_fan(at, apex);
  if (cut) {
    const std::vector<Face> triangles = cut_into_triangles(positions, face, at, cutter);
    double area = 0, sides = 0;
    for (const auto& [a, b, c] : triangles) {
      area += (at[b] - at[a]).cross(at[c] - at[a]).norm() / 2;
      for (const double side : side_lengths(at[a], at[b], at[c])) sides += side;
    }
    out.width = unit * sides / static_cast<double>(3 * triangles.size());
    // Flatter than this, rounding decides where the plane lies.
    constexpr double kFlat = 1e-12;
    if (!(area > kFlat) || !std::isfinite(area)) return out;
    for (const auto& [a, b, c] : triangles) {
      const FanTriangle t = fan_triangle(at[a], at[b], at[c]);
      Eigen::Matrix2Xd gradient = Eigen::Matrix2Xd::Zero(2, count);
      gradient.col(a) = t.from;
      gradient.col(b) = t.to;
      gradient.col(c) = t.apex;
      put(t, gradient, {a, b, c});
    }
    return out;
  }
  out.width = unit * mean_side_of_cuts(at);
  out.apex = positions[face[0]] + unit * apex;
  std::vector<FanTriangle> fan;
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(count);
  for (std::size_t i = 0; i < k; ++i) {
    const auto next = static_cast<Eigen::Index>((i + 1) % k);
    const FanTriangle& t = fan.emplace_back(fan_triangle(at[i], at[next], apex));
    pull[static_cast<Eigen::Index>(i)] -= t.area * t.apex.dot(t.from);
    pull[next] -= t.area * t.apex.dot(t.to);
  }
  const Eigen::VectorXd weights = pull / pull.sum();
  for (std::size_t i = 0; i < k; ++i) {
    const auto from = static_cast<Index>(i), to = static_cast<Index>((i + 1) % k);
    Eigen::Matrix2Xd gradient = fan[i].apex * weights.transpose();
    gradient.col(from) += fan[i].from;
    gradient.col(to) += fan[i].to;
    put(fan[i], gradient, {from, to});
  }
  return out;
}

Error bad_polygon(std::size_t face, const std::string& what) {
  return {ErrorCode::kBadInput, "face " + std::to_string(face) + " " + what};
}

/// Flags the ends of edges that occur once.
std::vector<char> ends_of_single_edges(std::vector<std::array<Index, 2>> edges, Index vertices) {
  std::ranges::sort(edges);
  std::vector<char> out(static_cast<std::size_t>(vertices), 0);
  for (auto at = edges.begin(); at != edges.end();) {
    const auto next = std::find_if(at, edges.end(), [at](const auto& e) { return e != *at; });
    if (next - at == 1) out[(*at)[0]] = out[(*at)[1]] = 1;
    at = next;
  }
  return out;
}

}  // namespace

Result<CellComplex> cells_of(const PolygonMesh& mesh) try {
  CellComplex cells;
  cells.cell_name = "polygon";
  cells.cells_name = "polygons";
  cells.vertices = static_cast<Index>(mesh.positions.size());
  cells.dimension = 2;
  cells.positions = mesh.positions;
  cells.lengths_are_straight = true;
  cells.start.push_back(0);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (mesh.positions[v].allFinite()) continue;
    return Error{ErrorCode::kBadInput,
                 "vertex " + std::to_string(v) + " has a coordinate that is not finite"};
  }
  io::PolygonCutter cutter(mesh.corners.size());
  std::size_t left_out = 0, meeting = 0;  // of them those that meet themselves
  std::vector<std::array<Index, 2>> edges;
  for (std::size_t f = 0; f + 1 < mesh.start.size(); ++f) {
    const std::int64_t begin = mesh.start[f], end = mesh.start[f + 1];
    if (begin < 0 || end < begin || end > std::ssize(mesh.corners)) {
      return bad_polygon(f, "has its corners from " + std::to_string(begin) + " to " +
                                std::to_string(end) + ", and there are " +
                                std::to_string(mesh.corners.size()));
    }
    std::vector<Index> face(mesh.corners.begin() + begin, mesh.corners.begin() + end);
    face.erase(std::unique(face.begin(), face.end()), face.end());
    if (face.size() > 1 && face.front() == face.back()) face.pop_back();
    if (face.size() > kMaxCorners) {
      return bad_polygon(f, "has " + std::to_string(face.size()) + " corners, and at most " +
                                std::to_string(kMaxCorners) +
                                " can be: cut it into smaller ones, or all into triangles");
    }
    for (const Index v : face) {
      if (v >= 0 && v < cells.vertices) continue;
      return bad_polygon(f, "has the corner " + std::to_string(v) +
                                ", which is out of range (0 to " +
                                std::to_string(cells.vertices - 1) + ")");
    }
    std::vector<Index> sorted(face.begin(), face.end());
    std::ranges::sort(sorted);
    const bool simple = face.size() >= 3 && std::ranges::adjacent_find(sorted) == sorted.end();
    const PolygonElement element =
        simple ? polygon_element(mesh.positions, face, cutter) : PolygonElement{};
    if (element.areas.empty()) {
      ++left_out;
      meeting += face.size() > 3 && !simple ? 1 : 0;
      continue;
    }
    for (std::size_t k = 0; k < face.size(); ++k) {
      const auto [low, high] = std::minmax(face[k], face[(k + 1) % face.size()]);
      edges.push_back({low, high});
    }
    for (std::size_t t = 0; t < element.areas.size(); ++t) {
      cells.corners.insert(cells.corners.end(), face.begin(), face.end());
      cells.start.push_back(std::ssize(cells.corners));
      const auto gradients = element.gradients[t].reshaped();
      cells.gradients.insert(cells.gradients.end(), gradients.begin(), gradients.end());
      cells.shares.insert(cells.shares.end(), element.shares[t].begin(), element.shares[t].end());
      cells.measures.push_back(element.areas[t]);
      cells.numbers.push_back(static_cast<Index>(f));
      cells.widths.push_back(element.width);
      cells.virtual_vertices.push_back(element.apex);
    }
  }
  const Hint as_triangles =
      meeting > 0 ? Hint{"solve on the triangles that it is cut into"} : Hint();
  if (cells.measures.empty()) {
    return Error{ErrorCode::kBadInput,
                 meeting > 0 ? "the mesh has no polygon that does not meet itself"
                             : "the mesh has no face with an area",
                 as_triangles};
  }
  if (left_out > 0) {
    cells.notes.push_back(
        {counted_text(left_out, "face was", "faces were") + " left out: no area, or a corner twice",
         as_triangles});
  }
  cells.on_boundary = ends_of_single_edges(std::move(edges), cells.vertices);
  return cells;
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory, "the memory ended while cells were made of polygons"};
}

}  // namespace geotherm
