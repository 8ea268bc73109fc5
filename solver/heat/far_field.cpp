// SPDX-License-Identifier: MIT
#include "solver/heat/far_field.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <utility>

#include "solver/core/processor.h"
#include "solver/core/sorting.h"
#include "solver/heat/field_kernels.h"

namespace geotherm {
namespace {

/// In how many masks each of 16 bits is set: all bits of a mask are counted at once.
class BitCounts {
 public:
  void add(std::uint16_t mask) {
    for (std::size_t k = 0; k < kBits; ++k) {
      short_[k] = static_cast<std::uint16_t>(short_[k] + ((mask & 1U << k) != 0 ? 1 : 0));
    }
    if (++added_ == std::numeric_limits<std::uint16_t>::max()) flush();
  }
  std::int64_t of(std::size_t bit) {
    flush();
    return long_[bit];
  }

 private:
  static constexpr std::size_t kBits = 16;
  void flush() {
    for (std::size_t k = 0; k < kBits; ++k) long_[k] += std::exchange(short_[k], 0);
    added_ = 0;
  }
  std::array<std::uint16_t, kBits> short_{};  ///< since the last flush: a register of all
  std::array<std::int64_t, kBits> long_{};
  std::uint16_t added_ = 0;
};

/// With direct solvers some 50 million edges at t = h^2: more than fit in memory.
constexpr int kMaxLevels = std::numeric_limits<HeatField::Level>::max();
/// Minimum rows per thread, about 0.1 ms of work.
constexpr std::int64_t kRowsOfThread = 1000;
/// Components from which on what a thread notes of each is too much to have it several times.
constexpr Index kManyComponents = 10'000;

}  // namespace

FarField::FarField(const LinearSystem& system, const Components& components,
                   const std::vector<std::vector<char>>& reached, double floor,
                   const Workspace& work, HeatField& field)
    : system_(system),
      components_(components),
      reached_(reached),
      floor_(floor),
      work_(work),
      passes_{work.pool, components.count > kManyComponents ? 1 : work.threads},
      field_(field) {}

Result<void> FarField::extend(std::span<const Eigen::Index> columns, const Range& of_columns,
                              const Progress& progress) {
  columns_.assign(columns.begin(), columns.end());
  const auto all = static_cast<Columns>((1U << columns.size()) - 1);
  const std::vector<std::int64_t> rows(columns.size(), std::int64_t{field_.u.rows()} + 1);
  const Range whole = components_.count == 1 ? of_columns : range();
  first_ = whole.largest;
  Far far = keep(below(whole, {}), all, rows);
  for (int level = 1; !columns_.empty() && level <= kMaxLevels; ++level) {
    // How many levels there will be is not known: each has half of the rest.
    const double rest = std::pow(0.5, level);
    if (!report(progress, "solve", 1 - rest)) return cancelled_error();
    Block right = work_.take_zero(field_.u.rows(), std::ssize(columns_));
    const std::vector<Index> asked = ask(far.rows, level - 1, right);
    if (asked.empty()) return {};
    std::vector<char> wanted(far.rows.size());
    std::ranges::transform(far.rows, wanted.begin(), [](Columns row) { return row != 0; });
    const auto solved = system_.invert_where(right, asked, wanted, work_,
                                             part_of(progress, 1 - rest, 1 - rest / 2));
    if (!solved) return solved.error();
    field_.iterations += solved->iterations;
    const Columns goes_on = heated(far.rows, right);  // the others are cut off by held vertices
    if (goes_on == 0) return {};
    const Range range = take(far.rows, goes_on, level, right);
    if (right.cols() == field_.u.cols()) work_.pool.give(std::move(right));  // else of no more use
    far = keep(below(range, far.rows), goes_on, far.count);
  }
  return {};
}

/// The range of the entries of columns_ in each component, over all rows.
FarField::Range FarField::range() const {
  Range all(components_.count, std::ssize(columns_));
  std::mutex mutex;
  passes_.for_rows(field_.u.rows(), all.largest.cols(), [&](std::int64_t begin, std::int64_t end) {
    Range here(components_.count, std::ssize(columns_));
    for (auto i = static_cast<Index>(begin); i < end; ++i) {
      for (Eigen::Index k = 0; k < here.largest.cols(); ++k) {
        here.take(components_.of[i], k, std::abs(field_.u(i, columns_[k])));
      }
    }
    const std::lock_guard lock(mutex);
    all.take(here);
  });
  return all;
}

/// Where this level ends: the floor below the first level's largest entry. Measured from its own
/// largest, each level would begin and end lower than the one before by up to what one edge costs,
/// and after some fifty of them sink into underflow. Only where a level begins below that, because
/// the heat has fallen that far over one edge, it counts from where it begins.
double FarField::end_of_level(double first, double largest) const {
  const double end = least_trusted(floor_, first);
  return end < largest ? end : floor_ * largest;
}

/// The entries among `candidates` (or among all) that are reached and free and lie below the end of
/// the level of their component. Each component has an end of its own, since the heat in it depends
/// on its size.
FarField::Far FarField::below(const Range& range, const Rows& candidates) const {
  const auto columns = std::ssize(columns_);
  Block least(components_.count, columns);
  bool none = true;
  for (Index component = 0; component < components_.count; ++component) {
    for (Eigen::Index k = 0; k < columns; ++k) {
      const bool reached = reached_[static_cast<std::size_t>(columns_[k])][component] != 0;
      least(component, k) =
          reached ? end_of_level(first_(component, k), range.largest(component, k)) : 0.0;
      none = none && !(range.smallest(component, k) < least(component, k));
    }
  }
  if (none) return {{}, std::vector<std::int64_t>(columns_.size())};
  Far far{Rows(static_cast<std::size_t>(field_.u.rows())), {}};
  far.count.resize(columns_.size());
  std::mutex mutex;
  passes_.for_rows(field_.u.rows(), columns, [&](std::int64_t begin, std::int64_t end) {
    mark_below(least, begin, end, far.rows);
    BitCounts count;
    for (auto i = static_cast<Index>(begin); i < end; ++i) {
      Columns small = far.rows[i];
      if (small == 0) continue;
      if (!candidates.empty()) small &= candidates[i];
      if (system_.matrix().is_held(i)) small = 0;
      far.rows[i] = small;
      count.add(small);
    }
    const std::lock_guard lock(mutex);
    for (std::size_t k = 0; k < far.count.size(); ++k) far.count[k] += count.of(k);
  });
  return far;
}

/// Marks the entries of columns_, in rows begin to end, that are below these values of their
/// component.
void FarField::mark_below(const Block& least, std::int64_t begin, std::int64_t end,
                          Rows& rows) const {
  const auto columns = std::ssize(columns_);
  const Eigen::Index stride = field_.u.cols();
  if (components_.count == 1 && columns == stride) {  // as a rule
    return mark_small(field_.u.data() + begin * stride, end - begin, static_cast<int>(columns),
                      least.data(), rows.data() + begin);
  }
  for (std::int64_t i = begin; i < end; ++i) {
    const double* const u = field_.u.data() + i * stride;
    const double* const floors = least.data() + components_.of[i] * columns;
    unsigned small = 0;
    for (Eigen::Index k = 0; k < columns; ++k) {
      small |= unsigned{std::abs(u[columns_[k]]) < floors[k]} << k;
    }
    rows[i] = static_cast<Columns>(small);
  }
}

/// Drops columns that are done, are not among these or have got no shorter; the others' bits move
/// up.
FarField::Far FarField::keep(Far next, Columns which, const std::vector<std::int64_t>& before) {
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    if ((which >> k & 1) != 0 && next.count[k] != 0 && next.count[k] < before[k]) kept.push_back(k);
  }
  if (kept.size() == columns_.size()) return next;
  for (std::size_t to = 0; to < kept.size(); ++to) {
    columns_[to] = columns_[kept[to]];
    next.count[to] = next.count[kept[to]];
    first_.col(static_cast<Eigen::Index>(to)) = first_.col(static_cast<Eigen::Index>(kept[to]));
  }
  columns_.resize(kept.size());
  next.count.resize(kept.size());
  for (Columns& row : next.rows) {
    unsigned renamed = 0;
    for (std::size_t to = 0; to < kept.size(); ++to) renamed |= (row >> kept[to] & 1U) << to;
    row = static_cast<Columns>(renamed);
  }
  return next;
}

