// SPDX-License-Identifier: MIT
#include "solver/heat/far_field.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <functional>
#include <mutex>

namespace geotherm {
namespace {

/// More levels than this many floors: 255 * 295 decades for direct solvers.
constexpr int kMostLevels = 255;
/// Rows to ask that are worth a thread: some 0.1 ms.
constexpr std::int64_t kRowsOfThread = 1000;
/// Ranges of faces that are.
constexpr std::int64_t kRangesOfThread = 4;
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
  Far far = keep(below(components_.count == 1 ? of_columns : range(), {}), all, rows);
  for (int level = 1; !columns_.empty() && level <= kMostLevels; ++level) {
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

/// Of the entries of columns_, all rows.
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

/// Those of these entries, or of all, reached and free, whose value is below the floor times the
/// largest of their component: sizes of components differ, and with them the heat in them.
FarField::Far FarField::below(const Range& range, const Rows& candidates) const {
  const auto columns = std::ssize(columns_);
  Block least(components_.count, columns);
  bool none = true;
  for (Index component = 0; component < components_.count; ++component) {
    for (Eigen::Index k = 0; k < columns; ++k) {
      const bool reached = reached_[static_cast<std::size_t>(columns_[k])][component] != 0;
      least(component, k) = reached ? floor_ * range.largest(component, k) : 0.0;
      none = none && !(range.smallest(component, k) < least(component, k));
    }
  }
  if (none) return {{}, std::vector<std::int64_t>(columns_.size())};
  Far far{Rows(static_cast<std::size_t>(field_.u.rows())), {}};
  far.count.resize(columns_.size());
  std::mutex mutex;
  passes_.for_rows(field_.u.rows(), columns, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::int64_t> count(columns_.size());
    const Eigen::Index* const column = columns_.data();
    const bool whole = components_.count == 1;
    const bool every = columns == field_.u.cols();  // as a rule
    for (auto i = static_cast<Index>(begin); i < end; ++i) {
      if (!candidates.empty() && candidates[i] == 0) continue;
      const double* const u = field_.u.data() + std::int64_t{i} * field_.u.cols();
      const double* const floors = least.data() + (whole ? 0 : components_.of[i]) * columns;
      unsigned small = 0;
      for (Eigen::Index k = 0; k < columns; ++k) {
        small |= static_cast<unsigned>(std::abs(u[every ? k : column[k]]) < floors[k]) << k;
      }
      if (!candidates.empty()) small &= candidates[i];
      if (small == 0 || system_.matrix().is_held(i)) continue;
      far.rows[i] = static_cast<Columns>(small);
      for (; small != 0; small &= small - 1) ++count[std::countr_zero(small)];
    }
    const std::lock_guard lock(mutex);
    for (std::size_t k = 0; k < count.size(); ++k) far.count[k] += count[k];
  });
  return far;
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

/// Entries that share a face with a far one and are not far. Of the faces within a range of rows
/// only those are looked at where some of its rows are far and others are not.
FarField::Rows FarField::layer_around(const Rows& far) const {
  const OperatorMesh& mesh = system_.matrix().mesh();
  Rows out(far.size());
  const auto look = [&](Index first, Index end) {
    for (Index f = first; f < end; ++f) {
      const auto [a, b, c] = mesh.faces[f];
      const auto some = static_cast<Columns>(far[a] | far[b] | far[c]);
      if (some == static_cast<Columns>(far[a] & far[b] & far[c])) continue;  // as a rule
      for (const Index i : mesh.faces[f]) out[i] |= static_cast<Columns>(some & ~far[i]);
    }
  };
  // Faces of a range meet no rows of another's.
  parallel_for(work_.threads, std::ssize(mesh.ranges), kRangesOfThread,
               [&](std::int64_t begin, std::int64_t end) {
                 for (; begin < end; ++begin) {
                   const FaceRange& range = mesh.ranges[static_cast<std::size_t>(begin)];
                   const auto rows = std::span(far).subspan(
                       static_cast<std::size_t>(range.first_row),
                       static_cast<std::size_t>(range.end_row - range.first_row));
                   const bool mixed = std::ranges::any_of(
                       rows, [&rows](Columns row) { return row != rows.front(); });
                   if (mixed) look(range.first_face, range.end_face);
                 }
               });
  look(mesh.crossing, mesh.face_count());
  return out;
}

/// What the heat on the far entries and on the layer of vertices that touch them asks of all
/// others, over the floor: the right side whose answer goes on from there. Gives its rows, none
/// where it is 0.
std::vector<Index> FarField::ask(const Rows& far, int level, Block& right) const {
  const OperatorMesh& mesh = system_.matrix().mesh();
  const Rows layer = layer_around(far);
  std::vector<char> beside(layer.size());
  for (Index i = 0; i < static_cast<Index>(layer.size()); ++i) {
    if (layer[i] == 0) continue;
    for (const Index f : mesh.faces_at(i)) {
      for (const Index j : mesh.faces[f]) beside[j] = 1;
    }
  }
  std::vector<Index> asked;
  for (Index i = 0; i < static_cast<Index>(beside.size()); ++i) {
    if (beside[i] != 0) asked.push_back(i);
  }
  std::atomic<bool> flows = false;
  parallel_for(work_.threads, std::ssize(asked), kRowsOfThread,
               [&](std::int64_t begin, std::int64_t end) {
                 for (; begin < end; ++begin) {
                   const Index i = asked[static_cast<std::size_t>(begin)];
                   unsigned some = 0;
                   for (const Index f : mesh.faces_at(i)) {
                     for (const Index j : mesh.faces[f]) some |= layer[j];
                   }
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
  unsigned found = 0;
  for (std::size_t i = 0; i < far.size() && found != all; ++i) {
    for (unsigned some = far[i] & ~found; some != 0; some &= some - 1) {
      const int k = std::countr_zero(some);
      if (std::abs(right(static_cast<Eigen::Index>(i), k)) > 0) found |= 1U << k;
    }
  }
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
            field_.level[static_cast<std::size_t>(entry)] = static_cast<std::uint8_t>(level);
            here.take(components_.of[i], k, std::abs(u));
          }
        }
        const std::lock_guard lock(mutex);
        all.take(here);
      });
  return all;
}

}  // namespace geotherm
