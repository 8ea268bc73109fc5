// SPDX-License-Identifier: MIT
#include "solver/heat/diffuse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <mutex>

namespace geotherm {
namespace {

/// More levels than this many floors: 255 * 280 decades for direct solvers.
constexpr int kMostLevels = 255;

class FarField {
 public:
  FarField(const LinearSystem& system, const Components& components,
           const std::vector<char>& reached, Eigen::Index column, HeatField& field,
           const Workspace& work, const Progress& progress)
      : system_(system),
        components_(components),
        reached_(reached),
        column_(column),
        columns_(field.u.cols()),
        field_(field),
        work_(work),
        progress_(progress) {}

  /// Restarts outwards until every reached entry lies above the floor or nothing more comes.
  Result<void> extend(double floor) {
    std::vector<Index> far = below(floor, 0);
    for (int level = 1; !far.empty() && level <= kMostLevels; ++level) {
      if (field_.level.empty()) field_.level.assign(n() * static_cast<std::size_t>(columns_), 0);
      Block right = work_.take_zero(field_.u.rows(), 1);
      const std::vector<Index> interface = restart(far, level - 1, floor, right);
      if (interface.empty()) break;
      // How many levels there will be is not known: each has half of the rest.
      const double rest = std::pow(0.5, level);
      if (!report(progress_, "solve", 1 - rest)) return cancelled_error();
      const auto solved =
          system_.invert(right, interface, work_, part_of(progress_, 1 - rest, 1 - rest / 2));
      if (!solved) return solved.error();
      field_.iterations += solved->iterations;
      bool heated = false;  // else cut off from the sources by held vertices
      for (const Index i : far) heated = heated || std::abs(right(i, 0)) > 0;
      if (!heated) break;
      for (const Index i : far) {
        field_.u(i, column_) = right(i, 0);
        level_at(i) = static_cast<std::uint8_t>(level);
      }
      work_.pool.give(std::move(right));
      std::vector<Index> next = below(floor, level);
      if (next.size() >= far.size()) break;
      far = std::move(next);
    }
    return {};
  }

 private:
  std::size_t n() const { return static_cast<std::size_t>(field_.u.rows()); }
  std::uint8_t& level_at(Index i) {
    return field_.level[static_cast<std::size_t>(i) * static_cast<std::size_t>(columns_) +
                        static_cast<std::size_t>(column_)];
  }
  int level_of(Index i) { return field_.level.empty() ? 0 : level_at(i); }

  /// Reached, free entries of this level whose value is below the floor times the largest of this
  /// level in their component: sizes of components differ, and with them the heat in them.
  std::vector<Index> below(double floor, int level) {
    std::vector<double> largest(static_cast<std::size_t>(components_.count), 0.0);
    const auto size = static_cast<Index>(n());
    for (Index i = 0; i < size; ++i) {
      if (level_of(i) != level) continue;
      double& most = largest[components_.of[i]];
      most = std::max(most, std::abs(field_.u(i, column_)));
    }
    std::vector<Index> out;
    for (Index i = 0; i < size; ++i) {
      if (std::abs(field_.u(i, column_)) >= floor * largest[components_.of[i]]) continue;
      if (!reached_[components_.of[i]] || system_.matrix().is_held(i)) continue;
      if (level_of(i) == level) out.push_back(i);
    }
    return out;
  }

