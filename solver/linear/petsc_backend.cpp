// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <span>
#include <string>
#include <utility>

#include "solver/core/text.h"
#include "solver/linear/backend_registry.h"
#include "solver/linear/matrix_rows.h"
#include "solver/linear/mpi_module.h"
#include "solver/linear/symmetric_pattern.h"

namespace geotherm {
namespace {

constexpr const char* kPetscName = "petsc";

/// Residual of each component, relative to its right side. Round-off may leave more, but no more
/// than the second.
constexpr double kPetscTolerance = 1e-12;
constexpr double kPetscWorst = 1e-7;
/// Components whose right sides differ in size by more than the tolerance are solved one after the
/// other: so many at most.
constexpr int kMaxRounds = 20;

/// PETSc is for one thread at a time.
std::mutex petsc_in_use;

/// Whether most rows add up to nothing, as those of a Laplacian do. What has masses is a heat step,
/// whose small entries must be right relative to themselves.
bool is_laplacian(const LowerMatrix& lower) {
  constexpr double kRoundOff = 1e-10;
  std::vector<double> sums(static_cast<std::size_t>(lower.size()), 0.0);
  for (Index j = 0; j < lower.size(); ++j) {
    for (std::int64_t e = lower.start[j]; e < lower.start[j + 1]; ++e) {
      const Index i = lower.row[static_cast<std::size_t>(e)];
      const double value = lower.value[static_cast<std::size_t>(e)];
      sums[i] += value;
      if (i != j) sums[j] += value;
    }
  }
  Index balanced = 0;
  for (Index j = 0; j < lower.size(); ++j) {
    const double diagonal = lower.value[static_cast<std::size_t>(lower.start[j])];
    balanced += std::abs(sums[j]) <= kRoundOff * std::abs(diagonal) ? 1 : 0;
  }
  return 2 * balanced > lower.size();
}

Error in_petsc(std::string what) {
  return {ErrorCode::kNumericalFailure,
          std::move(what),
          {"try ", SettingHint{"backend", {"native"}}},
          kPetscName};
}

/// A Laplacian with held rows: conjugate gradients with BoomerAMG.
class PoissonByPetsc final : public Factorization {
 public:
  static Result<std::unique_ptr<Factorization>> make(const LowerMatrix& lower) {
    const std::int64_t entries = 2 * lower.start.back() - lower.size();
    if (entries > std::numeric_limits<int>::max()) {
      return in_petsc("the matrix has " + std::to_string(entries) +
                      " entries, and indices of PETSc have 32 bits");
    }
    if (const auto ready = start_mpi(); !ready) return ready.error();
    const auto module = mpi_module();
    std::unique_ptr<PoissonByPetsc> out(new PoissonByPetsc(**module));
    out->rows_ = full_rows(lower);
    for (Index j = 0; j < lower.size(); ++j) {
      const double diagonal = lower.value[static_cast<std::size_t>(lower.start[j])];
      if (diagonal > 0) continue;
      return in_petsc("the matrix is not positive definite (diagonal " + rounded_text(diagonal) +
                      " in column " + std::to_string(j) + " of " + std::to_string(lower.size()) +
                      ")");
    }
    const FullRows& rows = out->rows_;
    out->parts_ = connected_components(lower.size(), [&rows](Index i) {
      return std::span(rows.column).subspan(rows.start[i], rows.start[i + 1] - rows.start[i]);
    });
    const std::lock_guard lock(petsc_in_use);
    const char* problem = nullptr;
    out->solver_ =
        (*module)->make_solver(lower.size(), out->rows_.start.data(), out->rows_.column.data(),
                               out->rows_.value.data(), &problem);
    if (out->solver_ == nullptr) return in_petsc(problem);
    return std::unique_ptr<Factorization>(std::move(out));
  }

  ~PoissonByPetsc() override {
    const std::lock_guard lock(petsc_in_use);
    if (solver_ != nullptr) module_.free_solver(solver_);
  }

  Result<SolveReport> solve(Block& x, std::span<const Index> /*support*/, const Progress& progress,
                            int /*threads*/) const override {
    SolveReport out;
    std::vector<double> b(static_cast<std::size_t>(size())), found(b.size());
    for (Eigen::Index c = 0; c < x.cols(); ++c) {
      const double share = static_cast<double>(c) / static_cast<double>(x.cols());
      if (!report(progress, "solve", share)) return cancelled_error();
      for (Index i = 0; i < size(); ++i) b[i] = x(i, c);
      const auto solved = solve_column(b, found);
      if (!solved) return solved.error();
      for (Index i = 0; i < size(); ++i) x(i, c) = found[i];
      out.iterations = std::max(out.iterations, solved->iterations);
      out.residual = std::max(out.residual, solved->residual);
    }
    return out;
  }

