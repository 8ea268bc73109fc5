// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/sources.h"

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

  std::vector<Anchor> anchors;       ///< ascending rows, each once
  std::vector<Piece> pieces;         ///< of the sources that are no vertices
  std::vector<NearFace> near_faces;  ///< each face once
  std::vector<Index> components;     ///< that hold a source, ascending

  std::vector<Index> rows() const;
};

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

/// What is known around the sources without heat: a wave (docs/numerics.md, "Wavefront") walks over
/// the faces nearest to them. Its distances count alone up to half as far as it is sure of them, at
/// most half of eight times the length that the triangulation resolves, and fade into heat's from
/// there on. Errors: kOutOfMemory.
/// Cost: that of two waves over some hundreds of faces; for many sources, over those at the sources
/// or a tenth of all.
Result<std::vector<NearVertex>> find_near_field(const Surface& surface,
                                                const SourceAnchors& anchors);

}  // namespace geotherm
