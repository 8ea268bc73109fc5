// SPDX-License-Identifier: MIT
#include "solver/heat/far_field.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>

namespace geotherm {
namespace {

/// More levels than this many floors: 255 * 280 decades for direct solvers.
constexpr int kMostLevels = 255;
/// Rows to ask that are worth a thread: some 0.1 ms.
constexpr std::int64_t kRowsOfThread = 1000;

}  // namespace

FarField::FarField(const LinearSystem& system, const Components& components,
                   const std::vector<std::vector<char>>& reached, double floor,
                   const Workspace& work, HeatField& field)
    : system_(system),
      components_(components),
      reached_(reached),
      floor_(floor),
      work_(work),
      field_(field) {}

Result<void> FarField::extend(std::span<const Eigen::Index> columns, const Progress& progress) {
  columns_.assign(columns.begin(), columns.end());
  Rows rows;
  rows.far = below(0);
  std::vector<std::int64_t> far_count = count(rows.far);
  for (int level = 1; !columns_.empty() && level <= kMostLevels; ++level) {
    // How many levels there will be is not known: each has half of the rest.
    const double rest = std::pow(0.5, level);
    if (!report(progress, "solve", 1 - rest)) return cancelled_error();
    Block right = work_.take_zero(field_.u.rows(), std::ssize(columns_));
    ask(rows, level - 1, right);
    if (rows.asked.empty()) return {};
    std::vector<char> wanted(rows.far.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = rows.far[i] != 0;
    const auto solved = system_.invert_where(right, rows.asked, wanted, work_,
                                             part_of(progress, 1 - rest, 1 - rest / 2));
    if (!solved) return solved.error();
    field_.iterations += solved->iterations;
    const Columns goes_on = heated(rows.far, right);  // the others are cut off by held vertices
    if (goes_on != 0) take(rows.far, goes_on, level, right);
    work_.pool.give(std::move(right));

    std::vector<Columns> next = below(level);
    const std::vector<std::int64_t> next_count = count(next);
    std::vector<Eigen::Index> kept;
    std::vector<std::int64_t> kept_count;
    std::vector<int> bits;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if ((goes_on >> k & 1) == 0 || next_count[k] == 0 || next_count[k] >= far_count[k]) continue;
      kept.push_back(columns_[k]);
      kept_count.push_back(next_count[k]);
      bits.push_back(static_cast<int>(k));
    }
    if (kept.size() < columns_.size()) {
      for (Columns& row : next) {
        Columns renamed = 0;
        for (std::size_t k = 0; k < bits.size(); ++k) {
          renamed = static_cast<Columns>(renamed | (row >> bits[k] & 1) << k);
        }
        row = renamed;
      }
    }
    columns_ = std::move(kept);
    far_count = std::move(kept_count);
    rows.far = std::move(next);
  }
  return {};
}

/// Reached, free entries of this level whose value is below the floor times the largest of this
/// level in their component: sizes of components differ, and with them the heat in them.
std::vector<FarField::Columns> FarField::below(int level) const {
  const auto count = std::ssize(columns_);
  Block least = Block::Zero(components_.count, count);  // at first the largest
  std::mutex mutex;
  work_.for_rows(field_.u.rows(), count, [&](std::int64_t begin, std::int64_t end) {
    Block most = Block::Zero(components_.count, count);
    for (auto i = static_cast<Index>(begin); i < end; ++i) {
      const Index component = components_.of[i];
      for (Eigen::Index k = 0; k < count; ++k) {
        if (level_of(i, columns_[k]) != level) continue;
        most(component, k) = std::max(most(component, k), std::abs(field_.u(i, columns_[k])));
      }
    }
    const std::lock_guard lock(mutex);
    least = least.cwiseMax(most);
  });
  for (Index component = 0; component < components_.count; ++component) {
    for (Eigen::Index k = 0; k < count; ++k) {
      const bool reached = reached_[static_cast<std::size_t>(columns_[k])][component] != 0;
      least(component, k) *= reached ? floor_ : 0.0;
    }
  }
  std::vector<Columns> out(static_cast<std::size_t>(field_.u.rows()));
  work_.for_rows(field_.u.rows(), count, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<Index>(begin); i < end; ++i) {
      unsigned small = 0;
      for (Eigen::Index k = 0; k < count; ++k) {
        const bool is_small = std::abs(field_.u(i, columns_[k])) < least(components_.of[i], k);
        if (is_small && level_of(i, columns_[k]) == level) small |= 1U << k;
      }
      out[i] = static_cast<Columns>(system_.matrix().is_held(i) ? 0 : small);
    }
  });
  return out;
}

