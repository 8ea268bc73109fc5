// SPDX-License-Identifier: MIT
#include "solver/heat/unit_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "solver/accuracy/check_heat.h"
#include "solver/core/processor.h"
#include "solver/heat/field_kernels.h"

namespace geotherm {
namespace {

using Field = std::array<double, 2>;

/// Squared norms between these can be neither underflowing nor overflowing.
constexpr double kSafeLow = 1e-280;
constexpr double kSafeHigh = 1e280;

/// Diffusion lengths, as shares of the extent, between which shortening fades out. Measured against
/// exact distances: below the first it helps, above the second it harms.
constexpr double kShortDiffusion = 0.15;
constexpr double kLongDiffusion = 0.35;

/// Widths of a component, area over extent, in diffusion lengths, between which it counts as narrow
/// and no longer. Measured against exact distances on stretched planes and strips.
constexpr double kNarrow = 2.5, kWide = 5;

/// Rows of a batch of logarithms.
constexpr std::int64_t kRowsOfPiece = 1024;
/// Minimum ranges of faces per thread, with one column.
constexpr std::int64_t kRanges = 2;

/// The unit vector against the gradient whose values at the corners are these, however small.
Field against_gradient(const FaceLayout& p, double u0, double u1, double u2) {
  const double largest = std::max(std::abs(u1 - u0), std::abs(u2 - u0));
  if (!(largest > kEquallyWarm * std::abs(u0)) || !std::isfinite(largest)) return {0, 0};
  Field g = gradient(p, u0, u1, u2);
  double square = g[0] * g[0] + g[1] * g[1];
  if (!(square > kSafeLow && square < kSafeHigh)) {
    int exponent = 0;
    std::frexp(largest, &exponent);
    g = gradient(p, 0.0, std::ldexp(u1 - u0, -exponent), std::ldexp(u2 - u0, -exponent));
    square = g[0] * g[0] + g[1] * g[1];
    if (!(square > 0)) return {0, 0};
  }
  const double scale = -1 / std::sqrt(square);
  return {g[0] * scale, g[1] * scale};
}

void add_divergence(const Face& face, const FaceLayout& p, const Field& x, Block& b,
                    Eigen::Index column) {
  const auto d = divergence(p, x[0], x[1]);
  for (int k = 0; k < 3; ++k) b(face[k], column) += d[k];
}

/// The largest and the smallest logarithm of each component and column. Comparisons are false for
/// what is no number, the logarithm of 0 and below.
class LogRange {
 public:
  LogRange(const Components& components, Eigen::Index columns)
      : components_(components),
        high_(Block::Constant(components.count, columns, -kUnreached)),
        low_(-high_) {
    most_.fill(-kUnreached);
    least_.fill(kUnreached);
  }

  /// `log_u`: of rows begin to end.
  void take(const double* log_u, std::int64_t begin, std::int64_t end) {
    const Eigen::Index columns = high_.cols();
    const std::int64_t count = (end - begin) * columns;
    std::int64_t e = 0;
    if (components_.count == 1 && kLanes % columns == 0) {
      for (; e + kLanes <= count; e += kLanes) {
        for (int j = 0; j < kLanes; ++j) {
          const double value = log_u[e + j];
          most_[j] = value > most_[j] ? value : most_[j];
          least_[j] = value < least_[j] ? value : least_[j];
        }
      }
    }
    for (; e < count; ++e) {
      widen(components_.of[static_cast<std::size_t>(begin + e / columns)], e % columns, log_u[e]);
    }
  }
  void take(LogRange& other) {
    high_ = high_.cwiseMax(other.high());
    low_ = low_.cwiseMin(other.low());
  }

  const Block& high() {
    gather();
    return high_;
  }
  const Block& low() {
    gather();
    return low_;
  }

 private:
  static constexpr int kLanes = 16;
  void widen(Index component, Eigen::Index c, double value) {
    if (value > high_(component, c)) high_(component, c) = value;
    if (value < low_(component, c)) low_(component, c) = value;
  }
  void gather() {
    for (int j = 0; j < kLanes && kLanes % high_.cols() == 0; ++j) {
      double& high = high_(0, j % high_.cols());
      double& low = low_(0, j % high_.cols());
      high = std::max(high, most_[j]);
      low = std::min(low, least_[j]);
    }
  }

