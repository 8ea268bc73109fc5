// SPDX-License-Identifier: MIT
#include "solver/heat/normalize.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "solver/core/memory.h"
#include "solver/core/parallel.h"

namespace geotherm {
namespace {

/// Values below 0 by less than this share of the largest distance are what solvers leave of a 0.
constexpr double kRoundOff = 1e-6;

/// Minimum vertices per thread, with one column.
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
  Scatter(const Domain& domain, const PoissonAnswer& answer, std::span<const SourceAnchors> anchors,
          std::span<DistanceResult> results)
      : domain_(domain),
        phi_(answer.phi),
        columns_(answer.phi.cols()),
        unit_(domain.unit),
        results_(results),
        most_(results.size(), 0.0),
        least_(results.size(), 0.0) {
    // +inf where no source is.
    add_ = Block::Constant(domain.parts_of_rows().count, columns_, kUnreached);
    for (Eigen::Index c = 0; c < columns_; ++c) {
      for (const Index component : anchors[static_cast<std::size_t>(c)].components) {
        add_(component, c) = answer.shift.size() == 0 ? 0.0 : answer.shift(component, c);
      }
    }
  }

  /// Columns are cut among threads by cache lines of them, and grow at their ends: no memory is
  /// cleared before it is written. Where threads are more than that, they are cut by vertices.
  void run(int threads) {
    const std::int64_t count = domain_.input_vertices;
    for (DistanceResult& result : results_) {
      result.distances.clear();
      result.distances.reserve(static_cast<std::size_t>(count));
      prefer_large_pages(result.distances.data(), static_cast<std::size_t>(count) * sizeof(double));
    }
    threads = piece_count(threads, count * columns_, kVerticesOfThread);
    if (threads <= columns_ / kAtOnce) {
      parallel_for(threads, columns_ / kAtOnce, 1, [&](std::int64_t begin, std::int64_t end) {
        const auto append = [this](Eigen::Index c, std::int64_t, const double* values,
                                   std::int64_t size) {
          std::vector<double>& out = results_[static_cast<std::size_t>(c)].distances;
          out.insert(out.end(), values, values + size);
        };
        const bool last = end == columns_ / kAtOnce;
        write_columns(begin * kAtOnce, last ? columns_ : end * kAtOnce, 0, count, append);
      });
      return;
    }
    for (DistanceResult& result : results_) {
      result.distances.resize(static_cast<std::size_t>(count));
    }
    parallel_for(threads, count, 1, [&](std::int64_t begin, std::int64_t end) {
      const auto put = [this](Eigen::Index c, std::int64_t first, const double* values,
                              std::int64_t size) {
        std::copy_n(values, size, results_[static_cast<std::size_t>(c)].distances.data() + first);
      };
      write_columns(0, columns_, begin, end, put);
    });
  }

  Index first_not_finite() const { return bad_; }
  /// Whether some phi of this column is below 0 by more than round-off.
  bool has_negative(std::size_t column) const {
    return least_[column] < -kRoundOff * most_[column];
  }
  /// But for those that have no part in the answer.
  Index count_negative(std::size_t column, std::span<const NearVertex> near) const {
    const auto c = static_cast<Eigen::Index>(column);
    Index count = 0;
    const auto is_negative = [&](Eigen::Index row) {
      if (!domain_.is_of_input(static_cast<Index>(row))) return false;
      const double add = add_(domain_.parts_of_rows().of[row], c);
      return phi_(row, c) + add < -kRoundOff * most_[column];
    };
    for (Eigen::Index row = 0; row < phi_.rows(); ++row) count += is_negative(row) ? 1 : 0;
    for (const NearVertex& vertex : near) {
      count -= vertex.share == 0 && is_negative(vertex.row) ? 1 : 0;
    }
    return count;
  }

 private:
  static constexpr int kAtOnce = 8;  ///< columns: a cache line
  /// Vertices whose distances are gathered before they are written: columns may lie at the same
  /// places of their pages, where a cache holds few of them side by side.
  static constexpr std::int64_t kTile = 128;
  /// Vertices ahead whose rows are asked for.
  static constexpr std::int64_t kAhead = 16;

