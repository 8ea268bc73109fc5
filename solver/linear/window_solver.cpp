// SPDX-License-Identifier: MIT
#include "solver/linear/window_solver.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace geotherm {

namespace {

/// The rows of a window, those of the last ring included, which are beyond it.
struct RowWindow {
  std::vector<Index> rows;
  std::size_t inside = 0;
  std::vector<int> start = {0}, column;  ///< of all rows
  std::vector<double> value, diagonal;
};

/// So many rings around the support; empty where they are more than half of the matrix.
RowWindow window_around(const MatrixRows& matrix, Index size, std::span<const Index> support,
                        int rings) {
  RowWindow window;
  std::vector<Index> local(static_cast<std::size_t>(size), kNoIndex);
  const auto add = [&](Index i) {
    if (local[i] == kNoIndex) {
      local[i] = static_cast<Index>(window.rows.size());
      window.rows.push_back(i);
    }
    return local[i];
  };
  std::size_t listed = 0;
  const auto list_next = [&](const auto& number) {
    std::size_t at = window.column.size();
    matrix.list_row(window.rows[listed++], window.column, window.value);
    window.diagonal.push_back(window.value[at]);
    for (std::size_t e = at; e < window.column.size(); ++e) {
      const Index j = number(window.column[e]);
      if (j == kNoIndex) continue;
      window.column[at] = j;
      window.value[at++] = window.value[e];
    }
    window.column.resize(at);
    window.value.resize(at);
    window.start.push_back(static_cast<int>(at));
  };
  for (const Index i : support) add(i);
  for (int ring = 0; ring < rings; ++ring) {
    window.inside = window.rows.size();
    while (listed < window.inside) list_next(add);
    if (2 * window.rows.size() > local.size()) return {};
  }
  while (listed < window.rows.size()) list_next([&local](Index i) { return local[i]; });
  return window;
}

/// y = M x on these rows of the window.
void multiply(const RowWindow& window, std::size_t begin, std::size_t end,
              const std::vector<double>& x, std::vector<double>& y) {
  for (std::size_t i = begin; i < end; ++i) {
    double sum = 0;
    for (int e = window.start[i]; e < window.start[i + 1]; ++e) {
      sum += window.value[e] * x[window.column[e]];
    }
    y[i] = sum;
  }
}

/// x of r, which is used up; the iterations, more than `budget` where it did not get there.
int conjugate_gradients(const RowWindow& window, std::vector<double>& r, std::vector<double>& x,
                        double wanted, int budget) {
  const std::size_t n = window.inside;
  std::vector<double> z(window.rows.size(), 0.0), p, q(n);  // z and p are 0 beyond
  const auto precondition = [&] {
    double rho = 0;
    for (std::size_t i = 0; i < n; ++i) {
      z[i] = r[i] / window.diagonal[i];
      rho += z[i] * r[i];
    }
    return rho;
  };
  double rho = precondition();
  p = z;
  int iterations = 0;
  while (!(rho <= wanted)) {
    if (++iterations > budget) break;
    multiply(window, 0, n, p, q);
    const double step = rho / std::inner_product(q.begin(), q.end(), p.begin(), 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += step * p[i];
      r[i] -= step * q[i];
    }
    const double next = precondition();
    for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + next / rho * p[i];
    rho = next;
  }
  return iterations;
}

}  // namespace

WindowSolver::WindowSolver(const SymmetricOperator& matrix, const MatrixRows& rows)
    : rows_(rows), size_(matrix.size()) {
  // On surfaces a row's stiffness over its mass is about five diffusion times over squared edges.
  constexpr double kStiffnessOfEdge = 5;
  const std::vector<double> ones(static_cast<std::size_t>(size_), 1.0);
  std::vector<double> sums(ones.size());
  matrix.apply(ones, sums);
  double lengths = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    lengths +=
        std::sqrt(std::clamp(matrix.diagonal()[i] / sums[i] - 1, 0.0, 1e6) / kStiffnessOfEdge);
  }
  length_ = std::max(1.0, lengths / std::max<Index>(size_, 1));
}

int WindowSolver::solve(Block& x, Eigen::Index column, std::span<const Index> support,
                        double tolerance, int budget) const {
  std::vector<Index> asked;
  for (const Index i : support) {
    if (x(i, column) != 0) asked.push_back(i);
  }
  if (asked.empty()) return 0;
  constexpr double kMore = 1.5;
  double rings = 2 - length_ * std::log(tolerance);
  for (;; rings *= kMore) {
    const RowWindow window = window_around(rows_, size_, asked, static_cast<int>(rings));
    if (window.inside == 0) return 0;
    std::vector<double> r(window.rows.size(), 0.0), found(r);
    double start = 0;
    for (std::size_t k = 0; k < asked.size(); ++k) {  // the first rows of the window
      r[k] = x(asked[k], column);
      start += r[k] * r[k] / window.diagonal[k];
    }
    const double wanted = tolerance * tolerance * start;
    const int iterations = conjugate_gradients(window, r, found, wanted, budget);
    if (iterations > budget) return 0;
    multiply(window, window.inside, window.rows.size(), found, r);
    double beyond = 0;
    for (std::size_t i = window.inside; i < window.rows.size(); ++i) {
      beyond += r[i] * r[i] / window.diagonal[i];
    }
    if (!(beyond <= wanted)) continue;
    for (const Index i : asked) x(i, column) = 0;
    for (std::size_t i = 0; i < window.inside; ++i) x(window.rows[i], column) = found[i];
    return std::max(iterations, 1);
  }
}

}  // namespace geotherm
