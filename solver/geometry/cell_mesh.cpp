// SPDX-License-Identifier: MIT
#include "solver/geometry/cell_mesh.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <numeric>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"

namespace geotherm {
namespace {

/// Mass is consistent on cells up to the first width, in means of their component, and lumped from
/// the second one on: there t is too short for the pairs of the consistent mass to leave u above 0.
constexpr double kConsistentWidth = 1.6, kLumpedWidth = 3.2;

/// Minimum rows or cells per thread.
constexpr std::int64_t kCellGrain = 1 << 12;

/// Builds the parts of a CellMesh one after the other.
class CellMeshBuilder {
 public:
  CellMeshBuilder(const CellComplex& cells, const CellPattern& pattern,
                  std::span<const Index> order, double unit, int threads, CellMesh& out)
      : cells_(cells), pattern_(pattern), unit_(unit), threads_(threads), out_(out) {
    const std::vector<Index> position = inverse_permutation(order, threads);
    row_of_.assign(pattern.local.size(), kNoIndex);
    for (std::size_t v = 0; v < row_of_.size(); ++v) {
      if (pattern.local[v] != kNoIndex) row_of_[v] = position[pattern.local[v]];
    }
    size_ = static_cast<Index>(order.size());
  }

  void sort_cells() {
    const auto count = static_cast<std::size_t>(cells_.cell_count());
    out_.dimension = cells_.dimension;
    out_.given_cell =
        sorted_by_key(count, static_cast<std::size_t>(size_), threads_,
                      [&](std::size_t c) { return low_high(static_cast<Index>(c)).first; });
    out_.ranges = part_by_rows(size_, out_.given_cell, [&](Index c) { return low_high(c); });
    out_.crossing = out_.ranges.back().end_cell;
    const double mean = std::accumulate(cells_.measures.begin(), cells_.measures.end(), 0.0) /
                        static_cast<double>(count);
    out_.start.resize(count + 1);
    out_.start[0] = 0;
    for (std::size_t c = 0; c < count; ++c) {
      out_.start[c + 1] = out_.start[c] + std::ssize(cells_.corners_of(out_.given_cell[c]));
    }
    out_.is_of_tets =
        cells_.dimension == 3 && std::ranges::adjacent_find(out_.start, [](auto a, auto b) {
                                   return b - a != 4;
                                 }) == out_.start.end();
    out_.corners.resize(static_cast<std::size_t>(out_.start.back()));
    out_.gradients.resize(out_.corners.size() * static_cast<std::size_t>(cells_.dimension));
    if (!cells_.shares.empty()) out_.shares.resize(out_.corners.size());
    out_.measures.resize(count);
    out_.widths.resize(count);
    parallel_each(threads_, std::ssize(out_.measures), kCellGrain,
                  [&](std::int64_t c) { copy_cell(c, mean); });
  }

  void add_up_masses() {
    out_.mass.assign(static_cast<std::size_t>(size_), 0.0);
    for (Index c = 0; c < out_.cell_count(); ++c) {
      const auto corners = out_.corners_of(c);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        out_.mass[corners[k]] += out_.measures[c] * share(c, static_cast<std::ptrdiff_t>(k));
      }
    }
  }

  void average_widths() {
    const auto parts = static_cast<std::size_t>(out_.components.count);
    out_.mean_width.assign(parts, 0.0);
    std::vector<Index> cells(parts, 0);
    for (Index c = 0; c < out_.cell_count(); ++c) {
      const Index part = out_.components.of[out_.corners_of(c).front()];
      out_.mean_width[part] += out_.widths[c];
      ++cells[part];
    }
    for (std::size_t part = 0; part < parts; ++part) out_.mean_width[part] /= cells[part];
  }

  void add_up_stiffness(std::span<const Index> order) {
    out_.pattern = pattern_hash(permuted_lower(pattern_.pattern, order, threads_), threads_);
    const SymmetricPattern rows = permuted(pattern_.pattern, order, threads_);
    out_.row_start = rows.start;
    out_.column.assign(rows.neighbor.begin(), rows.neighbor.end());
    out_.entry.resize(rows.neighbor.size());
    if (cells_.dimension == 2) out_.shared_mass.resize(rows.neighbor.size());
    out_.cells_at = CellTable(size_, out_.cell_count(), threads_,
                              [this](Index c) { return out_.corners_of(c); });
    parallel_each<Index>(threads_, size_, kCellGrain,
                         [&](Index i) { add_up_row(i, out_.cells_at.at(i)); });
  }

 private:
  void copy_cell(std::int64_t c, double mean) {
    const Index given = out_.given_cell[c];
    const auto corners = cells_.corners_of(given);
    const auto d = static_cast<std::int64_t>(cells_.dimension);
    std::ranges::transform(corners, out_.corners.begin() + out_.start[c],
                           [this](Index v) { return row_of_[v]; });
    const double* const from = cells_.gradients.data() + cells_.start[given] * d;
    std::transform(from, from + std::ssize(corners) * d, out_.gradients.begin() + out_.start[c] * d,
                   [this](double g) { return g * unit_; });
    if (!out_.shares.empty()) {
      std::copy_n(cells_.shares.begin() + cells_.start[given], corners.size(),
                  out_.shares.begin() + out_.start[c]);
    }
    out_.measures[c] = cells_.measures[given] / mean;
    out_.widths[c] = cells_.widths[given] / unit_;
  }

