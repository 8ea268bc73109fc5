// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "geotherm/distance_method.h"

// The methods that walk over the edges of the triangulation instead of solving systems: wavefronts,
// fast marching, and exact window propagation.
namespace geotherm {

/// The intrinsic Delaunay triangulation of a mesh with its edges, whatever number of faces they
/// have: what all three walk over. Immutable. For wavefronts vertices are inserted where faces are
/// large and the boundary is obtuse, as heat methods do (LaplacianKind::kRefined).
struct WaveSurface;

/// Whether the method walks over inserted vertices. The others, where they are given a surface with
/// some, make one without.
inline bool walks_on_inserted(MethodKind method) {
  return method == MethodKind::kWavefront || method == MethodKind::kWavefrontFine;
}

/// `earlier`: of the same faces with vertices elsewhere, of which what stays is taken over; or
/// null. Errors: kBadInput (no face with area, edges that cannot be added up), kOutOfMemory,
/// kCancelled. Cost: O(F + flips).
Result<std::shared_ptr<const WaveSurface>> build_wave_surface(
    std::shared_ptr<const TriangleMesh> mesh, const Progress& progress = {}, int threads = 1,
    const WaveSurface* earlier = nullptr);

/// What the three have in common.
class WaveMethod : public DistanceMethod {
 public:
  ~WaveMethod() override;
  MethodKind kind() const override;
  Result<std::vector<DistanceResult>> solve_each(std::span<const SourceSet> sets,
                                                 const QueryOptions& query = {},
                                                 const Progress& progress = {}) const override;
  const SetupTiming& timing() const override;
  double memory_mb() const override;
  const std::vector<Warning>& warnings() const override;
  const std::shared_ptr<const WaveSurface>& surface() const;  ///< that it walks over

 protected:
  struct State;
  explicit WaveMethod(std::unique_ptr<const State> state);  ///< for the three alone
  std::unique_ptr<const State> state_;                      ///< what is the same in the three
};

/// Near-exact distance by waves over the edges of the intrinsic Delaunay triangulation, each fitted
/// from the distances at an edge's ends and at samples between them (docs/numerics.md,
/// "Wavefront"). Quality figures: max_source_distance (0 but for round-off: a source starts at its
/// offset and can only fall) and eikonal_error_mean alone. A query ends with kBudgetEnded
/// where values would fall for ever.
class WavefrontMethod final : public WaveMethod {
 public:
  /// Samples inside an edge: its midpoint, or its quarter points.
  enum class Samples { kMidpoint, kQuarters };

  /// `earlier`: a method on the same faces with vertices elsewhere, whose tables and buffers are
  /// taken over where the triangles are the same; or null. Errors: those of build_wave_surface().
  /// Cost: O(F + flips).
  static Result<std::shared_ptr<const WavefrontMethod>> build(
      std::shared_ptr<const WaveSurface> surface, Samples samples, int threads = 0,
      const Progress& progress = {}, const WavefrontMethod* earlier = nullptr);

 private:
  struct State;
  explicit WavefrontMethod(std::unique_ptr<const State> state);
};

/// First-order fast marching with planar updates and unfolded supports at obtuse angles (Kimmel,
/// Sethian 1998), on the intrinsic Delaunay triangulation: the classic to compare with. Quality
/// figures: those of WavefrontMethod.
class FastMarchingMethod final : public WaveMethod {
 public:
  /// Errors: kOutOfMemory, kCancelled. Cost: O(F).
  static Result<std::shared_ptr<const FastMarchingMethod>> build(
      std::shared_ptr<const WaveSurface> surface, int threads = 0, const Progress& progress = {});

 private:
  struct State;
  explicit FastMarchingMethod(std::unique_ptr<const State> state);
};

/// Exact polyhedral distance by window propagation, to round-off: all source kinds, offsets, labels
/// (docs/numerics.md, "Exact"). Quality figures: max_source_distance (0 but for round-off: a source
/// starts at its offset and can only fall) and eikonal_error_mean alone. Beside the errors of every
/// method, a query ends with kOutOfMemory or kBudgetEnded where windows multiply without end: where
/// those of one solve_each() fill 1.5 GiB, of which each set that is solved at once has its share.
/// Cost: 15 to 60 windows a face on models as they come, a few on planes.
/// Sources: Mitchell, Mount, Papadimitriou 1987; Chen, Han 1990; Xin, Wang 2009.
class ExactMethod final : public WaveMethod {
 public:
  /// Errors: kCancelled, kOutOfMemory. Cost: O(F). Source sets are solved on `threads` threads,
  /// each on one.
  static Result<std::shared_ptr<const ExactMethod>> build(
      std::shared_ptr<const WaveSurface> surface, int threads = 0, const Progress& progress = {});

 private:
  struct State;
  explicit ExactMethod(std::unique_ptr<const State> state);
};

}  // namespace geotherm