/// What the heat on the far entries and on the layer of rows that share a cell with them asks of
/// all others, over the floor: the right side whose answer goes on from there. Gives its rows, none
/// where it is 0.
std::vector<Index> FarField::ask(const Rows& far, int level, Block& right) const {
  const DomainOperator& matrix = system_.matrix();
  std::vector<Index> listed;
  const Rows layer = matrix.columns_beside(far, work_.threads, listed);
  std::vector<char> beside(layer.size());
  std::vector<Index> near;
  for (const Index i : listed) {
    near.clear();
    matrix.list_neighbors(i, near);
    for (const Index j : near) beside[j] = 1;
  }
  std::vector<Index> asked;
  for_each_with_value(beside, char{1}, [&asked](Index i) { asked.push_back(i); });
  std::atomic<bool> flows = false;
  parallel_for(work_.threads, std::ssize(asked), kRowsOfThread,
               [&](std::int64_t begin, std::int64_t end) {
                 std::vector<Index> around;
                 for (; begin < end; ++begin) {
                   const Index i = asked[static_cast<std::size_t>(begin)];
                   around.clear();
                   matrix.list_neighbors(i, around);
                   unsigned some = 0;
                   for (const Index j : around) some |= layer[j];
                   for (some &= ~unsigned{far[i]}; some != 0; some &= some - 1) {
                     const int k = std::countr_zero(some);
                     const double out = outflow(i, k, level, far, layer);
                     if (out == 0 || !std::isfinite(out)) continue;
                     right(i, k) = out / floor_;
                     flows = true;
                   }
                 }
               });
  if (!flows) asked.clear();  // held vertices cut all of it off
  return asked;
}

