// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <mutex>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "geotherm/progress.h"
#include "solver/core/threads.h"

namespace geotherm {

/// The number of threads meant by an option: 0 or less means all cores.
inline int thread_count(int requested) {
  if (requested > 0) return requested;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Errors: kBadInput, a negative number where threads are counted.
inline Result<void> check_threads(int requested) {
  if (requested >= 0) return {};
  return Error{ErrorCode::kBadInput,
               "the number of threads is " + std::to_string(requested),
               {"give 0 for all cores, or more"}};
}

/// A thread that runs `work`. Where the system has none left it is not joinable, and `work` does
/// not run. Throws std::bad_alloc.
template <class Work>
std::jthread try_thread(Work&& work) {
  try {
    return std::jthread(std::forward<Work>(work));
  } catch (const std::system_error&) {
    return {};
  }
}

/// How many of up to `most` threads are worth having for work that takes one about `nanoseconds`:
/// each gets `least`, and one has all that is less than twice that. Helpers that sleep pay from
/// 1.5 ms of work each: less is gained than waking them and their cold caches cost.
inline int threads_worth(int most, double nanoseconds, double least = 1.5e6) {
  return static_cast<int>(std::clamp(nanoseconds / least, 1.0, std::max(1.0, double(most))));
}

/// The same where threads have to be started first. Beside busy processes a new thread runs for the
/// first time after milliseconds, and its end is waited for.
inline int threads_worth_starting(int most, double nanoseconds) {
  return threads_worth(most, nanoseconds, 1e7);
}

/// How many pieces a range is best cut into for `threads`: none shorter than `grain`.
inline int piece_count(int threads, std::int64_t count, std::int64_t grain) {
  return static_cast<int>(
      std::clamp<std::int64_t>(count / std::max<std::int64_t>(grain, 1), 1, std::max(threads, 1)));
}

/// Calls work(k, team) for all k in [0, calls), 0 on this thread and the others on whichever of up
/// to `threads` threads is free first, those of the crew where this thread has one. `work` may have
/// more made (HelperThreads::call_more), and must not throw. Throws std::bad_alloc.
template <class Work>
void run_team(int threads, int calls, Work&& work) {
  const auto call = [](void* context, int k, HelperThreads& team) {
    (*static_cast<std::remove_reference_t<Work>*>(context))(k, team);
  };
  ThreadCrew::run(threads, calls, &work, call);
}

/// Calls work(k) for all k in [0, calls) on up to `threads` threads, in the same way.
template <class Work>
void run_calls(int threads, int calls, Work&& work) {
  if (threads > 1 && calls > 1) {
    return run_team(threads, calls, [&work](int k, HelperThreads&) noexcept { work(k); });
  }
  for (int k = 0; k < calls; ++k) work(k);
}

/// Runs both functions, where `threads` > 1 and the system has a second thread at the same time.
/// Exceptions are rethrown after both have ended.
template <class First, class Second>
void run_both(int threads, First&& first, Second&& second) {
  if (threads <= 1) {
    first();
    second();
    return;
  }
  std::exception_ptr failure[2];
  run_calls(threads, 2, [&](int k) noexcept {
    try {
      if (k == 0) {
        second();
      } else {
        first();
      }
    } catch (...) {
      failure[k] = std::current_exception();
    }
  });
  for (int k : {1, 0}) {
    if (failure[k]) std::rethrow_exception(failure[k]);
  }
}

/// Calls body(begin, end) on contiguous pieces of [0, count), on as many threads as get `grain`
/// each. There are a few times more pieces than threads: whoever is held up delays no more than
/// one. The body must give the same result however the range is cut. An exception of the body's is
/// rethrown after all pieces have ended, the first piece's where there are several. Throws
/// std::bad_alloc.
template <class Body>
void parallel_for(int threads, std::int64_t count, std::int64_t grain, Body&& body) {
  constexpr std::int64_t kPiecesOfThread = 4;
  threads = piece_count(threads, count, grain);
  if (threads == 1) {
    body(std::int64_t{0}, count);
    return;
  }
  const int pieces = static_cast<int>(std::min(threads * kPiecesOfThread, count));
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(pieces));
  run_calls(threads, pieces, [&](int piece) noexcept {
    try {
      body(count * piece / pieces, count * (piece + 1) / pieces);
    } catch (...) {
      failures[static_cast<std::size_t>(piece)] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

/// Calls body(i) for all i in [0, count), an `I` each, in the same way.
template <class I = std::int64_t, class Body>
void parallel_each(int threads, std::int64_t count, std::int64_t grain, Body&& body) {
  parallel_for(threads, count, grain, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<I>(begin); i < static_cast<I>(end); ++i) body(i);
  });
}

/// Calls body(piece, begin, end) on the pieces of [0, count) cut into `pieces`, on as many threads:
/// for work in several passes over the same pieces. As parallel_for() otherwise.
template <class Body>
void for_pieces(int pieces, std::int64_t count, Body&& body) {
  parallel_each(pieces, pieces, 1, [&](std::int64_t p) {
    body(static_cast<int>(p), count * p / pieces, count * (p + 1) / pieces);
  });
}

/// part(begin, end) of each block of a fixed length that [0, count) is cut into, to be added in
/// this order: the same bits with any number of threads. Exceptions as of parallel_for().
template <class Sum, class Part>
std::vector<Sum> sums_of_blocks(int threads, std::int64_t count, Part&& part) {
  constexpr std::int64_t kBlock = 8192;
  const std::int64_t blocks = (count + kBlock - 1) / kBlock;
  std::vector<Sum> sums(static_cast<std::size_t>(blocks));
  parallel_each(threads, blocks, 2, [&](std::int64_t b) {
    sums[static_cast<std::size_t>(b)] = part(b * kBlock, std::min(count, (b + 1) * kBlock));
  });
  return sums;
}

/// What part(begin, end, list) appends on each block of `grain` that [0, count) is cut into, in
/// this order. Exceptions as of parallel_for().
template <class T, class Part>
std::vector<T> list_in_parallel(int threads, std::int64_t count, std::int64_t grain, Part&& part) {
  std::vector<std::vector<T>> lists(static_cast<std::size_t>((count + grain - 1) / grain));
  parallel_each(threads, std::ssize(lists), 1, [&](std::int64_t b) {
    part(b * grain, std::min(count, (b + 1) * grain), lists[static_cast<std::size_t>(b)]);
  });
  std::vector<T> all;
  for (const std::vector<T>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

/// The sum of part(begin, end) over such blocks.
template <class Part>
double parallel_sum(int threads, std::int64_t count, Part&& part) {
  double total = 0;
  for (const double sum : sums_of_blocks<double>(threads, count, part)) total += sum;
  return total;
}

/// A progress for work on several threads: passes calls on one at a time, with shares that never
/// fall, and none after the first that said stop or threw. An exception does not pass through the
/// work, whose threads could not hand it on: it is kept for rethrow().
class SharedProgress {
 public:
  /// Keeps a reference.
  explicit SharedProgress(const Progress& progress) : progress_(progress) {}
  explicit SharedProgress(Progress&& progress) = delete;

  bool operator()(std::string_view stage, double share) {
    const std::lock_guard lock(mutex_);
    if (stopped_) return false;
    if (share >= 0) share = most_ = std::max(most_, share);
    try {
      stopped_ = !report(progress_, stage, share);
    } catch (...) {
      thrown_ = std::current_exception();
      stopped_ = true;
    }
    return !stopped_;
  }

  /// Makes every later call say stop.
  void stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }

  /// Throws what the progress has thrown. To be called once the work has ended.
  void rethrow() {
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  }

  /// Valid while this object lives.
  Progress function() {
    return [this](std::string_view stage, double share) { return (*this)(stage, share); };
  }

 private:
  const Progress& progress_;
  std::mutex mutex_;
  double most_ = 0;
  bool stopped_ = false;
  std::exception_ptr thrown_;
};

}  // namespace geotherm
