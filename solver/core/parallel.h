// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

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

/// Calls body(begin, end) on contiguous pieces of [0, count), one a thread, none shorter than
/// `grain`; what threads the system does not have is done by the caller's. The body must not throw
/// and must give the same result however the range is cut. Throws std::bad_alloc.
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
  std::int64_t begun = 1;
  for (; begun < pieces; ++begun) {
    auto helper = try_thread([&body, begun, pieces, count] {
      body(count * begun / pieces, count * (begun + 1) / pieces);
    });
    if (!helper.joinable()) break;
    helpers.push_back(std::move(helper));
  }
  body(std::int64_t{0}, count / pieces);
  if (begun < pieces) body(count * begun / pieces, count);
}

}  // namespace geotherm
