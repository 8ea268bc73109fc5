// SPDX-License-Identifier: MIT
#include "solver/linear/multifrontal/front_factor.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <vector>

#include "solver/linear/multifrontal/front_tasks.h"

namespace geotherm {
namespace {

/// A front with more operations than this is eliminated by several threads.
constexpr double kLargeFront = 2e7;
constexpr std::int64_t kSlabsAPiece = 6;

class Factorizer {
 public:
  Factorizer(const FrontTree& tree, const LowerMatrix& matrix, int threads, FrontFactor& out,
             const KeptTasks* kept, InstructionSet set)
      : tree_(tree),
        matrix_(matrix),
        kernels_(front_kernels(set)),
        threads_(threads),
        out_(out),
        waiting_(tree.tasks.size()),
        kept_(kept) {}

  FactorFailure run() {
    std::mutex mutex;
    FactorFailure failure;
    const bool takes = kept_ != nullptr && !kept_->unchanged.empty();
    out_.cancellation = takes ? kept_->earlier.factor->cancellation : 0;
    out_.factored = 0;
    for (std::size_t t = 0; t < waiting_.size(); ++t) {
      const FrontTask& task = tree_.tasks[t];
      if (!takes || kept_->unchanged[t] == 0) out_.factored += task.end - task.begin;
    }
    run_tasks(
        tree_, TaskQueue::Direction::kUp, threads_, [this] { return Worker(tree_); },
        [&](const FrontTask& task, Index number, Worker& worker) {
          if (takes && kept_->unchanged[number] != 0) {
            take_over(task, number);
            return true;
          }
          ++active_;
          const FactorFailure ended = run_task(task, number, worker);
          --active_;
          const std::lock_guard lock(mutex);
          out_.cancellation = std::max(out_.cancellation, worker.cancellation);
          if (!ended.failed()) return true;
          if (failure.column == kNoIndex) failure = ended;
          return false;
        });
    if (kept_ != nullptr) out_.updates.assign(waiting_.begin(), waiting_.end());
    return failure;
  }

 private:
  /// What a thread keeps: a panel, and the two stacks of updates of the task at hand.
  struct Worker {
    explicit Worker(const FrontTree& tree)
        : panel(uncleared(tree.largest_panel)),
          stack{uncleared(tree.update_stack[0]), uncleared(tree.update_stack[1])} {}
    Doubles panel, stack[2];
    double* top[2] = {nullptr, nullptr};
    std::vector<Index> held[2];  ///< fronts whose updates wait, on each stack
    std::vector<double> inverses;
    double cancellation = 0;
    std::vector<std::int64_t> panel_row, triangle_row;
  };

  /// The numbers of the earlier factor.
  void take_over(const FrontTask& task, Index number) {
    const FrontTree& before = *kept_->earlier.tree;
    const FrontFactor& factor = *kept_->earlier.factor;
    const std::int64_t bytes = bytes_of(out_.storage);
    std::memcpy(out_.values.data() + tree_.value_start[task.begin] * bytes,
                factor.values.data() + before.value_start[task.begin] * bytes,
                static_cast<std::size_t>(
                    (tree_.value_start[task.end] - tree_.value_start[task.begin]) * bytes));
    waiting_[number] = factor.updates[number];
  }

  FactorFailure run_task(const FrontTask& task, Index number, Worker& worker) {
    for (int k = 0; k < 2; ++k) {
      worker.top[k] = worker.stack[k].get();
      worker.held[k].clear();
    }
    for (Index s = task.begin; s < task.end; ++s) {
      const bool last = s + 1 == task.end && task.parent != kNoIndex;
      const int own = tree_.stack[s];
      const std::int64_t size = triangle_size(slabs(tree_.below(s)));
      double* update = worker.top[own];
      if (last) {
        std::shared_ptr<double[]> kept = uncleared(size);
        update = kept.get();
        waiting_[number] = std::move(kept);
      } else {
        worker.top[own] += size;
        worker.held[own].push_back(s);
      }
      const FrontPanel front{tree_.width(s), tree_.below(s), worker.panel.get()};
      gather(front, s, update);
      take_updates(front, s, update, worker);
      if (s == task.begin) {  // its children, where it has any, are tasks of their own
        for (auto child = task.children.rbegin(); child != task.children.rend(); ++child) {
          extend(front, tree_.tasks[*child].end - 1, waiting_[*child].get(), update, worker);
          if (kept_ == nullptr) waiting_[*child].reset();
        }
      }
      const FactorFailure failure = eliminate(front, s, update, worker);
      if (failure.failed()) return failure;
    }
    return {};
  }

