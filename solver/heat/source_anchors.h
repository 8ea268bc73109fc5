// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "geotherm/distance_method.h"
#include "geotherm/error.h"
#include "geotherm/sources.h"
#include "solver/linear/symmetric_pattern.h"

namespace geotherm {

struct Surface;

/// What a source set means for the vertices around it. Lengths are in units of the domain. What
/// says "face" is of triangle meshes alone, and has the numbers of Surface::operators.
struct SourceAnchors {
  struct Anchor {
    Index row;
    double offset;  ///< distance to the source through the cell that holds it; 0 on a source
    double heat;    ///< share of a unit of heat (barycentric; 1 for a source at the vertex)
  };
  /// A face at a source, where the direction of u's gradient says little and the distance is known.
  struct NearFace {
    Index face;
    std::array<double, 2> field;  ///< gradient of the interpolated straight distance
  };

  /// A point (both ends the same) or a straight piece of a curve inside one face or along its side,
  /// in the face's layout; what lies on a side stands in both faces at it.
  struct Piece {
    Index face;
    Eigen::Vector2d from, to;
  };

  std::vector<Anchor> anchors;         ///< ascending rows, each once
  std::vector<Piece> pieces;           ///< of the sources that are no vertices
  std::vector<NearFace> near_faces;    ///< each face once
  std::vector<CellPoint> cell_points;  ///< sources in cells, as they were given
  std::vector<Index> components;       ///< that hold a source, ascending

  std::vector<Index> rows() const;
  /// How many sources a component holds; those of curves count as the heat that they have.
  std::size_t source_count(const Components& parts, Index component) const;
};

/// Gathers the anchors of vertices and points of cells, by rows.
class AnchorMap {
 public:
  void add_vertex(Index row) { anchors_[row] = {row, 0.0, 1.0}; }
  /// A corner of a cell that holds a point, at this distance and with this weight.
  void add_corner(Index row, double offset, double weight) {
    SourceAnchors::Anchor& anchor =
        anchors_.try_emplace(row, SourceAnchors::Anchor{row, kUnreached, 0.0}).first->second;
    if (anchor.offset == 0) return;  // a source itself, with all its heat
    anchor.offset = std::min(anchor.offset, offset);
    anchor.heat += weight;
  }
  /// `parts`: of the rows.
  SourceAnchors finish(const Components& parts) const;

 private:
  std::map<Index, SourceAnchors::Anchor> anchors_;
};

/// Errors: an offset above 0; kBadInput where `other`, which takes them, is a method of the same
/// space, else kNotAvailable.
Result<void> refuse_offsets(const SourceSet& sources, std::optional<MethodKind> other);

/// Errors (kBadInput): those of check_sources(), and offsets above 0.
Result<SourceAnchors> place_sources(const Surface& surface, const SourceSet& sources);

/// Whether a set has so many anchors that solves with compact factors are refined: rounding is in
/// proportion to u and to the range of phi, while distances, and the slope of u between the
/// sources, are the smaller the more sources there are.
bool has_many(std::span<const SourceAnchors> sets);

/// A vertex beside a source, where the near-exact distance stands in for some of heat's.
struct NearVertex {
  Index row;
  double distance;  ///< near-exact, in units of the domain
  double share;     ///< of heat's distance in the answer: 0 beside the source, below 1
};

/// What is known around the sources without heat. In components into which no vertices or few were
/// inserted a march over the faces finds the nearest vertices of up to 64 sources that are no
/// curves (near_march.h). Elsewhere a wave (docs/numerics.md, "Wavefront") walks over the nearest
/// faces: its distances count up to where it is sure of them, at most eight times the length that
/// the triangulation resolves. Up to half of that radius the distances count alone, and fade into
/// heat's from there on. Errors: kOutOfMemory. Cost: that of the march, or of two waves over some
/// hundreds of faces; for many sources, over those at the sources or a tenth of all.
Result<std::vector<NearVertex>> find_near_field(const Surface& surface,
                                                const SourceAnchors& anchors);

}  // namespace geotherm
