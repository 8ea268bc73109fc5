// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "solver/directions/directions_state.h"
#include "solver/directions/flipped_directions.h"
#include "solver/directions/spread_system.h"
#include "solver/geometry/domain_operator.h"

namespace geotherm {

/// -w r of an edge, r the rotation from its end to its begin.
struct Link {
  Index from, to;
  double weight, cosine, sine;
};

/// The factors of the scalar system for one time.
struct Factors {
  double t = 0;  ///< in squares of the mean edge
  std::shared_ptr<const Factorization> scalar;
};

/// The system of vectors: two rows for each row of the scalar one.
struct VectorSystem {
  SpreadSystem system;
  double t = 0;
  std::shared_ptr<const Factorization> factors;  ///< for that time
};

struct VectorHeat::State {
  std::shared_ptr<const TriangleMesh> mesh;
  int threads = 1;
  double unit = 1;
  std::vector<TangentFrame> frames;
  std::optional<Error> no_vectors;
  std::vector<Index> row_of_vertex;  ///< V, kNoIndex where in no face
  std::vector<double> mass;          ///< n
  std::vector<Link> links;           ///< of faces: an inner edge stands twice
  Components parts;                  ///< of the rows
  std::unique_ptr<const Directions::State> directions;
  FlippedDirections flipped;
  const Backend* backend = nullptr;
  SymmetricPattern pattern;  ///< of the scalar system
  std::vector<Vec3> places;  ///< of its rows
  SpreadSystem scalar;
  Factors factors;

  Index size() const { return static_cast<Index>(mass.size()); }

  void add_links();
  Result<Factors> factorize(double t) const;
  /// Made by the first call that needs vectors, and kept at the time that was asked for first.
  Result<VectorSystem> vectors(double t, const Progress& progress) const;
  Result<std::vector<Index>> rows_of(std::span<const Index> vertices) const;
  std::vector<char> reached(std::span<const Index> rows) const;

  /// Finds a time with which heat from the rows reaches all of their parts, and its heat.
  Result<Factors> warm(std::span<const Index> rows, std::span<const char> in_reach,
                       std::vector<double>& heat, std::vector<Warning>& warnings,
                       const Progress& progress) const;
  Result<std::vector<double>> spread(const Factors& at, std::span<const Index> rows,
                                     std::span<const double> values,
                                     const Progress& progress) const;

 private:
  Result<std::shared_ptr<const Factorization>> factorize_vectors(const SpreadSystem& system,
                                                                 double t) const;

  mutable std::mutex vector_lock_;
  mutable std::optional<VectorSystem> vector_;
};

}  // namespace geotherm
