// SPDX-License-Identifier: MIT
// The pass of field_kernels.h, compiled once for each instruction set. A lane is one face of one
// source set; with few sets several faces go side by side, so that registers are always full.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "solver/core/processor.h"
#include "solver/heat/field_kernels.h"

namespace geotherm::GEOTHERM_KERNEL_NAMESPACE {
namespace {

#include "solver/core/register.inl"

#include "solver/heat/face_lanes.inl"
#include "solver/heat/small_values.inl"
#include "solver/heat/tet_lanes.inl"

/// The divergence on a face by the slow way, which is right for small heat, too.
std::array<double, 3> divergence_of(const FieldPass& pass, Index f, int column) {
  const auto x = pass.careful(pass.context, f, column);
  return divergence(pass.mesh->layout[f], x[0], x[1]);
}

/// d1, d2: of one face, K columns.
template <int K>
inline void scatter(const FieldPass& pass, Index f, const double* d1, const double* d2) {
  const Face& face = pass.mesh->faces[f];
  double* b0 = pass.b + face[0] * pass.stride;
  double* b1 = pass.b + face[1] * pass.stride;
  double* b2 = pass.b + face[2] * pass.stride;
  // Three loops, since a face may visit one vertex twice.
  if constexpr (K >= kLanes) {
    for (int k = 0; k < K; k += kLanes) store(load(b0 + k) - (load(d1 + k) + load(d2 + k)), b0 + k);
    for (int k = 0; k < K; k += kLanes) store(load(b1 + k) + load(d1 + k), b1 + k);
    for (int k = 0; k < K; k += kLanes) store(load(b2 + k) + load(d2 + k), b2 + k);
  } else {
    for (int k = 0; k < K; ++k) b0[k] -= d1[k] + d2[k];
    for (int k = 0; k < K; ++k) b1[k] += d1[k];
    for (int k = 0; k < K; ++k) b2[k] += d2[k];
  }
}

/// Asks for what a face to come reads: rows of several cache lines each, out of order.
template <int K>
inline void ask_for(const FieldPass& pass, Index f) {
  constexpr int kLine = 8;  // doubles
  for (const Index vertex : pass.mesh->faces[f]) {
    const std::ptrdiff_t row = vertex * pass.stride;
    for (int k = 0; k < K; k += kLine) {
      __builtin_prefetch(pass.u + row + k);
      if (pass.log_u != nullptr) __builtin_prefetch(pass.log_u + row + k);
      __builtin_prefetch(pass.b + row + k);
    }
  }
}

/// Whether some corner has an exponent of its own in one of these columns.
template <int K>
inline bool has_mixed_levels(const FieldPass& pass, const Face& face) {
  if (pass.level == nullptr) return false;
  constexpr std::size_t kBytes = K * sizeof(*pass.level);
  const auto* const first = pass.level + face[0] * pass.stride;
  return std::memcmp(first, pass.level + face[1] * pass.stride, kBytes) != 0 ||
         std::memcmp(first, pass.level + face[2] * pass.stride, kBytes) != 0;
}

/// Many columns: they fill registers, and the shape is the same in all lanes.
template <int K>
void run_wide(const FieldPass& pass) {
  constexpr int kRegisters = K / kLanes;
  constexpr Index kAhead = 4;
  const double inverse_root_t = 1 / pass.root_t;
  for (Index f = pass.first_face; f < pass.end_face; ++f) {
    if (f + kAhead < pass.end_face) ask_for<K>(pass, f + kAhead);
    const Face& face = pass.mesh->faces[f];
    const FaceLayout& p = pass.mesh->layout[f];
    Shape shape{all_lanes(p.base),      all_lanes(p.x),
                all_lanes(p.height),    all_lanes(1 / (p.base * p.height)),
                all_lanes(pass.root_t), all_lanes(inverse_root_t)};
    if (pass.root_t_of_face != nullptr) {
      shape.root_t = all_lanes(pass.root_t_of_face[f]);
      shape.inverse_root_t = all_lanes(1 / pass.root_t_of_face[f]);
    }
    const auto corner = [&](const double* values, int k, int i) {
      return load(values + face[k] * pass.stride + i * kLanes);
    };
    double d1[K], d2[K];
    unsigned careful = 0;
    for (int i = 0; i < kRegisters; ++i) {
      const Register u0 = corner(pass.u, 0, i);
      Given given =
          unit_divergence(shape, u0, corner(pass.u, 1, i) - u0, corner(pass.u, 2, i) - u0);
      if (pass.log_u != nullptr) {
        const Register l0 = corner(pass.log_u, 0, i);
        shorten(shape, corner(pass.log_u, 1, i) - l0, corner(pass.log_u, 2, i) - l0, given);
      }
      store(given.d1, d1 + i * kLanes);
      store(given.d2, d2 + i * kLanes);
      careful |= lane_mask(given.careful) << (i * kLanes);
    }
    if (has_mixed_levels<K>(pass, face)) careful = (1U << K) - 1;
    for (; careful != 0; careful &= careful - 1) {
      const int k = std::countr_zero(careful);
      const auto d = divergence_of(pass, f, k);
      d1[k] = d[1];
      d2[k] = d[2];
    }
    scatter<K>(pass, f, d1, d2);
  }
}

/// Few columns: several faces fill the registers, number by number.
template <int K>
struct Lanes {
  // Two registers at least: one that has just been stored in parts cannot be read whole yet.
  static constexpr int kCount = 16;
  static constexpr int kFaces = kCount / K;
  double u0[kCount], du1[kCount], du2[kCount];  ///< u, and its differences to corner 0
  double dl1[kCount], dl2[kCount];              ///< of log u
  double base[kCount], x[kCount], height[kCount], root_t[kCount];
  double d1[kCount], d2[kCount];
  unsigned careful;  ///< bits of lanes where the fast path does not hold
};

template <int K>
void load_faces(const FieldPass& pass, Index first, Lanes<K>& s) {
  prefetch_ahead(pass.mesh->faces.data() + first, Lanes<K>::kFaces);
  prefetch_ahead(pass.mesh->layout.data() + first, Lanes<K>::kFaces);
  s.careful = 0;
  for (int i = 0; i < Lanes<K>::kFaces; ++i) {
    const Face& face = pass.mesh->faces[first + i];
    const FaceLayout& p = pass.mesh->layout[first + i];
    const unsigned mixed = has_mixed_levels<K>(pass, face) ? (1U << K) - 1 : 0;
    s.careful |= mixed << (i * K);
    for (int k = 0; k < K; ++k) {
      const int lane = i * K + k;
      const double u0 = pass.u[face[0] * pass.stride + k];
      s.u0[lane] = u0;
      s.du1[lane] = pass.u[face[1] * pass.stride + k] - u0;
      s.du2[lane] = pass.u[face[2] * pass.stride + k] - u0;
      s.base[lane] = p.base;
      s.x[lane] = p.x;
      s.height[lane] = p.height;
    }
    if (pass.log_u == nullptr) continue;
    if (pass.root_t_of_face != nullptr) {
      for (int k = 0; k < K; ++k) s.root_t[i * K + k] = pass.root_t_of_face[first + i];
    }
    for (int k = 0; k < K; ++k) {
      const int lane = i * K + k;
      const double l0 = pass.log_u[face[0] * pass.stride + k];
      s.dl1[lane] = pass.log_u[face[1] * pass.stride + k] - l0;
      s.dl2[lane] = pass.log_u[face[2] * pass.stride + k] - l0;
    }
  }
}

template <int K>
void compute(const FieldPass& pass, Lanes<K>& s) {
  const double inverse_root_t = 1 / pass.root_t;
  for (int j = 0; j < Lanes<K>::kCount; j += kLanes) {
    Shape shape{load(s.base + j),       load(s.x + j),
                load(s.height + j),     {},
                all_lanes(pass.root_t), all_lanes(inverse_root_t)};
    Given given = unit_divergence(shape, load(s.u0 + j), load(s.du1 + j), load(s.du2 + j));
    if (pass.log_u != nullptr) {
      if (pass.root_t_of_face != nullptr) {
        shape.root_t = load(s.root_t + j);
        shape.inverse_root_t = 1.0 / shape.root_t;
      }
      shape.inverse_area = 1.0 / (shape.base * shape.height);
      shorten(shape, load(s.dl1 + j), load(s.dl2 + j), given);
    }
    store(given.d1, s.d1 + j);
    store(given.d2, s.d2 + j);
    s.careful |= lane_mask(given.careful) << j;
  }
}

template <int K>
void run_narrow(const FieldPass& pass) {
  constexpr int kFaces = Lanes<K>::kFaces;
  Lanes<K> lanes[2];
  Index f = pass.first_face;
  const Index end = f + (pass.end_face - f) / kFaces * kFaces;
  if (f < end) load_faces<K>(pass, f, lanes[0]);
  for (int turn = 0; f < end; f += kFaces, turn = 1 - turn) {
    if (f + kFaces < end) load_faces<K>(pass, f + kFaces, lanes[1 - turn]);
    Lanes<K>& s = lanes[turn];
    compute<K>(pass, s);
    for (unsigned careful = s.careful; careful != 0; careful &= careful - 1) {
      const int j = std::countr_zero(careful);
      const auto d = divergence_of(pass, f + j / K, j % K);
      s.d1[j] = d[1];
      s.d2[j] = d[2];
    }
    for (int i = 0; i < kFaces; ++i) scatter<K>(pass, f + i, s.d1 + i * K, s.d2 + i * K);
  }
  for (; f < pass.end_face; ++f) {
    double d1[K], d2[K];
    for (int k = 0; k < K; ++k) {
      const auto d = divergence_of(pass, f, k);
      d1[k] = d[1];
      d2[k] = d[2];
    }
    scatter<K>(pass, f, d1, d2);
  }
}

template <int K>
void run(const FieldPass& pass) {
  if constexpr (K >= kLanes) {
    run_wide<K>(pass);
  } else {
    run_narrow<K>(pass);
  }
}

/// log of a positive number: its exponent, and 2 atanh((m - 1) / (m + 1)) of its mantissa m, which
/// is brought to [sqrt(1/2), sqrt(2)) so that five terms suffice.
inline double logarithm(double u) {
  constexpr double kLog2 = 0.693147180559945309417;
  constexpr std::int64_t kHalfRoot = 0x3fe6a09e667f3bcd;  // sqrt(1/2)
  const auto bits = std::bit_cast<std::int64_t>(u);
  const std::int64_t exponent = (bits - kHalfRoot) >> 52;
  const double m = std::bit_cast<double>(bits - (exponent << 52));
  const double z = (m - 1) / (m + 1);
  const double q = z * z;
  const double series = 1 + q * (1.0 / 3 + q * (1.0 / 5 + q * (1.0 / 7 + q * (1.0 / 9))));
  return static_cast<double>(exponent) * kLog2 + 2 * z * series;
}

void take_logarithms(const double* u, double* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = u[i] > 0 ? logarithm(u[i]) : std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

extern const FieldKernels kFieldKernels;
const FieldKernels kFieldKernels = {
    {run<1>, run<2>, run<4>, run<8>, run<16>},
    {run_tets<1>, run_tets<2>, run_tets<4>, run_tets<8>, run_tets<16>},
    take_logarithms,
    mark_small};

}  // namespace geotherm::GEOTHERM_KERNEL_NAMESPACE
