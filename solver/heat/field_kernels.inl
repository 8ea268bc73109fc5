// SPDX-License-Identifier: MIT
// The pass of field_kernels.h, compiled once for each instruction set. A lane is one face of one
// source set; with few sets several faces go side by side, so that registers are always full.
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "solver/heat/field_kernels.h"

namespace geotherm {
using FieldKernel = void (*)(const FieldPass&);
}

namespace geotherm::GEOTHERM_KERNEL_NAMESPACE {
namespace {

/// Differences and squares outside this range go the careful way: what has underflowed has no
/// direction left.
constexpr double kSafeLow = 1e-280;
constexpr double kSafeHigh = 1e280;

/// 1 / sqrt(x) to a few units of the last digit, for 1e-290 < x < 1e290, in a quarter of the time
/// that a square root and a division take: a guess from halving the exponent (3.5 % off, Lomont
/// 2003), and two steps y (1 - e)^(-1/2), e = 1 - x y^2, by the binomial series to e^2 and to e^3.
inline double inverse_root(double x) {
  constexpr std::uint64_t kGuess = 0x5fe6eb50c7b537a9;
  double y = std::bit_cast<double>(kGuess - (std::bit_cast<std::uint64_t>(x) >> 1));
  double e = 1 - x * (y * y);
  y += y * e * (0.5 + 0.375 * e);
  e = 1 - x * (y * y);
  return y + y * e * (0.5 + e * (0.375 + 0.3125 * e));
}

/// The power of two that brings x, positive and not denormal, to between 1 and 2.
inline double to_one(double x) {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000, kOfInverse = 0x7fe0000000000000;
  return std::bit_cast<double>(kOfInverse - (std::bit_cast<std::uint64_t>(x) & kExponent));
}

template <int K>
struct Lanes {
  // Sixteen lanes, not eight: the compiler unrolls shorter loops before it thinks of vectors.
  static constexpr int kFaces = 16 / K;
  static constexpr int kCount = kFaces * K;
  double du1[kCount], du2[kCount];  ///< differences of u to corner 0
  double same[kCount];              ///< what is no difference
  double dl1[kCount], dl2[kCount];  ///< of log u
  double base[kCount], x[kCount], height[kCount], inverse_area[kCount];
  double d1[kCount], d2[kCount];
  double root_t[kCount];   ///< where faces have their own
  double far[kCount];      ///< not 0 where a corner has an exponent of its own
  double careful[kCount];  ///< not 0 where the fast path does not hold
};

template <int K>
void load(const FieldPass& pass, Index first, Lanes<K>& s) {
  for (int i = 0; i < Lanes<K>::kFaces; ++i) {
    const Face& face = pass.mesh->faces[first + i];
    const FaceLayout& p = pass.mesh->layout[first + i];
    // Once for all columns, or with one column for all faces of the registers.
    const double inverse_area = K > 1 ? 1 / (p.base * p.height) : 0.0;
    for (int k = 0; k < K; ++k) {
      const int lane = i * K + k;
      const double u0 = pass.u[face[0] * pass.stride + k];
      s.du1[lane] = pass.u[face[1] * pass.stride + k] - u0;
      s.du2[lane] = pass.u[face[2] * pass.stride + k] - u0;
      s.same[lane] = kSafeLow + kEquallyWarm * std::abs(u0);
      s.base[lane] = p.base;
      s.x[lane] = p.x;
      s.height[lane] = p.height;
      if (K > 1) s.inverse_area[lane] = inverse_area;
    }
    for (int k = 0; k < K; ++k) s.far[i * K + k] = 0;
    if (pass.level != nullptr) {
      for (int k = 0; k < K; ++k) {
        s.far[i * K + k] = pass.level[face[0] * pass.stride + k] |
                           pass.level[face[1] * pass.stride + k] |
                           pass.level[face[2] * pass.stride + k];
      }
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

/// Shortens X; root_t(j) is that of lane j.
template <int K, class RootT>
void shorten(Lanes<K>& s, const RootT& root_t) {
  for (int j = 0; j < Lanes<K>::kCount; ++j) {
    const double base = s.base[j], x = s.x[j], height = s.height[j];
    const double gx = s.dl1[j] * height;
    const double gy = s.dl2[j] * base - x * s.dl1[j];
    const double square = gx * gx + gy * gy;
    const double inverse = inverse_root(square);
    const double inverse_area = K > 1 ? s.inverse_area[j] : 1 / (base * height);
    const double size = square * inverse * inverse_area;
    const double length =
        field_length(base, x, height, gx * inverse, gy * inverse, size, root_t(j));
    s.d1[j] *= length;
    s.d2[j] *= length;
    s.careful[j] += square > kSafeLow && square < kSafeHigh ? 0.0 : 1.0;
  }
}

template <int K>
bool compute(const FieldPass& pass, Lanes<K>& s) {
  double any = 0;
  for (int j = 0; j < Lanes<K>::kCount; ++j) {
    // Relative to the larger difference: squares of u itself underflow half way to the floor.
    const double size1 = std::abs(s.du1[j]);
    const double size2 = std::abs(s.du2[j]);
    const double largest = size1 > size2 ? size1 : size2;
    const double scale = to_one(largest);
    const double du1 = s.du1[j] * scale;
    // The gradient times base and height: only its direction counts.
    const double gx = du1 * s.height[j];
    const double gy = s.du2[j] * scale * s.base[j] - s.x[j] * du1;
    const double square = gx * gx + gy * gy;
    const double half = -0.5 * inverse_root(square);
    const double fx = gx * half;
    const double fy = gy * half;
    s.d1[j] = s.height[j] * fx - s.x[j] * fy;
    s.d2[j] = s.base[j] * fy;
    s.careful[j] = largest > s.same[j] && square > kSafeLow && square < kSafeHigh ? s.far[j] : 1.0;
  }
  if (pass.log_u != nullptr) {
    if (pass.root_t_of_face == nullptr) {
      shorten(s, [root_t = pass.root_t](int) { return root_t; });
    } else {
      shorten(s, [&s](int j) { return s.root_t[j]; });
    }
  }
  for (int j = 0; j < Lanes<K>::kCount; ++j) any += s.careful[j];
  return any > 0;
}

template <int K>
void scatter(const FieldPass& pass, Index first, const Lanes<K>& s) {
  for (int i = 0; i < Lanes<K>::kFaces; ++i) {
    const Face& face = pass.mesh->faces[first + i];
    double* b0 = pass.b + face[0] * pass.stride;
    double* b1 = pass.b + face[1] * pass.stride;
    double* b2 = pass.b + face[2] * pass.stride;
    const int lane = i * K;
    // Three loops, since a face may visit one vertex twice.
    for (int k = 0; k < K; ++k) b0[k] -= s.d1[lane + k] + s.d2[lane + k];
    for (int k = 0; k < K; ++k) b1[k] += s.d1[lane + k];
    for (int k = 0; k < K; ++k) b2[k] += s.d2[lane + k];
  }
}

void add_one(const FieldPass& pass, Index f, int column) {
  const auto x = pass.careful(pass.context, f, column);
  const auto d = divergence(pass.mesh->layout[f], x[0], x[1]);
  for (int k = 0; k < 3; ++k) pass.b[pass.mesh->faces[f][k] * pass.stride + column] += d[k];
}

template <int K>
void run(const FieldPass& pass) {
  constexpr int kFaces = Lanes<K>::kFaces;
  // Two sets of lanes: what has just been stored one by one cannot be read as a vector yet.
  Lanes<K> lanes[2];
  Index f = pass.first_face;
  const Index end = f + (pass.end_face - f) / kFaces * kFaces;
  if (f < end) load<K>(pass, f, lanes[0]);
  for (int turn = 0; f < end; f += kFaces, turn = 1 - turn) {
    if (f + kFaces < end) load<K>(pass, f + kFaces, lanes[1 - turn]);
    Lanes<K>& s = lanes[turn];
    if (compute<K>(pass, s)) {
      for (int j = 0; j < Lanes<K>::kCount; ++j) {
        if (s.careful[j] == 0) continue;
        const auto x = pass.careful(pass.context, f + j / K, j % K);
        const auto d = divergence(pass.mesh->layout[f + j / K], x[0], x[1]);
        s.d1[j] = d[1];
        s.d2[j] = d[2];
      }
    }
    scatter<K>(pass, f, s);
  }
  for (; f < pass.end_face; ++f) {
    for (int k = 0; k < K; ++k) add_one(pass, f, k);
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

extern void (*const kLogarithms)(const double*, double*, std::size_t);
void (*const kLogarithms)(const double*, double*, std::size_t) = take_logarithms;
extern const FieldKernel kFieldKernels[5];
const FieldKernel kFieldKernels[5] = {run<1>, run<2>, run<4>, run<8>, run<16>};

}  // namespace geotherm::GEOTHERM_KERNEL_NAMESPACE
