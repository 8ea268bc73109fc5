// SPDX-License-Identifier: MIT
#include "solver/method/solve_sets.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <optional>
#include <utility>

#include "solver/core/parallel.h"

namespace geotherm {
namespace {

/// Hands out sets to threads until all are done, one has failed or the work is cancelled.
class SetRunner {
 public:
  SetRunner(std::span<const SourceSet> sets, const Progress& progress, const SolveSet& solve)
      : sets_(sets),
        solve_(solve),
        results_(sets.size()),
        progress_(progress),
        watch_(progress_.function()) {}

  Result<std::vector<DistanceResult>> run(int threads, HelperPool& helpers) {
    const ThreadCrew crew(threads, &helpers);
    run_calls(threads, threads, [this](int) noexcept { work(); });
    progress_.rethrow();
    if (failure_ && failure_->message.empty()) throw std::bad_alloc();
    if (failure_) return *std::move(failure_);
    return std::move(results_);
  }

 private:
  void work() {
    const auto count = static_cast<double>(sets_.size());
    for (std::size_t i = next_++; i < sets_.size(); i = next_++) {
      try {
        const Progress part =
            part_of(watch_, static_cast<double>(i) / count, static_cast<double>(i + 1) / count);
        auto result = solve_(sets_[i], part);
        if (!result) return fail(i, result.error());
        results_[i] = *std::move(result);
      } catch (const std::bad_alloc&) {
        return fail(i, {ErrorCode::kOutOfMemory, {}});  // words would take memory
      }
    }
  }

  /// Keeps the failure of the first set, but for those that the stop itself brought about.
  void fail(std::size_t set, Error error) {
    const std::lock_guard lock(mutex_);
    const bool caused = failure_ && error.code == ErrorCode::kCancelled;
    if (!caused && (!failure_ || set < failed_set_)) {
      failure_ = std::move(error);
      failed_set_ = set;
    }
    progress_.stop();
  }

  std::span<const SourceSet> sets_;
  const SolveSet& solve_;
  std::vector<DistanceResult> results_;
  SharedProgress progress_;
  const Progress watch_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::optional<Error> failure_;
  std::size_t failed_set_ = 0;
};

}  // namespace

int SetThreads::at_once(std::size_t sets) const {
  const auto threads = static_cast<std::size_t>(thread_count(most));
  return threads_worth(static_cast<int>(std::clamp(sets, std::size_t{1}, threads)),
                       nanoseconds * static_cast<double>(sets));
}

Result<std::vector<DistanceResult>> solve_sets(std::span<const SourceSet> sets,
                                               const SetThreads& threads, const Progress& progress,
                                               const SolveSet& solve) try {
  const int workers = threads.at_once(sets.size());
  auto results = SetRunner(sets, progress, solve).run(workers, threads.helpers);
  if (!results) return results;
  // Threads work side by side: a set's share of the wall clock is that much smaller.
  for (DistanceResult& result : *results) {
    for (double* ms : {&result.timing.diffuse, &result.timing.gradient, &result.timing.poisson,
                       &result.timing.query}) {
      *ms /= workers;
    }
  }
  return results;
} catch (const std::bad_alloc&) {
  return Error{
      ErrorCode::kOutOfMemory, "the memory ended in a query", {"take a mesh with fewer faces"}};
}

}  // namespace geotherm
