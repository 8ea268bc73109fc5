// SPDX-License-Identifier: MIT
#include "solver/heat/normalize.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "solver/core/parallel.h"

namespace geotherm {
namespace {

/// Of the largest distance: values below 0 by less are what solvers leave of a 0.
constexpr double kRoundOff = 1e-6;

/// Vertices worth a thread, with one column.
constexpr std::int64_t kVerticesOfThread = 1 << 15;

/// What makes the mean of phi on the anchors of each component theirs: 0 where no source is.
void shift_to_mean(const Components& components, PoissonAnswer& answer,
                   std::span<const SourceAnchors> anchors) {
  Block& shift = answer.shift;
  shift = Block::Zero(components.count, answer.phi.cols());
  std::vector<Index> count(static_cast<std::size_t>(components.count));
  for (Eigen::Index c = 0; c < shift.cols(); ++c) {
    std::ranges::fill(count, 0);
    for (const auto& anchor : anchors[static_cast<std::size_t>(c)].anchors) {
      const Index component = components.of[anchor.row];
      shift(component, c) += anchor.offset - answer.phi(anchor.row, c);
      ++count[component];
    }
    for (Index k = 0; k < components.count; ++k) {
      if (count[k] > 0) shift(k, c) /= count[k];
    }
  }
}

/// The pass over the vertices, whose answers it takes from rows anywhere and writes in order.
class Scatter {
 public:
  Scatter(const Surface& surface, const PoissonAnswer& answer,
          std::span<const SourceAnchors> anchors, std::span<DistanceResult> results)
      : surface_(surface),
        phi_(answer.phi),
        columns_(answer.phi.cols()),
        unit_(surface.intrinsic.unit),
        most_(results.size(), 0.0),
        least_(results.size(), 0.0) {
    // +inf where no source is.
    add_ = Block::Constant(surface.operators->components.count, columns_, kUnreached);
    for (Eigen::Index c = 0; c < columns_; ++c) {
      for (const Index component : anchors[static_cast<std::size_t>(c)].components) {
        add_(component, c) = answer.shift.size() == 0 ? 0.0 : answer.shift(component, c);
      }
      DistanceResult& result = results[static_cast<std::size_t>(c)];
      result.distances.resize(surface.row_of_vertex.size());
      out_.push_back(result.distances.data());
    }
  }

  void run(int threads) {
    parallel_for(threads, std::ssize(surface_.row_of_vertex), kVerticesOfThread / columns_,
                 [this](std::int64_t begin, std::int64_t end) {
                   columns_ == 1 ? write<1>(begin, end) : write<0>(begin, end);
                 });
  }

  Index first_not_finite() const { return bad_; }
  /// Whether some phi of this column is below 0 by more than round-off.
  bool has_negative(std::size_t column) const {
    return least_[column] < -kRoundOff * most_[column];
  }
  Index count_negative(std::size_t column) const {
    const auto c = static_cast<Eigen::Index>(column);
    Index count = 0;
    for (Eigen::Index i = 0; i < phi_.rows(); ++i) {
      count +=
          phi_(i, c) + add_(surface_.operators->components.of[i], c) < -kRoundOff * most_[column];
    }
    return count;
  }

 private:
  /// K: the number of columns, or 0 for any.
  template <int K>
  void write(std::int64_t begin, std::int64_t end) {
    const Eigen::Index columns = K > 0 ? K : columns_;
    const auto& component = surface_.operators->components.of;
    const bool whole = surface_.operators->components.count == 1;
    std::vector<double> most(most_.size(), 0.0), least(most_.size(), 0.0);
    std::int64_t bad = end;
    for (std::int64_t v = begin; v < end; ++v) {
      const Index row = surface_.row_of_vertex[static_cast<std::size_t>(v)];
      const double* phi = phi_.data() + (row == kNoIndex ? 0 : row) * columns;
      const double* add = add_.data() + (whole || row == kNoIndex ? 0 : component[row]) * columns;
      for (Eigen::Index c = 0; c < columns; ++c) {
        double* const out = out_[static_cast<std::size_t>(c)] + v;
        if (row == kNoIndex || add[c] == kUnreached) {
          *out = kUnreached;
          continue;
        }
        const double distance = phi[c] + add[c];
        if (!std::isfinite(distance * unit_)) bad = std::min(bad, v);
        most[c] = distance > most[c] ? distance : most[c];
        least[c] = distance < least[c] ? distance : least[c];
        *out = (distance > 0 ? distance : 0.0) * unit_;
      }
    }
    const std::lock_guard lock(mutex_);
    if (bad < end)
      bad_ = bad_ == kNoIndex ? static_cast<Index>(bad) : std::min(bad_, static_cast<Index>(bad));
    for (std::size_t c = 0; c < most.size(); ++c) {
      most_[c] = std::max(most_[c], most[c]);
      least_[c] = std::min(least_[c], least[c]);
    }
  }

