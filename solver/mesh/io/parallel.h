// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

namespace geotherm::io {

/// Calls work(i) for every i below `count` on all cores, each i once. The first exception (by
/// thread, not by i) is thrown again here, after all work has ended.
template <class Work>
void for_each_parallel(std::size_t count, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto run = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::future<void>> helpers;
  try {
    while (helpers.size() + 1 < std::min(cores, count)) {
      helpers.push_back(std::async(std::launch::async, run));
    }
  } catch (const std::system_error&) {
    // No more threads to be had: those there are do the work.
  }
  run();
  for (std::future<void>& helper : helpers) helper.get();
}

}  // namespace geotherm::io
