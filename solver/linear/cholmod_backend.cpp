// SPDX-License-Identifier: MIT
#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

#include "solver/linear/backend_registry.h"
#include "solver/linear/blas_threads.h"
#include "solver/linear/multifrontal/fill_order.h"
#include "solver/linear/triangular_factor.h"

namespace geotherm {
namespace {

/// CHOLMOD's two families of functions under one name: `int` indices where they suffice, 64-bit
/// ones (cholmod_l_*) for factors of more than 2^31 entries.
template <class Int>
struct CholmodApi;

template <>
struct CholmodApi<int> {
  static constexpr int kType = CHOLMOD_INT;
  static constexpr auto start = cholmod_start;
  static constexpr auto finish = cholmod_finish;
  static constexpr auto analyze = cholmod_analyze_p;
  static constexpr auto copy = cholmod_copy_factor;
  static constexpr auto factorize = cholmod_factorize;
  static constexpr auto free_factor = cholmod_free_factor;
};

template <>
struct CholmodApi<SuiteSparse_long> {
  static constexpr int kType = CHOLMOD_LONG;
  static constexpr auto start = cholmod_l_start;
  static constexpr auto finish = cholmod_l_finish;
  static constexpr auto analyze = cholmod_l_analyze_p;
  static constexpr auto copy = cholmod_l_copy_factor;
  static constexpr auto factorize = cholmod_l_factorize;
  static constexpr auto free_factor = cholmod_l_free_factor;
};

/// A factor together with the workspace it was made in: CHOLMOD counts memory per workspace, so
/// both must go together.
template <class Int>
class CholmodFactor {
 public:
  CholmodFactor() {
    CholmodApi<Int>::start(&common);
    common.print = 0;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = 1;
    common.final_pack = 1;
  }
  ~CholmodFactor() {
    if (factor != nullptr) CholmodApi<Int>::free_factor(&factor, &common);
    CholmodApi<Int>::finish(&common);
  }
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  cholmod_common common{};
  cholmod_factor* factor = nullptr;
};

constexpr const char* kCholmodName = "cholmod";

/// CHOLMOD goes supernodal from this many floating-point operations per entry of the factor.
/// Measured (docs/performance.md): below, the panels are too small to pay for the dense kernels.
constexpr double kSupernodalSwitch = 40;

/// How readily CHOLMOD merges supernodes, storing zeros: by columns, and the share of zeros allowed
/// up to each. Half of its defaults: 12 % fewer entries, which every solve streams, at the same
/// speed of the factorisation (measured at 200k faces).
constexpr std::size_t kRelaxColumns[3] = {2, 8, 32};
constexpr double kRelaxZeros[3] = {0.3, 0.05, 0.02};

/// A view of a lower triangle for CHOLMOD, with the index type of the chosen family.
template <class Int>
class CholmodMatrix {
 public:
  CholmodMatrix(const std::vector<std::int64_t>& start, const std::vector<Index>& row,
                const double* value)
      : start_(start.begin(), start.end()) {
    if constexpr (!std::is_same_v<Int, Index>) wide_row_.assign(row.begin(), row.end());
    view_.nrow = view_.ncol = start.size() - 1;
    view_.nzmax = row.size();
    view_.p = start_.data();
    if constexpr (std::is_same_v<Int, Index>) {
      view_.i = const_cast<Index*>(row.data());  // CHOLMOD does not write to its input
    } else {
      view_.i = wide_row_.data();
    }
    view_.x = const_cast<double*>(value);
    view_.stype = -1;
    view_.itype = CholmodApi<Int>::kType;
    view_.xtype = value != nullptr ? CHOLMOD_REAL : CHOLMOD_PATTERN;
    view_.dtype = CHOLMOD_DOUBLE;
    view_.sorted = view_.packed = 1;
  }
  cholmod_sparse* get() { return &view_; }