  /// Sums what the cells at row i give its pairs, in their order.
  void add_up_row(Index i, std::span<const Index> cells) {
    const std::int64_t first = out_.row_start[i];
    const auto columns =
        std::span(out_.column.data() + first, out_.column.data() + out_.row_start[i + 1]);
    double* const entries = out_.entry.data() + first;
    std::fill_n(entries, columns.size(), 0.0);
    double* const shared = out_.shared_mass.empty() ? nullptr : out_.shared_mass.data() + first;
    if (shared != nullptr) std::fill_n(shared, columns.size(), 0.0);
    const int d = out_.dimension;
    for (const Index c : cells) {
      const auto corners = out_.corners_of(c);
      const double* const g = out_.gradients_of(c);
      const auto own = std::ranges::find(corners, i) - corners.begin();
      for (std::ptrdiff_t k = 0; k < std::ssize(corners); ++k) {
        if (k == own) continue;
        double product = 0;
        for (int e = 0; e < d; ++e) product += g[own * d + e] * g[k * d + e];
        product *= out_.measures[c];
        const auto place = std::ranges::lower_bound(columns, corners[k]) - columns.begin();
        entries[place] += product;
        if (shared != nullptr) {
          const double width = out_.widths[c] / out_.mean_width[out_.components.of[i]];
          const double consistent =
              std::clamp((kLumpedWidth - width) / (kLumpedWidth - kConsistentWidth), 0.0, 1.0);
          shared[place] += consistent * out_.measures[c] * consistent_mass(c, own, k);
        }
      }
    }
  }

  /// Corner k's share of the measure of cell c.
  double share(Index c, std::ptrdiff_t k) const {
    if (out_.shares.empty()) return 1 / static_cast<double>(out_.corners_of(c).size());
    return out_.shares[static_cast<std::size_t>(out_.start[c] + k)];
  }

  std::pair<Index, Index> low_high(Index c) const {
    Index low = size_, high = 0;
    for (const Index v : cells_.corners_of(c)) {
      low = std::min(low, row_of_[v]);
      high = std::max(high, row_of_[v]);
    }
    return {low, high};
  }

  /// The entry of the consistent mass matrix for two corners of a plane cell with the measure 1. It
  /// is proportional to the shares of both: for a triangle, whose shares are 1/3, it is 1/12, the
  /// integral of the product of two hat functions.
  double consistent_mass(Index c, std::ptrdiff_t i, std::ptrdiff_t j) const {
    constexpr double kOfTriangle = 0.75;
    return kOfTriangle * share(c, i) * share(c, j);
  }

  const CellComplex& cells_;
  const CellPattern& pattern_;
  const double unit_;
  const int threads_;
  CellMesh& out_;
  std::vector<Index> row_of_;  ///< V
  Index size_ = 0;
};

}  // namespace

Eigen::Matrix3d inverse_along(const Eigen::Matrix3d& square) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(square);
  const Vec3& sizes = axes.eigenvalues();  // ascending
  const double rounded = 3 * std::numeric_limits<double>::epsilon() * sizes[2];
  Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = axes.eigenvectors().col(i);
    if (sizes[i] > rounded) out += axis * axis.transpose() / sizes[i];
  }
  return out;
}

CellPattern pattern_of_cells(const CellComplex& cells, int threads) {
  CellPattern out;
  std::vector<char> used(static_cast<std::size_t>(cells.vertices), 0);
  for (const Index v : cells.corners) used[v] = 1;
  out.local.assign(used.size(), kNoIndex);
  for (Index v = 0; v < cells.vertices; ++v) {
    if (!used[v]) continue;
    out.local[v] = static_cast<Index>(out.vertices.size());
    out.vertices.push_back(v);
  }
  const CellTable at(cells.vertices, cells.cell_count(), threads,
                     [&cells](Index c) { return cells.corners_of(c); });
  const auto add_neighbors = [&](Index i, std::vector<Index>& row) {
    const Index vertex = out.vertices[i];
    const auto begin = static_cast<std::ptrdiff_t>(row.size());
    std::span<const Index> before;
    for (const Index c : at.at(vertex)) {
      const auto corners = cells.corners_of(c);
      if (std::ranges::equal(corners, before)) continue;  // as the triangles of a polygon are
      before = corners;
      for (const Index v : corners) {
        if (v != vertex) row.push_back(out.local[v]);
      }
    }
    std::sort(row.begin() + begin, row.end());
    row.erase(std::unique(row.begin() + begin, row.end()), row.end());
  };
  list_rows(static_cast<Index>(out.vertices.size()), threads, add_neighbors, out.pattern.start,
            out.pattern.neighbor);
  out.parts = connected_components(out.pattern);
  return out;
}

std::shared_ptr<const CellMesh> build_cell_mesh(const CellComplex& cells,
                                                const CellPattern& pattern,
                                                std::span<const Index> order, double unit,
                                                int threads) {
  auto out = std::make_shared<CellMesh>();
  CellMeshBuilder builder(cells, pattern, order, unit, threads, *out);
  builder.sort_cells();
  builder.add_up_masses();
  name_components(pattern.parts, order, out->components);
  builder.average_widths();
  builder.add_up_stiffness(order);
  return out;
}

}  // namespace geotherm
