// SPDX-License-Identifier: MIT
#include "solver/core/thread_crew.h"

#include <algorithm>
#include <utility>

namespace geotherm {
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
