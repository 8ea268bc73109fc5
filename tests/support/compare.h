// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "geotherm/backend.h"

namespace geotherm::test {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Largest finite |a_i|.
inline double largest(std::span<const double> a) {
  double most = 0;
  for (const double x : a) {
    if (std::isfinite(x)) most = std::max(most, std::abs(x));
  }
  return most;
}

/// Largest |a_i - b_i| over the largest |b_i|; infinite where sizes or the places of values that
/// are not finite differ.
inline double relative_difference(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;  // infinities too
    if (!std::isfinite(a[i]) || !std::isfinite(b[i])) {
      return std::numeric_limits<double>::infinity();
    }
    most = std::max(most, std::abs(a[i] - b[i]));
  }
  const double scale = largest(b);
  return scale > 0 ? most / scale : most;
}

inline std::span<const double> values(const Eigen::MatrixXd& m) {
  return {m.data(), static_cast<std::size_t>(m.size())};
}

/// The whole symmetric matrix.
inline Eigen::MatrixXd dense(const LowerMatrix& lower) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(lower.size(), lower.size());
  for (Index j = 0; j < lower.size(); ++j) {
    for (std::int64_t e = lower.start[j]; e < lower.start[j + 1]; ++e) {
      const Index i = lower.row[static_cast<std::size_t>(e)];
      out(i, j) = out(j, i) = lower.value[static_cast<std::size_t>(e)];
    }
  }
  return out;
}

/// The operator applied to every unit vector.
inline Eigen::MatrixXd dense(const SymmetricOperator& op) {
  const Index n = op.size();
  Eigen::MatrixXd out(n, n);
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(n);
  for (Index j = 0; j < n; ++j) {
    unit(j) = 1;
    op.apply({unit.data(), static_cast<std::size_t>(n)},
             {out.col(j).data(), static_cast<std::size_t>(n)});
    unit(j) = 0;
  }
  return out;
}

}  // namespace geotherm::test