 private:
  std::vector<Int> start_, wide_row_;
  cholmod_sparse view_{};
};

template <class Int>
std::shared_ptr<const SupernodalStructure> supernodal_structure(const cholmod_factor& factor) {
  const auto* super = static_cast<const Int*>(factor.super);
  const auto* row_start = static_cast<const Int*>(factor.pi);
  const auto* value_start = static_cast<const Int*>(factor.px);
  const auto* row = static_cast<const Int*>(factor.s);
  auto out = std::make_shared<SupernodalStructure>();
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    const Int width = super[s + 1] - super[s];
    for (Int r = row_start[s] + width; r < row_start[s + 1]; ++r) {
      out->rows.push_back(static_cast<Index>(row[r]));
    }
    const Int height = row_start[s + 1] - row_start[s];
    out->first.push_back(static_cast<Index>(super[s + 1]));
    out->row_start.push_back(static_cast<std::int64_t>(out->rows.size()));
    out->value_start.push_back(static_cast<std::int64_t>(value_start[s]) +
                               static_cast<std::int64_t>(width) * height);
  }
  out->finish();
  return out;
}

template <class Int>
ColumnFactorData column_data(const cholmod_factor& factor) {
  const auto* start = static_cast<const Int*>(factor.p);
  const auto* row = static_cast<const Int*>(factor.i);
  const auto* count = static_cast<const Int*>(factor.nz);
  const auto* value = static_cast<const double*>(factor.x);
  ColumnFactorData out;
  out.start.reserve(factor.n + 1);
  out.inverse_pivot.reserve(factor.n);
  std::size_t entries = 0;
  for (std::size_t j = 0; j < factor.n; ++j) entries += static_cast<std::size_t>(count[j]) - 1;
  out.row.reserve(entries);
  out.value.reserve(entries);
  for (std::size_t j = 0; j < factor.n; ++j) {
    out.inverse_pivot.push_back(1 / value[start[j]]);
    for (Int e = start[j] + 1; e < start[j] + count[j]; ++e) {
      out.row.push_back(static_cast<Index>(row[e]));
      out.value.push_back(value[e]);
    }
    out.start.push_back(static_cast<std::int64_t>(out.row.size()));
  }
  return out;
}

Error cholmod_out_of_memory(const char* stage, Index size) {
  return {ErrorCode::kOutOfMemory,
          std::string("ran out of memory in the ") + stage + " of a matrix of size " +
              std::to_string(size),
          {"try ", SettingHint{"backend", {"cg"}}, ", which needs no factor"},
          kCholmodName};
}

Error not_definite(std::size_t column, std::size_t size, int status) {
  return {ErrorCode::kNumericalFailure,
          "the matrix is not positive definite (pivot of column " + std::to_string(column) +
              " of " + std::to_string(size) + ", status " + std::to_string(status) + ")",
          {"try another backend"},
          kCholmodName};
}

template <class Int>
class CholmodAnalysis final : public Analysis {
 public:
  /// `pattern_` must be set by analyze() below before use.
  CholmodAnalysis(std::unique_ptr<CholmodFactor<Int>> symbolic, const SymmetricPattern& pattern,
                  std::vector<Index> order)
      : symbolic_(std::move(symbolic)), pattern_(pattern_hash(pattern)), order_(std::move(order)) {
    if (symbolic_->factor->is_super) {
      structure_ = supernodal_structure<Int>(*symbolic_->factor);
    }
    forecast_ = structure_ ? forecast_panels(pattern) : forecast_columns(pattern);
  }

  std::span<const Index> order() const override { return order_; }
  std::int64_t factor_bytes(FactorStorage /*storage*/) const override { return forecast_.factor; }
  std::int64_t work_bytes() const override { return forecast_.work; }

  Result<std::unique_ptr<Factorization>> factorize(std::shared_ptr<const SymmetricOperator> matrix,
                                                   const FactorOptions& options) const override {
    if (const auto same = check_pattern(*matrix, pattern_, static_cast<Index>(order_.size()));
        !same) {
      return same.error();
    }
    BlasThreads blas(options.threads);
    if (structure_ && !blas.has_room(forecast_.factor + forecast_.work)) {
      return cholmod_out_of_memory("factorisation", matrix->size());
    }
    const LowerMatrix& lower = matrix->assembled();
    CholmodMatrix<Int> input(lower.start, lower.row, lower.value.data());
    auto numeric = std::make_shared<CholmodFactor<Int>>();
    numeric->factor = CholmodApi<Int>::copy(symbolic_->factor, &numeric->common);
    if (numeric->factor == nullptr) return cholmod_out_of_memory("factorisation", matrix->size());
    CholmodApi<Int>::factorize(input.get(), numeric->factor, &numeric->common);
    const int status = numeric->common.status;
    if (status == CHOLMOD_OUT_OF_MEMORY)
      return cholmod_out_of_memory("factorisation", matrix->size());
    if (status < CHOLMOD_OK || numeric->factor->minor < numeric->factor->n) {
      return not_definite(numeric->factor->minor, numeric->factor->n, status);
    }
    if (!structure_) {
      ColumnFactorData columns = column_data<Int>(*numeric->factor);
      // CHOLMOD's LDL^T goes on where a pivot is negative; its supernodal LL^T does not.
      const auto& inverse = columns.inverse_pivot;
      const auto bad = std::find_if(inverse.begin(), inverse.end(),
                                    [](double p) { return !(p > 0) || !std::isfinite(p); });
      if (bad != inverse.end()) {
        return not_definite(static_cast<std::size_t>(bad - inverse.begin()), inverse.size(),
                            status);
      }
      return make_direct_factorization(make_column_factor(columns, operations()));
    }
    const auto* values = static_cast<const double*>(numeric->factor->x);
    return make_direct_factorization(
        make_supernodal_factor(structure_, values, numeric, operations()));
  }