  /// Clears the front and writes the matrix entries of its columns into it.
  void gather(const FrontPanel& front, Index s, double* update) const {
    const std::int64_t rows = slabs(front.width) + slabs(front.below);
    std::fill_n(front.values, rows * front.slab_size(), 0.0);
    std::fill_n(update, triangle_size(slabs(front.below)), 0.0);
    const std::int64_t end = tree_.entry_start[tree_.nodes.first[s + 1]];
    for (std::int64_t e = tree_.entry_start[tree_.nodes.first[s]]; e < end; ++e) {
      front.values[tree_.entry_offset[e]] = matrix_.value[e];
    }
  }

  /// Adds the updates of the children that belong to the same task, the last child first.
  void take_updates(const FrontPanel& front, Index s, double* update, Worker& worker) const {
    const int other = 1 - tree_.stack[s];
    std::vector<Index>& held = worker.held[other];
    while (!held.empty() && tree_.tree.parent[held.back()] == s) {
      const Index child = held.back();
      held.pop_back();
      worker.top[other] -= triangle_size(slabs(tree_.below(child)));
      extend(front, child, worker.top[other], update, worker);
    }
  }

  /// Adds the update of a child where its rows are in this front ("extend-add").
  void extend(const FrontPanel& front, Index child, const double* from, double* update,
              Worker& worker) const {
    const Index count = tree_.below(child);
    const Index* const place = tree_.places_in_parent(child);
    const Index own = padded(front.width);
    worker.panel_row.resize(static_cast<std::size_t>(padded(count)));
    worker.triangle_row.resize(worker.panel_row.size());
    Index columns_in_panel = 0;
    for (Index i = 0; i < count; ++i) {
      worker.panel_row[i] = place[i] / kSlab * front.slab_size() + place[i] % kSlab;
      const Index under = place[i] - own;
      if (under < 0) {
        columns_in_panel = i + 1;
      } else {
        worker.triangle_row[i] = triangle_size(under / kSlab) + under % kSlab;
      }
    }
    for (Index first = 0; first < count; first += kSlab) {
      const Index end = std::min(first + kSlab, count);
      for (Index column = 0; column < end; ++column, from += kSlab) {
        const bool in_panel = column < columns_in_panel;
        const std::int64_t* const row =
            in_panel ? worker.panel_row.data() : worker.triangle_row.data();
        double* const to = (in_panel ? front.values + place[column] * kSlab
                                     : update + (place[column] - own) * kSlab);
        for (Index i = std::max(first, column); i < end; ++i) to[row[i]] += from[i - first];
      }
      from += (first + kSlab - end) * kSlab;
    }
  }

  /// The largest share of a diagonal entry that elimination took away, as entry over pivot.
  double cancellation(const FrontPanel& front, Index s) const {
    double most = 0;
    for (Index c = 0; c < front.width; ++c) {
      const double root = front.values[c / kSlab * front.slab_size() + c * kSlab + c % kSlab];
      const double entry = matrix_.value[tree_.entry_start[tree_.nodes.first[s] + c]];
      most = std::max(most, entry / (root * root));
    }
    return most;
  }

