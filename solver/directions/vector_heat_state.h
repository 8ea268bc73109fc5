// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "solver/directions/directions_state.h"
#include "solver/directions/flipped_directions.h"
#include "solver/directions/scaled_heat.h"
#include "solver/directions/spread_system.h"
#include "solver/heat/diffuse.h"
#include "solver/heat/linear_system.h"
#include "solver/heat/surface.h"

namespace geotherm {

/// Vectors at rows, over the heat there.
using RowVectors = std::vector<std::complex<double>>;

/// The heat of the rows that something spreads from.
struct Warmth {
  double t = 0;  ///< in squares of the surface's unit
  std::shared_ptr<const LinearSystem> system;
  HeatField heat;
  std::vector<char> reached;  ///< a flag for each row that is joined to one of those
  bool scaled = false;        ///< the heat spans more than iterations resolve: solve by ScaledHeat

  /// The heat at row j divided by the heat at row i.
  double ratio(Index j, Index i) const;
};

/// What vectors need beyond values.
struct VectorParts {
  std::unique_ptr<const Directions::State> directions;
  FlippedDirections flipped;
  std::vector<TangentFrame> frames;
  std::vector<Link> links;  ///< of sides: an inner edge stands twice
  std::optional<Error> broken;
};

/// The error of a system of mass and t stiffness, which is definite unless t drowns the mass.
inline Error about_time(Error error) {
  if (error.code == ErrorCode::kNumericalFailure) {
    error.hint = {"lower ", SettingHint{"time-factor"}, ", or try another backend"};
  }
  return error;
}

struct VectorHeat::State {
  int threads = 1;
  double t = 1;  ///< as asked for, in squares of the surface's unit
  std::shared_ptr<const Surface> surface;
  std::shared_ptr<const LinearSystem> scalar;  ///< for that time
  mutable BlockPool pool;

  Index size() const { return surface->size(); }
  double unit() const { return surface->unit; }
  bool iterative() const { return surface->backend->iterative(); }
  const TriangleMesh& mesh() const { return *surface->mesh; }
  /// kNoIndex where the vertex is in no face.
  Index row_of(Index vertex) const { return surface->row_of_vertex[mesh().standing_for(vertex)]; }

  Result<std::shared_ptr<const LinearSystem>> factorize(double time) const;
  Result<std::vector<Index>> rows_of(std::span<const Index> vertices) const;

  /// Heat of 1 at each of the rows, everywhere in their parts. A time with which that is so within
  /// the range of doubles where vectors need it: by a factor.
  Result<Warmth> warm(std::span<const Index> rows, bool for_vectors, std::vector<Warning>& warnings,
                      const Progress& progress) const;
  /// One value for each of the rows at all rows, as the nearest has it: within their range.
  Result<std::vector<double>> spread(const Warmth& warmth, std::span<const Index> rows,
                                     std::span<const double> values, std::vector<Warning>& warnings,
                                     const Progress& progress) const;
  /// One vector for each of the rows, as the nearest has it; a row may stand in the list several
  /// times. Errors: VectorParts::broken.
  Result<RowVectors> carry(const Warmth& warmth, std::span<const Index> rows,
                           std::span<const std::complex<double>> vectors,
                           const Progress& progress) const;

  /// Made when they are first asked for. Errors: kCancelled, kOutOfMemory.
  Result<const VectorParts*> vector_parts(const Progress& progress) const;

 private:
  struct VectorFactor {
    double t = 0;
    std::shared_ptr<const Factorization> factor;
  };
  std::vector<Link> find_links(const FlippedDirections* flipped) const;
  Result<VectorFactor> vector_factor(double time, const VectorParts& parts,
                                     const Progress& progress) const;

  mutable std::mutex lock_;
  mutable std::unique_ptr<const VectorParts> parts_;
  mutable std::optional<SpreadSystem> doubled_;  ///< vectors by two rows each
  mutable std::optional<VectorFactor> factor_;   ///< of the time that was asked for first
};

}  // namespace geotherm
