// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "geotherm/distance_method.h"
#include "geotherm/domains.h"
#include "geotherm/mesh.h"
#include "geotherm/mesh_report.h"
#include "geotherm/options.h"

namespace geotherm {

/// A triangulation of the surface that may have other edges than the mesh; internal.
struct IntrinsicSurface;

/// A function that takes a triangulation which waves may share, as soon as it is made and while the
/// rest of the set-up goes on. Called on a thread of the set-up, again where another backend takes
/// over.
using TriangulationReady = std::function<void(std::shared_ptr<const IntrinsicSurface>)>;

/// Geodesic distance by the heat method (Crane, Weischedel, Wardetzky 2013): solve
/// (A + t L) u = u0, take X = -grad u / |grad u| on each face, solve L phi = div-form of X.
///
/// build() does everything that does not depend on the sources; solve() then costs two pairs of
/// triangular solves and one pass over the faces. Immutable: solve() may be called from several
/// threads at once. with() gives a method with other options that shares whatever stays the same:
/// the symbolic analysis always (unless backend or Laplacian change), a factor where its matrix is
/// the same.
///
/// A backend that fails (a matrix that it cannot factor, iterations or memory that end, a forecast
/// of the factors above HeatOptions::memory_limit_mb) is replaced by the others in the order of
/// backend_names(), unless HeatOptions::strict: warnings() says so, fallbacks() holds the reasons.
/// A query that fails is answered by a method with another backend, which is set up then and kept;
/// its result says so (DistanceResult::backend). Where t is extreme none of this helps, and where
/// memory ended only what needs no factor does.
///
/// Progress: set-up asks between operators, flips, analysis and factorisations, but a numeric
/// factorisation (the backend's library) cannot be interrupted: up to some seconds at a million
/// faces. A query asks between its steps, and within an iterative backend every few milliseconds.
/// Calls come from any thread of the work, one at a time, and none after the first that returned
/// false. What was cancelled leaves no trace: the method answers as before.
class HeatMethod final : public DistanceMethod {
 public:
  /// Errors: kNotAvailable (backend), kBadInput (options, a mesh without area), kNumericalFailure
  /// (with the column or residual), kOutOfMemory, kCancelled. `ready` is called where there will be
  /// a delaunay_triangulation().
  static Result<HeatMethod> build(std::shared_ptr<const TriangleMesh> mesh,
                                  const HeatOptions& options = {}, const Progress& progress = {},
                                  const TriangulationReady& ready = {});

  /// The same on any space that is cut into cells (domains.h). Of the options `laplacian` is kAuto
  /// or kCotan, which are one. Sources are vertices and cell points. Errors: the same, and
  /// kBadInput where the arrays do not fit together.
  static Result<HeatMethod> build(std::shared_ptr<const CellComplex> cells,
                                  const HeatOptions& options = {}, const Progress& progress = {});

  /// The same on a grid. Errors: the same, and those of check_grid(). Cost: by the backend cg some
  /// 400 bytes a sample.
  static Result<HeatMethod> build(std::shared_ptr<const Grid> grid, const HeatOptions& options = {},
                                  const Progress& progress = {});

  /// The same mesh with other options. Cost: of the set-up what the change makes necessary; sources
  /// cost nothing before a query has them. The backend that took over stays where the same one is
  /// asked for again.
  Result<HeatMethod> with(const HeatOptions& options, const Progress& progress = {}) const;

