// SPDX-License-Identifier: MIT
#include "solver/linear/multigrid.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>

namespace geotherm {
namespace {

/// Below so many unknowns the diagonal is as quick.
constexpr Index kWorthLevels = 2'000;
/// A level so small is solved directly.
constexpr Index kDirect = 600;
/// Jacobi's damping: smooths what varies between neighbours, and converges where eigenvalues of the
/// scaled matrix stay below 3.
constexpr double kDamping = 0.66;

/// Joins each unknown with the neighbour behind it of the strongest negative coupling that is still
/// alone; where none is, with what the strongest of all others is joined to: coarse matrices have
/// hubs, whose many neighbours would stay alone. Returns how many there are then.
Index join_pairs(const LowerMatrix& matrix, std::vector<Index>& joined) {
  constexpr double kWeak = 0.02;  // of the diagonal: not worth joining
  struct Neighbour {
    double coupling = 0;
    Index at = kNoIndex;
  };
  std::vector<Neighbour> before(static_cast<std::size_t>(matrix.size()));  // the strongest
  joined.assign(before.size(), kNoIndex);
  Index count = 0;
  for (Index j = 0; j < matrix.size(); ++j) {
    const double weak = kWeak * matrix.value[static_cast<std::size_t>(matrix.start[j])];
    Neighbour alone{.coupling = weak}, other = before[j];
    if (!(other.coupling > weak)) other = alone;
    for (auto e = static_cast<std::size_t>(matrix.start[j]) + 1;
         e < static_cast<std::size_t>(matrix.start[j + 1]); ++e) {
      const Index i = matrix.row[e];
      const double coupling = -matrix.value[e];
      if (coupling > before[i].coupling) before[i] = {coupling, j};
      Neighbour& strongest = joined[i] == kNoIndex ? alone : other;
      if (coupling > strongest.coupling) strongest = {coupling, i};
    }
    if (joined[j] != kNoIndex) continue;
    if (alone.at == kNoIndex && other.at != kNoIndex) {
      joined[j] = joined[other.at];
      continue;
    }
    if (alone.at != kNoIndex) joined[alone.at] = count;
    joined[j] = count++;
  }
  return count;
}

/// The matrix on joined unknowns: sums of its entries. They are gathered for some columns at a
/// time, else they would take more memory than the matrix itself.
LowerMatrix joined_matrix(const LowerMatrix& matrix, const std::vector<Index>& joined,
                          Index count) {
  constexpr Index kColumnsAtOnce = 1 << 19;
  const auto column_of = [&](Index i, Index j) { return std::min(joined[i], joined[j]); };
  std::vector<std::int64_t> start(static_cast<std::size_t>(count) + 1, 0);
  for (Index j = 0; j < matrix.size(); ++j) {
    for (std::int64_t e = matrix.start[j]; e < matrix.start[j + 1]; ++e) {
      ++start[column_of(matrix.row[e], j) + 1];
    }
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  LowerMatrix out;
  out.start.push_back(0);
  out.row.reserve(static_cast<std::size_t>(start.back()));
  out.value.reserve(out.row.capacity());
  std::vector<std::pair<Index, double>> entries;
  for (Index first = 0; first < count; first += kColumnsAtOnce) {
    const Index last = std::min(first + kColumnsAtOnce, count);
    entries.resize(static_cast<std::size_t>(start[last] - start[first]));
    std::vector<std::int64_t> next;
    for (Index c = first; c < last; ++c) next.push_back(start[c] - start[first]);
    for (Index j = 0; j < matrix.size(); ++j) {
      for (std::int64_t e = matrix.start[j]; e < matrix.start[j + 1]; ++e) {
        const Index i = matrix.row[e], column = column_of(i, j);
        if (column < first || column >= last) continue;
        const bool inside = joined[i] == joined[j] && i != j;  // stands for both triangles
        entries[static_cast<std::size_t>(next[column - first]++)] = {
            std::max(joined[i], joined[j]), inside ? 2 * matrix.value[e] : matrix.value[e]};
      }
    }
    for (Index c = first; c < last; ++c) {
      const auto begin = entries.begin() + (start[c] - start[first]);
      const auto end = entries.begin() + (start[c + 1] - start[first]);
      std::sort(begin, end, [](const auto& a, const auto& b) { return a.first < b.first; });
      for (auto at = begin; at != end; ++at) {
        if (at != begin && at->first == out.row.back()) {
          out.value.back() += at->second;
        } else {
          out.row.push_back(at->first);
          out.value.push_back(at->second);
        }
      }
      out.start.push_back(std::ssize(out.row));
    }
  }
  return out;
}

double product(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

struct Multigrid::Level {
  LowerMatrix matrix;
  std::vector<double> diagonal;
  Eigen::LLT<Eigen::MatrixXd> direct;  ///< of the last one
};

std::unique_ptr<const Multigrid> Multigrid::build(const SymmetricOperator& matrix) {
  if (matrix.size() < kWorthLevels || !matrix.kernel().empty()) return nullptr;
  {
    // The share of the diagonal that no neighbour takes up.
    constexpr double kMassive = 0.02;
    const std::vector<double> ones(static_cast<std::size_t>(matrix.size()), 1.0);
    std::vector<double> sums(ones.size());
    matrix.apply(ones, sums);
    double share = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) share += sums[i] / matrix.diagonal()[i];
    if (!(share < kMassive * static_cast<double>(sums.size()))) return nullptr;
  }
  std::unique_ptr<Multigrid> out(new Multigrid(matrix));
  const LowerMatrix* above = &matrix.assembled();
  while (above->size() > kDirect) {
    auto level = std::make_shared<Level>();
    std::vector<Index> joined(static_cast<std::size_t>(above->size()));
    std::iota(joined.begin(), joined.end(), 0);
    const LowerMatrix* from = above;
    for (int pass = 0; pass < 3; ++pass) {
      std::vector<Index> pairs;
      const Index count = join_pairs(*from, pairs);
      LowerMatrix next = joined_matrix(*from, pairs, count);
      level->matrix = std::move(next);
      from = &level->matrix;
      for (Index& each : joined) each = pairs[each];
    }
    constexpr double kMin = 0.6;  // else the levels cost more than they give
    if (!(level->matrix.size() < kMin * above->size())) return nullptr;
    for (Index j = 0; j < level->matrix.size(); ++j) {
      level->diagonal.push_back(
          level->matrix.value[static_cast<std::size_t>(level->matrix.start[j])]);
      if (!(level->diagonal.back() > 0)) return nullptr;
    }
    out->joined_.push_back(std::move(joined));
    above = &level->matrix;
    if (above->size() <= kDirect) {
      Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(above->size(), above->size());
      for (Index j = 0; j < above->size(); ++j) {
        for (std::int64_t e = above->start[j]; e < above->start[j + 1]; ++e) {
          dense(above->row[static_cast<std::size_t>(e)], j) =
              above->value[static_cast<std::size_t>(e)];
        }
      }
      level->direct.compute(dense);
      if (level->direct.info() != Eigen::Success) return nullptr;
    }
    out->levels_.push_back(std::move(level));
  }
  return out;
}

void Multigrid::apply(std::span<const double> r, std::span<double> z) const { cycle(0, r, z); }

void Multigrid::multiply(std::size_t level, std::span<const double> x, std::span<double> y) const {
  if (level == 0) return matrix_.apply(x, y);
  const LowerMatrix& matrix = levels_[level - 1]->matrix;
  std::fill(y.begin(), y.end(), 0.0);
  for (Index j = 0; j < matrix.size(); ++j) {
    auto e = static_cast<std::size_t>(matrix.start[j]);
    const double own = x[j];
    double sum = matrix.value[e] * own;
    for (++e; e < static_cast<std::size_t>(matrix.start[j + 1]); ++e) {
      const Index i = matrix.row[e];
      sum += matrix.value[e] * x[i];
      y[i] += matrix.value[e] * own;
    }
    y[j] += sum;
  }
}

std::span<const double> Multigrid::diagonal(std::size_t level) const {
  return level == 0 ? matrix_.diagonal() : std::span<const double>(levels_[level - 1]->diagonal);
}

/// Smooths, solves on the next level for what is left, smooths.
void Multigrid::cycle(std::size_t level, std::span<const double> r, std::span<double> z) const {
  if (level == levels_.size()) {
    const auto size = static_cast<Eigen::Index>(r.size());
    Eigen::Map<Eigen::VectorXd>(z.data(), size) =
        levels_.back()->direct.solve(Eigen::Map<const Eigen::VectorXd>(r.data(), size));
    return;
  }
  const std::span<const double> d = diagonal(level);
  std::vector<double> left(r.size());
  const auto find_left = [&] {
    multiply(level, z, left);
    for (std::size_t i = 0; i < r.size(); ++i) left[i] = r[i] - left[i];
  };
  for (std::size_t i = 0; i < r.size(); ++i) z[i] = kDamping * r[i] / d[i];
  find_left();
  const std::vector<Index>& joined = joined_[level];
  std::vector<double> b(levels_[level]->diagonal.size(), 0.0), x(b.size());
  for (std::size_t i = 0; i < r.size(); ++i) b[joined[i]] += left[i];
  solve_below(level + 1, b, x);
  for (std::size_t i = 0; i < r.size(); ++i) z[i] += x[joined[i]];
  find_left();
  for (std::size_t i = 0; i < r.size(); ++i) z[i] += kDamping * left[i] / d[i];
}

/// One or two steps of flexible conjugate gradients with the cycle of this level.
void Multigrid::solve_below(std::size_t level, std::span<const double> r,
                            std::span<double> x) const {
  cycle(level, r, x);
  if (level == levels_.size()) return;
  constexpr double kEnough = 0.25;
  std::vector<double> v(r.size()), left(r.size());
  multiply(level, x, v);
  const double rho = product(x, v), alpha = product(x, r);
  if (!(rho > 0)) return;
  for (std::size_t i = 0; i < r.size(); ++i) left[i] = r[i] - alpha / rho * v[i];
  if (product(left, left) <= kEnough * kEnough * product(r, r)) {
    for (double& each : x) each *= alpha / rho;
    return;
  }
  std::vector<double> c(r.size()), w(r.size());
  cycle(level, left, c);
  multiply(level, c, w);
  const double gamma = product(c, v), beta = product(c, w), second = product(c, left);
  const double rest = beta - gamma * gamma / rho;
  const bool both = rest > 0;
  const double of_x = alpha / rho - (both ? gamma * second / (rho * rest) : 0);
  const double of_c = both ? second / rest : 0;
  for (std::size_t i = 0; i < r.size(); ++i) x[i] = of_x * x[i] + of_c * c[i];
}

}  // namespace geotherm