  /// The first of these vertices with a value that is not finite.
  template <int K>
  std::int64_t first_bad(Eigen::Index first, std::int64_t begin, std::int64_t end) const {
    for (; begin < end; ++begin) {
      const Index row = domain_.row_of_vertex[static_cast<std::size_t>(begin)];
      if (row == kNoIndex) continue;
      for (Eigen::Index c = first; c < first + K; ++c) {
        const double add = add_(domain_.parts_of_rows().of[row], c);
        if (add != kUnreached && !std::isfinite((phi_(row, c) + add) * unit_)) return begin;
      }
    }
    return end;
  }

  template <class Sink>
  void write_columns(Eigen::Index first, Eigen::Index end_column, std::int64_t begin,
                     std::int64_t end, const Sink& sink) {
    for (; first + kAtOnce <= end_column; first += kAtOnce) write<kAtOnce>(first, begin, end, sink);
    for (; first < end_column; ++first) write<1>(first, begin, end, sink);
  }

  /// Calls sink(column, first vertex, values, count) for columns from `first` on, by pieces of the
  /// vertices.
  template <int K, class Sink>
  void write(Eigen::Index first, std::int64_t begin, std::int64_t end, const Sink& sink) {
    const auto& component = domain_.parts_of_rows().of;
    const bool whole = domain_.parts_of_rows().count == 1;
    const Index* const row_of = domain_.row_of_vertex.data();
    double most[K] = {}, least[K] = {}, tile[K][kTile];
    std::int64_t bad = end;
    for (std::int64_t next = begin; begin < end; begin = next) {
      next = std::min(end, begin + kTile);
      bool finite = true;
      for (std::int64_t v = begin; v < next; ++v) {
        if (v + kAhead < end && row_of[v + kAhead] != kNoIndex) {
          __builtin_prefetch(phi_.data() + row_of[v + kAhead] * columns_ + first);
        }
        const Index row = row_of[v];
        if (row == kNoIndex) {
          for (int c = 0; c < K; ++c) tile[c][v - begin] = kUnreached;
          continue;
        }
        const double* const phi = phi_.data() + row * columns_ + first;
        const double* const add = add_.data() + (whole ? 0 : component[row]) * columns_ + first;
        for (int c = 0; c < K; ++c) {
          const double distance = phi[c] + add[c];
          const bool reached = add[c] < kUnreached;
          tile[c][v - begin] = reached ? (distance > 0 ? distance : 0.0) * unit_ : kUnreached;
          if (!reached) continue;
          finite = finite && std::abs(distance) * unit_ < kUnreached;
          most[c] = distance > most[c] ? distance : most[c];
          least[c] = distance < least[c] ? distance : least[c];
        }
      }
      if (!finite && bad == end) bad = first_bad<K>(first, begin, next);
      for (int c = 0; c < K; ++c) sink(first + c, begin, tile[c], next - begin);
    }
    const std::lock_guard lock(mutex_);
    if (bad < end && (bad_ == kNoIndex || bad < bad_)) bad_ = static_cast<Index>(bad);
    for (int c = 0; c < K; ++c) {
      const auto column = static_cast<std::size_t>(first + c);
      most_[column] = std::max(most_[column], most[c]);
      least_[column] = std::min(least_[column], least[c]);
    }
  }

  const Domain& domain_;
  const Block& phi_;
  const Eigen::Index columns_;
  const double unit_;
  std::span<DistanceResult> results_;
  Block add_;  ///< components x K
  std::mutex mutex_;
  std::vector<double> most_, least_;
  Index bad_ = kNoIndex;
};

double shift_of(const Components& components, const PoissonAnswer& answer, Index row,
                Eigen::Index column) {
  return answer.shift.size() == 0 ? 0.0 : answer.shift(components.of[row], column);
}

}  // namespace

Hint no_answer_hint(ConstraintMode mode) {
  if (mode != ConstraintMode::kPenalty) return {"try another backend"};
  return {"raise the penalty, or use ", SettingHint{"constraint", {"pin-sources"}}};
}

