// SPDX-License-Identifier: MIT
#include "solver/core/threads.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace geotherm {
namespace {

/// In HelperThreads::state_: a helper inside the pass, and the bits that count calls to be claimed.
constexpr std::uint64_t kInside = std::uint64_t{1} << 32;
constexpr std::uint64_t kUnclaimed = kInside - 1;

/// Watches for done() for about twice as long as it takes to wake a thread that sleeps. Whether it
/// is done.
template <class Done>
bool watch_for(const Done& done) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::microseconds kWatch{20};
  constexpr int kLooks = 32;
  const auto end = Clock::now() + kWatch;
  do {
    for (int look = 0; look < kLooks; ++look) {
      if (done()) return true;
#if defined(__x86_64__) || defined(__i386__)
      __builtin_ia32_pause();
#endif
    }
  } while (Clock::now() < end);
  return done();
}

}  // namespace

HelperThreads::~HelperThreads() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  work_there_.notify_all();
}

bool HelperThreads::is_open() const { return (state_.load() & kUnclaimed) != 0; }

/// Claims a call and adds to the state with the same stroke.
bool HelperThreads::claim(std::uint64_t and_add) {
  std::uint64_t state = state_.load();
  while ((state & kUnclaimed) != 0) {
    if (state_.compare_exchange_weak(state, state - 1 + and_add)) return true;
  }
  return false;
}

void HelperThreads::start(int count) {
  std::vector<std::unique_ptr<Helper>> ended;
  {
    const std::lock_guard lock(mutex_);
    for (auto& helper : helpers_) {
      if (helper->ended) ended.push_back(std::move(helper));
    }
  }
  std::erase(helpers_, nullptr);
  ended.clear();  // joins them, without the lock
  try {
    while (static_cast<int>(helpers_.size()) < count) {
      auto helper = std::make_unique<Helper>();
      helpers_.reserve(helpers_.size() + 1);
      helper->thread = std::jthread([this, at = helper.get()] { help(*at); });
      helpers_.push_back(std::move(helper));
    }
  } catch (const std::system_error&) {
    // The system has no more threads: those there are have to do.
  }
}

int HelperThreads::alive() {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(
      std::ranges::count_if(helpers_, [](const auto& helper) { return !helper->ended; }));
}

void HelperThreads::wake(int count) {
  count = std::min(count, sleepers_.load());
  if (count <= 0) return;
  { const std::lock_guard lock(mutex_); }  // who is about to sleep has looked, or sleeps
  for (; count > 0; --count) work_there_.notify_one();
}

void HelperThreads::run(int calls, int helpers, void* context, Work work) {
  helpers = std::min(helpers, calls - 1);
  start(helpers);
  context_ = context;
  work_ = work;
  next_ = 1;
  state_ = static_cast<std::uint64_t>(calls - 1);
  wake(helpers);
  work(context, 0, *this);
  do {
    work_on();
    wait_for_others();
  } while (state_.load() != 0);
}

void HelperThreads::work_on() {
  while (claim(0)) work_(context_, next_++, *this);
}

/// Waits until no helper is at work, or one has called for more.
void HelperThreads::wait_for_others() {
  const auto over = [this] {
    const std::uint64_t state = state_.load();
    return state == 0 || (state & kUnclaimed) != 0;
  };
  if (watch_for(over)) return;
  std::unique_lock lock(mutex_);
  owner_sleeps_ = true;
  all_done_.wait(lock, over);
  owner_sleeps_ = false;
}

void HelperThreads::call_more(int calls) {
  if (calls <= 0) return;
  state_ += static_cast<std::uint64_t>(calls);
  if (owner_sleeps_) {
    { const std::lock_guard lock(mutex_); }
    all_done_.notify_one();
    --calls;
  }
  wake(calls);
}

void HelperThreads::help(Helper& helper) {
  for (;;) {
    if (claim(kInside)) {
      // The owner stays in the pass while a helper is inside.
      work_(context_, next_++, *this);
      work_on();
      state_ -= kInside;
      if (owner_sleeps_) {
        { const std::lock_guard lock(mutex_); }
        all_done_.notify_one();
      }
    }
    if (ends_) return;
    if (!watch_for([this] { return is_open() || ends_; }) && !sleep(helper)) return;
  }
}

/// False when nothing came for so long that the thread may end.
bool HelperThreads::sleep(Helper& helper) {
  std::unique_lock lock(mutex_);
  ++sleepers_;
  const bool called = work_there_.wait_for(lock, patience_, [this] { return is_open() || ends_; });
  --sleepers_;
  helper.ended = !called;
  return called;
}

namespace {

thread_local ThreadCrew* crew_of_thread = nullptr;

}  // namespace

ThreadCrew::ThreadCrew(int threads, HelperPool* pool)
    : threads_(std::max(1, threads)), pool_(pool), before_(std::exchange(crew_of_thread, this)) {}

ThreadCrew::~ThreadCrew() {
  crew_of_thread = before_;
  if (pool_ != nullptr && helpers_ != nullptr) pool_->give(std::move(helpers_));
}

void ThreadCrew::run(int threads, int calls, void* context, HelperThreads::Work work) {
  ThreadCrew* const crew = crew_of_thread;
  if (crew != nullptr && !crew->in_pass_) return crew->run_pass(threads, calls, context, work);
  HelperThreads().run(calls, threads - 1, context, work);
}

void ThreadCrew::run_pass(int threads, int calls, void* context, HelperThreads::Work work) {
  if (helpers_ == nullptr && pool_ != nullptr) helpers_ = pool_->take();
  if (helpers_ == nullptr) helpers_ = std::make_unique<HelperThreads>();
  in_pass_ = true;
  try {
    helpers_->run(calls, std::min(threads, threads_) - 1, context, work);
  } catch (...) {
    in_pass_ = false;
    throw;
  }
  in_pass_ = false;
}

}  // namespace geotherm
