// SPDX-License-Identifier: MIT
#include "solver/core/thread_crew.h"

#include <algorithm>
#include <system_error>

#include "solver/core/spin.h"

namespace geotherm {
namespace {

thread_local ThreadCrew* crew_of_thread = nullptr;

/// Returns when `value` is no longer `old`.
template <class T>
void wait_for_change(const std::atomic<T>& value, T old) {
  if (!watch_for([&] { return value.load(std::memory_order_acquire) != old; })) value.wait(old);
}

}  // namespace

ThreadCrew::ThreadCrew(int threads) : threads_(std::max(1, threads)), before_(crew_of_thread) {
  crew_of_thread = this;
}

ThreadCrew::~ThreadCrew() {
  crew_of_thread = before_;
  ends_ = true;
  ++pass_;
  pass_.notify_all();
}

bool ThreadCrew::run(int count, void* context, Work work) {
  ThreadCrew* const crew = crew_of_thread;
  if (crew == nullptr || crew->in_pass_) return false;
  crew->run_pass(count, context, work);
  return true;
}

void ThreadCrew::start_helpers() {
  helpers_.reserve(static_cast<std::size_t>(threads_ - 1));
  try {
    for (int k = 1; k < threads_; ++k) helpers_.emplace_back([this, k] { help(k); });
  } catch (const std::system_error&) {  // the system has no more: those there are have to do
  }
}

void ThreadCrew::run_pass(int count, void* context, Work work) {
  if (helpers_.empty()) start_helpers();
  in_pass_ = true;
  context_ = context;
  work_ = work;
  shared_ = std::min(count - 1, static_cast<int>(helpers_.size()));
  at_work_.store(static_cast<int>(helpers_.size()), std::memory_order_relaxed);
  pass_.fetch_add(1, std::memory_order_release);
  pass_.notify_all();
  work(context, 0);
  for (int k = shared_ + 1; k < count; ++k) work(context, k);
  for (int left = at_work_; left > 0; left = at_work_) wait_for_change(at_work_, left);
  in_pass_ = false;
}

void ThreadCrew::help(int k) {
  for (unsigned seen = 0;;) {
    wait_for_change(pass_, seen);
    seen = pass_.load(std::memory_order_acquire);
    if (ends_) return;
    if (k <= shared_) work_(context_, k);
    if (at_work_.fetch_sub(1, std::memory_order_acq_rel) == 1) at_work_.notify_one();
  }
}

}  // namespace geotherm
