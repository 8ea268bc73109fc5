// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <thread>
#include <vector>

namespace geotherm {

/// The number of threads meant by an option: 0 or less means all cores.
inline int thread_count(int requested) {
  if (requested > 0) return requested;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Runs both functions, the first on a second thread when `threads` > 1. Exceptions are rethrown
/// after both have ended.
template <class First, class Second>
void run_both(int threads, First&& first, Second&& second) {
  if (threads <= 1) {
    first();
    second();
    return;
  }
  std::exception_ptr failure;
  {
    const std::jthread helper([&] {
      try {
        first();
      } catch (...) {
        failure = std::current_exception();
      }
    });
    second();
  }
  if (failure) std::rethrow_exception(failure);
}

/// Calls body(begin, end) on contiguous pieces of [0, count), one a thread, none shorter than
/// `grain`. The body must not throw and must give the same result however the range is cut.
template <class Body>
void parallel_for(int threads, std::int64_t count, std::int64_t grain, Body&& body) {
  const std::int64_t pieces =
      std::clamp<std::int64_t>(count / std::max<std::int64_t>(grain, 1), 1, std::max(threads, 1));
  if (pieces == 1) {
    body(std::int64_t{0}, count);
    return;
  }
  std::vector<std::jthread> helpers;
  helpers.reserve(static_cast<std::size_t>(pieces - 1));
  for (std::int64_t p = 1; p < pieces; ++p) {
    helpers.emplace_back(
        [&body, p, pieces, count] { body(count * p / pieces, count * (p + 1) / pieces); });
  }
  body(std::int64_t{0}, count / pieces);
}

}  // namespace geotherm
