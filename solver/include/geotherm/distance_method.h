// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/names.h"
#include "geotherm/progress.h"
#include "geotherm/sources.h"
#include "geotherm/types.h"

// What all methods have in common: a DistanceMethod is a mesh made ready for sources, a
// DistanceResult the answer to one set of them. build_method() (build_method.h) makes any of them.
namespace geotherm {

/// How distance is computed.
enum class MethodKind {
  kHeat,           ///< the heat method (Crane, Weischedel, Wardetzky 2013)
  kWavefront,      ///< waves over edges with a sample at each midpoint: near exact
  kWavefrontFine,  ///< the same with samples at the quarters, too
  kFastMarching,   ///< first-order fast marching (Kimmel, Sethian 1998)
  kExact,          ///< exact polyhedral distance by window propagation
};
inline NamedValues<MethodKind> named_values(MethodKind) {
  using enum MethodKind;
  return {"there is no method '*'",
          {{kHeat, "heat"},
           {kWavefront, "wavefront"},
           {kWavefrontFine, "wavefront-fine"},
           {kFastMarching, "fast-marching"},
           {kExact, "exact"}},
          ErrorCode::kNotAvailable};
}

/// How good an answer is, computed from the answer itself.
struct Quality {
  double heat_residual = 0;        ///< |M u - b| / |b|, Euclidean, M = A + t L, free rows
  double poisson_residual = 0;     ///< |L phi - b| / |b|, Euclidean, rows that are not held
  double max_source_distance = 0;  ///< largest |d| on a source as solved, model units
  double eikonal_error_mean = 0;   ///< area-weighted mean of | |grad phi| - 1 |
  Index zero_gradient_faces = 0;   ///< faces (in reach, not held) without a gradient of u
  Index clamped_vertices = 0;      ///< values below 0 by more than round-off, set to 0
  double clamped_reach = 0;        ///< straight line to the farthest of these, model units
  Index reached_vertices = 0;      ///< with a distance
  /// Distances below the straight line to the nearest source by more than the method's
  /// tolerance, before they are raised to it where that is done, and the largest share of the line
  /// that is missing in one of them.
  Index below_straight_line = 0;
  double most_below_straight_line = 0;  ///< that share
  /// Edges along which the distance differs by more than their length and that tolerance, and the
  /// largest difference over length of one of them.
  Index steep_edges = 0;
  double steepest_edge = 0;  ///< that difference
  /// Whether these two bounds were looked at: travel times have no straight line, and edges are
  /// those of triangle meshes.
  bool lines_checked = false, edges_checked = false;
  int iterations_heat = 0;     ///< 0 for direct backends
  int iterations_poisson = 0;  ///< 0 for direct backends
};

/// Milliseconds of one query: from the source set to the distances. In a blocked call each
/// result holds its share (the block's time over its number of source sets).
struct QueryTiming {
  double diffuse = 0;   ///< the heat
  double gradient = 0;  ///< its direction
  double poisson = 0;   ///< distances of that direction
  double query = 0;     ///< the whole
};

/// Milliseconds from mesh in memory to first query ready.
struct SetupTiming {
  double operators = 0;  ///< cleaning, Delaunay flips, renumbering, assembly
  double analyze = 0;    ///< ordering and symbolic analysis
  double factorize = 0;  ///< both numeric factorisations
  double setup = 0;      ///< the whole

  /// What `operators` consists of, for the heat method.
  struct Operators {
    double clean = 0;      ///< faces, edges, orientation
    double intrinsic = 0;  ///< lengths, mollification, cover
    double flips = 0;      ///< looking for edges to flip, and flips
    double pattern = 0;    ///< the pattern of the matrices
    double renumber = 0;   ///< everything in elimination order
  } stages;                ///< all 0 for other methods
};

/// Geodesic distance from one source set.
struct DistanceResult {
  std::vector<double> distances;  ///< V, file order, model units; kUnreached where no source can be
  Quality quality;                ///< figures of the answer itself, without another method
  QueryTiming timing;             ///< of this query
  std::vector<Warning> warnings;  ///< one sentence each

  /// The backend that gave the answer of the heat method, and those that failed at it before.
  std::string backend;
  std::vector<Fallback> fallbacks;  ///< in the order in which they failed

  /// V: the group (source_groups) of the nearest source, kNoIndex where none can be; only when
  /// asked for (QueryOptions::nearest) and from methods that carry it along: all but heat.
  std::vector<Index> nearest_source;

  /// The vertices that distances and nearest sources are of, where that is not all of them: the
  /// targets of Reach as they were given, or with Reach::sparse those within reach, ascending.
  std::vector<Index> vertices;

  /// Only when asked for (QueryOptions::fields), and only by the heat method.
  std::vector<double> heat;      ///< V: u, scaled so that its largest value is 1
  std::vector<double> log_heat;  ///< V: ln of that, right where `heat` underflows; -inf: u <= 0
};

class HeatMethod;

/// How far a query goes. What lies within has the bits of the answer to all of the mesh. Waves,
/// fast marching and windows on triangle meshes end where nothing nearer is left to find, and spend
/// time on what lies within alone; the other methods solve for all and cut. Quality
/// figures of the whole surface are left out then.
struct Reach {
  double max_distance = kUnreached;  ///< > 0, model units; what is farther is kUnreached
  /// In [0, V): the query ends when all of them have their distance, and the answer is theirs alone
  /// (DistanceResult::vertices); empty: all vertices.
  std::vector<Index> targets = {};
  bool sparse = false;  ///< without targets: the answer holds those within reach alone
  /// Whether it asks for less than all.
  bool is_bounded() const { return max_distance < kUnreached || !targets.empty(); }
};

/// What a query computes beside the distances.
struct QueryOptions {
  bool quality = true;   ///< the quality figures; what they cost stands at each method
  bool fields = false;   ///< u of the heat method (DistanceResult::heat and log_heat)
  bool nearest = false;  ///< DistanceResult::nearest_source, by methods that know it
  Reach reach = {};      ///< all of the mesh
};

/// Geodesic distance on one mesh, ready for sources: what every method has in common. Immutable;
/// queries may run on several threads at once.
class DistanceMethod {
 public:
  virtual ~DistanceMethod() = default;

  /// Which method it is.
  virtual MethodKind kind() const = 0;

  /// Distance to the nearest source. Errors: kBadInput (no source, a vertex or face out of range,
  /// weights that are negative or do not sum to 1, offsets that are negative or that the method
  /// does not know, an empty reach), kBudgetEnded, kNumericalFailure, kOutOfMemory, kCancelled.
  Result<DistanceResult> solve(const SourceSet& sources, const QueryOptions& query = {},
                               const Progress& progress = {}) const;

  /// One result per source set. The results do not depend on the number of threads.
  virtual Result<std::vector<DistanceResult>> solve_each(std::span<const SourceSet> sets,
                                                         const QueryOptions& query = {},
                                                         const Progress& progress = {}) const = 0;

  /// What setting it up took.
  virtual const SetupTiming& timing() const = 0;
  virtual double memory_mb() const = 0;  ///< of factors or tables, in 2^20 bytes
  virtual const std::vector<Warning>& warnings() const = 0;  ///< about mesh and options

  /// The heat method, where it is that.
  virtual const HeatMethod* heat() const { return nullptr; }
};

}  // namespace geotherm
