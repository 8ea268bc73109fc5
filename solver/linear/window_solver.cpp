// SPDX-License-Identifier: MIT
#include "solver/linear/window_solver.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace geotherm {

FullRows full_rows(const LowerMatrix& lower) {
  const Index n = lower.size();
  FullRows rows;
  rows.start.assign(static_cast<std::size_t>(n) + 1, 0);
  const auto for_each = [&](auto&& take) {
    for (Index j = 0; j < n; ++j) {
      for (std::int64_t e = lower.start[j]; e < lower.start[j + 1]; ++e) {
        const Index i = lower.row[static_cast<std::size_t>(e)];
        const double value = lower.value[static_cast<std::size_t>(e)];
        if (i != j && value == 0) continue;
        take(i, j, value);
        if (i != j) take(j, i, value);
      }
    }
  };
  for_each([&](Index i, Index, double) { ++rows.start[i + 1]; });
  std::partial_sum(rows.start.begin(), rows.start.end(), rows.start.begin());
  rows.column.resize(static_cast<std::size_t>(rows.start.back()));
  rows.value.resize(rows.column.size());
  std::vector<int> next(rows.start.begin(), rows.start.end() - 1);
  // Columns ascend: those below the diagonal come in the order of j, and then the others.
  for_each([&](Index i, Index j, double value) {
    const int at = next[i]++;
    rows.column[at] = j;
    rows.value[at] = value;
  });
  return rows;
}

namespace {

/// The rows of a window, those of the last ring included, which are beyond it.
struct Window {
  std::vector<Index> rows;
  std::size_t inside = 0;
  std::vector<int> start = {0}, column;  ///< of all rows, columns inside alone
  std::vector<double> value, diagonal;
};

/// So many rings around the support; empty where they are more than half of the matrix.
Window window_around(const FullRows& all, std::span<const Index> support, int rings) {
  Window window;
  std::vector<Index> local(static_cast<std::size_t>(all.size()), kNoIndex);
  const auto add = [&](Index i) {
    if (local[i] != kNoIndex) return;
    local[i] = static_cast<Index>(window.rows.size());
    window.rows.push_back(i);
  };
  for (const Index i : support) add(i);
  std::size_t begin = 0;
  for (int ring = 0; ring <= rings; ++ring) {
    const std::size_t end = window.rows.size();
    if (ring == rings) window.inside = begin;
    for (std::size_t k = begin; ring < rings && k < end; ++k) {
      const Index i = window.rows[k];
      for (int e = all.start[i]; e < all.start[i + 1]; ++e) add(all.column[e]);
    }
    if (ring < rings) begin = end;
    if (2 * window.rows.size() > local.size()) return {};
  }
  for (const Index i : window.rows) {
    double diagonal = 0;
    for (int e = all.start[i]; e < all.start[i + 1]; ++e) {
      const Index j = local[all.column[e]];
      if (all.column[e] == i) diagonal = all.value[e];
      if (j == kNoIndex || static_cast<std::size_t>(j) >= window.inside) continue;
      window.column.push_back(j);
      window.value.push_back(all.value[e]);
    }
    window.start.push_back(static_cast<int>(window.column.size()));
    window.diagonal.push_back(diagonal);
  }
  return window;
}

/// y = M x on these rows of the window.
void multiply(const Window& window, std::size_t begin, std::size_t end,
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
int conjugate_gradients(const Window& window, std::vector<double>& r, std::vector<double>& x,
                        double wanted, int budget) {
  const std::size_t n = window.inside;
  std::vector<double> z(n), p(n), q(n);
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
    const double step = rho / std::inner_product(p.begin(), p.end(), q.begin(), 0.0);
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

WindowSolver::WindowSolver(const LowerMatrix& lower) : rows_(full_rows(lower)) {
  // On surfaces a row's stiffness over its mass is about five diffusion times over squared edges.
  constexpr double kStiffnessOfEdge = 5;
  double lengths = 0;
  for (Index i = 0; i < rows_.size(); ++i) {
    double sum = 0, diagonal = 0;
    for (int e = rows_.start[i]; e < rows_.start[i + 1]; ++e) {
      sum += rows_.value[e];
      if (rows_.column[e] == i) diagonal = rows_.value[e];
    }
    lengths += std::sqrt(std::clamp(diagonal / sum - 1, 0.0, 1e6) / kStiffnessOfEdge);
  }
  length_ = std::max(1.0, lengths / std::max<Index>(rows_.size(), 1));
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
    const Window window = window_around(rows_, asked, static_cast<int>(rings));
    if (window.inside == 0) return 0;
    std::vector<double> r(window.rows.size(), 0.0), found(window.inside, 0.0);
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