  FactorFailure eliminate(const FrontPanel& front, Index s, double* update, Worker& worker) const {
    worker.inverses.resize(static_cast<std::size_t>(slabs(front.width)) * kSlab * kSlab);
    double* const inverses = worker.inverses.data();
    const Index failed = kernels_.factor_own(front, inverses);
    if (failed != kNoIndex) return {.column = tree_.nodes.first[s] + failed};
    worker.cancellation = std::max(worker.cancellation, cancellation(front, s));
    const double height = front.width + front.below;
    // No more threads in all than were given: those that have nothing else to do.
    const int idle = std::max(1, threads_ / std::max(1, active_.load()));
    const int threads = front.width * height * height > kLargeFront ? idle : 1;
    const Index below = slabs(front.below);
    parallel_for(threads, below, kSlabsAPiece, [&](std::int64_t begin, std::int64_t end) {
      const FlushDenormals flush;
      kernels_.factor_below(front, inverses, static_cast<Index>(begin), static_cast<Index>(end));
    });
    // Later slabs of a triangle are longer: the pieces alternate.
    const std::int64_t pieces = threads == 1 ? 1 : (below + kSlabsAPiece - 1) / kSlabsAPiece;
    std::atomic<Index> next{0};
    parallel_for(threads, pieces, 1, [&](std::int64_t, std::int64_t) {
      const FlushDenormals flush;
      for (Index k = next++; k < pieces; k = next++) {
        const auto from = static_cast<Index>(below * std::int64_t{k} / pieces);
        const auto to = static_cast<Index>(below * std::int64_t{k + 1} / pieces);
        kernels_.update(front, update, from, to);
      }
    });
    void* const to = out_.values.data() + tree_.value_start[s] * bytes_of(out_.storage);
    if (!kernels_.store(front, inverses, out_.storage, to)) return {.narrow = true};
    return {};
  }

  const FrontTree& tree_;
  const LowerMatrix& matrix_;
  const FrontKernels& kernels_;
  int threads_;
  std::atomic<int> active_{0};  ///< tasks in hand
  FrontFactor& out_;
  std::vector<std::shared_ptr<const double[]>> waiting_;  ///< per task: update of its last front
  const KeptTasks* kept_;                                 ///< null: `waiting_` is not kept
};

/// Whether a task has the fronts of an earlier tree, so that places and sizes are the same.
bool same_fronts(const FrontTree& tree, const FrontTask& task, const FrontTree& before,
                 const FrontTask& old) {
  if (task.begin != old.begin || task.end != old.end) return false;
  for (Index s = task.begin; s < task.end; ++s) {
    if (tree.width(s) != before.width(s) || tree.below(s) != before.below(s)) return false;
  }
  // The parent of the last front may have got other rows.
  return std::equal(tree.place_in_parent.begin() + tree.below_start[task.begin],
                    tree.place_in_parent.begin() + tree.below_start[task.end - 1],
                    before.place_in_parent.begin() + before.below_start[task.begin]);
}

}  // namespace

std::vector<char> find_unchanged(const FrontTree& tree, FactorStorage storage,
                                 const EarlierFronts& earlier) {
  std::vector<char> unchanged;
  if (earlier.factor == nullptr || earlier.factor->updates.size() != tree.tasks.size() ||
      earlier.factor->storage != storage) {
    return unchanged;
  }
  for (std::size_t t = 0; t < tree.tasks.size(); ++t) {
    const FrontTask& task = tree.tasks[t];
    const auto begin = earlier.changed.begin();
    const bool changed =
        std::ranges::any_of(task.children, [&](Index c) { return unchanged[c] == 0; }) ||
        std::any_of(begin + tree.nodes.first[task.begin], begin + tree.nodes.first[task.end],
                    [](char flag) { return flag != 0; }) ||
        !same_fronts(tree, task, *earlier.tree, earlier.tree->tasks[t]);
    unchanged.push_back(changed ? 0 : 1);
  }
  return unchanged;
}

FactorFailure factorize_fronts(const FrontTree& tree, const LowerMatrix& matrix,
                               const FactorOptions& options, FrontFactor& out,
                               const KeptTasks* kept, InstructionSet set) {
  out.storage = options.storage;
  const std::int64_t bytes = tree.value_start.back() * bytes_of(options.storage);
  const auto padding = static_cast<std::size_t>(kStoredPadding * bytes_of(options.storage));
  out.values = LargeBuffer(static_cast<std::size_t>(bytes) + padding, options.memory);
  std::memset(out.values.data() + bytes, 0, padding);
  return Factorizer(tree, matrix, options.threads, out, kept, set).run();
}

std::int64_t front_work_bytes(const FrontTree& tree, int threads) {
  const auto workers = std::min<std::int64_t>(threads, std::ssize(tree.tasks));
  const std::int64_t each = tree.largest_panel + tree.update_stack[0] + tree.update_stack[1];
  return static_cast<std::int64_t>(sizeof(double)) *
         (workers * each + tree.waiting_updates + (workers - 1) * tree.largest_update);
}

}  // namespace geotherm