  const Surface& surface_;
  const Block& phi_;
  const Eigen::Index columns_;
  const double unit_;
  Block add_;  ///< components x K
  std::vector<double*> out_;
  std::mutex mutex_;
  std::vector<double> most_, least_;
  Index bad_ = kNoIndex;
};

double shift_of(const Surface& surface, const PoissonAnswer& answer, Index row,
                Eigen::Index column) {
  return answer.shift.size() == 0 ? 0.0
                                  : answer.shift(surface.operators->components.of[row], column);
}

}  // namespace

Result<void> normalize(const Surface& surface, PoissonAnswer& answer,
                       std::span<const SourceAnchors> anchors, ConstraintMode mode, int threads,
                       std::span<DistanceResult> results) {
  const bool pinned = mode == ConstraintMode::kPinSources;
  if (!pinned) shift_to_mean(surface.operators->components, answer, anchors);
  Scatter scatter(surface, answer, anchors, results);
  scatter.run(threads);
  if (const Index v = scatter.first_not_finite(); v != kNoIndex) {
    return Error{ErrorCode::kNumericalFailure,
                 "the distance of vertex " + std::to_string(v) +
                     " is not finite; try another backend or --laplacian intrinsic-delaunay"};
  }
  const double unit = surface.intrinsic.unit;
  for (std::size_t c = 0; c < results.size(); ++c) {
    const auto column = static_cast<Eigen::Index>(c);
    DistanceResult& result = results[c];
    for (const auto& anchor : anchors[c].anchors) {
      const double phi =
          answer.phi(anchor.row, column) + shift_of(surface, answer, anchor.row, column);
      const double off = std::abs(phi - anchor.offset) * unit;
      if (!(off <= result.quality.max_source_distance)) result.quality.max_source_distance = off;
      // Held: what was off is the solve's round-off.
      if (pinned) result.distances[surface.vertex_of_row[anchor.row]] = anchor.offset * unit;
    }
    if (scatter.has_negative(c)) result.quality.clamped_vertices = scatter.count_negative(c);
  }
  return {};
}

std::vector<double> shifted_phi(const Surface& surface, const PoissonAnswer& answer,
                                const SourceAnchors& anchors, ConstraintMode mode,
                                Eigen::Index column) {
  std::vector<double> out(static_cast<std::size_t>(answer.phi.rows()));
  for (Index i = 0; i < static_cast<Index>(out.size()); ++i) {
    out[i] = answer.phi(i, column) + shift_of(surface, answer, i, column);
  }
  if (mode != ConstraintMode::kPinSources) return out;
  for (const auto& anchor : anchors.anchors) out[anchor.row] = anchor.offset;
  return out;
}

std::vector<double> heat_in_file_order(const Surface& surface, const HeatField& heat,
                                       Eigen::Index column) {
  std::vector<double> out(static_cast<std::size_t>(surface.mesh->vertex_count()), 0.0);
  const double largest = heat.u.col(column).cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < heat.u.rows(); ++i) {
    const bool far =
        !heat.level.empty() && heat.level[static_cast<std::size_t>(i * heat.u.cols() + column)] > 0;
    if (!far && largest > 0) out[surface.vertex_of_row[i]] = heat.u(i, column) / largest;
  }
  return out;
}

std::vector<double> log_heat_in_file_order(const Surface& surface, const HeatField& heat,
                                           Eigen::Index column) {
  std::vector<double> out(static_cast<std::size_t>(surface.mesh->vertex_count()), -kUnreached);
  const double largest = std::log(heat.u.col(column).cwiseAbs().maxCoeff());
  const double step = std::log(heat.step);
  for (Eigen::Index i = 0; i < heat.u.rows(); ++i) {
    if (!(heat.u(i, column) > 0)) continue;
    const int level =
        heat.level.empty() ? 0 : heat.level[static_cast<std::size_t>(i * heat.u.cols() + column)];
    out[surface.vertex_of_row[i]] = std::log(heat.u(i, column)) + level * step - largest;
  }
  return out;
}

}  // namespace geotherm
