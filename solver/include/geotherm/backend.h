// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/progress.h"
#include "geotherm/types.h"

// The linear layer: what solves the sparse symmetric systems of the heat method. A Backend analyses
// a pattern, the Analysis factorises matrices that have it, a Factorization solves with one of
// them. All three are immutable. docs/adding_a_backend.md leads through a backend of one's own.
namespace geotherm {

// Types that only the library's own backends use: memory of earlier factors, the tree that says
// which columns of a factor change which, an order that follows such a tree, and how rows stood
// earlier.
class BufferPool;
struct EliminationTree;
struct NodeOrder;
struct EarlierRows;

/// The nonzero pattern of a symmetric matrix as a graph: row i has a diagonal entry and one at
/// every neighbour of i. Neighbours are sorted; the graph is symmetric and has no loops.
struct SymmetricPattern {
  std::vector<std::int64_t> start = {0};  ///< n + 1
  std::vector<Index> neighbor;            ///< both directions of every edge

  /// n.
  Index size() const { return static_cast<Index>(start.size()) - 1; }
  /// The neighbours of row i. Precondition: i in [0, n).
  std::span<const Index> neighbors(Index i) const {
    return {neighbor.data() + start[i], neighbor.data() + start[i + 1]};
  }
};

/// The same graph with vertex order[k] renamed k. Precondition: order is a permutation. Cost: O(n),
/// by all threads.
SymmetricPattern permuted(const SymmetricPattern& pattern, std::span<const Index> order,
                          int threads = 1);

/// The lower triangle of permuted(pattern, order), as LowerMatrix has it: by columns, the diagonal
/// first, rows ascending.
struct LowerPattern {
  std::vector<std::int64_t> start;  ///< n + 1
  std::vector<Index> row;           ///< ascending in each column
};
/// Precondition: `order` is a permutation.
LowerPattern permuted_lower(const SymmetricPattern& pattern, std::span<const Index> order,
                            int threads = 1);

/// position[order[k]] = k.
std::vector<Index> inverse_permutation(std::span<const Index> order, int threads = 1);

/// A number that differs (but for bad luck) between different patterns.
std::uint64_t pattern_hash(const SymmetricPattern& pattern, int threads = 1);
/// The number of the pattern that has this lower triangle.
std::uint64_t pattern_hash(const LowerPattern& lower, int threads = 1);

/// The lower triangle of a symmetric matrix by columns; the diagonal is the first entry of each.
struct LowerMatrix {
  std::vector<std::int64_t> start;  ///< n + 1
  std::vector<Index> row;           ///< ascending in each column
  std::vector<double> value;        ///< of each entry

  /// n.
  Index size() const { return static_cast<Index>(start.size()) - 1; }
};

/// Constant vectors that an operator maps to zero: one for each listed component.
struct Kernel {
  std::span<const Index> component;  ///< component of every row; empty when there is no kernel
  Index count = 0;                   ///< of components

  /// Whether nothing but zero is mapped to zero.
  bool empty() const { return count == 0; }
};

/// A real symmetric positive (semi)definite operator of size n, in elimination numbering (row k
/// belongs to the k-th eliminated vertex of the Analysis it is given to).
class SymmetricOperator {
 public:
  virtual ~SymmetricOperator() = default;

  /// n.
  virtual Index size() const = 0;

  /// y = M x, without forming M. Sizes n. May be called from several threads.
  virtual void apply(std::span<const double> x, std::span<double> y) const = 0;

  /// The n diagonal entries, > 0.
  virtual std::span<const double> diagonal() const = 0;

  /// Empty when the operator is definite.
  virtual Kernel kernel() const { return {}; }

  /// Hash of the pattern (pattern_hash of the permuted graph).
  virtual std::uint64_t pattern() const = 0;

  /// M as a matrix, built on the first call. Matrix-free backends never call it. Not to be called
  /// from several threads at once.
  virtual const LowerMatrix& assembled() const = 0;

  /// The same where only some columns are of use: those with a flag in `wanted` (n, or empty: all).
  /// The others may hold any numbers.
  virtual const LowerMatrix& assembled_where(std::span<const char> /*wanted*/) const {
    return assembled();
  }
};

/// A block of K vectors of length n; the K values of a row are contiguous.
using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What a factorisation cost.
struct FactorStats {
  std::int64_t nonzeros = 0;  ///< stored entries of the factor (0: no factor)
  std::int64_t bytes = 0;     ///< memory held
  /// Floating-point operations that the numeric factorisation took; 0 where nobody counts.
  std::int64_t operations = 0;
  /// Fronts (dense blocks of columns), and those that were factorised; the others are those of an
  /// earlier factor. 0 where there are none.
  Index fronts = 0, fronts_factored = 0;
};

/// How a direct backend may keep the numbers of a factor, which it computes in double always.
/// Solves are bound by reading them. Backends that cannot keep them narrow keep them full.
enum class FactorStorage {
  kFull,          ///< double
  kSingle,        ///< float: for answers within a few decades of each other
  kWideExponent,  ///< the upper half of a double: 21 bits of mantissa, all of its exponent
};

class Factorization;

/// A factor of almost the same matrix, by an analysis that this one followed, or by this one.
struct EarlierFactor {
  const Factorization* factor = nullptr;  ///< null: there is none so far
  /// n: a flag for each row that has other entries, or one whose place in the order has changed
  /// among its neighbours.
  std::span<const char> changed;
};

/// How a factor is to be made.
struct FactorOptions {
  int threads = 1;                               ///< at most so many
  FactorStorage storage = FactorStorage::kFull;  ///< how its numbers are kept
  /// Where memory of factors that are gone is kept for the next; null: nowhere. For the library's
  /// own backends; others pass it over.
  std::shared_ptr<BufferPool> memory = nullptr;
  /// Where only some rows have changed, and more changes are to be expected: a backend may keep
  /// what it needs to do less next time. Null: it need not.
  const EarlierFactor* earlier = nullptr;
};

/// What one solve did.
struct SolveReport {
  int iterations = 0;     ///< largest over the block's columns; 0 for direct backends
  double residual = 0.0;  ///< |B - M X| / |B| as the solver estimates it; 0 for direct backends
};

/// One matrix, ready to solve with. Immutable; solve() is safe from several threads at once.
class Factorization {
 public:
  virtual ~Factorization() = default;