 private:
  struct Forecast {
    std::int64_t factor = 0, work = 0;  ///< bytes
  };
  static constexpr std::int64_t kEntryBytes = sizeof(double) + sizeof(Int);

  /// CHOLMOD counts while it analyses: the sum of the squared columns, stored zeros left out.
  std::int64_t operations() const { return std::llround(symbolic_->common.fl); }

  /// The assembled matrix, and CHOLMOD's transpose of it for factors by columns.
  static std::int64_t matrix_bytes(const SymmetricPattern& pattern) {
    return 2 * kEntryBytes * (pattern.size() + std::ssize(pattern.neighbor) / 2);
  }

  Forecast forecast_panels(const SymmetricPattern& pattern) const {
    const cholmod_factor& factor = *symbolic_->factor;
    const auto integers = static_cast<std::int64_t>(factor.ssize + 3 * factor.nsuper + factor.n);
    return {supernodal_factor_bytes(*structure_),
            matrix_bytes(pattern) + static_cast<std::int64_t>(sizeof(Int)) * integers +
                static_cast<std::int64_t>(sizeof(double) * factor.maxcsize)};
  }

  /// CHOLMOD gives columns room to grow, and they are copied out of its factor.
  Forecast forecast_columns(const SymmetricPattern& pattern) const {
    const ColumnCounts counts = count_columns(pattern);
    const auto below = std::accumulate(counts.below.begin(), counts.below.end(), std::int64_t{0});
    return {column_factor_bytes(counts), matrix_bytes(pattern) + 2 * kEntryBytes * below};
  }

  std::unique_ptr<CholmodFactor<Int>> symbolic_;
  std::uint64_t pattern_;
  std::vector<Index> order_;
  Forecast forecast_;
  std::shared_ptr<const SupernodalStructure> structure_;
};

/// The analysis, or null when these indices are too narrow for the factor.
template <class Int>
Result<std::shared_ptr<const Analysis>> analyze(const SymmetricPattern& pattern,
                                                const std::vector<Index>& order) {
  std::vector<std::int64_t> start = {0};
  std::vector<Index> row;
  start.reserve(pattern.start.size());
  row.reserve(pattern.neighbor.size() / 2 + static_cast<std::size_t>(pattern.size()));
  for (Index j = 0; j < pattern.size(); ++j) {
    row.push_back(j);
    for (const Index i : pattern.neighbors(j)) {
      if (i > j) row.push_back(i);
    }
    start.push_back(static_cast<std::int64_t>(row.size()));
  }
  CholmodMatrix<Int> input(start, row, nullptr);
  auto symbolic = std::make_unique<CholmodFactor<Int>>();
  symbolic->common.supernodal = CHOLMOD_AUTO;
  symbolic->common.supernodal_switch = kSupernodalSwitch;
  std::copy(std::begin(kRelaxColumns), std::end(kRelaxColumns), symbolic->common.nrelax);
  std::copy(std::begin(kRelaxZeros), std::end(kRelaxZeros), symbolic->common.zrelax);
  std::vector<Int> given(order.begin(), order.end());
  symbolic->factor =
      CholmodApi<Int>::analyze(input.get(), given.data(), nullptr, 0, &symbolic->common);
  if (symbolic->common.status == CHOLMOD_TOO_LARGE) return std::shared_ptr<const Analysis>();
  if (symbolic->factor == nullptr) return cholmod_out_of_memory("analysis", pattern.size());

  // From here on matrices come in elimination order: tell CHOLMOD that nothing is permuted.
  auto* permutation = static_cast<Int*>(symbolic->factor->Perm);
  std::vector<Index> final_order(permutation, permutation + symbolic->factor->n);
  for (std::size_t k = 0; k < symbolic->factor->n; ++k) permutation[k] = static_cast<Int>(k);
  symbolic->factor->ordering = CHOLMOD_NATURAL;
  const SymmetricPattern eliminated = permuted(pattern, final_order);
  return std::shared_ptr<const Analysis>(std::make_shared<CholmodAnalysis<Int>>(
      std::move(symbolic), eliminated, std::move(final_order)));
}

class CholmodBackend final : public Backend {
 public:
  std::string_view name() const override { return kCholmodName; }
  std::string_view description() const override {
    return "sparse Cholesky of SuiteSparse, supernodal on large meshes";
  }

  Result<std::shared_ptr<const Analysis>> analyze(const SymmetricPattern& pattern,
                                                  std::span<const Vec3> positions,
                                                  int threads) const override {
    const std::vector<Index> order = fill_reducing_order(pattern, positions, threads);
    auto narrow = geotherm::analyze<int>(pattern, order);
    if (!narrow || *narrow) return narrow;
    return geotherm::analyze<SuiteSparse_long>(pattern, order);
  }
};

}  // namespace

const Backend* cholmod_backend() {
  static const CholmodBackend kBackend;
  return &kBackend;
}

}  // namespace geotherm
