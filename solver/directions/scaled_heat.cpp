// SPDX-License-Identifier: MIT
#include "solver/directions/scaled_heat.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "solver/core/text.h"

namespace geotherm {
namespace {

using Complex = ScaledHeat::Complex;
using Complexes = std::vector<Complex>;

/// The residual over the first one at which Z is solved, and products allowed until then.
constexpr double kMinResidual = 1e-13;
constexpr int kBudget = 3000;
/// Where rounding may be all that is left of the residual.
constexpr double kRounded = 1e-11;
/// Products between two restarts, each of which keeps a vector.
constexpr int kKept = 16;

Complex inner(const Complexes& a, const Complexes& b) {
  Complex sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::conj(a[i]) * b[i];
  return sum;
}

double norm(const Complexes& a) {
  double sum = 0;
  for (const Complex& x : a) sum += std::norm(x);
  return std::sqrt(sum);
}

void add(Complex factor, const Complexes& from, Complexes& to) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * from[i];
}

}  // namespace

ScaledHeat::ScaledHeat(std::span<const Link> links, std::span<const double> mass, double t,
                       const HeatField& heat, bool turns) {
  const auto level = [&](Index i) {
    return heat.level.empty() ? 0 : int{heat.level[static_cast<std::size_t>(i * heat.u.cols())]};
  };
  place_.assign(mass.size(), kNoIndex);
  for (Index i = 0; i < static_cast<Index>(mass.size()); ++i) {
    if (std::isfinite(heat.u(i, 0)) && heat.u(i, 0) != 0) row_.push_back(i);
  }
  std::ranges::sort(row_, [&](Index a, Index b) {
    const int la = level(a), lb = level(b);
    const double ha = std::abs(heat.u(a, 0)), hb = std::abs(heat.u(b, 0));
    return la != lb ? la < lb : ha != hb ? ha > hb : a < b;
  });
  for (Index k = 0; k < size(); ++k) place_[row_[k]] = k;

  std::vector<double> diagonal(mass.begin(), mass.end());
  start_.assign(row_.size() + 1, 0);
  const auto for_each = [&](auto&& take) {
    for (const Link& link : links) {
      if (link.from == link.to) continue;
      if (place_[link.from] == kNoIndex || place_[link.to] == kNoIndex) continue;
      const Complex turn = turns ? Complex(link.cosine, link.sine) : Complex(1);
      take(link.from, link.to, -t * link.weight * turn);
      take(link.to, link.from, -t * link.weight * std::conj(turn));
    }
  };
  for (const Link& link : links) {
    const double w = t * link.weight;
    if (link.from != link.to) {
      diagonal[link.from] += w;
      diagonal[link.to] += w;
    } else if (turns) {
      diagonal[link.from] += 2 * w * (1 - link.cosine);
    }
  }
  for_each([&](Index i, Index, Complex) { ++start_[place_[i] + 1]; });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  column_.resize(static_cast<std::size_t>(start_.back()));
  entry_.resize(column_.size());
  // Warmer ones from the front, colder ones from the back.
  std::vector<std::int64_t> front(start_.begin(), start_.end() - 1);
  middle_.assign(start_.begin() + 1, start_.end());
  std::vector<double> to_colder(row_.size(), 0.0);
  for_each([&](Index i, Index j, Complex value) {
    const Index own = place_[i], other = place_[j];
    const std::int64_t at = other < own ? front[own]++ : --middle_[own];
    const double ratio = std::abs(heat.u(j, 0) / heat.u(i, 0)) *
                         std::pow(heat.step, level(j) - level(i)) / diagonal[i];
    column_[static_cast<std::size_t>(at)] = other;
    entry_[static_cast<std::size_t>(at)] = value * ratio;
    if (other > own) to_colder[own] += std::abs(value) * ratio;
  });
  constexpr double kMin = 0.05;  // where heat falls to nearly no side
  for (const double share : to_colder) kept_.push_back(std::max(1 - share, kMin));
  for (const Index i : row_) {
    inverse_.push_back(1 / (std::abs(heat.u(i, 0)) * std::pow(heat.step, level(i)) * diagonal[i]));
  }
}

/// Applies one sweep to a right side.
Complexes ScaledHeat::sweep(Complexes right) const {
  for (Index k = 0; k < size(); ++k) {
    Complex sum = right[k];
    for (std::int64_t e = start_[k]; e < middle_[k]; ++e) sum -= entry_[e] * right[column_[e]];
    right[k] = sum / kept_[k];
  }
  return right;
}

/// Applies one sweep to the product of the matrix and z.
Complexes ScaledHeat::swept_product(const Complexes& z) const {
  Complexes rest(z.size());
  for (Index k = 0; k < size(); ++k) {
    Complex sum = (1 - kept_[k]) * z[k];
    for (std::int64_t e = middle_[k]; e < start_[k + 1]; ++e) sum += entry_[e] * z[column_[e]];
    rest[k] = sum;
  }
  Complexes out = sweep(std::move(rest));
  for (std::size_t k = 0; k < z.size(); ++k) out[k] += z[k];
  return out;
}

Result<Complexes> ScaledHeat::solve(std::span<const Index> rows, std::span<const Complex> values,
                                    const Progress& progress) const {
  Complexes right(row_.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Index k = place_[rows[i]];
    if (k != kNoIndex) right[k] += values[i] * inverse_[k];
  }
  right = sweep(std::move(right));
  Complexes z(right.size()), residual = right;
  const double first = norm(right);
  int products = 0;
  for (double left = first; left > kMinResidual * first;) {
    if (!report(progress, "solve", std::log(left / first) / std::log(kMinResidual))) {
      return cancelled_error();
    }
    std::vector<Complexes> kept = {std::move(residual)};
    for (Complex& x : kept.front()) x /= left;
    Eigen::MatrixXcd products_kept = Eigen::MatrixXcd::Zero(kKept + 1, kKept);
    Eigen::VectorXcd shares;
    for (int j = 0; j < kKept; ++j) {
      Complexes next = swept_product(kept.back());
      for (int i = 0; i <= j; ++i) {
        products_kept(i, j) = inner(kept[static_cast<std::size_t>(i)], next);
        add(-products_kept(i, j), kept[static_cast<std::size_t>(i)], next);
      }
      const double length = norm(next);
      products_kept(j + 1, j) = length;
      const Eigen::MatrixXcd least = products_kept.topLeftCorner(j + 2, j + 1);
      const Eigen::VectorXcd wanted = Eigen::VectorXcd::Unit(j + 2, 0);
      shares = least.colPivHouseholderQr().solve(wanted);
      ++products;
      if (!(length > 0) || (least * shares - wanted).norm() * left <= kMinResidual * first) break;
      for (Complex& x : next) x /= length;
      kept.push_back(std::move(next));
    }
    for (Eigen::Index i = 0; i < shares.size(); ++i) {
      add(left * shares[i], kept[static_cast<std::size_t>(i)], z);
    }
    residual = right;
    add(-1, swept_product(z), residual);
    const double before = std::exchange(left, norm(residual));
    if (left > before / 2 && left <= kRounded * first) break;
    if (!(left <= kMinResidual * first) && (products >= kBudget || !std::isfinite(left))) {
      return Error{ErrorCode::kBudgetEnded,
                   "the budget of " + std::to_string(kBudget) +
                       " iterations ended at a relative residual of " + rounded_text(left / first),
                   {"use ", SettingHint{"backend", {backend_names().front()}}}};
    }
  }
  Complexes out(place_.size());
  for (Index k = 0; k < size(); ++k) out[row_[k]] = z[k];
  return out;
}

}  // namespace geotherm