  const Components& components_;
  Block high_, low_;  ///< components x K
  std::array<double, kLanes> most_, least_;
};

}  // namespace

FaceField::FaceField(const Surface& surface, const HeatField& heat, const PerComponent& t,
                     const Workspace& work, std::span<const Extent> whole)
    : surface_(surface),
      mesh_(*surface.operators),
      heat_(heat),
      root_t_(std::sqrt(t.of(0))),
      work_(work) {
  if (!(root_t_ > 0)) return;
  if (!t.same()) {
    root_t_of_face_.reserve(mesh_.faces.size());
    for (const Face& face : mesh_.faces) {
      root_t_of_face_.push_back(std::sqrt(t.of(mesh_.components.of[face[0]])));
    }
  }
  log_u_ = work.pool.take(heat.u.rows(), heat.u.cols());
  take_logarithms(t, whole);
}

void FaceField::take_logarithms(const PerComponent& t, std::span<const Extent> whole) {
  const Eigen::Index columns = log_u_.cols();
  const double step = std::log(heat_.step);
  LogRange all(mesh_.components, columns);
  std::mutex mutex;
  work_.for_rows(log_u_.rows(), columns, [&](std::int64_t begin, std::int64_t end) {
    LogRange spread(mesh_.components, columns);
    // In pieces that stay in the nearest cache between their two passes.
    for (std::int64_t next = begin; begin < end; begin = next) {
      next = std::min(end, begin + kRowsOfPiece);
      const std::int64_t from = begin * columns, to = next * columns;
      logarithms(heat_.u.data() + from, log_u_.data() + from, static_cast<std::size_t>(to - from));
      for (std::int64_t e = from; e < to && !heat_.level.empty(); ++e) {
        log_u_.data()[e] += step * heat_.level[static_cast<std::size_t>(e)];
      }
      spread.take(log_u_.data() + from, begin, next);
    }
    const std::lock_guard lock(mutex);
    all.take(spread);
  });
  Block high = all.high(), low = all.low();
  std::vector<double> area = mesh_.area;
  for (std::size_t c = 0; c < whole.size(); ++c) {
    high.row(static_cast<Eigen::Index>(c)).setConstant(whole[c].high);
    low.row(static_cast<Eigen::Index>(c)).setConstant(whole[c].low);
    area[c] = whole[c].area;
  }
  if (!measure_width(high, low, area, t)) {
    root_t_ = 0;  // narrow everywhere: the published field
    return;
  }
  measure_trust(high, low);
}

/// False where every component that heat has reached is narrow, for every source set.
bool FaceField::measure_width(const Block& high, const Block& low, std::span<const double> area,
                              const PerComponent& t) {
  std::vector<double> width(static_cast<std::size_t>(high.size()), 1.0);
  bool wide = true, some = false;
  for (Eigen::Index component = 0; component < high.rows(); ++component) {
    for (Eigen::Index c = 0; c < high.cols(); ++c) {
      const double fall = high(component, c) - low(component, c);
      if (!(fall > 0)) continue;  // no heat here
      const double widths =
          area[static_cast<std::size_t>(component)] / (fall * t.of(static_cast<Index>(component)));
      double& of = width[static_cast<std::size_t>(component * high.cols() + c)];
      of = std::clamp((widths - kNarrow) / (kWide - kNarrow), 0.0, 1.0);
      wide = wide && of == 1;
      some = some || of > 0;
    }
  }
  if (!wide) width_ = std::move(width);
  return wide || some;
}

/// u ~ exp(-d / sqrt(t)) (Varadhan): log u falls by the extent over sqrt(t) in all.
void FaceField::measure_trust(const Block& high, const Block& low) {
  std::vector<double> trust = width_;
  trust.resize(static_cast<std::size_t>(high.size()), 1.0);
  bool whole = width_.empty();
  for (std::size_t e = 0; e < trust.size(); ++e) {
    const double fall = high.data()[e] - low.data()[e];
    if (!(fall * kShortDiffusion < 1) || fall < 0) continue;  // also: no heat in this component
    trust[e] *=
        fall > 0
            ? std::clamp((kLongDiffusion - 1 / fall) / (kLongDiffusion - kShortDiffusion), 0.0, 1.0)
            : 0.0;
    whole = false;
  }
  if (!whole) trust_ = std::move(trust);
}

double FaceField::at(const std::vector<double>& values, Index row, Eigen::Index column) const {
  if (values.empty()) return 1;
  return values[static_cast<std::size_t>(mesh_.components.of[row] * log_u_.cols() + column)];
}

double FaceField::length(Index f, Eigen::Index column) const {
  if (!(root_t_ > 0)) return 1;
  const FaceLayout& p = mesh_.layout[f];
  const Face& face = mesh_.faces[f];
  const Field g =
      gradient(p, log_u_(face[0], column), log_u_(face[1], column), log_u_(face[2], column));
  const double square = g[0] * g[0] + g[1] * g[1];
  if (!(square > 0) || !std::isfinite(square)) return 1;  // no logarithm: u <= 0
  const double size = std::sqrt(square);
  const double whole =
      field_length(p.base, p.x, p.height, g[0] / size, g[1] / size, size, root_t(f), 1 / root_t(f));
  return 1 - at(trust_, face[0], column) * (1 - whole);
}

Field FaceField::of_face(Index f, Eigen::Index column) const {
  const Face& face = mesh_.faces[f];
  std::array<double, 3> u{};
  for (int k = 0; k < 3; ++k) u[k] = heat_.u(face[k], column);
  if (!heat_.level.empty()) {  // to one exponent: the largest values'
    std::array<int, 3> level{};
    for (int k = 0; k < 3; ++k) {
      level[k] = heat_.level[static_cast<std::size_t>(face[k] * heat_.u.cols() + column)];
    }
    const int base = std::min({level[0], level[1], level[2]});
    for (int k = 0; k < 3; ++k) {
      if (level[k] > base) u[k] *= std::pow(heat_.step, level[k] - base);
    }
  }
  const FaceLayout& p = mesh_.layout[f];
  const Field x = against_gradient(p, u[0], u[1], u[2]);
  const double size = length(f, column);
  return {x[0] * size, x[1] * size};
}

void FaceField::add_group(Index first_face, Index end_face, Eigen::Index first, int group,
                          Block& b) const {
  if (!trust_.empty()) {  // rare: face by face
    for (Index f = first_face; f < end_face; ++f) {
      for (Eigen::Index c = first; c < first + group; ++c) {
        add_divergence(mesh_.faces[f], mesh_.layout[f], of_face(f, c), b, c);
      }
    }
    return;
  }
  struct Context {
    const FaceField* field;
    Eigen::Index first;
  };
  const Context context{this, first};
  FieldPass pass{};
  pass.mesh = &mesh_;
  pass.first_face = first_face;
  pass.end_face = end_face;
  pass.u = heat_.u.data() + first;
  if (!heat_.level.empty()) pass.level = heat_.level.data() + first;
  pass.b = b.data() + first;
  pass.stride = b.cols();
  pass.context = &context;
  pass.careful = [](const void* at, Index face, int column) {
    const auto& c = *static_cast<const Context*>(at);
    return c.field->of_face(face, c.first + column);
  };
  if (root_t_ > 0) {
    pass.log_u = log_u_.data() + first;
    pass.root_t = root_t_;
    if (!root_t_of_face_.empty()) pass.root_t_of_face = root_t_of_face_.data();
  }
  add_unit_divergence(pass, group);
}

void FaceField::add_faces(Index first_face, Index end_face, Block& b) const {
  for (Eigen::Index first = 0; first < b.cols();) {
    const int group = column_group(b.cols() - first);
    add_group(first_face, end_face, first, group, b);
    first += group;
  }
}

Block FaceField::divergence(std::span<const SourceAnchors> anchors) const {
  const Eigen::Index columns = heat_.u.cols();
  Block b = work_.pool.take(heat_.u.rows(), columns);
  const std::int64_t grain = std::max<std::int64_t>(1, kRanges / columns);
  for_ranges(mesh_.ranges, work_.threads, grain, [&](const RowRange& range) {
    b.middleRows(range.first_row, range.end_row - range.first_row).setZero();
    add_faces(range.first_cell, range.end_cell, b);
  });
  add_faces(mesh_.crossing, mesh_.face_count(), b);
  if (!(root_t_ > 0)) return b;
  for (Eigen::Index c = 0; c < columns; ++c) {
    for (const auto& near : anchors[static_cast<std::size_t>(c)].near_faces) {
      const Field x = of_face(near.face, c);
      const double share = at(width_, mesh_.faces[near.face][0], c);
      add_divergence(mesh_.faces[near.face], mesh_.layout[near.face],
                     {share * (near.field[0] - x[0]), share * (near.field[1] - x[1])}, b, c);
    }
  }
  return b;
}

CellCounts FaceField::inspect(std::span<const double> phi, Eigen::Index column,
                              const SourceAnchors& anchors, std::span<const char> held_at_zero,
                              int threads, Quality& quality) const {
  return inspect_faces(mesh_, surface_.intrinsic.twin,
                       SteepSides(bound_tolerance(MethodKind::kHeat)), *this, phi, column, anchors,
                       held_at_zero, threads, quality);
}

CellCounts FaceField::inspect(std::span<const double> phi, const SourceAnchors& anchors,
                              std::span<const char> some, int threads, Quality& quality) const {
  return inspect_faces(mesh_, surface_.intrinsic.twin,
                       SteepSides(bound_tolerance(MethodKind::kHeat)), *this, phi, 0, anchors, {},
                       threads, quality, some);
}

}  // namespace geotherm
