// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geotherm/distance_method.h"
#include "geotherm/mesh.h"
#include "geotherm/names.h"
#include "geotherm/progress.h"

// Lines on the surface: the shortest paths, isolines (level sets of distances, or of any values at
// the vertices), and files of them.
namespace geotherm {

/// A polyline on the surface. Two points that follow each other lie in a common face.
struct SurfacePath {
  std::vector<SurfacePoint>
      points;                ///< n, of the mesh of the file; a closed path repeats its first
  std::vector<Index> faces;  ///< n - 1: the face (of the file) that holds each piece
  double length = 0;         ///< model units
  bool closed = false;       ///< ends where it begins
};

/// Where a point of the mesh lies, model units. Precondition: it lies on the mesh.
Vec3 position_at(const TriangleMesh& mesh, const SurfacePoint& point);

/// The points as weights in a face each: that of the piece that begins there, the last one in that
/// of the last piece. A path of one vertex takes the first face that has it; one of a vertex in no
/// face stays bare.
std::vector<SurfacePoint> points_in_faces(const TriangleMesh& mesh, const SurfacePath& path);

/// Positions of the points, model units.
std::vector<Vec3> positions_of(const TriangleMesh& mesh, const SurfacePath& path);

/// Sum of the lengths of the pieces, model units.
double length_of(const TriangleMesh& mesh, const std::vector<SurfacePoint>& points);

/// The same path from its end to its start.
SurfacePath reversed(SurfacePath path);

/// Appends a path that begins where the other ends, if that has points.
void append(SurfacePath& path, const SurfacePath& next);

class PathSurface;

/// What a path follows.
enum class PathField {
  kGeodesic,  ///< nothing: it is the shortest that is found, and straight wherever it can be
  kDistance,  ///< -grad phi, the distance from its start, backwards from its end
  kHeat,      ///< X = -grad u / |grad u| of the heat method, likewise
};
inline NamedValues<PathField> named_values(PathField) {
  using enum PathField;
  return {"there is no field '*' to follow",
          {{kGeodesic, "geodesic"}, {kDistance, "distance"}, {kHeat, "heat"}},
          ErrorCode::kNotAvailable};
}

/// What a path is to be.
struct PathOptions {
  PathField field = PathField::kGeodesic;  ///< what it follows
  bool closed = false;                     ///< goes on from the last point to the first
  /// A closed geodesic is held by its points; else these only say where it runs at first, and it
  /// is shortened all round (to one point, where it can be).
  bool hold_points = false;
};

/// A path and what is to be known of it.
struct FoundPath {
  SurfacePath path;               ///< the path
  std::vector<Warning> warnings;  ///< one sentence each
};

/// Finds paths on one mesh. Immutable; several threads may ask at once.
class PathFinder {
 public:
  /// `method`: of the same mesh. Geodesics begin as streamlines of its distances and at vertices
  /// whose distances say that a shorter path may pass there; so the better they are, the surer a
  /// geodesic is the shortest of all. Those of MethodKind::kWavefront will do. Cost: O(F).
  PathFinder(std::shared_ptr<const TriangleMesh> mesh,
             std::shared_ptr<const DistanceMethod> method);

  /// The path through two points or more, in order. The geodesic from a to b is that from b to a.
  /// Errors: kBadInput (fewer points, one that is not on the mesh, no way from one to the next, a
  /// heat field without the heat method), kBudgetEnded (a path that does not become straight),
  /// kOutOfMemory, those of DistanceMethod::solve(). Shares of the progress do not fall.
  /// Cost: a query of the method for each piece, or two for a geodesic, and milliseconds; the
  /// answers for the last two points are kept, so that paths from one point to many take one each.
  Result<FoundPath> find(std::span<const SurfacePoint> points, const PathOptions& options = {},
                         const Progress& progress = {}) const;

  /// The mesh as paths see it; internal.
  const PathSurface& surface() const { return *surface_; }

 private:
  Result<FoundPath> through(std::span<const SurfacePoint> points, const PathOptions& options,
                            const Progress& progress) const;
  Result<FoundPath> piece(const SurfacePoint& from, const SurfacePoint& to, PathField field,
                          const Progress& progress) const;
  Result<FoundPath> streamline(const SurfacePoint& from, const SurfacePoint& to, PathField field,
                               const Progress& progress) const;
  Result<std::shared_ptr<const DistanceResult>> distances(const SurfacePoint& source, bool heat,
                                                          const Progress& progress) const;
  Result<FoundPath> geodesic(const SurfacePoint& from, const SurfacePoint& to,
                             const Progress& progress) const;
  /// By exact distances: one that is no longer than they say, if it is found at once.
  Result<std::optional<SurfacePath>> as_long_as_known(const SurfacePoint& from,
                                                      const SurfacePoint& to,
                                                      const Progress& progress) const;

  struct Recent;

  std::shared_ptr<const PathSurface> surface_;
  std::shared_ptr<const DistanceMethod> method_;
  std::shared_ptr<Recent> recent_;  ///< answers
};

/// A line for a file, with its number there in the order given.
struct Polyline {
  const SurfacePath* path = nullptr;  ///< where it runs; not null
  std::optional<double> value;        ///< of an isoline; all lines of a file have one or none has
};

/// Errors: kNotAvailable, with the formats there are, unless write_polylines() knows the ending.
Result<void> check_polyline_path(const std::string& path);

/// Writes lines by the ending of `path`:
/// - .obj: `v` and an `l` of two points for each straight piece (`p` for a single point).
/// - .csv: polyline_csv().
/// - .vtp: VTK PolyData with the cell data `length`, `closed` and, where there are any, `value`.
/// Errors: kNotAvailable (another ending), kBadFile.
Result<void> write_polylines(const std::string& path, const TriangleMesh& mesh,
                             std::span<const Polyline> lines);

/// One row a point: line,point,x,y,z,face,b0,b1,b2 and, where there are any, value. Faces and
/// weights are those of points_in_faces(). A closed line repeats its first point.
std::string polyline_csv(const TriangleMesh& mesh, std::span<const Polyline> lines);

/// A piece of a level set, as long as it can be followed: closed, or open from boundary to boundary
/// (or to an edge with three faces and more).
struct Isoline {
  double value = 0;  ///< of the function
  SurfacePath path;  ///< where it runs
};

/// Level sets of the function that is linear on each face. `values`: V, file order; faces with a
/// value that is not finite have none. `levels`: ascending. Sorted by level, the longest first. The
/// lines of a value that vertices have pass through these; no piece has length 0.
/// Errors: kOutOfMemory, kCancelled. Cost: O(F log levels + pieces).
Result<std::vector<Isoline>> find_isolines(const TriangleMesh& mesh, std::span<const double> values,
                                           std::span<const double> levels,
                                           const Progress& progress = {});

}  // namespace geotherm
