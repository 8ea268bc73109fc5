// SPDX-License-Identifier: MIT
#include "solver/geometry/fem_operator.h"

#include <algorithm>

#include "solver/core/parallel.h"

namespace geotherm {
namespace {

/// Share of a face's stiffness coupling that its mass coupling may take away.
constexpr double kMostOfStiffness = 0.5;

}  // namespace

FemOperator::FemOperator(std::shared_ptr<const OperatorMesh> mesh, double mass_factor,
                         PerComponent stiffness_factor, std::vector<Index> held,
                         PerComponent consistent_share)
    : mesh_(std::move(mesh)),
      mass_factor_(mass_factor),
      stiffness_factor_(std::move(stiffness_factor)),
      consistent_share_(std::move(consistent_share)),
      held_(std::move(held)) {
  diagonal_.resize(static_cast<std::size_t>(size()));
  for (Index i = 0; i < size(); ++i) {
    const double stiff = stiffness_factor_.of(mesh_->components.of[i]);
    diagonal_[i] = mass_factor_ * mesh_->mass[i] + stiff * mesh_->stiffness_diagonal[i];
  }
  if (consistent_share_.most() > 0) {
    for (std::size_t f = 0; f < mesh_->faces.size(); ++f) {
      const auto coupled = weights(f);
      const auto plain = stiffness(mesh_->layout[f]);
      const double stiff = of_face(stiffness_factor_, f);
      for (int k = 0; k < 3; ++k) {
        const double moved = coupled[k] + stiff * plain[k];
        const Index a = mesh_->faces[f][k];
        const Index b = mesh_->faces[f][next_corner(k)];
        if (a == b) continue;
        diagonal_[a] += moved;
        diagonal_[b] += moved;
      }
    }
  }
  if (held_.empty()) return;
  is_held_.assign(static_cast<std::size_t>(size()), 0);
  for (const Index i : held_) {
    is_held_[i] = 1;
    diagonal_[i] = 1;
  }
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
  for (double& weight : w) weight -= std::min(mass, kMostOfStiffness * std::max(weight, 0.0));
  return w;
}

Kernel FemOperator::kernel() const {
  if (mass_factor_ != 0 || !held_.empty()) return {};
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

void FemOperator::apply(std::span<const double> x, std::span<double> y) const {
  if (held_.empty()) {
    apply_free(x, y);
    return;
  }
  std::vector<double> masked(x.begin(), x.end());
  for (const Index i : held_) masked[i] = 0;
  apply_free(masked, y);
  for (const Index i : held_) y[i] = x[i];
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
  parallel_for(threads, std::ssize(mesh_->ranges), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t at = begin; at < end; ++at) {
      const FaceRange& range = mesh_->ranges[static_cast<std::size_t>(at)];
      for (Index i = range.first_row; i < range.end_row; ++i) {
        r.row(i) = b.row(i) - mass_factor_ * mesh_->mass[i] * x.row(i);
      }
      subtract_faces(range.first_face, range.end_face, x, r);
    }
  });
  subtract_faces(mesh_->crossing, mesh_->face_count(), x, r);
  for (const Index i : held_) r.row(i) = b.row(i) - x.row(i);
}

const LowerMatrix& FemOperator::assembled() const {
  if (!assembled_.value.empty()) return assembled_;
  assembled_.start = mesh_->lower.start;
  assembled_.row = mesh_->lower.row;
  std::vector<double>& value = assembled_.value;
  value.assign(assembled_.row.size(), 0.0);
  for (std::size_t f = 0; f < mesh_->faces.size(); ++f) {
    const std::array<double, 3> weight = weights(f);
    for (int k = 0; k < 3; ++k) {
      const std::int64_t entry = mesh_->entry[f][k];
      if (entry >= 0) value[entry] -= weight[k];
    }
  }
  for (Index j = 0; j < size(); ++j) {
    value[assembled_.start[j]] = diagonal_[j];
    if (is_held_.empty()) continue;
    for (std::int64_t e = assembled_.start[j] + 1; e < assembled_.start[j + 1]; ++e) {
      if (is_held_[j] || is_held_[assembled_.row[e]]) value[e] = 0;
    }
  }
  return assembled_;
}

}  // namespace geotherm
