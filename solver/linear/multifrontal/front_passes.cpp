// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>
#include <vector>

#include "solver/linear/multifrontal/front_factor.h"
#include "solver/linear/multifrontal/front_tasks.h"

namespace geotherm {
namespace {

/// `count` groups of doubles, from one stride to another.
inline void copy_groups(const double* from, std::ptrdiff_t from_stride, int group, Index count,
                        double* to, std::ptrdiff_t to_stride) {
  if (from_stride == group && to_stride == group) {
    std::memcpy(to, from, sizeof(double) * static_cast<std::size_t>(count * std::int64_t{group}));
    return;
  }
  for (; count > 0; --count, from += from_stride, to += to_stride) {
    for (int k = 0; k < group; ++k) to[k] = from[k];
  }
}

/// The vector of a front on a path, which its parent or child still needs.
struct HeldVector {
  Index front;
  Doubles vector;
};

}  // namespace

FrontPasses::FrontPasses(const FrontTree& tree, const FrontFactor& factor, int group,
                         InstructionSet set)
    : tree_(tree),
      factor_(factor),
      group_(group),
      solves_(front_solves(factor.storage, group, set)) {}

/// The steps at one front; y is its vector, with a group at each of its places.
class FrontPasses::Steps {
 public:
  Steps(const FrontPasses& passes, double* x, Eigen::Index stride)
      : p_(passes), tree_(passes.tree_), group_(passes.group_), x_(x), stride_(stride) {}

  std::int64_t vector_size(Index s) const { return std::int64_t{tree_.places(s)} * group_; }
  std::int64_t own_size(Index s) const { return std::int64_t{padded(tree_.width(s))} * group_; }

  /// Forward: copies the right side at the front's own rows, and clears the rows below unless the
  /// front is fresh.
  void start(Index s, double* y, bool fresh) const {
    copy_groups(rows(s), stride_, group_, tree_.width(s), y, group_);
    if (!fresh) std::fill(y + own_size(s), y + vector_size(s), 0.0);
  }

  /// Forward: adds the contribution of a child to the rows of its parent.
  void take(Index child, const double* left, double* y) const {
    p_.solves_.take(left, tree_.places_in_parent(child), tree_.below(child), y);
  }

  void eliminate(Index s, double* y, bool fresh) const {
    p_.solves_.forward(p_.factor_.front(tree_, s), y, fresh);
    store(s, y);
  }

  /// Backward: `above` is the vector of its parent, if it has one.
  void substitute(Index s, const double* above, double* y) const {
    const Index width = tree_.width(s);
    copy_groups(rows(s), stride_, group_, width, y, group_);
    std::fill(y + std::int64_t{width} * group_, y + own_size(s), 0.0);
    p_.solves_.backward(p_.factor_.front(tree_, s), y, above, tree_.places_in_parent(s));
    store(s, y);
  }

 private:
  double* rows(Index s) const { return x_ + tree_.nodes.first[s] * stride_; }
  void store(Index s, const double* y) const {
    copy_groups(y, group_, group_, tree_.width(s), rows(s), stride_);
  }

  const FrontPasses& p_;
  const FrontTree& tree_;
  int group_;
  double* x_;
  Eigen::Index stride_;
};

/// Fronts that a pass visits.
class FrontPasses::Visits {
 public:
  Visits(std::span<const Index> fronts, Index count)
      : flag_(fronts.empty() ? 0 : static_cast<std::size_t>(count), 0) {
    for (const Index s : fronts) flag_[s] = 1;
  }
  bool operator()(Index s) const { return flag_.empty() || flag_[s] != 0; }

 private:
  std::vector<char> flag_;  ///< empty: all
};

/// The forward pass over the fronts of a task: vectors wait on two stacks, as updates do in the
/// factorisation.
class FrontPasses::Upwards {
 public:
  Upwards(const FrontTree& tree, int group, const Steps& steps)
      : tree_(tree),
        steps_(steps),
        stack_{uncleared(tree.vector_stack[0] * group), uncleared(tree.vector_stack[1] * group)} {}

  /// `left`: the contributions of the last fronts of tasks to their parents in other tasks.
  void run(const FrontTask& task, Index number, const Visits& visits, std::vector<Doubles>& left) {
    for (int k = 0; k < 2; ++k) {
      top_[k] = stack_[k].get();
      held_[k].clear();
    }
    for (Index s = task.begin; s < task.end; ++s) {
      if (!visits(s)) continue;
      const int own = tree_.stack[s];
      double* const y = top_[own];
      top_[own] += steps_.vector_size(s);
      const bool fresh = tree_.is_leaf[s] != 0;
      steps_.start(s, y, fresh);
      take_children(s, y);
      if (s == task.begin) {
        for (auto child = task.children.rbegin(); child != task.children.rend(); ++child) {
          if (left[*child] == nullptr) continue;  // not visited
          steps_.take(tree_.tasks[*child].end - 1, left[*child].get(), y);
        }
      }
      steps_.eliminate(s, y, fresh);
      held_[own].push_back(s);
    }
    const Index last = task.end - 1;
    if (task.parent == kNoIndex || !visits(last)) return;
    const std::int64_t size = steps_.vector_size(last) - steps_.own_size(last);
    left[number] = uncleared(size);
    std::copy_n(top_[tree_.stack[last]] - size, size, left[number].get());
  }

