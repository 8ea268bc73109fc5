// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/core/thread_crew.h"

namespace geotherm {

/// The number of threads meant by an option: 0 or less means all cores.
inline int thread_count(int requested) {
  if (requested > 0) return requested;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
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

/// Runs both functions, the first on a second thread when `threads` > 1 and the system has one.
/// Exceptions are rethrown after both have ended.
template <class First, class Second>
void run_both(int threads, First&& first, Second&& second) {
  if (threads <= 1) {
    first();
    second();
    return;
  }
  std::exception_ptr failure;
  const auto guarded = [&] {
    try {
      first();
    } catch (...) {
      failure = std::current_exception();
    }
  };
  {
    const std::jthread helper = try_thread(guarded);
    if (!helper.joinable()) guarded();
    second();
  }
  if (failure) std::rethrow_exception(failure);
}

/// How many pieces a range is best cut into for `threads`: none shorter than `grain`.
inline int piece_count(int threads, std::int64_t count, std::int64_t grain) {
  return static_cast<int>(
      std::clamp<std::int64_t>(count / std::max<std::int64_t>(grain, 1), 1, std::max(threads, 1)));
}

/// Calls work(k) for all k in [0, count), 0 on this thread and the others each on one of its own,
/// the crew's where this thread has one; what is left without a thread is done here afterwards.
/// `work` must not throw. Throws std::bad_alloc.
template <class Work>
void run_on_threads(int count, Work&& work) {
  if (count <= 1) return work(0);
  const auto call = [](void* context, int k) {
    (*static_cast<std::remove_reference_t<Work>*>(context))(k);
  };
  if (ThreadCrew::run(count, &work, call)) return;
  std::vector<std::jthread> helpers;
  helpers.reserve(static_cast<std::size_t>(count - 1));
  int begun = 1;
  for (; begun < count; ++begun) {
    auto helper = try_thread([&work, begun] { work(begun); });
    if (!helper.joinable()) break;
    helpers.push_back(std::move(helper));
  }
  work(0);
  for (; begun < count; ++begun) work(begun);
}

/// Calls body(begin, end) on contiguous pieces of [0, count), one a thread, none shorter than
/// `grain`. The body must give the same result however the range is cut. An exception of the
/// body's is rethrown after all pieces have ended, the first piece's where there are several.
/// Throws std::bad_alloc.
template <class Body>
void parallel_for(int threads, std::int64_t count, std::int64_t grain, Body&& body) {
  const int pieces = piece_count(threads, count, grain);
  if (pieces == 1) {
    body(std::int64_t{0}, count);
    return;
  }
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(pieces));
  run_on_threads(pieces, [&](int piece) noexcept {
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

/// Calls body(piece, begin, end) on the pieces of [0, count) cut into `pieces`, one a thread: for
/// work in several passes over the same pieces. As parallel_for() otherwise.
template <class Body>
void for_pieces(int pieces, std::int64_t count, Body&& body) {
  parallel_for(pieces, pieces, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t p = first; p < last; ++p) {
      body(static_cast<int>(p), count * p / pieces, count * (p + 1) / pieces);
    }
  });
}

/// part(begin, end) of each block of a fixed length that [0, count) is cut into, to be added in
/// this order: the same bits with any number of threads. Exceptions as of parallel_for().
template <class Sum, class Part>
std::vector<Sum> sums_of_blocks(int threads, std::int64_t count, Part&& part) {
  constexpr std::int64_t kBlock = 8192;
  const std::int64_t blocks = (count + kBlock - 1) / kBlock;
  std::vector<Sum> sums(static_cast<std::size_t>(blocks));
  parallel_for(threads, blocks, 2, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t b = first; b < last; ++b) {
      sums[static_cast<std::size_t>(b)] = part(b * kBlock, std::min(count, (b + 1) * kBlock));
    }
  });
  return sums;
}

/// The sum of part(begin, end) over such blocks.
template <class Part>
double parallel_sum(int threads, std::int64_t count, Part&& part) {
  double total = 0;
  for (const double sum : sums_of_blocks<double>(threads, count, part)) total += sum;
  return total;
}

}  // namespace geotherm
