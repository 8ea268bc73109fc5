// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geotherm/distance_method.h"
#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/names.h"
#include "geotherm/path.h"
#include "geotherm/progress.h"

// Directions on a triangle mesh: tangent planes, logarithmic maps, straightest lines, vectors and
// values carried over the surface, on which side of a curve it is, and centres of points.
namespace geotherm {

class HeatMethod;

/// The axes in which directions at a point are said. A direction is an angle in radians from e1
/// towards e2.
///
/// In a face e1 points from its first corner to its second, as the file has them. At a vertex the
/// angles of its corners are added up, from the first edge on: on the boundary that from which the
/// faces follow each other counterclockwise, elsewhere that towards the next corner of the first
/// face with the vertex. Inside the surface the sum is scaled to 2 pi, on the boundary it stays
/// what it is; the surface then lies in the directions from 0 to `angle`. At vertices e1 and e2 lie
/// in the plane of the mean normal (faces weighted by their angles), e1 below the first edge;
/// vectors in space are those of the tangent plane by that.
struct TangentFrame {
  Vec3 e1 = Vec3::UnitX(), e2 = Vec3::UnitY(), normal = Vec3::UnitZ();  ///< orthonormal
  double angle = 0;          ///< of the surface round the point, radians: 2 pi where it is flat
  bool on_boundary = false;  ///< a vertex on the boundary, where directions are not scaled
  Index first = kNoIndex;    ///< of a vertex: the other end of its first edge

  /// The vector of this direction and length, in the units of the length.
  Vec3 vector(double direction, double length = 1) const;
};

/// Polar coordinates about a point: where each vertex is seen from there along the shortest path.
struct LogMap {
  TangentFrame frame;              ///< at the point
  std::vector<double> distances;   ///< V, model units; kUnreached where no path leads
  std::vector<double> directions;  ///< V, radians, -pi to pi, on the boundary 0 to its angle, as
                                   ///< the path leaves the point; NaN where there is no path
  /// By waves: how many directions hang on which of two paths of almost one length is the shorter,
  /// which waves cannot tell. Exact maps have none.
  Index in_doubt = 0;
  /// One sentence: that number, where it is more than one in a hundred.
  std::vector<Warning> warnings;
};

/// How a log map is carried along, and how far.
struct LogMapOptions {
  /// kExact, by windows; kWavefront and kWavefrontFine are near exact and many times as fast.
  MethodKind method = MethodKind::kExact;
  double max_distance = kUnreached;  ///< > 0, model units; what is farther is kUnreached
  /// In [0, V): the map ends when all of these have their place, and is theirs alone; empty: all.
  std::vector<Index> targets = {};
};

/// Why a straightest line ends.
enum class TraceEnd {
  kLength,    ///< it is as long as was asked for
  kBoundary,  ///< at the boundary
  kSplit,     ///< at an edge with three faces or more, or a vertex of several fans
};
inline NamedValues<TraceEnd> named_values(TraceEnd) {
  using enum TraceEnd;
  return {"a line does not end by '*'",
          {{kLength, "length"}, {kBoundary, "border"}, {kSplit, "split"}}};
}

/// A straightest line.
struct TracedLine {
  SurfacePath path;                  ///< its length is that asked for unless it ends before
  TraceEnd end = TraceEnd::kLength;  ///< why it ends
  /// In which it would go on, in the frame of its last point; NaN where that is a vertex.
  double direction = 0;
};

/// How the side of a curve is told.
enum class SideRule {
  kAuto,   ///< kSides, or kHeat where the curves leave the surface in one part
  kSides,  ///< exact distance, with the sign of the part of the surface that a vertex is in
  kHeat,   ///< the signed heat method (Feng, Crane 2024), which closes gaps
};
inline NamedValues<SideRule> named_values(SideRule) {
  using enum SideRule;
  return {"there is no rule '*'", {{kAuto, "auto"}, {kSides, "sides"}, {kHeat, "heat"}}};
}

/// Distance to curves, negative to the left of their direction: inside a loop that runs
/// counterclockwise.
struct SignedDistance {
  std::vector<double> distances;     ///< V, model units; kUnreached where no curve is
  SideRule rule = SideRule::kSides;  ///< kSides or kHeat: which it was
  std::vector<Warning> warnings;     ///< one sentence each
};

/// The directions of a mesh. Immutable; several threads may ask at once. Faces are
/// at least 1e-5 of their longest side high, for which edges of degenerate ones are lengthened.
class Directions {
 public:
  /// Errors: kBadInput (no face with area), kOutOfMemory, kCancelled. Cost: O(F).
  static Result<std::shared_ptr<const Directions>> build(std::shared_ptr<const TriangleMesh> mesh,
                                                         const Progress& progress = {});
  ~Directions();

