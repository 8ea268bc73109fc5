// SPDX-License-Identifier: MIT
#include "app/session/session_state.h"

#include <sys/resource.h>

#include <chrono>
#include <utility>

#include "solver/core/memory.h"

namespace geotherm::app {
namespace {

/// A worker that has rested for so long gives the system what its jobs have freed: methods that
/// come and go leave holes, 40 to 150 MB on 200,000 faces. That takes milliseconds.
constexpr std::chrono::seconds kRest{1};

/// Frames come first. On Linux this is for the calling thread and those that it starts.
void give_way() {
  constexpr int kNice = 3;  // half the share of a thread that is not nice
  [[maybe_unused]] const int done = ::setpriority(PRIO_PROCESS, 0, kNice);
}

}  // namespace

Worker::Worker(std::function<void()> changed)
    : changed_(std::move(changed)), thread_([this](const std::stop_token& stop) {
        give_way();
        work(stop);
      }) {}

Worker::~Worker() {
  cancel();
  thread_.request_stop();
  thread_.join();
}

void Worker::start(Job job, bool cancel_running) {
  {
    const std::lock_guard lock(mutex_);
    waiting_ = std::move(job);
    if (running_ && cancel_running) cancelled_ = true;
  }
  work_there_.notify_one();
}

bool Worker::cancel() {
  const std::lock_guard lock(mutex_);
  if (running_) cancelled_ = true;
  return std::exchange(waiting_, nullptr) != nullptr;
}

void Worker::wait() {
  std::unique_lock lock(mutex_);
  idle_.wait(lock, [this] { return !running_ && !waiting_; });
}

Worker::Status Worker::status() const {
  const std::lock_guard lock(mutex_);
  return {running_ || waiting_ != nullptr, stage_, share_};
}

bool Worker::take_progress(std::string_view stage, double share) {
  bool goes_on = true, new_stage = false;
  {
    const std::lock_guard lock(mutex_);
    goes_on = !cancelled_;
    new_stage = stage_ != stage;
    stage_ = stage;
    share_ = share;
  }
  if (new_stage) changed_();
  return goes_on;
}

void Worker::work(const std::stop_token& stop) {
  const auto is_there = [this] { return waiting_ != nullptr; };
  bool kept = false;  // what the last job freed
  for (;;) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      if (kept && !work_there_.wait_for(lock, stop, kRest, is_there)) {
        lock.unlock();
        if (!stop.stop_requested()) release_freed_memory();
        lock.lock();
      }
      kept = true;
      if (!work_there_.wait(lock, stop, is_there)) return;
      job = std::exchange(waiting_, nullptr);
      running_ = true;
      cancelled_ = false;
      stage_.clear();
      share_ = -1;
    }
    job([this](std::string_view stage, double share) { return take_progress(stage, share); });
    job = nullptr;
    {
      const std::lock_guard lock(mutex_);
      running_ = false;
    }
    idle_.notify_all();
    changed_();
  }
}

}  // namespace geotherm::app
