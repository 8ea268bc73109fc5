// SPDX-License-Identifier: MIT
#include "solver/linear/multifrontal/front_tasks.h"

#include <algorithm>
#include <array>

namespace geotherm {
namespace {

/// A subtree with less than this share of all work is one task: this gives enough tasks for many
/// threads, and few enough that scheduling them costs nothing.
constexpr double kShareOfTask = 1.0 / 64;
/// A factor with fewer entries is one task: solving with it takes as long as waking a thread.
constexpr double kSmallFactor = 50'000;

/// Work of every subtree as a share of the whole: the larger of factorising it and solving with it.
std::vector<double> shares(const FrontTree& tree) {
  std::vector<double> flops(static_cast<std::size_t>(tree.count()));
  std::vector<double> values(flops.size());
  double all_flops = 0, all_values = 0;
  for (Index s = 0; s < tree.count(); ++s) {
    const double width = tree.width(s), height = width + tree.below(s);
    const double own_flops = width * height * height;
    const auto own_values = static_cast<double>(tree.value_start[s + 1] - tree.value_start[s]);
    flops[s] += own_flops;
    values[s] += own_values;
    all_flops += own_flops;
    all_values += own_values;
    const Index p = tree.tree.parent[s];
    if (p == kNoIndex) continue;
    flops[p] += flops[s];
    values[p] += values[s];
  }
  for (std::size_t s = 0; s < flops.size(); ++s) {
    flops[s] =
        all_values < kSmallFactor ? 0.0 : std::max(flops[s] / all_flops, values[s] / all_values);
  }
  return flops;
}

/// How much is held on two stacks, one for even depths and one for odd, while a subtree is walked:
/// a front pushes on its own stack what its parent takes off.
class StackDepth {
 public:
  void push(Index s, int stack, std::int64_t size) {
    held_[stack].push_back({s, size});
    depth_[stack] += size;
    most_[stack] = std::max(most_[stack], depth_[stack]);
  }
  void pop_children(const std::vector<Index>& parent, Index s, int stack) {
    std::vector<Held>& held = held_[stack];
    while (!held.empty() && parent[held.back().front] == s) {
      depth_[stack] -= held.back().size;
      held.pop_back();
    }
  }
  const std::array<std::int64_t, 2>& most() const { return most_; }

