// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "solver/linear/backend_registry.h"
#include "solver/linear/multifrontal/fill_order.h"
#include "solver/linear/multifrontal/front_factor.h"
#include "solver/linear/triangular_factor.h"

namespace geotherm {
namespace {

constexpr const char* kNativeName = "native";

class NativeFactor final : public TriangularFactor {
 public:
  NativeFactor(std::shared_ptr<const FrontTree> tree, FrontFactor factor)
      : tree_(std::move(tree)), factor_(std::move(factor)) {}

  const EliminationTree& tree() const override { return tree_->tree; }
  const FrontTree& fronts() const { return *tree_; }
  const FrontFactor& numbers() const { return factor_; }
  Index size() const override { return tree_->size(); }
  FactorStats stats() const override {
    const std::int64_t numbers = tree_->value_start.back();
    return {numbers, numbers * bytes_of(factor_.storage),
            static_cast<std::int64_t>(tree_->operations), tree_->count(), factor_.factored};
  }

  void forward(double* x, Eigen::Index stride, int columns, std::span<const Index> nodes,
               int threads) const override {
    const FrontPasses passes(*tree_, factor_, columns);
    if (is_short(nodes)) {
      passes.forward_along(nodes, x, stride);
    } else {
      passes.forward(x, stride, threads, nodes);
    }
  }

  void backward(double* x, Eigen::Index stride, int columns, std::span<const Index> nodes,
                int threads) const override {
    const FrontPasses passes(*tree_, factor_, columns);
    if (is_short(nodes)) {
      passes.backward_along(nodes, x, stride);
    } else {
      passes.backward(x, stride, threads, nodes);
    }
  }

 private:
  /// A pass over fewer numbers of the factor runs on one thread: starting tasks would take longer.
  static constexpr std::int64_t kShort = 1 << 18;

  bool is_short(std::span<const Index> nodes) const {
    std::int64_t values = nodes.empty() ? kShort : 0;
    for (const Index s : nodes) values += tree_->value_start[s + 1] - tree_->value_start[s];
    return values < kShort;
  }

  std::shared_ptr<const FrontTree> tree_;
  FrontFactor factor_;
};

Error out_of_memory(const std::string& what, Index size) {
  return {ErrorCode::kOutOfMemory,
          what + " for a matrix of size " + std::to_string(size),
          {"try ", SettingHint{"backend", {"cg"}}, ", which needs no factor"},
          kNativeName};
}

/// What a factorisation can take over; nothing where the earlier factor is none of this backend.
KeptTasks kept_of(const EarlierFactor& earlier, const FrontTree& tree, FactorStorage storage) {
  const TriangularFactor* const factor =
      earlier.factor != nullptr ? triangular_factor_of(*earlier.factor) : nullptr;
  const auto* const native = dynamic_cast<const NativeFactor*>(factor);
  if (native == nullptr) return {{nullptr, nullptr, earlier.changed}, {}};
  const EarlierFronts fronts{&native->fronts(), &native->numbers(), earlier.changed};
  return {fronts, find_unchanged(tree, storage, fronts)};
}

/// A flag for each column whose numbers are not taken over; empty where none are.
std::vector<char> columns_to_factorize(const FrontTree& tree, const KeptTasks& kept) {
  std::vector<char> wanted(kept.unchanged.empty() ? 0 : static_cast<std::size_t>(tree.size()), 1);
  for (std::size_t t = 0; t < kept.unchanged.size(); ++t) {
    const FrontTask& task = tree.tasks[t];
    std::fill(wanted.begin() + tree.nodes.first[task.begin],
              wanted.begin() + tree.nodes.first[task.end], kept.unchanged[t] == 0 ? 1 : 0);
  }
  return wanted;
}

class NativeAnalysis final : public Analysis {
 public:
  NativeAnalysis(std::vector<Index> order, std::uint64_t pattern,
                 std::shared_ptr<const FrontTree> tree, int threads)
      : order_(std::move(order)), pattern_(pattern), tree_(std::move(tree)), threads_(threads) {}

  /// `order`: that of `eliminated`, a pattern or its lower triangle, of which `tree` was built.
  template <class Pattern>
  static Result<std::shared_ptr<const Analysis>> make(std::vector<Index> order,
                                                      const Pattern& eliminated, FrontTree tree,
                                                      int threads) {
    if (tree.largest_panel > std::numeric_limits<Index>::max()) {
      return out_of_memory(
          "would need a front of " + std::to_string(tree.largest_panel) + " numbers",
          static_cast<Index>(order.size()));
    }
    const std::uint64_t hash = pattern_hash(eliminated, threads);
    return std::shared_ptr<const Analysis>(std::make_shared<NativeAnalysis>(
        std::move(order), hash, std::make_shared<const FrontTree>(std::move(tree)), threads));
  }

