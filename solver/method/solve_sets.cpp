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

std::optional<JobFailure> share_out_jobs(std::size_t jobs, int threads, HelperPool& helpers,
                                         const Progress& progress, const Job& job) {
  SharedProgress shared(progress);
  const Progress watch = shared.function();
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::optional<JobFailure> failure;
  const auto fail = [&](std::size_t i, Error error) {
    const std::lock_guard lock(mutex);
    const bool caused = failure && error.code == ErrorCode::kCancelled;
    if (!caused && (!failure || i < failure->job)) failure = {i, std::move(error)};
    shared.stop();
  };
  const auto work = [&](int) noexcept {
    const auto count = static_cast<double>(jobs);
    for (std::size_t i = next++; i < jobs; i = next++) {
      try {
        const auto done = job(
            i, part_of(watch, static_cast<double>(i) / count, static_cast<double>(i + 1) / count));
        if (!done) return fail(i, done.error());
      } catch (const std::bad_alloc&) {
        return fail(i, {ErrorCode::kOutOfMemory, {}});  // words would take memory
      }
    }
  };
  const ThreadCrew crew(threads, &helpers);
  run_calls(threads, threads, work);
  shared.rethrow();
  if (failure && failure->error.message.empty()) throw std::bad_alloc();
  return failure;
}

int SetThreads::at_once(std::size_t sets) const {
  const auto threads = static_cast<std::size_t>(thread_count(most));
  return threads_worth(static_cast<int>(std::clamp(sets, std::size_t{1}, threads)),
                       nanoseconds * static_cast<double>(sets));
}

Result<std::vector<DistanceResult>> solve_sets(std::span<const SourceSet> sets,
                                               const SetThreads& threads, const Progress& progress,
                                               const SolveSet& solve) try {
  const int workers = threads.at_once(sets.size());
  std::vector<DistanceResult> results(sets.size());
  const auto job = [&](std::size_t i, const Progress& part) -> Result<void> {
    auto result = solve(sets[i], part);
    if (!result) return result.error();
    results[i] = *std::move(result);
    return {};
  };
  auto failure = share_out_jobs(sets.size(), workers, threads.helpers, progress, job);
  if (failure) return std::move(failure->error);
  // Threads work side by side: a set's share of the wall clock is that much smaller.
  for (DistanceResult& result : results) {
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
