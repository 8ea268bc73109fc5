// SPDX-License-Identifier: MIT
#include "solver/geometry/tufted_cover.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace geotherm {
namespace {

/// Corners of a back are (0, 2, 1) of its face: side k of the face is side 2 - k of the back.
Side on_back(const IntrinsicMesh& mesh, Side side) {
  return 3 * mesh.back[face_of(side)] + 2 - corner_of(side);
}

/// A corner nearer to the line of an edge than this, in lengths of the edge or of the way to the
/// corner, says nothing of the direction of its face: what is left is rounding of the coordinates.
constexpr double kOnLine = 1e-7;
/// Faces whose angles round an edge differ by less lie on each other but for rounding.
constexpr double kSameAngle = 1e-6;

/// The sides of an edge in their order round it, counterclockwise seen against the way from its low
/// to its high end; where angles are the same, by number. Faces without a direction stand together
/// in the widest gap between the others, so that rounding decides nothing.
class SidesInOrder {
 public:
  SidesInOrder(std::span<const Vec3> positions, const CleanFaces& clean)
      : positions_(positions), clean_(clean) {}

  std::span<const Side> operator()(Index edge) {
    const auto sides = clean_.edges.sides(edge);
    if (sides.size() <= 2) return sides;
    measure(edge, sides);
    if (at_angle_.empty()) return sides;
    std::ranges::sort(at_angle_);
    // Angles that are the same but for rounding become the first of them.
    for (std::size_t i = 1; i < at_angle_.size(); ++i) {
      if (at_angle_[i].first - at_angle_[i - 1].first < kSameAngle) {
        at_angle_[i].first = at_angle_[i - 1].first;
      }
    }
    std::ranges::sort(at_angle_);
    const std::size_t widest = before_widest_gap();
    sorted_.clear();
    for (std::size_t i = 0; i < at_angle_.size(); ++i) {
      sorted_.push_back(at_angle_[i].second);
      if (i == widest) sorted_.insert(sorted_.end(), without_.begin(), without_.end());
    }
    return sorted_;
  }

 private:
  /// Angles from the first side that has a direction, 0 to 2 pi, and the sides that have none.
  void measure(Index edge, std::span<const Side> sides) {
    const Vec3& low = positions_[clean_.edges.low(edge)];
    const Vec3 along = positions_[clean_.edges.high(edge)] - low;
    const double length = along.stableNorm();
    const Vec3 axis = along.stableNormalized();
    at_angle_.clear();
    without_.clear();
    Vec3 zero = Vec3::Zero(), quarter = Vec3::Zero();
    for (const Side side : sides) {
      const Vec3 out =
          positions_[clean_.faces[face_of(side)][previous_corner(corner_of(side))]] - low;
      const Vec3 rest = out - axis * axis.dot(out);
      if (!(rest.stableNorm() > kOnLine * std::max(length, out.stableNorm()))) {
        without_.push_back(side);
        continue;
      }
      const Vec3 across = rest.stableNormalized();
      if (at_angle_.empty()) {
        zero = across;
        quarter = axis.cross(across);
      }
      const double angle = std::atan2(across.dot(quarter), across.dot(zero));
      at_angle_.emplace_back(angle < -kSameAngle ? angle + 2 * std::numbers::pi : angle, side);
    }
  }

  /// The last of the sides before it; of gaps that are equal but for rounding the first.
  std::size_t before_widest_gap() const {
    std::size_t widest = 0;
    double most = 0;
    for (std::size_t i = 0; i < at_angle_.size(); ++i) {
      const double next = i + 1 < at_angle_.size() ? at_angle_[i + 1].first
                                                   : at_angle_.front().first + 2 * std::numbers::pi;
      if (next - at_angle_[i].first < most + kSameAngle) continue;
      most = next - at_angle_[i].first;
      widest = i;
    }
    return widest;
  }

  std::span<const Vec3> positions_;
  const CleanFaces& clean_;
  std::vector<std::pair<double, Side>> at_angle_;
  std::vector<Side> without_, sorted_;
};

void add_backs(IntrinsicMesh& mesh, const std::vector<char>& doubled) {
  const Index fronts = mesh.face_count();
  mesh.back.assign(static_cast<std::size_t>(fronts), kNoIndex);
  for (Index f = 0; f < fronts; ++f) {
    if (!doubled[f]) continue;
    mesh.back[f] = mesh.face_count();
    const Face face = mesh.faces[f];
    const std::array<double, 3> l = mesh.lengths[f];
    mesh.faces.push_back({face[0], face[2], face[1]});
    mesh.lengths.push_back({l[2], l[1], l[0]});
  }
  mesh.twin.resize(3 * mesh.faces.size(), kNoSide);
}

}  // namespace

bool is_oriented_manifold(const CleanFaces& clean, Index edge) {
  const auto sides = clean.edges.sides(edge);
  return sides.size() == 1 || (sides.size() == 2 && sides_agree(clean.faces, sides[0], sides[1]));
}

std::vector<char> faces_that_need_cover(const CleanFaces& clean, Index vertex_count) {
  if (clean.oriented_manifold) return {};
  const FaceComponents components = face_components(clean.faces, vertex_count);
  std::vector<char> marked(static_cast<std::size_t>(components.count), 0);
  for (Index e = 0; e < clean.edges.edge_count(); ++e) {
    if (is_oriented_manifold(clean, e)) continue;
    marked[components.of[face_of(clean.edges.sides(e).front())]] = 1;
  }
  std::vector<char> needed;
  needed.reserve(clean.faces.size());
  for (const Index component : components.of) needed.push_back(marked[component]);
  return needed;
}

void make_tufted_cover(IntrinsicMesh& mesh, std::span<const Vec3> positions,
                       const CleanFaces& clean, const std::vector<char>& doubled) {
  add_backs(mesh, doubled);
  SidesInOrder in_order(positions, clean);
  for (Index e = 0; e < clean.edges.edge_count(); ++e) {
    if (!doubled[face_of(clean.edges.sides(e).front())]) continue;
    const std::span<const Side> sides = in_order(e);
    // Each side has two copies: one runs upwards, low to high, and looks towards the next side.
    const auto copy = [&](Side side, bool upwards) {
      const bool front = clean.faces[face_of(side)][corner_of(side)] == clean.edges.low(e);
      return front == upwards ? side : on_back(mesh, side);
    };
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const Side here = copy(sides[i], true);
      const Side next = copy(sides[i + 1 < sides.size() ? i + 1 : 0], false);
      mesh.twin[here] = next;
      mesh.twin[next] = here;
    }
  }
}

}  // namespace geotherm
