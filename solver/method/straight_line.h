// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geotherm/mesh.h"
#include "geotherm/sources.h"
#include "solver/mesh/box_tree.h"

namespace geotherm {

/// The straight line from anywhere to the nearest of some sources: vertices, points in faces and
/// curves, each with its offset added. In units of `unit` (model units), with the first source as
/// the origin. Immutable; may be asked from several threads.
class StraightLine {
 public:
  /// Preconditions: check_sources() accepts the sources, unit > 0. Cost: O(K log K) for K sources.
  /// Throws std::bad_alloc.
  StraightLine(const TriangleMesh& mesh, const SourceSet& sources, double unit);

  Vec3 place(const Vec3& position) const { return (position - origin_) * scale_; }
  /// Whether some source is no farther from the place than `reach`. `hint`: the source to look at
  /// first; becomes the one that was found. Cost: O(log K), and O(1) where the hint holds.
  bool is_within(const Vec3& place, double reach, Index& hint) const {
    const Piece& piece = pieces_[static_cast<std::size_t>(hint)];
    const double left = reach - piece.offset;
    // Of a curve's piece the beginning is tried, which costs no more than a point.
    if (left >= 0 && (place - piece.from).squaredNorm() <= left * left) return true;
    return find_within(place, reach, hint);
  }
  /// Cost: O(log K) on ordinary sources.
  double length(const Vec3& place) const;

 private:
  /// A point, or a straight piece of a curve.
  struct Piece {
    Vec3 from, along;
    double inverse_square;  ///< of its length; 0 of a point
    double offset;
  };
  void add(const Vec3& from, const Vec3& to, double offset);
  double length_to(const Piece& piece, const Vec3& place) const;
  bool find_within(const Vec3& place, double reach, Index& hint) const;
  /// The nearest piece that is nearer than `reach`, or the first one found.
  Index find(const Vec3& place, double& reach, bool any) const;

  Vec3 origin_;
  double scale_;
  std::vector<Piece> pieces_;
  BoxTree tree_;  ///< none for few pieces
};

}  // namespace geotherm
