// SPDX-License-Identifier: MIT
#include "solver/geometry/fem_operator.h"

#include <algorithm>
#include <mutex>

#include "solver/core/parallel.h"
#include "solver/core/processor.h"

namespace geotherm {
namespace {

/// Minimum vertices per thread.
constexpr std::int64_t kMinRowsPerThread = 1 << 12;

/// Minimum ranges of faces per thread, of passes that look at few faces.
constexpr std::int64_t kRangesPerThread = 4;
/// Faces of which is asked together whether their rows are all alike.
constexpr Index kFacesAtOnce = 8;

/// The consistent mass may cancel at most this share of a face's stiffness coupling.
constexpr double kMaxOfStiffness = 0.5;

}  // namespace

FemOperator::FemOperator(std::shared_ptr<const OperatorMesh> mesh, double mass_factor,
                         PerComponent stiffness_factor, std::vector<Index> held,
                         PerComponent consistent_share, int threads)
    : DomainOperator(mesh->size(), std::move(held)),
      mesh_(std::move(mesh)),
      mass_factor_(mass_factor),
      stiffness_factor_(std::move(stiffness_factor)),
      consistent_share_(std::move(consistent_share)),
      threads_(threads) {
  diagonal_.resize(static_cast<std::size_t>(size()));
  set_diagonal();
  for (const Index i : this->held()) diagonal_[i] = 1;
}

RawVector<double> FemOperator::side_weights(std::span<const char> wanted) const {
  RawVector<double> weight(3 * mesh_->faces.size());
  parallel_each<std::size_t>(threads_, mesh_->face_count(), kMinRowsPerThread, [&](std::size_t f) {
    const auto [i, j, k] = mesh_->faces[f];
    if (!wanted.empty() && (wanted[i] | wanted[j] | wanted[k]) == 0) return;
    const std::array<double, 3> w = weights(f);
    std::ranges::copy(w, weight.data() + 3 * f);
  });
  return weight;
}

/// The row sums of the mass matrix are the lumped masses; a consistent mass moves a part of them
/// from the diagonal to the pairs of corners.
void FemOperator::set_diagonal() {
  const bool lumped = !(consistent_share_.most() > 0);
  const RawVector<double> weight = lumped ? RawVector<double>() : side_weights();
  parallel_each<Index>(threads_, size(), kMinRowsPerThread, [&](Index i) {
    const double mass = mass_factor_ * mesh_->mass[i];
    if (lumped) {
      const double stiff = stiffness_factor_.of(mesh_->components.of[i]);
      diagonal_[i] = mass + stiff * mesh_->stiffness_diagonal[i];
      return;
    }
    double sum = 0;
    for (const Side corner : mesh_->corners.at(i)) {
      const Face& face = mesh_->faces[face_of(corner)];
      const int k = corner_of(corner), before = previous_corner(k);
      if (face[next_corner(k)] != i) sum += weight[corner];
      if (face[before] != i) sum += weight[corner - k + before];
    }
    diagonal_[i] = mass + sum;
  });
}

std::array<double, 3> FemOperator::weights(std::size_t face) const {
  const FaceLayout& p = mesh_->layout[face];
  const double stiff = of_face(stiffness_factor_, face);
  const double share = of_face(consistent_share_, face);
  std::array<double, 3> w = stiffness(p);
  for (double& weight : w) weight *= -stiff;
  if (!(share > 0)) return w;
  // The consistent mass couples each pair by area / 12; no more of it than half of what the
  // stiffness couples, so that M keeps the signs that make u positive.
  const double mass = share * mass_factor_ * p.base * p.height / 24;
  for (double& weight : w) weight -= std::min(mass, kMaxOfStiffness * std::max(weight, 0.0));
  return w;
}

Kernel FemOperator::kernel() const {
  if (mass_factor_ != 0 || !held().empty()) return {};
  return {mesh_->components.of, mesh_->components.count};
}

void FemOperator::apply_free(std::span<const double> x, std::span<double> y) const {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = mass_factor_ * mesh_->mass[i] * x[i];
  for (std::size_t f = 0; f < mesh_->faces.size(); ++f) {
    const Face& face = mesh_->faces[f];
    const auto w = weights(f);
    for (int k = 0; k < 3; ++k) {
      const Index a = face[k];
      const Index b = face[next_corner(k)];
      const double flow = w[k] * (x[a] - x[b]);
      y[a] += flow;
      y[b] -= flow;
    }
  }
}

double FemOperator::product_at(Index i, const std::function<double(Index)>& x) const {
  const double own = x(i);
  if (is_held(i)) return own;
  const auto free = [&](Index j) { return is_held(j) ? 0.0 : x(j); };
  double sum = mass_factor_ * mesh_->mass[i] * own;
  for (const Side corner : mesh_->corners.at(i)) {
    const Index f = face_of(corner);
    const auto w = weights(static_cast<std::size_t>(f));
    const int k = corner_of(corner), before = previous_corner(k);
    sum += w[k] * (own - free(mesh_->faces[f][next_corner(k)]));
    sum += w[before] * (own - free(mesh_->faces[f][before]));
  }
  return sum;
}

void FemOperator::subtract_faces(Index first_face, Index end_face, const Block& x, Block& r) const {
  for (Index f = first_face; f < end_face; ++f) {
    const Face& face = mesh_->faces[f];
    const auto w = weights(static_cast<std::size_t>(f));
    for (int k = 0; k < 3; ++k) {
      const Index a = face[k];
      const Index b = face[next_corner(k)];
      const double of_a = is_held(a) ? 0.0 : w[k];  // columns of held rows are the identity's
      const double of_b = is_held(b) ? 0.0 : w[k];
      for (Eigen::Index c = 0; c < x.cols(); ++c) {
        const double flow = of_a * x(a, c) - of_b * x(b, c);
        r(a, c) -= flow;
        r(b, c) += flow;
      }
    }
  }
}

void FemOperator::residual(const Block& b, const Block& x, Block& r, int threads) const {
  for_ranges(mesh_->ranges, threads, 1, [&](const RowRange& range) {
    const FlushDenormals flush;
    for (Index i = range.first_row; i < range.end_row; ++i) {
      r.row(i) = b.row(i) - mass_factor_ * mesh_->mass[i] * x.row(i);
    }
    subtract_faces(range.first_cell, range.end_cell, x, r);
  });
  const FlushDenormals flush;
  subtract_faces(mesh_->crossing, mesh_->face_count(), x, r);
  for (const Index i : held()) r.row(i) = b.row(i) - x.row(i);
}

void FemOperator::list_row(Index i, std::vector<Index>& columns,
                           std::vector<double>& values) const {
  const auto begin = std::ssize(columns);
  columns.push_back(i);
  values.push_back(diagonal_[i]);
  if (is_held(i)) return;
  const auto subtract = [&](Index j, double weight) {
    if (j == i || is_held(j)) return;
    const auto at = std::find(columns.begin() + begin, columns.end(), j);
    if (at != columns.end()) {
      values[static_cast<std::size_t>(at - columns.begin())] -= weight;
      return;
    }
    columns.push_back(j);
    values.push_back(-weight);
  };
  for (const Side corner : mesh_->corners.at(i)) {
    const Face& face = mesh_->faces[face_of(corner)];
    const auto w = weights(static_cast<std::size_t>(face_of(corner)));
    const int k = corner_of(corner), before = previous_corner(k);
    subtract(face[next_corner(k)], w[k]);
    subtract(face[before], w[before]);
  }
}

void FemOperator::list_neighbors(Index i, std::vector<Index>& rows) const {
  for (const Side corner : mesh_->corners.at(i)) {
    for (const Index j : mesh_->faces[face_of(corner)]) rows.push_back(j);
  }
}

/// Faces are only looked at one by one where rows differ.
std::vector<ColumnSet> FemOperator::columns_beside(std::span<const ColumnSet> sets, int threads,
                                                   std::vector<Index>& listed) const {
  std::vector<ColumnSet> out(sets.size());
  const auto take = [&](const Face& face, std::vector<Index>& here) {
    const auto some = static_cast<ColumnSet>(sets[face[0]] | sets[face[1]] | sets[face[2]]);
    for (const Index i : face) {
      const auto near = static_cast<ColumnSet>(some & ~sets[i]);
      if (near == 0) continue;
      if (out[i] == 0) here.push_back(i);
      out[i] |= near;
    }
  };
  const auto look = [&](Index first, Index end, std::vector<Index>& here) {
    for (Index f = first; f < end; f += kFacesAtOnce) {
      const Index next = std::min(f + kFacesAtOnce, end);
      unsigned some = 0, all = ~0U;
      prefetch_ahead(mesh_->faces.data() + f, kFacesAtOnce);
      for (Index g = f; g < next; ++g) {
        const auto [i, j, k] = mesh_->faces[g];
        const unsigned a = sets[i], b = sets[j], c = sets[k];
        some |= a | b | c;
        all &= a & b & c;
      }
      if (some == all) continue;  // as a rule
      for (Index g = f; g < next; ++g) take(mesh_->faces[g], here);
    }
  };
  std::mutex mutex;
  for_ranges(mesh_->ranges, threads, kRangesPerThread, [&](const RowRange& range) {
    unsigned some = 0, all = ~0U;
    for (Index i = range.first_row; i < range.end_row; ++i) {
      some |= sets[i];
      all &= sets[i];
    }
    if (some == all) return;
    std::vector<Index> here;
    look(range.first_cell, range.end_cell, here);
    const std::lock_guard lock(mutex);
    listed.insert(listed.end(), here.begin(), here.end());
  });
  look(mesh_->crossing, mesh_->face_count(), listed);
  return out;
}

const LowerMatrix& FemOperator::assembled() const { return assembled_where({}); }

const LowerMatrix& FemOperator::assembled_where(std::span<const char> wanted) const {
  if (has_all_) return assembled_;
  assembled_.start = mesh_->lower.start;
  assembled_.row = mesh_->lower.row;
  const RawVector<double> weight = side_weights(wanted);
  assembled_.value.assign(assembled_.row.size(), 0.0);
  parallel_each<Index>(threads_, size(), kMinRowsPerThread, [&](Index j) {
    if (wanted.empty() || wanted[j] != 0) assemble_column(j, weight);
  });
  has_all_ = wanted.empty();
  return assembled_;
}

/// Adds up what the faces at vertex j give its pairs with later vertices, in their order.
void FemOperator::assemble_column(Index j, const RawVector<double>& weight) const {
  const std::int64_t begin = assembled_.start[j];
  const Index* const rows = assembled_.row.data() + begin;
  double* const values = assembled_.value.data() + begin;
  const auto count = static_cast<std::size_t>(assembled_.start[j + 1] - begin);
  // Places are found by counting, without branches that a processor would mispredict; entries of
  // earlier columns land on the diagonal, which is set last.
  const auto subtract = [&](Index row, Side side) {
    std::size_t entry = 1;
    for (std::size_t e = 1; e < count; ++e) entry += rows[e] < row ? 1 : 0;
    values[row > j ? entry : 0] -= weight[side];
  };
  for (const Side corner : mesh_->corners.at(j)) {
    const Face& face = mesh_->faces[face_of(corner)];
    const int k = corner_of(corner), before = previous_corner(k);
    subtract(face[next_corner(k)], corner);
    subtract(face[before], corner - k + before);
  }
  values[0] = diagonal_[j];
  if (held().empty()) return;
  for (std::size_t e = 1; e < count; ++e) {
    if (is_held(j) || is_held(rows[e])) values[e] = 0;
  }
}

}  // namespace geotherm
