// SPDX-License-Identifier: MIT
// A backend of one's own: dense Cholesky, for small meshes.
#include <geotherm/geotherm.h>

#include <Eigen/Cholesky>

#include "require.h"

using namespace geotherm;

class DenseFactorization final : public Factorization {
 public:
  explicit DenseFactorization(const Eigen::MatrixXd& lower) : factor_(lower) {}
  bool positive() const { return factor_.info() == Eigen::Success; }

  // M X = B in place. Const, and safe from several threads: work space is local or pooled.
  Result<SolveReport> solve(Block& x, std::span<const Index> /*support*/,
                            const Progress& /*progress*/, int /*threads*/) const override {
    x = factor_.solve(x);
    return SolveReport{};
  }
  FactorStats stats() const override { return {.nonzeros = factor_.matrixLLT().size()}; }
  Index size() const override { return static_cast<Index>(factor_.rows()); }

 private:
  Eigen::LLT<Eigen::MatrixXd> factor_;  // reads and keeps the lower triangle
};

class DenseAnalysis final : public Analysis {
 public:
  explicit DenseAnalysis(const SymmetricPattern& pattern) : hash_(pattern_hash(pattern)) {
    for (Index i = 0; i < pattern.size(); ++i) order_.push_back(i);
  }

  std::span<const Index> order() const override { return order_; }  // order()[k] is eliminated k-th

  Result<std::unique_ptr<Factorization>> factorize(
      std::shared_ptr<const SymmetricOperator> matrix,
      const FactorOptions& /*options*/) const override {
    const auto size = static_cast<Index>(order_.size());
    if (auto same = check_pattern(*matrix, hash_, size); !same) return same.error();
    const LowerMatrix& entries = matrix->assembled();
    Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(size, size);
    for (Index column = 0; column < size; ++column) {
      for (auto i = entries.start[column]; i < entries.start[column + 1]; ++i) {
        lower(entries.row[i], column) = entries.value[i];
      }
    }
    auto made = std::make_unique<DenseFactorization>(lower);
    if (!made->positive()) return Error{ErrorCode::kNumericalFailure, "a pivot is not positive"};
    return std::unique_ptr<Factorization>(std::move(made));
  }

 private:
  std::uint64_t hash_;
  std::vector<Index> order_;
};

class DenseBackend final : public Backend {
 public:
  std::string_view name() const override { return "dense"; }
  std::string_view description() const override { return "dense Cholesky, for small meshes"; }
  Result<std::shared_ptr<const Analysis>> analyze(const SymmetricPattern& pattern,
                                                  std::span<const Vec3> /*positions*/,
                                                  int /*threads*/) const override {
    return std::shared_ptr<const Analysis>(std::make_shared<DenseAnalysis>(pattern));
  }
};

int main() {
  AddedBackend added(std::make_unique<DenseBackend>());  // known while this lives
  auto square = require(
      TriangleMesh::build({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}));
  auto mesh = std::make_shared<const TriangleMesh>(require(subdivide(square, 4)));
  HeatOptions options;
  options.backend = "dense";
  options.strict = true;  // no other backend takes over
  auto method = require(HeatMethod::build(mesh, options));
  auto result = require(method.solve(SourceSet::of_vertices({0})));
  std::printf("%.4f\n", result.distances[2]);
}