  std::span<const Index> order() const override { return order_; }
  std::int64_t factor_bytes(FactorStorage storage) const override {
    return tree_->value_start.back() * bytes_of(storage_for(storage));
  }
  std::int64_t work_bytes() const override {
    // The matrix, and half of what an operator on faces puts it together from: measured, the heap
    // uses the memory of the other half again.
    constexpr std::int64_t kWeightBytes = 6;
    constexpr std::int64_t kEntryBytes = sizeof(double) + sizeof(Index) + kWeightBytes;
    return kEntryBytes * tree_->entry_start.back() + front_work_bytes(*tree_, (threads_ + 1) / 2);
  }

  const EliminationTree* tree() const override { return &tree_->tree; }

  Result<std::shared_ptr<const Analysis>> follow(const NodeOrder& order,
                                                 const SymmetricPattern& eliminated,
                                                 int threads) const override try {
    return make(order.order, eliminated, build_front_tree(eliminated, order, threads, tree_.get()),
                threads);
  } catch (const std::bad_alloc&) {
    return out_of_memory("ran out of memory in the analysis", eliminated.size());
  }

  Result<std::shared_ptr<const Analysis>> update(const NodeOrder& order, const LowerPattern& lower,
                                                 const EarlierRows& rows,
                                                 int threads) const override try {
    return make(order.order, lower, update_front_tree(lower, order, *tree_, rows, threads),
                threads);
  } catch (const std::bad_alloc&) {
    return out_of_memory("ran out of memory in the analysis",
                         static_cast<Index>(order.order.size()));
  }

  Result<std::unique_ptr<Factorization>> factorize(std::shared_ptr<const SymmetricOperator> matrix,
                                                   const FactorOptions& options) const override
      try {
    if (const auto same = check_pattern(*matrix, pattern_, static_cast<Index>(order_.size()));
        !same) {
      return same.error();
    }
    FrontFactor factor;
    FactorOptions kept = options;
    kept.storage = storage_for(options.storage);
    KeptTasks tasks;
    if (options.earlier != nullptr) tasks = kept_of(*options.earlier, *tree_, kept.storage);
    FactorFailure failure =
        factorize_fronts(*tree_, matrix->assembled_where(columns_to_factorize(*tree_, tasks)), kept,
                         factor, options.earlier != nullptr ? &tasks : nullptr);
    const bool unsafe = failure.narrow || factor.cancellation > kMaxCancellation;
    if (kept.storage != FactorStorage::kFull && unsafe && failure.column == kNoIndex) {
      kept.storage = FactorStorage::kFull;
      factor = {};
      failure = factorize_fronts(*tree_, matrix->assembled(), kept, factor);
    }
    if (failure.narrow) {
      return Error{ErrorCode::kNumericalFailure,
                   "numbers of the factor are beyond what a double holds",
                   {"scale the model, or try another backend"},
                   kNativeName};
    }
    if (failure.failed()) {
      return Error{ErrorCode::kNumericalFailure,
                   "the matrix is not positive definite (pivot of column " +
                       std::to_string(failure.column) + " of " + std::to_string(matrix->size()) +
                       ")",
                   {"try another backend"},
                   kNativeName};
    }
    return make_direct_factorization(std::make_unique<NativeFactor>(tree_, std::move(factor)));
  } catch (const std::bad_alloc&) {
    return out_of_memory("ran out of memory in the factorisation", matrix->size());
  }

 private:
  /// Below so many rows the factor stays in the cache whatever its width, and narrow numbers gain
  /// nothing.
  static constexpr Index kNarrowFrom = 20'000;
  /// Good meshes have 2 to 10. Where elimination takes more of a diagonal entry away than all but
  /// this share, weights differ by so many orders that the rounding of narrow numbers would show.
  static constexpr double kMaxCancellation = 64;

  FactorStorage storage_for(FactorStorage asked) const {
    return tree_->size() < kNarrowFrom ? FactorStorage::kFull : asked;
  }

  std::vector<Index> order_;
  std::uint64_t pattern_;
  std::shared_ptr<const FrontTree> tree_;
  int threads_;
};

class NativeBackend final : public Backend {
 public:
  std::string_view name() const override { return kNativeName; }
  std::string_view description() const override {
    return "multifrontal Cholesky made for meshes: nested dissection, narrow factors, all threads";
  }

  Result<std::shared_ptr<const Analysis>> analyze(const SymmetricPattern& pattern,
                                                  std::span<const Vec3> positions,
                                                  int threads) const override try {
    std::vector<Index> order = fill_reducing_order(pattern, positions, threads);
    SymmetricPattern eliminated = permuted(pattern, order, threads);
    // The front tree needs contiguous subtrees, hence a postorder.
    const std::vector<Index> post = postorder(elimination_parents(eliminated));
    std::vector<Index> final_order(order.size());
    for (std::size_t k = 0; k < post.size(); ++k) final_order[k] = order[post[k]];
    eliminated = permuted(eliminated, post, threads);
    return NativeAnalysis::make(std::move(final_order), eliminated,
                                build_front_tree(eliminated, count_columns(eliminated), threads),
                                threads);
  } catch (const std::bad_alloc&) {
    return out_of_memory("ran out of memory in the analysis", pattern.size());
  }
};

}  // namespace

const Backend* native_backend() {
  static const NativeBackend kBackend;
  return &kBackend;
}

}  // namespace geotherm
