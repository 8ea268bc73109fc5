// SPDX-License-Identifier: MIT
// The wave that is fitted to the distances along an edge; part of wave_kernels.inl.
#include <limits>

#include "solver/wave/wave_kernels.h"

namespace geotherm::GEOTHERM_KERNEL_NAMESPACE {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
/// Below this share of h^2 the values along an edge fall as fast as they can: the wave runs along
/// the edge, straight lines from its ends say all, and the fit divides by nothing.
constexpr double kAlongEdge = 1e-5;
/// The same for the square of the wave's component across the edge.
constexpr double kGrazing = 1e-7;
/// A wave that converges more than this (curvature times h) is none: two fronts meet on the edge.
constexpr double kKink = -0.3;
/// A ray may miss its edge by this share of the half length: neighbours share the ray at their
/// ends.
constexpr double kRayTolerance = 1e-5;
constexpr double kHalfRayTolerance = 1e-6;

inline double least(double a, double b) { return b < a ? b : a; }
inline double most(double a, double b) { return b > a ? b : a; }

template <int N>
struct VectorOf {
  typedef double Values __attribute__((vector_size(8 * N)));
  typedef long long Mask __attribute__((vector_size(8 * N)));
};

/// What a face's targets are, as shares of its opposite vertex (cx, cy) and of the half edge (h,
/// 0): that vertex first, then the samples of the side that ends at a, then of that which begins at
/// b, each in the direction of the side. The last lane only fills the register.
template <int kSamples>
struct Targets;
template <>
struct Targets<1> {
  static constexpr int kLanes = 4;
  static constexpr VectorOf<4>::Values kOpposite = {1, 0.5, 0.5, 1};
  static constexpr VectorOf<4>::Values kEdge = {0, -0.5, 0.5, 0};
};
template <>
struct Targets<3> {
  static constexpr int kLanes = 8;
  static constexpr VectorOf<8>::Values kOpposite = {1, 0.75, 0.5, 0.25, 0.25, 0.5, 0.75, 1};
  static constexpr VectorOf<8>::Values kEdge = {0, -0.25, -0.5, -0.75, 0.75, 0.5, 0.25, 0};
};

template <int N>
inline void root(const typename VectorOf<N>::Values& x, typename VectorOf<N>::Values& out) {
  double values[N];
  __builtin_memcpy(values, &x, sizeof(values));
  for (int i = 0; i < N; ++i) values[i] = __builtin_sqrt(values[i]);
  __builtin_memcpy(&out, values, sizeof(values));
}

/// One wave through the values at three points of a line, `half` apart, the middle one at `centre`:
/// d(T) = w + (sqrt(1 + k q) - 1) / k with q = k |T|^2 + 2 (uy y - ux x), T from the centre.
struct Fit {
  enum class Kind { kNone, kWave, kKinked } kind;
  double centre, half;
  double left, middle, right;
  double k, ux, uy;
};

inline Fit fit_wave(double centre, double half, double left, double middle, double right) {
  Fit fit{Fit::Kind::kNone, centre, half, left, middle, right, 0, 0, 0};
  const double al = left - middle, be = right - middle, square = half * half;
  const double den = 2 * square - al * al - be * be;
  if (!(den > kAlongEdge * square)) return fit;
  const double inverse = 1 / (4 * half * den);
  fit.k = 8 * half * (al + be) * inverse;
  if (fit.k * half < kKink) {
    fit.kind = Fit::Kind::kKinked;
    return fit;
  }
  fit.ux = (2 * (al - be) + fit.k * (al * al - be * be)) * (den * inverse);
  const double across = 1 - fit.ux * fit.ux;
  if (!(across > kGrazing)) return fit;
  fit.uy = __builtin_sqrt(across);
  fit.kind = Fit::Kind::kWave;
  return fit;
}

/// The same seen from a face whose side runs the other way.
inline Fit mirrored(const Fit& fit) {
  Fit out = fit;
  out.centre = -fit.centre;
  out.left = fit.right;
  out.right = fit.left;
  out.ux = -fit.ux;
  return out;
}

/// A plane wave through the values at (0, 0) and (length, 0), at (x, y).
inline double plane_wave(double at_0, double at_length, double length, double x, double y) {
  const double ux = (at_length - at_0) / length;
  if (!(ux < 1 && ux > -1)) return kFar;
  const double uy = __builtin_sqrt(1 - ux * ux);
  const double ray = x * uy - y * ux;
  if (ray < -kHalfRayTolerance * length || ray > length * uy) return kFar;
  return at_0 + ux * x + uy * y;
}

/// An edge as one of its faces sees it: a and b where its side begins and ends.
template <int kSamples>
struct Front {
  double a, b;
  Index label_a, label_b;
  Fit fits[(kSamples + 1) / 2];
  Index labels[kSamples];
};

template <int kSamples>
Front<kSamples> mirrored(const Front<kSamples>& front) {
  Front<kSamples> out;
  out.a = front.b;
  out.b = front.a;
  out.label_a = front.label_b;
  out.label_b = front.label_a;
  constexpr int kFits = (kSamples + 1) / 2;
  for (int i = 0; i < kFits; ++i) out.fits[i] = mirrored(front.fits[kFits - 1 - i]);
  for (int i = 0; i < kSamples; ++i) out.labels[i] = front.labels[kSamples - 1 - i];
  return out;
}

}  // namespace
}  // namespace geotherm::GEOTHERM_KERNEL_NAMESPACE
