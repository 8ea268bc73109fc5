// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "geotherm/distance_method.h"
#include "geotherm/mesh.h"
#include "geotherm/sources.h"
#include "solver/geometry/intrinsic_surface.h"
#include "solver/mesh/box_tree.h"

namespace geotherm {

/// A source as straight lines see it: a point (both ends the same) or a straight piece of a curve.
struct LineSource {
  Vec3 from, to;
  double offset;
};

/// The straight line from anywhere to the nearest of some sources: vertices, points in faces and
/// curves, each with its offset added. In units of `unit` (model units), whatever the
/// order of the sources. Immutable; may be asked from several threads.
class StraightLine {
 public:
  /// Preconditions: check_sources() accepts the sources, unit > 0. Cost: O(K log K) for K sources.
  /// Throws std::bad_alloc.
  StraightLine(const TriangleMesh& mesh, const SourceSet& sources, double unit);
  /// Precondition: there are some.
  StraightLine(std::span<const LineSource> sources, double unit);

  Vec3 place(const Vec3& position) const { return (position - origin_) * scale_; }
  /// The straight line to the nearest source where it is longer than `reach`, 0 where it is not.
  /// `hint`: the source to look at first; becomes one that is near enough. Cost: O(log K), and O(1)
  /// where the hint holds.
  double length_beyond(const Vec3& place, double reach, Index& hint) const {
    const Piece& piece = pieces_[static_cast<std::size_t>(hint)];
    const double left = reach - piece.offset;
    // The beginning of a curve's piece is tried first, which costs no more than a point.
    const double square = (place - piece.from).squaredNorm();
    if (left >= 0 && square <= left * left) return 0;
    return find_within(place, reach, hint) ? 0 : length(place);
  }
  /// Whether there is one source, and that is a point without an offset.
  bool is_point() const {
    return pieces_.size() == 1 && pieces_[0].inverse_square == 0 && pieces_[0].offset == 0;
  }
  /// The square of the straight line to that.
  double square_to_point(const Vec3& place) const {
    return (place - pieces_[0].from).squaredNorm();
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

// Two bounds that every distance keeps, whatever the surface: it is at least the straight line to
// the nearest source, and along an edge it differs by at most the edge. They cost one pass, and see
// answers that are grossly wrong. They are counted on the mesh that is solved on.

/// How far a method may miss the bounds without being wrong by more than its users accept.
struct BoundTolerance {
  double line_share = 0;  ///< of the straight line
  double line_edges = 0;  ///< and so many mean edges
  double edge_share = 0;  ///< of the edge
  double edge_edges = 0;  ///< and so many mean edges
};

/// Heat: users accept errors of a tenth of a distance, near the sources of an edge or two; slopes
/// of u are off by up to 0.6 at single edges of ordinary meshes, and around ridges. Fast marching
/// and wavefronts: a few times the largest error that their documents give, and that of single
/// edges. Exact: rounding, with the lengths that degenerate faces are given.
BoundTolerance bound_tolerance(MethodKind method);

/// Counts edges that are too steep; for a loop over the sides of all faces, each with the
/// difference of the distances at its ends. Lengths in mean edges.
class SteepSides {
 public:
  SteepSides() = default;
  explicit SteepSides(const BoundTolerance& tolerance)
      : most_(1 + tolerance.edge_share), more_(tolerance.edge_edges) {}

  /// False: no edge of a face on which the distance has this slope is. `slope` may be no number.
  bool may_be_steep(double slope) const { return !(slope <= most_); }
  bool is_steep(double difference, double length) const {
    return std::abs(difference) > most_ * length + more_;
  }
  /// `share`: of the edge that this side is, 1/2 where it has two sides.
  void add(double difference, double length, double share) {
    count_ += share;
    steepest_ = std::max(steepest_, std::abs(difference) / length);
  }
  void add(const SteepSides& other) {
    count_ += other.count_;
    steepest_ = std::max(steepest_, other.steepest_);
  }
  void write_to(Quality& quality) const {
    quality.steep_edges = static_cast<Index>(std::ceil(count_));
    quality.steepest_edge = steepest_;
    quality.edges_checked = true;
  }

 private:
  double most_ = 1, more_ = 0;
  double count_ = 0, steepest_ = 0;
};

/// What becomes of a distance that is below the straight line.
enum class BelowLine { kKept, kRaised };

/// Counts the vertices whose distances are below the straight line by more than the tolerance, and
/// raises all that are below to it where `below` says so. `result.distances`: V, as `positions`, in
/// units of `unit` (model units). `mean_edge`: what `straight` was made with. Cost: one pass over
/// the vertices, for K sources O(log K) where the nearest changes; the same figures with any number
/// of threads. Preconditions: those of StraightLine. Throws std::bad_alloc.
void apply_straight_line_bound(std::span<const Vec3> positions, const StraightLine& straight,
                               double mean_edge, double unit, const BoundTolerance& tolerance,
                               BelowLine below, int threads, DistanceResult& result);
void apply_straight_line_bound(const IntrinsicSurface& surface, const SourceSet& sources,
                               double unit, const BoundTolerance& tolerance, BelowLine below,
                               int threads, DistanceResult& result);

/// A sentence for each bound that the figures say is broken, with what to do. `below`: what became
/// of distances below the straight line.
void add_bound_warnings(MethodKind method, DistanceResult& result,
                        BelowLine below = BelowLine::kKept);

}  // namespace geotherm
