// SPDX-License-Identifier: MIT
#include "solver/heat/unit_field.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "solver/heat/field_kernels.h"

namespace geotherm {
namespace {

using Field = std::array<double, 2>;

/// Squared norms between these can be neither underflowing nor overflowing.
constexpr double kSafeLow = 1e-280;
constexpr double kSafeHigh = 1e280;

/// Diffusion lengths, as shares of the extent, between which shortening fades out. Measured against
/// exact distances: below the first it helps, above the second it harms.
constexpr double kShort = 0.15;
constexpr double kLong = 0.35;

/// Rows whose logarithms are taken before they are looked at.
constexpr std::int64_t kRowsOfPiece = 1024;
/// Ranges of faces that are worth a thread, with one column.
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

}  // namespace

UnitField::UnitField(const OperatorMesh& mesh, const HeatField& heat, const PerComponent& t,
                     const Workspace& work)
    : mesh_(mesh), heat_(heat), root_t_(std::sqrt(t.of(0))), work_(work) {
  if (!(root_t_ > 0)) return;
  if (!t.same()) {
    root_t_of_face_.reserve(mesh.faces.size());
    for (const Face& face : mesh.faces) {
      root_t_of_face_.push_back(std::sqrt(t.of(mesh.components.of[face[0]])));
    }
  }
  log_u_ = work.pool.take(heat.u.rows(), heat.u.cols());
  take_logarithms();
}

void UnitField::take_logarithms() {
  const Eigen::Index columns = log_u_.cols();
  const double step = std::log(heat_.step);
  Block high = Block::Constant(mesh_.components.count, columns, -kUnreached);
  Block low = -high;
  std::mutex mutex;
  work_.for_rows(log_u_.rows(), columns, [&](std::int64_t begin, std::int64_t end) {
    Block most = Block::Constant(high.rows(), columns, -kUnreached);
    Block least = -most;
    // In pieces that stay in the nearest cache between their two passes.
    for (std::int64_t next = begin; begin < end; begin = next) {
      next = std::min(end, begin + kRowsOfPiece);
      const std::int64_t from = begin * columns, to = next * columns;
      logarithms(heat_.u.data() + from, log_u_.data() + from, static_cast<std::size_t>(to - from));
      for (std::int64_t e = from; e < to && !heat_.level.empty(); ++e) {
        log_u_.data()[e] += step * heat_.level[static_cast<std::size_t>(e)];
      }
      const auto widen = [&](std::int64_t i, Index component) {
        for (Eigen::Index c = 0; c < columns; ++c) {  // comparisons that are false where u <= 0
          const double log_u = log_u_(i, c);
          most(component, c) = log_u > most(component, c) ? log_u : most(component, c);
          least(component, c) = log_u < least(component, c) ? log_u : least(component, c);
        }
      };
      for (std::int64_t i = begin; i < next; ++i) widen(i, mesh_.components.of[i]);
    }
    const std::lock_guard lock(mutex);
    high = high.cwiseMax(most);
    low = low.cwiseMin(least);
  });
  measure_trust(high, low);
}

/// u ~ exp(-d / sqrt(t)) (Varadhan): log u falls by the extent over sqrt(t) in all.
void UnitField::measure_trust(const Block& high, const Block& low) {
  std::vector<double> trust(static_cast<std::size_t>(high.size()), 1.0);
  bool whole = true;
  for (std::size_t e = 0; e < trust.size(); ++e) {
    const double fall = high.data()[e] - low.data()[e];
    if (!(fall * kShort < 1) || fall < 0) continue;  // also: no heat in this component
    trust[e] = fall > 0 ? std::clamp((kLong - 1 / fall) / (kLong - kShort), 0.0, 1.0) : 0.0;
    whole = false;
  }
  if (!whole) trust_ = std::move(trust);
}

double UnitField::trust(Index row, Eigen::Index column) const {
  if (trust_.empty()) return 1;
  return trust_[static_cast<std::size_t>(mesh_.components.of[row] * log_u_.cols() + column)];
}

double UnitField::length(Index f, Eigen::Index column) const {
  if (!(root_t_ > 0)) return 1;
  const FaceLayout& p = mesh_.layout[f];
  const Face& face = mesh_.faces[f];
  const Field g =
      gradient(p, log_u_(face[0], column), log_u_(face[1], column), log_u_(face[2], column));
  const double square = g[0] * g[0] + g[1] * g[1];
  if (!(square > 0) || !std::isfinite(square)) return 1;  // no logarithm: u <= 0
  const double whole = field_length(p.base, p.x, p.height, g[0], g[1], root_t(f));
  return 1 - trust(face[0], column) * (1 - whole);
}

Field UnitField::of_face(Index f, Eigen::Index column) const {
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

void UnitField::add_group(Index first_face, Index end_face, Eigen::Index first, int group,
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
    const UnitField* field;
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

void UnitField::add_faces(Index first_face, Index end_face, Block& b) const {
  for (Eigen::Index first = 0; first < b.cols();) {
    const int group = column_group(b.cols() - first);
    add_group(first_face, end_face, first, group, b);
    first += group;
  }
}

Block UnitField::divergence(std::span<const SourceAnchors> anchors) const {
  const Eigen::Index columns = heat_.u.cols();
  Block b = work_.pool.take(heat_.u.rows(), columns);
  // Ranges write to rows of their own, then those faces follow that join them: each row has its sum
  // in one order, with any number of threads.
  parallel_for(work_.threads, std::ssize(mesh_.ranges),
               std::max<std::int64_t>(1, kRanges / columns),
               [&](std::int64_t begin, std::int64_t end) {
                 for (std::int64_t r = begin; r < end; ++r) {
                   const FaceRange& range = mesh_.ranges[static_cast<std::size_t>(r)];
                   b.middleRows(range.first_row, range.end_row - range.first_row).setZero();
                   add_faces(range.first_face, range.end_face, b);
                 }
               });
  add_faces(mesh_.crossing, mesh_.face_count(), b);
  if (!(root_t_ > 0)) return b;
  for (Eigen::Index c = 0; c < columns; ++c) {
    for (const auto& near : anchors[static_cast<std::size_t>(c)].near_faces) {
      const Field x = of_face(near.face, c);
      add_divergence(mesh_.faces[near.face], mesh_.layout[near.face],
                     {near.field[0] - x[0], near.field[1] - x[1]}, b, c);
    }
  }
  return b;
}

}  // namespace geotherm