 private:
  struct Held {
    Index front;
    std::int64_t size;
  };
  std::array<std::vector<Held>, 2> held_;
  std::array<std::int64_t, 2> depth_{}, most_{};
};

void measure_stacks(FrontTree& tree) {
  for (const FrontTask& task : tree.tasks) {
    StackDepth updates, vectors;
    for (Index s = task.begin; s < task.end; ++s) {
      const int stack = tree.stack[s];
      const bool leaves = s + 1 == task.end && task.parent != kNoIndex;  // waits elsewhere
      updates.push(s, stack, leaves ? 0 : triangle_size(slabs(tree.below(s))));
      vectors.push(s, stack, tree.places(s));
      updates.pop_children(tree.tree.parent, s, 1 - stack);
      vectors.pop_children(tree.tree.parent, s, 1 - stack);
    }
    std::vector<std::int64_t> path(static_cast<std::size_t>(task.end - task.begin));
    for (Index s = task.end; s-- > task.begin;) {
      const Index p = tree.tree.parent[s];
      const bool inside = p != kNoIndex && p < task.end;
      path[s - task.begin] = tree.places(s) + (inside ? path[p - task.begin] : 0);
      tree.vector_path = std::max(tree.vector_path, path[s - task.begin]);
    }
    for (int k = 0; k < 2; ++k) {
      tree.update_stack[k] = std::max(tree.update_stack[k], updates.most()[k]);
      tree.vector_stack[k] = std::max(tree.vector_stack[k], vectors.most()[k]);
    }
  }
}

/// Updates between tasks: those that wait at once when one thread takes the tasks in order, which
/// goes up as soon as it can, and one more for each other thread.
void measure_waiting(FrontTree& tree) {
  std::int64_t waiting = 0;
  const auto update_of = [&tree](const FrontTask& task) {
    return triangle_size(slabs(tree.below(task.end - 1)));
  };
  for (const FrontTask& task : tree.tasks) {
    if (task.parent != kNoIndex) {
      waiting += update_of(task);
      tree.largest_update = std::max(tree.largest_update, update_of(task));
    }
    tree.waiting_updates = std::max(tree.waiting_updates, waiting);
    for (const Index child : task.children) waiting -= update_of(tree.tasks[child]);
  }
}

void divide_by_work(FrontTree& tree) {
  const std::vector<double> share = shares(tree);
  std::vector<Index> task_of(static_cast<std::size_t>(tree.count()), kNoIndex);  // of last fronts
  std::vector<Index> first(static_cast<std::size_t>(tree.count()));              // of each subtree
  for (Index s = 0; s < tree.count(); ++s) first[s] = s;
  for (Index s = 0; s < tree.count(); ++s) {
    const Index p = tree.tree.parent[s];
    if (p != kNoIndex) first[p] = std::min(first[p], first[s]);
  }
  double gathered = 0;  // small trees of their own follow each other in one task
  bool open = false;
  Index begin = 0;
  const auto close = [&](Index end) {
    task_of[end - 1] = static_cast<Index>(tree.tasks.size());
    tree.tasks.push_back({begin, end, kNoIndex, {}});
    begin = end;
    open = false;
    gathered = 0;
  };
  for (Index s = 0; s < tree.count(); ++s) {
    const Index p = tree.tree.parent[s];
    if (share[s] >= kShareOfTask) {
      if (open) close(s);
      close(s + 1);
    } else if (p == kNoIndex) {
      gathered += share[s];
      open = true;
      if (gathered >= kShareOfTask) close(s + 1);
    } else if (share[p] >= kShareOfTask) {
      if (open) close(first[s]);
      close(s + 1);
    }
  }
  if (open) close(tree.count());
  for (Index t = 0; t < static_cast<Index>(tree.tasks.size()); ++t) {
    const Index p = tree.tree.parent[tree.tasks[t].end - 1];
    if (p == kNoIndex) continue;
    tree.tasks[t].parent = task_of[p];
    tree.tasks[task_of[p]].children.push_back(t);
  }
}

}  // namespace

void divide_into_tasks(FrontTree& tree, const FrontTree* earlier) {
  if (earlier != nullptr && earlier->tree.parent == tree.tree.parent) {
    tree.tasks = earlier->tasks;
  } else {
    divide_by_work(tree);
  }
  tree.stack.assign(static_cast<std::size_t>(tree.count()), 0);
  for (Index s = tree.count(); s-- > 0;) {
    const Index p = tree.tree.parent[s];
    tree.stack[s] = p == kNoIndex ? 0 : static_cast<std::uint8_t>(1 - tree.stack[p]);
  }
  measure_stacks(tree);
  measure_waiting(tree);
}

TaskQueue::TaskQueue(const std::vector<FrontTask>& tasks, Direction direction, int threads)
    : tasks_(tasks), direction_(direction), threads_(threads) {
  for (const FrontTask& task : tasks) {
    waits_for_.push_back(direction == Direction::kUp ? static_cast<Index>(task.children.size())
                                                     : Index{task.parent != kNoIndex});
  }
  for (std::size_t t = tasks.size(); t-- > 0;) {
    if (waits_for_[t] == 0) ready_.push_back(static_cast<Index>(t));
  }
}

Index TaskQueue::next(Index done, int& others) {
  const std::lock_guard lock(mutex_);
  others = 0;
  if (done == kNoIndex) {
    if (at_work_ == threads_) return kNoIndex;
    ++at_work_;
  } else {
    const std::size_t before = ready_.size();
    const auto release = [this](Index task) {
      if (--waits_for_[task] == 0) ready_.push_back(task);
    };
    if (direction_ == Direction::kDown) {
      for (const Index child : tasks_[done].children) release(child);
    } else if (tasks_[done].parent != kNoIndex) {
      release(tasks_[done].parent);
    }
    // One of them is for the thread that asks.
    if (ready_.size() > before + 1) {
      others = std::min(threads_ - at_work_, static_cast<int>(ready_.size() - before - 1));
    }
  }
  if (stopped_ || ready_.empty()) {
    --at_work_;
    return kNoIndex;
  }
  const Index task = ready_.back();
  ready_.pop_back();
  return task;
}

void TaskQueue::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
}

}  // namespace geotherm
