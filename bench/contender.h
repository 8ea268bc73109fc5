// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/mesh.h"

namespace geotherm::bench {

/// One way to get geodesic distance, as the benchmark drives it: set up once for a mesh, then ask.
class Contender {
 public:
  virtual ~Contender() = default;

  virtual std::string name() const = 0;

  /// Not another method that answers the same question.
  virtual bool heat_method() const { return true; }

  /// Everything between a mesh in memory and the first query ready. Replaces an earlier set-up.
  virtual Result<void> set_up(std::shared_ptr<const TriangleMesh> mesh) = 0;

  /// Frees what set_up() made.
  virtual void drop() = 0;

  /// Distances to one vertex.
  virtual Result<std::vector<double>> query(Index source) = 0;

  /// Distances to each of the sources, by the fastest way there is.
  virtual Result<void> batch(std::span<const Index> sources) = 0;

  /// Memory of all factors, in 2^20 bytes.
  virtual double factor_mb() const = 0;
};

/// geotherm with this backend of the heat method, or with another method, and default options.
/// `threads` 0: all cores.
std::unique_ptr<Contender> make_contender(std::string name, int threads);

/// What the backends are held against; null in a build without CHOLMOD.
std::unique_ptr<Contender> make_baseline_contender();

inline constexpr const char* kBaseline = "baseline";

}  // namespace geotherm::bench