 private:
  void take_children(Index s, double* y) {
    const int other = 1 - tree_.stack[s];
    std::vector<Index>& held = held_[other];
    while (!held.empty() && tree_.tree.parent[held.back()] == s) {
      const Index child = held.back();
      held.pop_back();
      top_[other] -= steps_.vector_size(child);
      steps_.take(child, top_[other] + steps_.own_size(child), y);
    }
  }

  const FrontTree& tree_;
  const Steps& steps_;
  Doubles stack_[2];
  double* top_[2] = {nullptr, nullptr};
  std::vector<Index> held_[2];  ///< fronts whose vectors wait, on each stack
};

/// The backward pass over the fronts of a task: the vectors of all fronts above the current one are
/// kept.
class FrontPasses::Downwards {
 public:
  Downwards(const FrontTree& tree, int group, const Steps& steps)
      : tree_(tree), steps_(steps), room_(uncleared(tree.vector_path * group)) {}

  void run(const FrontTask& task, const Visits& visits, const double* above) {
    held_.clear();
    for (Index s = task.end; s-- > task.begin;) {
      if (!visits(s)) continue;
      while (!held_.empty() && held_.back().front != tree_.tree.parent[s]) held_.pop_back();
      double* const y = held_.empty() ? room_.get() : held_.back().end;
      steps_.substitute(s, held_.empty() ? above : held_.back().vector, y);
      held_.push_back({s, y, y + steps_.vector_size(s)});
    }
  }

 private:
  struct Held {
    Index front;
    double *vector, *end;
  };
  const FrontTree& tree_;
  const Steps& steps_;
  Doubles room_;
  std::vector<Held> held_;
};

void FrontPasses::forward(double* x, Eigen::Index stride, int threads,
                          std::span<const Index> fronts) const {
  const Steps steps(*this, x, stride);
  const Visits visits(fronts, tree_.count());
  std::vector<Doubles> left(tree_.tasks.size());
  run_tasks(
      tree_, TaskQueue::Direction::kUp, threads, [&] { return Upwards(tree_, group_, steps); },
      [&](const FrontTask& task, Index number, Upwards& pass) {
        pass.run(task, number, visits, left);
        return true;
      });
}

void FrontPasses::backward(double* x, Eigen::Index stride, int threads,
                           std::span<const Index> fronts) const {
  const Steps steps(*this, x, stride);
  const Visits visits(fronts, tree_.count());
  std::vector<Doubles> kept(tree_.tasks.size());  // vectors of single fronts that others hang on
  run_tasks(
      tree_, TaskQueue::Direction::kDown, threads, [&] { return Downwards(tree_, group_, steps); },
      [&](const FrontTask& task, Index number, Downwards& pass) {
        const double* above = task.parent == kNoIndex ? nullptr : kept[task.parent].get();
        if (task.children.empty()) {
          pass.run(task, visits, above);
        } else if (visits(task.begin)) {
          kept[number] = uncleared(steps.vector_size(task.begin));
          steps.substitute(task.begin, above, kept[number].get());
        }
        return true;
      });
}

void FrontPasses::forward_along(std::span<const Index> fronts, double* x,
                                Eigen::Index stride) const {
  const FlushDenormals flush;
  const Steps steps(*this, x, stride);
  std::vector<HeldVector> held;
  for (const Index s : fronts) {
    Doubles y = uncleared(steps.vector_size(s));
    steps.start(s, y.get(), false);
    for (; !held.empty() && tree_.tree.parent[held.back().front] == s; held.pop_back()) {
      const Index child = held.back().front;
      steps.take(child, held.back().vector.get() + steps.own_size(child), y.get());
    }
    steps.eliminate(s, y.get(), false);
    held.push_back({s, std::move(y)});
  }
}

void FrontPasses::backward_along(std::span<const Index> fronts, double* x,
                                 Eigen::Index stride) const {
  const FlushDenormals flush;
  const Steps steps(*this, x, stride);
  std::vector<HeldVector> held;
  for (auto s = fronts.rbegin(); s != fronts.rend(); ++s) {
    while (!held.empty() && held.back().front != tree_.tree.parent[*s]) held.pop_back();
    Doubles y = uncleared(steps.vector_size(*s));
    steps.substitute(*s, held.empty() ? nullptr : held.back().vector.get(), y.get());
    held.push_back({*s, std::move(y)});
  }
}

}  // namespace geotherm
