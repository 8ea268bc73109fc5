// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/core/progress.h"
#include "solver/core/result.h"
#include "solver/linear/symmetric_operator.h"
#include "solver/linear/symmetric_pattern.h"

namespace geotherm {

/// A block of K vectors of length n; the K values of a row are contiguous.
using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The widest group of columns, 16, 8, 4, 2 or 1, that kernels take at once out of so many.
inline int column_group(Eigen::Index columns) {
  for (const int width : {16, 8, 4, 2}) {
    if (columns >= width) return width;
  }
  return 1;
}

/// What a factorisation cost.
struct FactorStats {
  std::int64_t nonzeros = 0;  ///< stored entries of the factor (0: no factor)
  std::int64_t bytes = 0;     ///< memory held
  /// Floating-point operations that the numeric factorisation took; 0 where nobody counts.
  std::int64_t operations = 0;
};

/// How a direct backend may keep the numbers of a factor, which it computes in double always.
/// Solves are bound by reading them. Backends that cannot keep them narrow keep them full.
enum class FactorStorage {
  kFull,          ///< double
  kSingle,        ///< float: for answers within a few decades of each other
  kWideExponent,  ///< the upper half of a double: 21 bits of mantissa, all of its exponent
};

struct FactorOptions {
  int threads = 1;
  FactorStorage storage = FactorStorage::kFull;
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

  virtual FactorStats stats() const = 0;
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

  virtual std::int64_t bytes() const { return 0; }

  /// FactorStats::bytes of every factor of this pattern, known before one is made; 0 where none is
  /// held.
  virtual std::int64_t factor_bytes(FactorStorage /*storage*/) const { return 0; }

  /// What factorize() takes beside that while it works, the assembled matrix included.
  virtual std::int64_t work_bytes() const { return 0; }
};

/// The error of every backend for a matrix whose pattern is not the analysed one.
Result<void> check_pattern(const SymmetricOperator& matrix, std::uint64_t analysed, Index size);

/// A way to solve sparse symmetric systems, known by its name. Stateless.
class Backend {
 public:
  virtual ~Backend() = default;

  virtual std::string_view name() const = 0;
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

}  // namespace geotherm