  /// The same faces with the vertices elsewhere: a surface that moves. The answers are those of a
  /// fresh build() on the moved mesh, but for rounding (1e-12 of the largest distance with factors
  /// in doubles).
  ///
  /// What the shape does not change stays: cleaned faces, elimination order and, where no edge of
  /// the triangulation flips, the whole analysis. Flips and insertions change the pattern within
  /// the kept order; a new order is made once a factor would be 15 % larger than in a fresh one.
  /// Where at most an eighth of the vertices moved, only the fronts above them are factorised
  /// (fronts()): in the Poisson equation always, in the heat step where the time is absolute
  /// (TimeRule::kAbsolute), since other rules follow the mean edge. That needs the backend native,
  /// and from the second such call on, since the first keeps what the next ones need (as much
  /// memory as the factors again). Memory of earlier factors is used again: at most that of three
  /// methods is held, however many frames there are.
  ///
  /// Errors: kBadInput (another number of positions, a coordinate that is not finite, a method that
  /// is not on a triangle mesh), those of build(). Cost: about half of build().
  Result<HeatMethod> with_positions(std::vector<Vec3> positions,
                                    const Progress& progress = {}) const;

  /// The same for a mesh that was moved elsewhere, and with other options. Errors: the same, and
  /// those of check_moved().
  Result<HeatMethod> with_mesh(std::shared_ptr<const TriangleMesh> moved,
                               const HeatOptions& options, const Progress& progress = {}) const;

  MethodKind kind() const override { return MethodKind::kHeat; }

  /// As one blocked solve. Quality costs two matrix products and a pass over the faces. Offsets of
  /// sources are refused (kBadInput).
  Result<std::vector<DistanceResult>> solve_each(std::span<const SourceSet> sets,
                                                 const QueryOptions& query = {},
                                                 const Progress& progress = {}) const override;

  const HeatOptions& options() const;              ///< with the backend at work
  const std::vector<Fallback>& fallbacks() const;  ///< backends that failed before it
  /// Diffusion time, model units squared. Rules that follow the mean edge h or the area over faces
  /// A/F give each component a time of its own: m g h^2 or m g A/F, with the time factor m and g as
  /// in grading(); then this is the time of the component with most faces (of several, the first).
  double t() const;
  double relative_t() const;  ///< the same in squares of that component's mean edge
  /// g = t / h^2 of that component at the time factor 1, where the time follows h. It is 1, but
  /// where faces are too large for t = h^2 and their triangulation is refined; in tets, where it
  /// follows how many lie across a body and is 0.6 or more; and on grids with one speed (1/4).
  double grading() const;
  /// The least and the largest time of a component, model units squared.
  std::array<double, 2> t_range() const;
  BoundaryRule boundary() const;    ///< what kAuto became
  LaplacianKind laplacian() const;  ///< what kAuto became
  Index flips() const;              ///< Delaunay edge flips made
  /// What was inserted into the triangulation, never into the mesh. The same for every time step:
  /// with() keeps it.
  const RefinementCounts& refinement() const;
  const SetupTiming& timing() const override;  ///< of build() or of the with() that made this
  double memory_mb() const override;           ///< of all factors
  double forecast_mb() const;                  ///< the same, as it was foreseen
  /// Fronts of all factors (blocks of columns that are eliminated together), and how many were
  /// factorised for this method; with_positions() keeps the others. 0 for backends without fronts.
  struct Fronts {
    Index all = 0, factored = 0;  ///< how many
  };
  Fronts fronts() const;  ///< of all factors of this method
  const std::vector<Warning>& warnings() const override;
  const HeatMethod* heat() const override { return this; }

  /// The triangulation of the operators, where it is Delaunay and no cover, inserted vertices
  /// included: what waves on the same mesh may share. Null otherwise.
  std::shared_ptr<const IntrinsicSurface> delaunay_triangulation() const;

 private:
  struct State;
  explicit HeatMethod(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

/// What LaplacianKind::kAuto becomes on a mesh.
inline LaplacianKind auto_kind(const MeshReport& mesh) {
  if (mesh.refinement.points > 0) return LaplacianKind::kRefined;
  if (mesh.tufted_components > 0) return LaplacianKind::kTufted;
  return mesh.non_delaunay_edges > 0 ? LaplacianKind::kIntrinsicDelaunay : LaplacianKind::kCotan;
}

}  // namespace geotherm