/// (M u)_i of one column, u restricted to these entries and at the scale of this level.
double FarField::outflow(Index i, int k, int level, const Rows& far, const Rows& layer) const {
  const Eigen::Index column = columns_[static_cast<std::size_t>(k)];
  const auto value = [&](Index j) {
    if (((far[j] | layer[j]) >> k & 1) == 0) return 0.0;
    return field_.u(j, column) * (level_of(j, column) == level ? 1.0 : 1.0 / field_.step);
  };
  return system_.matrix().product_at(i, std::cref(value));  // no copy on the heap
}

/// Columns whose far entries got any heat.
FarField::Columns FarField::heated(const Rows& far, const Block& right) const {
  const unsigned all = (1U << columns_.size()) - 1;
  std::atomic<unsigned> found = 0;
  work_.for_rows(std::ssize(far), 1, [&](std::int64_t begin, std::int64_t end) {
    unsigned seen = 0;
    for (; begin < end && seen != all; ++begin) {
      for (unsigned some = far[begin] & ~seen; some != 0; some &= some - 1) {
        const int k = std::countr_zero(some);
        if (std::abs(right(begin, k)) > 0) seen |= 1U << k;
      }
    }
    found |= seen;
  });
  return static_cast<Columns>(found);
}

FarField::Range FarField::take(const Rows& far, Columns which, int level, const Block& right) {
  if (field_.level.empty()) field_.level.assign(static_cast<std::size_t>(field_.u.size()), 0);
  Range all(components_.count, std::ssize(columns_));
  std::mutex mutex;
  passes_.for_rows(
      field_.u.rows(), std::ssize(columns_), [&](std::int64_t begin, std::int64_t end) {
        Range here(components_.count, std::ssize(columns_));
        for (auto i = static_cast<Index>(begin); i < end; ++i) {
          const std::int64_t row = i * static_cast<std::int64_t>(field_.u.cols());
          for (unsigned some = far[i] & which; some != 0; some &= some - 1) {
            const int k = std::countr_zero(some);
            const std::int64_t entry = row + columns_[static_cast<std::size_t>(k)];
            const double u = right(i, k);
            field_.u.data()[entry] = u;
            field_.level[static_cast<std::size_t>(entry)] = static_cast<HeatField::Level>(level);
            here.take(components_.of[i], k, std::abs(u));
          }
        }
        const std::lock_guard lock(mutex);
        all.take(here);
      });
  return all;
}

}  // namespace geotherm