  /// Errors: kBadInput (a point that is not on the mesh, a vertex whose faces are no single fan).
  Result<TangentFrame> frame_at(const SurfacePoint& point) const;

  /// The logarithmic map about a point. Carried along by exact windows it is exact on polyhedra, by
  /// waves near exact (docs/directions.md says how near). Paths that bend round a vertex have the
  /// direction of their first piece. Errors: those of frame_at(), a point on an edge with three
  /// faces or more, another method, an empty reach, those of the method. Cost: a query of the
  /// method, by waves as much again; windows within max_distance or as far as the targets.
  Result<LogMap> log_map(const SurfacePoint& point, const LogMapOptions& options = {},
                         const Progress& progress = {}) const;

  /// The straightest line (Polthier, Schmies 1998) from a point in a direction: straight across
  /// edges, and with the same angle on both sides at vertices. `length` in model units. It may pass
  /// a seam where orientations disagree. Errors: those of frame_at(), kBadInput (a direction or
  /// length that is not finite, a negative length, at the boundary a direction that leaves the
  /// surface), kBudgetEnded (ten million pieces), kCancelled. Cost: O(pieces).
  Result<TracedLine> trace(const SurfacePoint& point, double direction, double length,
                           const Progress& progress = {}) const;

  /// Signed distance to directed curves that separate the surface, each piece of which lies in one
  /// face (PathFinder finds such): exact on the faces, by windows. Errors: kBadInput (no curve, a
  /// piece that is in no face, curves that leave the surface in one part, go round a part in both
  /// directions or there and back), those of exact distances. Cost: an exact query.
  Result<SignedDistance> signed_distance(std::span<const SurfacePath> curves,
                                         const Progress& progress = {}) const;

  struct State;  ///< internal

 private:
  explicit Directions(std::unique_ptr<const State> state);
  std::unique_ptr<const State> state_;
};

/// A tangent vector at a vertex, in its frame.
struct TangentVector {
  Index vertex = kNoIndex;  ///< where it stands
  double x = 0, y = 0;      ///< along e1 and e2
};

/// How values and vectors are spread.
struct SpreadOptions {
  std::string backend;     ///< of backend_names(); empty: the first of them
  double time_factor = 1;  ///< diffusion time in squares of the mean edge, > 0
  int threads = 0;         ///< 0: all cores