Result<void> normalize(const Domain& domain, PoissonAnswer& answer,
                       std::span<const SourceAnchors> anchors,
                       std::span<const std::vector<NearVertex>> near, ConstraintMode mode,
                       int threads, std::span<DistanceResult> results) {
  const bool pinned = mode == ConstraintMode::kPinSources;
  const Components& components = domain.parts_of_rows();
  if (!pinned) shift_to_mean(components, answer, anchors);
  Scatter scatter(domain, answer, anchors, results);
  scatter.run(threads);
  if (const Index v = scatter.first_not_finite(); v != kNoIndex) {
    return Error{ErrorCode::kNumericalFailure,
                 "the distance of vertex " + std::to_string(v) + " is not finite",
                 no_answer_hint(mode)};
  }
  const double unit = domain.unit;
  for (std::size_t c = 0; c < results.size(); ++c) {
    const auto column = static_cast<Eigen::Index>(c);
    DistanceResult& result = results[c];
    for (const auto& anchor : anchors[c].anchors) {
      const double phi =
          answer.phi(anchor.row, column) + shift_of(components, answer, anchor.row, column);
      const double off = std::abs(phi - anchor.offset) * unit;
      if (!(off <= result.quality.max_source_distance)) result.quality.max_source_distance = off;
      // Held: what was off is the solve's round-off.
      if (!pinned || !domain.is_of_input(anchor.row)) continue;
      result.distances[domain.vertex_of_row[anchor.row]] = anchor.offset * unit;
    }
    const std::span<const NearVertex> near_here =
        near.empty() ? std::span<const NearVertex>() : near[c];
    if (scatter.has_negative(c)) {
      result.quality.clamped_vertices = scatter.count_negative(c, near_here);
    }
    for (const NearVertex& vertex : near_here) {
      if (!domain.is_of_input(vertex.row)) continue;
      double& distance = result.distances[domain.vertex_of_row[vertex.row]];
      distance = vertex.share * distance + (1 - vertex.share) * vertex.distance * unit;
    }
  }
  return {};
}

std::vector<double> shifted_phi(const Domain& domain, const PoissonAnswer& answer,
                                const SourceAnchors& anchors, ConstraintMode mode,
                                Eigen::Index column) {
  const Components& components = domain.parts_of_rows();
  std::vector<double> out(static_cast<std::size_t>(answer.phi.rows()));
  for (Index i = 0; i < static_cast<Index>(out.size()); ++i) {
    out[i] = answer.phi(i, column) + shift_of(components, answer, i, column);
  }
  if (mode != ConstraintMode::kPinSources) return out;
  for (const auto& anchor : anchors.anchors) out[anchor.row] = anchor.offset;
  return out;
}

std::vector<double> heat_in_file_order(const Domain& domain, const HeatField& heat,
                                       Eigen::Index column) {
  std::vector<double> out(static_cast<std::size_t>(domain.input_vertices), 0.0);
  const double largest = heat.u.col(column).cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < heat.u.rows(); ++i) {
    const bool far =
        !heat.level.empty() && heat.level[static_cast<std::size_t>(i * heat.u.cols() + column)] > 0;
    if (!far && largest > 0 && domain.is_of_input(static_cast<Index>(i)))
      out[domain.vertex_of_row[i]] = heat.u(i, column) / largest;
  }
  return out;
}

std::vector<double> log_heat_in_file_order(const Domain& domain, const HeatField& heat,
                                           Eigen::Index column) {
  std::vector<double> out(static_cast<std::size_t>(domain.input_vertices), -kUnreached);
  const double largest = std::log(heat.u.col(column).cwiseAbs().maxCoeff());
  const double step = std::log(heat.step);
  for (Eigen::Index i = 0; i < heat.u.rows(); ++i) {
    if (!(heat.u(i, column) > 0) || !domain.is_of_input(static_cast<Index>(i))) continue;
    const int level =
        heat.level.empty() ? 0 : heat.level[static_cast<std::size_t>(i * heat.u.cols() + column)];
    out[domain.vertex_of_row[i]] = std::log(heat.u(i, column)) + level * step - largest;
  }
  return out;
}

}  // namespace geotherm
