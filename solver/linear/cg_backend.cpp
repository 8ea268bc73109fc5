// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <numeric>
#include <string>

#include "solver/core/text.h"
#include "solver/linear/backend_registry.h"
#include "solver/linear/multigrid.h"
#include "solver/linear/window_solver.h"

namespace geotherm {
namespace {

constexpr const char* kCgName = "cg";

/// Relative residual, in the norm of the preconditioner, at which a column is solved.
constexpr double kCgTolerance = 1e-13;
/// Iterations allowed: conjugate gradients need about the square root of the condition number,
/// which for a Laplacian is about the graph's radius; 20 sqrt(n) + 2000 leaves room for bad meshes.
constexpr double kBudgetPerRoot = 20;
constexpr int kBudgetAtLeast = 2000;
/// Below so many rows all of them are as quick as a window; above, entries are too many for int.
constexpr Index kWorthWindows = 5000, kMaxWindowed = 100'000'000;
/// Rows worked on between two calls of progress: about 10 ms at 20 ns a row.
constexpr std::size_t kRowsBetweenCalls = 500'000;

/// Removes from x its mean on every component of the kernel.
void project(const Kernel& kernel, std::span<double> x) {
  if (kernel.empty()) return;
  std::vector<double> sum(static_cast<std::size_t>(kernel.count), 0.0);
  std::vector<Index> count(static_cast<std::size_t>(kernel.count), 0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum[kernel.component[i]] += x[i];
    ++count[kernel.component[i]];
  }
  for (Index c = 0; c < kernel.count; ++c) sum[c] /= count[c];
  for (std::size_t i = 0; i < x.size(); ++i) x[i] -= sum[kernel.component[i]];
}

/// The decades that the residual has fallen by, out of those that it has to; squares of norms.
double share_done(double fallen_to) {
  const double share = std::log(fallen_to) / std::log(kCgTolerance * kCgTolerance);
  return share > 0 ? std::min(share, 1.0) : 0.0;  // 0 for what is no number
}

class ConjugateGradient final : public Factorization {
 public:
  explicit ConjugateGradient(std::shared_ptr<const SymmetricOperator> matrix)
      : matrix_(std::move(matrix)),
        rows_(dynamic_cast<const MatrixRows*>(matrix_.get())),
        multigrid_(Multigrid::build(*matrix_)) {
    if (rows_ != nullptr) rows_->drop_assembled();
  }

  Result<SolveReport> solve(Block& x, std::span<const Index> /*support*/, const Progress& progress,
                            int /*threads*/) const override {
    SolveReport report;
    std::vector<double> column(static_cast<std::size_t>(size()));
    for (Eigen::Index c = 0; c < x.cols(); ++c) {
      for (Index i = 0; i < size(); ++i) column[i] = x(i, c);
      const auto columns = static_cast<double>(x.cols());
      const auto done = static_cast<double>(c);
      const auto solved =
          solve_one(column, part_of(progress, done / columns, (done + 1) / columns));
      if (!solved) return solved.error();
      for (Index i = 0; i < size(); ++i) x(i, c) = column[i];
      report.iterations = std::max(report.iterations, solved->iterations);
      report.residual = std::max(report.residual, solved->residual);
    }
    return report;
  }

  /// What lies far from a few rows, of a heat step that goes on from there: a window around them.
  Result<SolveReport> solve_where(Block& x, std::span<const Index> support,
                                  std::span<const char> wanted, const Progress& progress,
                                  int threads) const override {
    if (rows_ == nullptr || size() < kWorthWindows || size() > kMaxWindowed || support.empty() ||
        !matrix_->kernel().empty()) {
      return Factorization::solve_where(x, support, wanted, progress, threads);
    }
    std::call_once(window_made_,
                   [this] { window_ = std::make_unique<WindowSolver>(*matrix_, *rows_); });
    SolveReport out;
    for (Eigen::Index c = 0; c < x.cols(); ++c) {
      const auto columns = static_cast<double>(x.cols());
      const double done = static_cast<double>(c) / columns;
      if (!geotherm::report(progress, "solve", done)) return cancelled_error();
      int iterations = window_->solve(x, c, support, kCgTolerance, kBudgetAtLeast);
      if (iterations == 0) {  // no window that would help
        Block column = x.col(c);
        const auto solved =
            solve(column, support, part_of(progress, done, done + 1 / columns), threads);
        if (!solved) return solved.error();
        x.col(c) = column;
        iterations = solved->iterations;
        out.residual = std::max(out.residual, solved->residual);
      }
      out.iterations = std::max(out.iterations, iterations);
    }
    out.residual = std::max(out.residual, kCgTolerance);
    if (!geotherm::report(progress, "solve", 1.0)) return cancelled_error();
    return out;
  }

  FactorStats stats() const override { return {}; }
  Index size() const override { return matrix_->size(); }