/// Of each column.
std::vector<std::int64_t> FarField::count(const std::vector<Columns>& rows) const {
  std::vector<std::int64_t> counts(columns_.size());
  for (unsigned row : rows) {
    for (; row != 0; row &= row - 1) ++counts[static_cast<std::size_t>(std::countr_zero(row))];
  }
  return counts;
}

/// Entries that share a face with one of these and are not far.
std::vector<FarField::Columns> FarField::beside(const std::vector<Columns>& rows,
                                                const std::vector<Columns>& far) const {
  const OperatorMesh& mesh = system_.matrix().mesh();
  std::vector<Columns> out(rows.size());
  const auto look = [&](Index first, Index end) {
    for (Index f = first; f < end; ++f) {
      const auto [a, b, c] = mesh.faces[f];
      const auto some = static_cast<Columns>(rows[a] | rows[b] | rows[c]);
      if (some == 0) continue;
      for (const Index i : mesh.faces[f]) out[i] |= static_cast<Columns>(some & ~far[i]);
    }
  };
  // Faces of a range meet no rows of another's.
  parallel_for(work_.threads, std::ssize(mesh.ranges), 4,
               [&](std::int64_t begin, std::int64_t end) {
                 for (; begin < end; ++begin) {
                   const FaceRange& range = mesh.ranges[static_cast<std::size_t>(begin)];
                   look(range.first_face, range.end_face);
                 }
               });
  look(mesh.crossing, mesh.face_count());
  return out;
}

/// What the heat on the far entries and on the layer of vertices that touch them asks of all
/// others, over the floor: the right side whose answer goes on from there.
void FarField::ask(Rows& rows, int level, Block& right) const {
  rows.near = beside(rows.far, rows.far);
  const std::vector<Columns> around = beside(rows.near, rows.far);
  rows.asked.clear();
  for (std::size_t i = 0; i < around.size(); ++i) {
    if (around[i] != 0) rows.asked.push_back(static_cast<Index>(i));
  }
  parallel_for(work_.threads, std::ssize(rows.asked), kRowsOfThread,
               [&](std::int64_t begin, std::int64_t end) {
                 for (; begin < end; ++begin) {
                   const Index i = rows.asked[static_cast<std::size_t>(begin)];
                   for (unsigned some = around[i]; some != 0; some &= some - 1) {
                     const int k = std::countr_zero(some);
                     const Eigen::Index column = columns_[static_cast<std::size_t>(k)];
                     const double asked = system_.matrix().product_at(i, [&](Index j) {
                       if (((rows.far[j] | rows.near[j]) >> k & 1) == 0) return 0.0;
                       return field_.u(j, column) *
                              (level_of(j, column) == level ? 1.0 : 1.0 / field_.step);
                     });
                     if (std::isfinite(asked)) right(i, k) = asked / floor_;
                   }
                 }
               });
}

/// Columns whose far entries got any heat.
FarField::Columns FarField::heated(const std::vector<Columns>& far, const Block& right) const {
  const unsigned all = (1U << columns_.size()) - 1;
  unsigned found = 0;
  for (std::size_t i = 0; i < far.size() && found != all; ++i) {
    for (unsigned some = far[i] & ~found; some != 0; some &= some - 1) {
      const int k = std::countr_zero(some);
      if (std::abs(right(static_cast<Eigen::Index>(i), k)) > 0) found |= 1U << k;
    }
  }
  return static_cast<Columns>(found);
}

void FarField::take(const std::vector<Columns>& far, Columns which, int level, const Block& right) {
  if (field_.level.empty()) field_.level.assign(static_cast<std::size_t>(field_.u.size()), 0);
  work_.for_rows(field_.u.rows(), std::ssize(columns_), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      for (unsigned some = far[static_cast<std::size_t>(i)] & which; some != 0; some &= some - 1) {
        const int k = std::countr_zero(some);
        const Eigen::Index column = columns_[static_cast<std::size_t>(k)];
        field_.u(i, column) = right(i, k);
        field_.level[static_cast<std::size_t>(i * field_.u.cols() + column)] =
            static_cast<std::uint8_t>(level);
      }
    }
  });
}

}  // namespace geotherm
