// SPDX-License-Identifier: MIT
#include "solver/core/thread_crew.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "solver/core/spin.h"

namespace geotherm {
namespace {

thread_local ThreadCrew* crew_of_thread = nullptr;

/// Returns when `value` is no longer `old`.
template <class T>
void wait_for_change(const std::atomic<T>& value, T old) {
  const auto changed = [&] { return value.load(std::memory_order_acquire) != old; };
  if (!watch_for(changed)) value.wait(old, std::memory_order_acquire);
}

}  // namespace

ThreadCrew::ThreadCrew(int threads) : threads_(std::max(1, threads)), before_(crew_of_thread) {
  crew_of_thread = this;
}

ThreadCrew::~ThreadCrew() {
  crew_of_thread = before_;
  ends_ = true;
  for (const auto& helper : helpers_) {
    ++helper->passes;
    helper->passes.notify_one();
  }
}

bool ThreadCrew::run(int count, void* context, Work work) {
  ThreadCrew* const crew = crew_of_thread;
  if (crew == nullptr || crew->in_pass_) return false;
  crew->run_pass(count, context, work);
  return true;
}

void ThreadCrew::start_helpers(int count) {
  helpers_.reserve(static_cast<std::size_t>(threads_ - 1));
  try {
    while (static_cast<int>(helpers_.size()) < count) {
      auto helper = std::make_unique<Helper>();
      const int k = static_cast<int>(helpers_.size()) + 1;
      helper->thread = std::jthread([this, k, at = helper.get()] { help(k, *at); });
      helpers_.push_back(std::move(helper));
    }
  } catch (const std::system_error&) {
    no_more_ = true;  // those there are have to do
  }
}

void ThreadCrew::run_pass(int count, void* context, Work work) {
  const int wanted = std::min(count, threads_) - 1;
  if (static_cast<int>(helpers_.size()) < wanted && !no_more_) start_helpers(wanted);
  const int called = std::min(wanted, static_cast<int>(helpers_.size()));
  in_pass_ = true;
  context_ = context;
  work_ = work;
  at_work_.store(called, std::memory_order_relaxed);
  for (int k = 0; k < called; ++k) {
    Helper& helper = *helpers_[static_cast<std::size_t>(k)];
    helper.passes.fetch_add(1, std::memory_order_release);
    helper.passes.notify_one();
  }
  work(context, 0);
  for (int k = called + 1; k < count; ++k) work(context, k);
  for (int left = at_work_; left > 0; left = at_work_) wait_for_change(at_work_, left);
  in_pass_ = false;
}

void ThreadCrew::help(int k, Helper& helper) {
  for (unsigned seen = 0;; ++seen) {
    wait_for_change(helper.passes, seen);
    if (ends_) return;
    work_(context_, k);
    if (at_work_.fetch_sub(1, std::memory_order_acq_rel) == 1) at_work_.notify_one();
  }
}

}  // namespace geotherm