 private:
  /// Solves for one right side, in place. The preconditioner is multigrid or the diagonal; the norm
  /// that is watched is that of the preconditioned residual, which is scaled like the unknowns.
  Result<SolveReport> solve_one(std::vector<double>& b, const Progress& progress) const {
    const auto n = static_cast<std::size_t>(size());
    const std::span<const double> diagonal = matrix_->diagonal();
    const Kernel kernel = matrix_->kernel();
    project(kernel, b);
    std::vector<double> r = b, z(n), p(n), q(n), x(n, 0.0);
    const auto precondition = [&] {
      if (multigrid_) return multigrid_->apply(r, z);
      for (std::size_t i = 0; i < n; ++i) z[i] = r[i] / diagonal[i];
      project(kernel, z);
    };
    precondition();
    p = z;
    double rho = std::inner_product(r.begin(), r.end(), z.begin(), 0.0);
    const double start = rho;
    const int budget =
        kBudgetAtLeast + static_cast<int>(kBudgetPerRoot * std::sqrt(static_cast<double>(n)));
    constexpr std::size_t kPassesOfMultigrid = 10;
    const std::size_t rows = multigrid_ ? kPassesOfMultigrid * n : n;
    const auto between_calls = static_cast<int>(1 + kRowsBetweenCalls / rows);
    SolveReport report;
    while (
        !(rho <= kCgTolerance * kCgTolerance * start)) {  // goes on, to an error, where rho is NaN
      if (report.iterations % between_calls == 0 &&
          !geotherm::report(progress, "solve", share_done(rho / start))) {
        return cancelled_error();
      }
      if (report.iterations == budget) {
        return Error{ErrorCode::kBudgetEnded,
                     "the budget of " + std::to_string(budget) +
                         " iterations ended at a relative residual of " +
                         rounded_text(std::sqrt(rho / start)),
                     {"try ", SettingHint{"backend", {"native"}}},
                     kCgName};
      }
      ++report.iterations;
      matrix_->apply(p, q);
      const double curvature = std::inner_product(p.begin(), p.end(), q.begin(), 0.0);
      if (!(curvature > 0)) {
        return Error{ErrorCode::kNumericalFailure,
                     "the matrix is not positive definite (curvature " + rounded_text(curvature) +
                         " in iteration " + std::to_string(report.iterations) + ")",
                     {"try another backend"},
                     kCgName};
      }
      const double step = rho / curvature;
      for (std::size_t i = 0; i < n; ++i) {
        x[i] += step * p[i];
        r[i] -= step * q[i];
      }
      precondition();
      const double next = std::inner_product(r.begin(), r.end(), z.begin(), 0.0);
      // Flexible: what z has of the step before is taken off, not only where the preconditioner is
      // linear. r became less by step q.
      const double beta = multigrid_
                              ? -step * std::inner_product(z.begin(), z.end(), q.begin(), 0.0) / rho
                              : next / rho;
      for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + beta * p[i];
      rho = next;
    }
    report.residual = start > 0 ? std::sqrt(rho / start) : 0.0;
    b = std::move(x);
    return report;
  }

  std::shared_ptr<const SymmetricOperator> matrix_;
  const MatrixRows* rows_;                      ///< of the same; null: it does not know them
  std::unique_ptr<const Multigrid> multigrid_;  ///< null: the diagonal
  mutable std::once_flag window_made_;
  mutable std::unique_ptr<const WindowSolver> window_;
};

class CgAnalysis final : public Analysis {
 public:
  explicit CgAnalysis(const SymmetricPattern& pattern)
      : order_(static_cast<std::size_t>(pattern.size())), pattern_(pattern_hash(pattern)) {
    std::iota(order_.begin(), order_.end(), 0);
  }

  std::span<const Index> order() const override { return order_; }

  Result<std::unique_ptr<Factorization>> factorize(
      std::shared_ptr<const SymmetricOperator> matrix,
      const FactorOptions& /*options*/) const override {
    if (const auto same = check_pattern(*matrix, pattern_, static_cast<Index>(order_.size()));
        !same) {
      return same.error();
    }
    const std::span<const double> diagonal = matrix->diagonal();
    const auto bad =
        std::find_if(diagonal.begin(), diagonal.end(), [](double d) { return !(d > 0); });
    if (bad != diagonal.end()) {
      return Error{ErrorCode::kNumericalFailure,
                   "the matrix is not positive definite (diagonal " + rounded_text(*bad) +
                       " in column " + std::to_string(bad - diagonal.begin()) + " of " +
                       std::to_string(diagonal.size()) + ")",
                   {"try another backend"},
                   kCgName};
    }
    return std::unique_ptr<Factorization>(std::make_unique<ConjugateGradient>(std::move(matrix)));
  }

 private:
  std::vector<Index> order_;
  std::uint64_t pattern_;
};

class CgBackend final : public Backend {
 public:
  std::string_view name() const override { return kCgName; }
  std::string_view description() const override {
    return "conjugate gradients, with multigrid where systems are large: least memory, slow "
           "queries";
  }
  bool iterative() const override { return true; }

  Result<std::shared_ptr<const Analysis>> analyze(const SymmetricPattern& pattern,
                                                  std::span<const Vec3> /*positions*/,
                                                  int /*threads*/) const override {
    return std::shared_ptr<const Analysis>(std::make_shared<CgAnalysis>(pattern));
  }
};

}  // namespace

const Backend* cg_backend() {
  static const CgBackend kBackend;
  return &kBackend;
}

}  // namespace geotherm
