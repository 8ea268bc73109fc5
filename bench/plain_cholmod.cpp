// SPDX-License-Identifier: MIT
#include "bench/plain_cholmod.h"

namespace geotherm::bench {
namespace {

/// CHOLMOD's view of a matrix whose two triangles are stored; it reads the lower one.
cholmod_sparse view_of(Eigen::SparseMatrix<double>& matrix) {
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(matrix.rows());
  view.ncol = static_cast<std::size_t>(matrix.cols());
  view.nzmax = static_cast<std::size_t>(matrix.nonZeros());
  view.p = matrix.outerIndexPtr();
  view.i = matrix.innerIndexPtr();
  view.x = matrix.valuePtr();
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

}  // namespace

PlainCholmod::PlainCholmod() {
  cholmod_start(&common_);
  common_.print = 0;
  // The one setting that differs from CHOLMOD's defaults, and it is theirs: the supernodal modules
  // need a real BLAS and are GPL, so libraries ask for the simplicial factorisation.
  common_.supernodal = CHOLMOD_SIMPLICIAL;
}

PlainCholmod::~PlainCholmod() {
  cholmod_free_factor(&factor_, &common_);
  cholmod_finish(&common_);
}

bool PlainCholmod::factorize(Eigen::SparseMatrix<double>& matrix) {
  cholmod_free_factor(&factor_, &common_);
  cholmod_sparse view = view_of(matrix);
  factor_ = cholmod_analyze(&view, &common_);
  if (factor_ == nullptr) return false;
  cholmod_factorize(&view, factor_, &common_);
  return common_.status == CHOLMOD_OK && factor_->minor == factor_->n;
}

Eigen::VectorXd PlainCholmod::solve(Eigen::VectorXd& b) {
  cholmod_dense view{};
  view.nrow = view.d = view.nzmax = static_cast<std::size_t>(b.size());
  view.ncol = 1;
  view.x = b.data();
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* answer = cholmod_solve(CHOLMOD_A, factor_, &view, &common_);
  if (answer == nullptr) return {};
  Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(static_cast<double*>(answer->x), b.size());
  cholmod_free_dense(&answer, &common_);
  return x;
}

double PlainCholmod::bytes() const {
  if (factor_ == nullptr) return 0;
  const auto n = static_cast<double>(factor_->n);
  const auto* count = static_cast<const int*>(factor_->nz);
  double entries = 0;
  for (std::size_t j = 0; j < factor_->n; ++j) entries += count[j];
  constexpr double kIndexArrays = 6;  // Perm, ColCount, p, nz, next, prev
  return entries * (sizeof(double) + sizeof(int)) + kIndexArrays * n * sizeof(int);
}

}  // namespace geotherm::bench
