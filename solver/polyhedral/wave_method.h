// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "geotherm/polyhedral_methods.h"
#include "solver/method/solve_sets.h"
#include "solver/polyhedral/wave_surface.h"

// What wavefronts, fast marching and windows have in common.
namespace geotherm {

/// What a method keeps.
struct WaveMethod::State {
  /// `nanoseconds`: that a query takes at least for each face.
  State(std::shared_ptr<const WaveSurface> waves, int thread_limit, double nanoseconds)
      : surface(std::move(waves)), threads{thread_limit, nanoseconds * surface->face_count()} {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  virtual ~State() = default;

  virtual MethodKind kind() const = 0;
  virtual double bytes() const = 0;  ///< of tables
  /// What a bounded reach asks for, in model units; otherwise all vertices, inserted ones last, in
  /// units of the intrinsic mesh. `at_once`: so many sets are solved side by side.
  virtual Result<DistanceResult> answer(const SourceSeeds& seeds, const QueryOptions& query,
                                        int at_once, const Progress& progress) const = 0;
  /// A whole query.
  Result<DistanceResult> solve(const SourceSet& sources, const QueryOptions& query, int at_once,
                               const Progress& progress) const;

  std::shared_ptr<const WaveSurface> surface;
  SetThreads threads;
  SetupTiming timing;
};

/// A vertex that a query came to, in model units.
struct ReachedVertex {
  Index vertex;
  double distance;  ///< kUnreached where it is not known to be the least
  Index label;      ///< where nearest sources are asked for
};

/// What is within reach, of the targets in the order in which they are asked for, or of others in
/// any order. Cost: that of these, and where the answer is neither sparse nor of targets one pass
/// over the vertices.
DistanceResult answer_within(std::vector<ReachedVertex> reached, Index vertices,
                             const QueryOptions& query);

/// Work memory that is kept between queries, each of which has one alone. Grows to one for each
/// thread.
template <class Work>
class WorkPool {
 public:
  /// One that is free, rather one that `fits`; null where none is.
  template <class Fits>
  std::unique_ptr<Work> take(const Fits& fits) {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return nullptr;
    const auto found = std::ranges::find_if(free_, [&](const auto& work) { return fits(*work); });
    std::swap(found == free_.end() ? free_.back() : *found, free_.back());
    auto work = std::move(free_.back());
    free_.pop_back();
    return work;
  }
  void give(std::unique_ptr<Work> work) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(work));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Work>> free_;
};

}  // namespace geotherm