  /// The size of the matrix; hypre does not say what it keeps beside it.
  FactorStats stats() const override {
    const auto nonzeros = std::ssize(rows_.column);
    return {.nonzeros = nonzeros,
            .bytes = nonzeros * static_cast<std::int64_t>(sizeof(double) + sizeof(int))};
  }
  Index size() const override { return rows_.size(); }

 private:
  explicit PoissonByPetsc(const MpiModule& module) : module_(module) {}

  /// Solves for what the residual of each component is still too large for, until none is, or
  /// round-off keeps it.
  Result<SolveReport> solve_column(const std::vector<double>& b, std::vector<double>& x) const {
    constexpr double kNear = 10,
                     kProgress = 0.5;  // the residual is not quite the one that CG keeps
    std::vector<double> left = b, step(b.size());
    const std::vector<double> wanted = norms(b);
    std::fill(x.begin(), x.end(), 0.0);
    SolveReport out;
    out.residual = 1;
    for (int round = 0; round <= kMaxRounds; ++round) {
      const std::vector<double> now = norms(left);
      const double before = std::exchange(out.residual, 0.0);
      for (Index c = 0; c < parts_.count; ++c) {
        if (wanted[c] > 0) out.residual = std::max(out.residual, now[c] / wanted[c]);
      }
      if (out.residual <= kNear * kPetscTolerance) return out;
      const bool stays = round > 1 && !(out.residual < kProgress * before);
      if (stays && out.residual <= kPetscWorst) return out;
      for (std::size_t i = 0; i < left.size(); ++i) {
        const Index c = parts_.of[i];
        if (now[c] <= kNear * kPetscTolerance * wanted[c]) left[i] = 0;
      }
      int iterations = 0;
      {
        const std::lock_guard lock(petsc_in_use);
        const std::string problem =
            module_.solve(solver_, left.data(), step.data(), kPetscTolerance, &iterations);
        if (!problem.empty()) return in_petsc(problem);
      }
      out.iterations += iterations;
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += step[i];
      find_left(b, x, left);
    }
    return in_petsc("the residual stays at " + rounded_text(out.residual) + " of the right side");
  }

  std::vector<double> norms(const std::vector<double>& r) const {
    std::vector<double> squares(static_cast<std::size_t>(parts_.count), 0.0);
    for (std::size_t i = 0; i < r.size(); ++i) squares[parts_.of[i]] += r[i] * r[i];
    for (double& each : squares) each = std::sqrt(each);
    return squares;
  }

  void find_left(const std::vector<double>& b, const std::vector<double>& x,
                 std::vector<double>& left) const {
    for (std::size_t i = 0; i < b.size(); ++i) {
      double sum = b[i];
      for (int e = rows_.start[i]; e < rows_.start[i + 1]; ++e) {
        sum -= rows_.value[e] * x[rows_.column[e]];
      }
      left[i] = sum;
    }
  }

  const MpiModule& module_;
  void* solver_ = nullptr;
  FullRows rows_;
  Components parts_;
};

/// The native analysis, whose factors serve the heat step.
class PetscAnalysis final : public Analysis {
 public:
  explicit PetscAnalysis(std::shared_ptr<const Analysis> native) : native_(std::move(native)) {}

  std::span<const Index> order() const override { return native_->order(); }
  std::int64_t factor_bytes(FactorStorage storage) const override {
    return native_->factor_bytes(storage);
  }
  std::int64_t work_bytes() const override { return native_->work_bytes(); }

  Result<std::unique_ptr<Factorization>> factorize(std::shared_ptr<const SymmetricOperator> matrix,
                                                   const FactorOptions& options) const override {
    if (matrix->size() == static_cast<Index>(order().size()) && is_laplacian(matrix->assembled())) {
      return PoissonByPetsc::make(matrix->assembled());
    }
    FactorOptions afresh = options;
    afresh.earlier = nullptr;
    auto factor = native_->factorize(std::move(matrix), afresh);
    if (factor) return factor;
    Error error = factor.error();
    if (!error.subject.empty()) error.subject = kPetscName;
    return error;
  }

 private:
  std::shared_ptr<const Analysis> native_;
};

class PetscBackend final : public Backend {
 public:
  std::string_view name() const override { return kPetscName; }
  std::string_view description() const override {
    return "Poisson by PETSc: conjugate gradients with hypre's BoomerAMG; heat by the native "
           "factor";
  }

  Result<std::shared_ptr<const Analysis>> analyze(const SymmetricPattern& pattern,
                                                  std::span<const Vec3> positions,
                                                  int threads) const override {
    auto native = native_backend()->analyze(pattern, positions, threads);
    if (!native) return native;
    return std::shared_ptr<const Analysis>(std::make_shared<PetscAnalysis>(*std::move(native)));
  }
};

}  // namespace

const Backend* petsc_backend() {
  static const PetscBackend kBackend;
  return &kBackend;
}

}  // namespace geotherm
