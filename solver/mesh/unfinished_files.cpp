// SPDX-License-Identifier: MIT
#include "solver/mesh/unfinished_files.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>

namespace geotherm {
namespace {

enum State : int { kFree, kTaken, kOpening, kOpen };

struct Slot {
  std::atomic<int> state = kFree;
  std::array<char, PATH_MAX> path;
};
static_assert(std::atomic<int>::is_always_lock_free);

std::array<Slot, 32> slots;
std::atomic<bool> closed = false;

/// A slot with the path in it, or -1.
int take_slot(const std::string& path) {
  if (path.size() >= PATH_MAX) return -1;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    int expected = kFree;
    if (!slots[i].state.compare_exchange_strong(expected, kTaken)) continue;
    std::copy_n(path.c_str(), path.size() + 1, slots[i].path.begin());
    return static_cast<int>(i);
  }
  return -1;
}

/// While it lives, signals are handled by other threads: the handler waits for this one.
class NoSignals {
 public:
  NoSignals() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  NoSignals(const NoSignals&) = delete;
  NoSignals& operator=(const NoSignals&) = delete;
  ~NoSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

}  // namespace

UnfinishedFile::UnfinishedFile(const std::string& path) : slot_(take_slot(path)) {
  int code = 0;
  {
    const NoSignals undisturbed;
    if (slot_ >= 0) slots[slot_].state = kOpening;
    // Set before the handler looks at the slots: it sees kOpening, or nothing is opened here.
    if (closed) {
      code = EINTR;
    } else {
      descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      code = errno;
    }
    if (slot_ >= 0) slots[slot_].state = descriptor_ >= 0 ? kOpen : kTaken;
  }
  errno = code;
}

UnfinishedFile::~UnfinishedFile() {
  if (slot_ >= 0) slots[slot_].state = kFree;
}

void remove_unfinished_files() noexcept {
  constexpr int kMaxWaits = 1000, kMilliseconds = 1;
  closed = true;
  for (Slot& slot : slots) {
    for (int i = 0; slot.state == kOpening && i < kMaxWaits; ++i) {
      ::poll(nullptr, 0, kMilliseconds);
    }
    if (slot.state == kOpen) ::unlink(slot.path.data());
  }
}

}  // namespace geotherm
