// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <thread>

namespace geotherm {

/// Watches for done() for as long as it takes to wake a thread that sleeps, some 50 us, and gives
/// the processor away to whoever needs it meanwhile. Whether it is done.
template <class Done>
bool watch_for(const Done& done) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::microseconds kWatch{50};
  constexpr int kLooks = 32;
  const auto end = Clock::now() + kWatch;
  do {
    for (int look = 0; look < kLooks; ++look) {
      if (done()) return true;
#if defined(__x86_64__) || defined(__i386__)
      __builtin_ia32_pause();
#endif
    }
    std::this_thread::yield();
  } while (Clock::now() < end);
  return done();
}

}  // namespace geotherm