  /// Solves M X = B in place (B, X: n x K). `support`, where not empty, lists the only rows in
  /// which B may be nonzero, in any order: a backend may use it to skip work. An iterative backend
  /// calls `progress` before it starts and then every few milliseconds, as far as single iterations
  /// allow, and ends with kCancelled when told to; X is of no use then. A direct one need not.
  /// `threads`: that it may use; the answer has the same bits with any number of them.
  /// Errors: kBudgetEnded (iterations, residual), kNumericalFailure, kCancelled.
  virtual Result<SolveReport> solve(Block& x, std::span<const Index> support = {},
                                    const Progress& progress = {}, int threads = 1) const = 0;

  /// The same where only some rows of the answer are of use: those with a flag in `wanted` (n). The
  /// others may come out as anything finite. Direct backends skip the work for them.
  virtual Result<SolveReport> solve_where(Block& x, std::span<const Index> support,
                                          std::span<const char> /*wanted*/,
                                          const Progress& progress, int threads) const {
    return solve(x, support, progress, threads);
  }

  /// The entries of M^-1 at the given rows and columns: k x k. Cost for direct backends: the
  /// elimination-tree paths of the rows; otherwise k solves.
  virtual Result<Eigen::MatrixXd> inverse_entries(std::span<const Index> rows) const;

  /// What it cost.
  virtual FactorStats stats() const = 0;
  /// n.
  virtual Index size() const = 0;
};

/// Ordering and symbolic analysis of one pattern; serves every matrix that has it. Immutable.
class Analysis {
 public:
  virtual ~Analysis() = default;

  /// order()[k] is the vertex eliminated k-th. Operators, right sides and answers are in this
  /// numbering, so that no solve permutes anything.
  virtual std::span<const Index> order() const = 0;

  /// Errors: kBadInput (another pattern), kNumericalFailure (the column whose pivot is not
  /// positive), kOutOfMemory. May be called from several threads at once.
  virtual Result<std::unique_ptr<Factorization>> factorize(
      std::shared_ptr<const SymmetricOperator> matrix, const FactorOptions& options) const = 0;

  /// FactorStats::bytes of every factor of this pattern, known before one is made; 0 where none is
  /// held.
  virtual std::int64_t factor_bytes(FactorStorage /*storage*/) const { return 0; }

  /// What factorize() takes beside that while it works, the assembled matrix included.
  virtual std::int64_t work_bytes() const { return 0; }

  /// The tree of which the factors of this pattern are made; null where the backend has none that
  /// follow() could keep. This, follow() and update() are for the library's own backends; others
  /// leave them as they are.
  virtual const EliminationTree* tree() const { return nullptr; }

  /// The analysis of another pattern in an order that keeps such a tree. `eliminated`: the pattern
  /// in that order. Errors: kNotAvailable (no tree), kOutOfMemory. Cost: far less than analyze().
  virtual Result<std::shared_ptr<const Analysis>> follow(const NodeOrder& order,
                                                         const SymmetricPattern& eliminated,
                                                         int threads) const;

  /// The same where few rows have changed and the tree's nodes are the same. `lower`: the lower
  /// triangle of the pattern. Cost: that of the changed rows, and of copying the rest.
  virtual Result<std::shared_ptr<const Analysis>> update(const NodeOrder& order,
                                                         const LowerPattern& lower,
                                                         const EarlierRows& rows,
                                                         int threads) const;
};

/// The error of every backend for a matrix whose pattern is not the analysed one.
Result<void> check_pattern(const SymmetricOperator& matrix, std::uint64_t analysed, Index size);

/// A way to solve sparse symmetric systems, known by its name. Stateless.
class Backend {
 public:
  virtual ~Backend() = default;

  /// As options name it: "native".
  virtual std::string_view name() const = 0;
  /// What it is, in a few words, for lists of backends.
  virtual std::string_view description() const = 0;

  /// Iterative: factorisation is free, a semidefinite operator is solved by projecting its kernel
  /// out, and answers are accurate relative to their largest entry only.
  virtual bool iterative() const { return false; }

  /// `positions`: one point a vertex, or empty; offered for geometric orderings.
  /// Errors: kOutOfMemory, kNumericalFailure.
  virtual Result<std::shared_ptr<const Analysis>> analyze(const SymmetricPattern& pattern,
                                                          std::span<const Vec3> positions,
                                                          int threads) const = 0;
};

/// Names of the backends of this build, the default first.
std::vector<std::string> backend_names();

/// Error kNotAvailable: lists the names there are.
Result<const Backend*> find_backend(std::string_view name);

/// A backend from outside the library: while this lives, it is the last of backend_names(), and
/// find_backend() finds it. It must live as long as any method that works with it. May be made and
/// gone while others look for backends. Precondition: its name is not taken.
class AddedBackend {
 public:
  /// Adds it.
  explicit AddedBackend(std::unique_ptr<const Backend> backend);
  ~AddedBackend();
  AddedBackend(const AddedBackend&) = delete;
  AddedBackend& operator=(const AddedBackend&) = delete;

 private:
  std::unique_ptr<const Backend> backend_;
};

}  // namespace geotherm