  /// Entries that share a face with one of these and are not far, ascending.
  std::vector<Index> around(const std::vector<Index>& rows, const std::vector<char>& is_far) const {
    const OperatorMesh& mesh = system_.matrix().mesh();
    std::vector<Index> out;
    for (const Index i : rows) {
      for (const Index f : mesh.faces_at(i)) {
        for (const Index j : mesh.faces[f]) {
          if (is_far[j] == 0) out.push_back(j);
        }
      }
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  /// What the heat on the far entries and on the layer of vertices that touch them asks of all
  /// others, over the floor: the right side whose answer goes on from there. Gives its rows.
  std::vector<Index> restart(const std::vector<Index>& far, int level, double floor, Block& right) {
    std::vector<char> is_far(n(), 0);
    for (const Index i : far) is_far[i] = 1;
    Block heat = work_.take_zero(field_.u.rows(), 1);
    const std::vector<Index> layer = around(far, is_far);
    for (const auto& rows : {std::cref(far), std::cref(layer)}) {
      for (const Index j : rows.get()) {
        heat(j, 0) = field_.u(j, column_) * (level_of(j) == level ? 1.0 : 1.0 / field_.step);
      }
    }
    std::vector<Index> rows;
    for (const Index i : around(layer, is_far)) {
      const double asked = system_.matrix().product_at(i, {heat.data(), n()});
      if (asked == 0 || !std::isfinite(asked)) continue;
      right(i, 0) = asked / floor;
      rows.push_back(i);
    }
    work_.pool.give(std::move(heat));
    return rows;
  }

  const LinearSystem& system_;
  const Components& components_;
  const std::vector<char>& reached_;
  Eigen::Index column_, columns_;
  HeatField& field_;
  const Workspace& work_;
  const Progress& progress_;
};

/// The largest and the smallest |u| of each column of a block.
struct Extremes {
  explicit Extremes(Eigen::Index columns)
      : largest(static_cast<std::size_t>(columns), 0.0), smallest(largest.size(), kUnreached) {}
  std::vector<double> largest, smallest;

  void take(std::size_t column, double high, double low) {
    largest[column] = high > largest[column] ? high : largest[column];
    smallest[column] = low < smallest[column] ? low : smallest[column];
  }
  /// Those of rows that stand one after the other.
  void take_rows(const double* u, std::size_t count) {
    const std::size_t columns = largest.size();
    const std::size_t lanes = kLanes / columns * columns;  // whole rows
    if (lanes == 0) {
      for (std::size_t e = 0; e < count; ++e) take(e % columns, std::abs(u[e]), std::abs(u[e]));
      return;
    }
    std::array<double, kLanes> high{}, low;
    low.fill(kUnreached);
    std::size_t e = 0;
    const auto look = [&](std::size_t width) {
      for (std::size_t j = 0; j < width; ++j) {
        const double size = std::abs(u[e + j]);
        high[j] = size > high[j] ? size : high[j];
        low[j] = size < low[j] ? size : low[j];
      }
    };
    if (lanes == kLanes) {  // a number the compiler knows: vectors
      for (; e + kLanes <= count; e += kLanes) look(kLanes);
    } else {
      for (; e + lanes <= count; e += lanes) look(lanes);
    }
    look(count - e);
    for (std::size_t j = 0; j < lanes; ++j) take(j % columns, high[j], low[j]);
  }

 private:
  static constexpr std::size_t kLanes = 16;
};

/// Columns with an entry below `floor` times their largest: one pass along memory.
std::vector<Eigen::Index> columns_with_small_values(const Block& u, double floor,
                                                    const Workspace& work) {
  Extremes all(u.cols());
  std::mutex mutex;
  work.for_rows(u.rows(), u.cols(), [&](std::int64_t begin, std::int64_t end) {
    Extremes here(u.cols());
    here.take_rows(u.data() + begin * u.cols(), static_cast<std::size_t>((end - begin) * u.cols()));
    const std::lock_guard lock(mutex);
    for (std::size_t c = 0; c < here.largest.size(); ++c) {
      all.take(c, here.largest[c], here.smallest[c]);
    }
  });
  std::vector<Eigen::Index> found;
  for (std::size_t c = 0; c < all.largest.size(); ++c) {
    if (all.smallest[c] < floor * all.largest[c]) found.push_back(static_cast<Eigen::Index>(c));
  }
  return found;
}

}  // namespace

Result<HeatField> diffuse(const LinearSystem& system, const Components& components, Block b,
                          std::span<const Index> support,
                          const std::vector<std::vector<char>>& reached, double floor,
                          const Workspace& work, const Progress& progress) {
  HeatField field;
  field.step = floor;
  field.u = std::move(b);
  if (!report(progress, "solve", 0.0)) return cancelled_error();
  const auto solved = system.solve(field.u, support, work, part_of(progress, 0.0, 0.5));
  if (!solved) return solved.error();
  field.iterations = solved->iterations;
  for (const Eigen::Index c : columns_with_small_values(field.u, floor, work)) {
    FarField far(system, components, reached[static_cast<std::size_t>(c)], c, field, work,
                 progress);
    if (const auto extended = far.extend(floor); !extended) return extended.error();
  }
  return field;
}

HeatField average(HeatField a, const HeatField& b) {
  a.iterations += b.iterations;
  if (a.level.empty() && b.level.empty()) {
    a.u = 0.5 * (a.u + b.u);
    return a;
  }
  const auto count = static_cast<std::size_t>(a.u.size());
  if (a.level.empty()) a.level.assign(count, 0);
  for (std::size_t e = 0; e < count; ++e) {
    double& ours = a.u.data()[e];
    double theirs = b.u.data()[e];
    const int their_level = b.level.empty() ? 0 : b.level[e];
    const int difference = their_level - a.level[e];
    if (difference > 0) theirs *= std::pow(a.step, difference);
    if (difference < 0) {
      ours *= std::pow(a.step, -difference);
      a.level[e] = static_cast<std::uint8_t>(their_level);
    }
    ours = 0.5 * (ours + theirs);
  }
  return a;
}

}  // namespace geotherm
