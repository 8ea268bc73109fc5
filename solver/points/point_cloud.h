// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/progress.h"
#include "geotherm/types.h"

// Points without faces, and the surface that they sample. P is their number; they are numbered from
// 0 in the order of the file or of the arrays given.
namespace geotherm {

/// An immutable set of points on some surface, exactly as a file or a program gave it.
///
/// Positions: P x 3, finite, model units. Normals: P x 3, or none at all; of any length, and those
/// that are 0 or not finite say nothing about their point. Points may lie at one place.
class PointCloud {
 public:
  /// Takes the arrays. Errors (kBadInput): no points, a coordinate that is not finite (with the
  /// number of its point), normals of another number than the points. Cost: O(P).
  static Result<PointCloud> build(std::vector<Vec3> positions, std::vector<Vec3> normals = {});

  std::span<const Vec3> positions() const { return positions_; }
  std::span<const Vec3> normals() const { return normals_; }  ///< P, or none
  Index point_count() const { return static_cast<Index>(positions_.size()); }

 private:
  PointCloud(std::vector<Vec3> positions, std::vector<Vec3> normals)
      : positions_(std::move(positions)), normals_(std::move(normals)) {}

  std::vector<Vec3> positions_, normals_;
};

/// How points become a surface.
struct PointOptions {
  /// Nearest neighbours that each point is triangulated with, from 6 to 100. Fewer bridge narrower
  /// gaps between sheets and along borders; more even out noise.
  int neighbours = 30;
  /// Points whose normals are more than 120 degrees apart are never joined. For normals that all
  /// point to one side of their surface.
  bool normals_separate = true;

  bool operator==(const PointOptions&) const = default;
};

/// The surface of a point cloud.
struct PointSurface {
  /// Its vertices are the points, in their order; equal ones are one (TriangleMesh::same_as()). Its
  /// faces overlap here and there, and no edge of them need have two: methods that take the tufted
  /// cover (LaplacianKind::kAuto or kTufted) work on it as it is.
  TriangleMesh mesh;
  Index duplicates = 0;  ///< points that an earlier one at the same place stands for
  Index parts = 0;       ///< pieces that no triangle joins; sources in one do not reach the others
  Index outliers = 0;    ///< points in no face, which no source reaches
  Index between_sheets = 0;        ///< points whose faces join two sheets that are near each other
  double spacing = 0;              ///< mean distance from a point to the nearest other, model units
  std::vector<std::string> notes;  ///< one sentence each, for people: what was done
  std::vector<Warning> warnings;   ///< what may make distances wrong
};

/// Joins points by triangles where they sample a surface (Sharp, Crane 2020, section 5.7).
///
/// Each point is triangulated with its nearest neighbours in its tangent plane, which is that of
/// its normal or, where there is none, of a weighted fit (principal components). Of that Delaunay
/// triangulation the triangles at the point are kept: those whose corners share a vertex of the
/// point's Voronoi cell. The cell is that of space, cut by the tangent plane (Boissonnat, Ghosh
/// 2014), so that points far above the plane have no share. The surface is the union over all
/// points, each triangle once: of every triangle that two of its corners found, and of those that
/// one found while all three are among each other's neighbours. A lone point off the surface is
/// therefore joined to nothing.
///
/// Two sheets nearer to each other than some three quarters of the spacing are joined, unless
/// normals keep them apart; holes narrower than some three spacings may be closed.
///
/// `progress` is asked as stage "surface". `threads`: 0 means all cores; the answer has the same
/// bits with any number. Errors: kBadInput (options, points on one line or fewer than three that
/// differ), kOutOfMemory, kCancelled. Cost: O(P log P).
Result<PointSurface> surface_of(const PointCloud& cloud, const PointOptions& options = {},
                                const Progress& progress = {}, int threads = 0);

}  // namespace geotherm