  bool operator==(const SpreadOptions&) const = default;
};

/// Vectors or values at all vertices, from some of them.
struct Spread {
  std::vector<Vec3> vectors;  ///< V, of vectors: in space, model axes; NaN where none can be
  std::vector<std::array<double, 2>> components;  ///< the same in the frames of the vertices
  std::vector<double> values;                     ///< V, of values; NaN where none can be
  double t = 0;                                   ///< diffusion time, model units squared
  std::vector<Warning> warnings;                  ///< one sentence each
};

/// The vector heat method (Sharp, Soliman, Crane 2019): vectors carried along shortest paths from
/// their nearest source without turning, and values extended as the nearest source has them, by
/// short diffusion on the triangulation of the heat method, whose inserted vertices no answer has.
/// Immutable; several threads may ask at once.
class VectorHeat {
 public:
  /// `beside`: a method on the same mesh, whose triangulation, matrices and analysis are shared
  /// where it has the same backend, LaplacianKind::kAuto or kRefined, and a triangulation without
  /// a cover; the answers are those without it. Errors: kBadInput (no face with area, a
  /// time factor that is not above 0), kNotAvailable (no such backend), those of the backend. Cost:
  /// a factorisation of V rows; the first call about vectors or signs adds one of 2 V in the same
  /// elimination order. Backends that iterate factorise nothing.
  static Result<std::shared_ptr<const VectorHeat>> build(std::shared_ptr<const TriangleMesh> mesh,
                                                         const SpreadOptions& options = {},
                                                         const Progress& progress = {},
                                                         const HeatMethod* beside = nullptr);
  ~VectorHeat();

  /// The frames of the vertices: V, as long as this lives; those in no face have the axes of space.
  /// Made when they are first needed. Errors: kCancelled, kOutOfMemory.
  Result<std::span<const TangentFrame>> frames(const Progress& progress = {}) const;

  /// Vectors at all vertices. Their lengths are extended like values. Where the mesh is so wide
  /// that heat falls below the smallest double, backends that factorise make the time longer for
  /// this call, and a warning says so; others say how many vertices have no vector, and at how many
  /// the time was too short for the faces at the border, so that heat is not positive. Errors:
  /// kBadInput (no vector, a vertex out of range or in no face, two different vectors at one
  /// vertex, numbers that are not finite; a mesh that is no oriented manifold, with the vertex),
  /// those of the backend.
  Result<Spread> transport(std::span<const TangentVector> vectors,
                           const Progress& progress = {}) const;

  /// Values at all vertices, within the range of those given; on any mesh. Errors: the same, and
  /// not as many values as vertices.
  Result<Spread> extend(std::span<const Index> vertices, std::span<const double> values,
                        const Progress& progress = {}) const;

  /// Signed distance to directed curves by the signed heat method, whether or not they are closed:
  /// their normals diffuse, and gaps are closed by what they point to. Errors: kBadInput (no curve,
  /// a piece that is in no face, a mesh that is no oriented manifold), those of the backend. Cost:
  /// a factorisation more.
  Result<SignedDistance> signed_distance(std::span<const SurfacePath> curves,
                                         const Progress& progress = {}) const;

