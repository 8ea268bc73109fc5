// SPDX-License-Identifier: MIT
#include "solver/heat/diffuse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "solver/heat/far_field.h"

namespace geotherm {
namespace {

/// The largest and the smallest |u| of each column of a block.
struct Extremes {
  explicit Extremes(Eigen::Index columns)
      : largest(static_cast<std::size_t>(columns), 0.0), smallest(largest.size(), kUnreached) {}
  std::vector<double> largest, smallest;

  void take(std::size_t column, double high, double low) {
    largest[column] = high > largest[column] ? high : largest[column];
    smallest[column] = low < smallest[column] ? low : smallest[column];
  }
  /// Takes the entries of rows that stand one after the other.
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

/// The extremes of each column, over all components together: one pass along memory.
Extremes extremes_of(const Block& u, const Workspace& work) {
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
  return all;
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
  const Extremes extremes = extremes_of(field.u, work);
  std::vector<Eigen::Index> small;  // columns with an entry below the floor
  for (std::size_t c = 0; c < extremes.largest.size(); ++c) {
    if (extremes.smallest[c] < least_trusted(floor, extremes.largest[c])) {
      small.push_back(static_cast<Eigen::Index>(c));
    }
  }
  for (std::size_t next = 0; next < small.size(); next += kColumnsOfFarField) {
    const auto columns =
        std::span(small).subspan(next, std::min(small.size() - next, kColumnsOfFarField));
    FarField::Range range(1, std::ssize(columns));
    for (Eigen::Index k = 0; k < std::ssize(columns); ++k) {
      const auto column = static_cast<std::size_t>(columns[static_cast<std::size_t>(k)]);
      range.take(0, k, extremes.largest[column]);
      range.take(0, k, extremes.smallest[column]);
    }
    FarField far(system, components, reached, floor, work, field);
    if (const auto extended = far.extend(columns, range, progress); !extended) {
      return extended.error();
    }
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
      a.level[e] = static_cast<HeatField::Level>(their_level);
    }
    ours = 0.5 * (ours + theirs);
  }
  return a;
}

}  // namespace geotherm
