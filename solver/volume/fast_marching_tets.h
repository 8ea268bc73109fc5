// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geotherm/domains.h"
#include "geotherm/progress.h"
#include "solver/volume/clean_tets.h"

namespace geotherm {

/// Distance in a volume from one set of sources.
struct TetDistances {
  std::vector<double> distances;  ///< V, file order, model units; kUnreached where no source can be
  std::vector<Index> nearest;     ///< V: number of the source that each distance is from; kNoIndex
  Index straight = 0;             ///< vertices whose distance is the straight line to their source
};

struct TetMarchingOptions {
  /// Straight lines up to this distance from their source, model units. Some edges around a point
  /// source must be exact, for the front is bent there; 0: only the tets that touch the source.
  double straight_reach = kUnreached;
};

/// Distance in a volume of tetrahedra: exact wherever a vertex sees its source along a straight
/// line, and fast marching where the way bends round a border.
///
/// A vertex has the straight line's length where its source is a corner of one of its tets, or
/// where the line to the source leaves one of its tets through a face whose corners (those that
/// weigh at the crossing) have it from the same source. In a convex volume that is every vertex. It
/// can be too short only behind a hole that is narrower than one face in its shadow. Elsewhere a
/// vertex has the least that the planes through the distances of the other corners of its tets give
/// (updated_distance()), of first order in the edge length. A vertex that became nearer is looked
/// at again, in the order of distance, until nothing changes: obtuse tets, whose fronts arrive in
/// no order, need no other care.
///
/// Sources: Kimmel, Sethian 1998; Bornemann, Rasch 2006; Fu, Kirby, Whitaker 2013 (tetrahedra).
class TetFastMarching {
 public:
  /// Errors: kBadInput (no tet with a volume), kOutOfMemory. Cost: O(V + T); some 35 bytes a tet.
  static Result<TetFastMarching> build(std::shared_ptr<const TetMesh> mesh);

  /// From the nearest of the points, each with its offset, the distance there (none: all 0).
  /// Errors: kBadInput (no source, a vertex or tet out of range or left out, weights that are
  /// negative or do not sum to 1, offsets that are negative, not finite or not one a point),
  /// kBudgetEnded, kOutOfMemory, kCancelled. Cost: O(T log V), some microseconds a vertex. Several
  /// queries may run at once.
  Result<TetDistances> solve(std::span<const VolumePoint> points,
                             std::span<const double> offsets = {},
                             const TetMarchingOptions& options = {},
                             const Progress& progress = {}) const;

  /// What was left out, as CleanTets::notes() says it.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  friend class TetMarch;

  TetFastMarching(std::shared_ptr<const TetMesh> mesh, CleanTets clean);

  std::shared_ptr<const TetMesh> mesh_;
  std::vector<Tet> tets_;             ///< clean
  std::vector<Index> original_;       ///< their numbers in the mesh, ascending
  std::vector<std::uint32_t> first_;  ///< V + 1: into `around_`
  std::vector<Index> around_;         ///< the clean tets around each vertex
  std::vector<double> longest_edge_;  ///< V
  std::vector<std::string> notes_;
};

}  // namespace geotherm