 private:
  struct State;
  explicit VectorHeat(std::unique_ptr<const State> state);
  std::unique_ptr<const State> state_;
};

/// Where signed_distance() finds what is set up for it; each is asked for when it is needed.
struct SignedSetup {
  /// What tells sides of curves that separate.
  std::function<Result<std::shared_ptr<const Directions>>(const Progress&)> directions;
  /// What carries the normals of curves that do not.
  std::function<Result<std::shared_ptr<const VectorHeat>>(const Progress&)> heat;
};

/// Signed distance by a rule: that of Directions, or of VectorHeat. With kAuto a warning says why
/// VectorHeat answers. Errors: those of both.
Result<SignedDistance> signed_distance(const SignedSetup& setup,
                                       std::span<const SurfacePath> curves,
                                       SideRule rule = SideRule::kAuto,
                                       const Progress& progress = {});
/// Signed distance with all that it needs set up for this call.
Result<SignedDistance> signed_distance(const std::shared_ptr<const TriangleMesh>& mesh,
                                       std::span<const SurfacePath> curves,
                                       SideRule rule = SideRule::kAuto,
                                       const SpreadOptions& options = {},
                                       const Progress& progress = {});

/// What a centre is of.
enum class CentreKind {
  kMean,    ///< sum of w d^2 is least (Frechet 1948, Karcher 1977)
  kMedian,  ///< sum of w d is least (Fletcher, Venkatasubramanian, Joshi 2009)
};
inline NamedValues<CentreKind> named_values(CentreKind) {
  return {"there is no centre '*'", {{CentreKind::kMean, "mean"}, {CentreKind::kMedian, "median"}}};
}

/// How a centre is looked for.
struct CentreOptions {
  CentreKind kind = CentreKind::kMean;     ///< what of the points is looked for
  MethodKind method = MethodKind::kExact;  ///< of the log maps (LogMapOptions)
  int max_steps = 100;                     ///< of each descent, >= 1
  int threads = 0;                         ///< of the first search; 0: all cores
};

/// A point where the energy is least, round it at least.
struct Centre {
  SurfacePoint point;      ///< where it is
  double energy = 0;       ///< mean of w d^2 (model units squared), or of w d
  double residual = 0;     ///< length of the step that was left to do, model units
  bool converged = false;  ///< the residual is 1e-5 of the mean distance or less (waves: 5e-3)
  std::vector<double> distances;  ///< K: to the points
  /// Where the descent began and after each step; they fall. With exact maps on more than 20,000
  /// faces it begins where one by waves has ended.
  std::vector<double> energies;
};

/// All centres that were found.
struct Centres {
  std::vector<Centre> found;      ///< the first has the least energy; in its order
  std::vector<Warning> warnings;  ///< one sentence each: several minima, descents that stalled
};

/// Frechet means or medians of points with weights: where the energy, the sum of w d^2 or w d over
/// the sum of w, is least. Near-exact distances from every point show at which vertices it is low;
/// from the lowest of these, eight at most, it descends: in the tangent plane of a log map the mean
/// or the median is found (Weiszfeld 1937; at the points themselves as in Vardi, Zhang 2000), and a
/// straightest line leads there, half as far and so on until the energy falls. Further minima whose
/// energy is at most 2 % more are found, too. At tips, on the boundary and at creases of the
/// distances a descent can stall; then it has not converged.
///
/// `points`: K, on one component. `weights`: K, >= 0, some above; none: all 1. Errors: kBadInput
/// (no point, other numbers of weights, points in several components, an option out of range),
/// those of log_map(). Cost: K wavefront queries and a log map for each step.
Result<Centres> find_centres(const std::shared_ptr<const TriangleMesh>& mesh,
                             std::span<const SurfacePoint> points,
                             std::span<const double> weights = {},
                             const CentreOptions& options = {}, const Progress& progress = {});

/// Points moved to the middle of their cells.
struct RelaxedPoints {
  std::vector<SurfacePoint> points;  ///< K
  std::vector<double> distances;     ///< V: to the nearest of them; kUnreached where none can be
  std::vector<Index> nearest;        ///< V: its number, kNoIndex where none can be
  /// Before the first step and after each that was made: the sum over vertices of d^2 times a third
  /// of the area of their faces, model units^4. It falls with every one.
  std::vector<double> energies;
  std::vector<double> moves;  ///< of each step: how far the points went, the farthest, model units
  bool settled = false;       ///< ended because no step lowers the energy
};

/// Lloyd's iteration (Lloyd 1957; on surfaces: Peyre, Cohen 2006): each point moves to the mean of
/// the vertices that are nearest to it, by a log map of its cell and a straightest line, `steps`
/// times or until the energy does not fall, towards a geodesic centroidal Voronoi tessellation. A
/// step that would raise the energy is halved. Points on edges with three faces, or at vertices of
/// several fans, stay.
///
/// `method`: on `mesh`, one that says the nearest source (all but heat). Errors: kBadInput (no
/// point, negative steps), kNotAvailable (the heat method), those of queries. Cost: a query a step,
/// and exact ones in the cells.
Result<RelaxedPoints> relax_points(const DistanceMethod& method,
                                   const std::shared_ptr<const TriangleMesh>& mesh,
                                   std::span<const SurfacePoint> points, int steps,
                                   const Progress& progress = {}, int threads = 0);

}  // namespace geotherm
