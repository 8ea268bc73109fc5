// SPDX-License-Identifier: MIT
// The wave that is fitted to the distances along an edge; part of wave_kernels.inl.
#include <limits>

#include "solver/polyhedral/wave_kernels.h"

namespace geotherm::GEOTHERM_KERNEL_NAMESPACE {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
/// Below this share of h^2 the values along an edge fall as fast as they can: the wave runs along
/// the edge, straight lines from its ends give the distances, and a fit would divide by zero.
constexpr double kAlongEdge = 1e-9;
/// Below this the square of the wave's component across the edge counts as 0 for the same reason.
constexpr double kGrazing = 1e-12;
/// Where a fit converges more than this (curvature times h), two fronts meet on the edge, and it is
/// discarded.
constexpr double kKink = -0.3;
/// A ray may miss its edge by this share of the half length: neighbours share the ray at their
/// ends.
constexpr double kRayTolerance = 1e-5;
constexpr double kHalfRayTolerance = 1e-6;

inline double least(double a, double b) { return b < a ? b : a; }
inline double most(double a, double b) { return b > a ? b : a; }

#ifdef __AVX__
constexpr int kWidest = 4;
#else
constexpr int kWidest = 2;
#endif

/// A register of doubles.
template <int N>
struct Register {
  typedef double Values __attribute__((vector_size(8 * N)));
  typedef long long Mask __attribute__((vector_size(8 * N)));
};

template <class Values>
Values load(const double* from) {
  Values out;
  __builtin_memcpy(&out, from, sizeof(out));
  return out;
}

template <class Values>
void store(const Values& values, double* to) {
  __builtin_memcpy(to, &values, sizeof(values));
}

template <class Values>
Values root(const Values& x) {
  double values[sizeof(Values) / sizeof(double)];
  store(x, values);
  for (double& value : values) value = __builtin_sqrt(value);
  return load<Values>(values);
}

/// What a face's targets are, as shares of its opposite vertex (cx, cy) and of the half edge (h,
/// 0): that vertex first, then the samples of the side that ends at a, then of that which begins at
/// b, each in the direction of the side. The last lane only fills the register.
template <int Samples>
struct Targets;
template <>
struct Targets<1> {
  static constexpr int kLanes = 4;
  static constexpr double kOpposite[kLanes] = {1, 0.5, 0.5, 1};
  static constexpr double kEdge[kLanes] = {0, -0.5, 0.5, 0};
};
template <>
struct Targets<3> {
  static constexpr int kLanes = 8;
  static constexpr double kOpposite[kLanes] = {1, 0.75, 0.5, 0.25, 0.25, 0.5, 0.75, 1};
  static constexpr double kEdge[kLanes] = {0, -0.25, -0.5, -0.75, 0.75, 0.5, 0.25, 0};
};

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

/// The fit as it is seen from a face whose side runs the other way.
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

/// The data of an edge as seen from one of its faces: a and b are the values where its side begins
/// and ends.
template <int Samples>
struct Front {
  double a, b;
  Index label_a, label_b;
  Fit fits[(Samples + 1) / 2];
  Index labels[Samples];
};

template <int Samples>
Front<Samples> mirrored(const Front<Samples>& front) {
  Front<Samples> out;
  out.a = front.b;
  out.b = front.a;
  out.label_a = front.label_b;
  out.label_b = front.label_a;
  constexpr int kFits = (Samples + 1) / 2;
  for (int i = 0; i < kFits; ++i) out.fits[i] = mirrored(front.fits[kFits - 1 - i]);
  for (int i = 0; i < Samples; ++i) out.labels[i] = front.labels[Samples - 1 - i];
  return out;
}

/// The wave's arrival at targets; far where its ray misses the edge.
template <class Values, class Mask>
Values wave(const Fit& fit, const Values& at, const Values& y, const Values& yy) {
  const Values x = at - fit.centre;
  const Values q = fit.k * (x * x + yy) + 2.0 * (fit.uy * y - fit.ux * x);
  const Values square = 1.0 + fit.k * q;
  const Values gx = fit.k * x - fit.ux, gy = fit.k * y + fit.uy;
  const Values miss = x * gy - y * gx;
  const Values reach = fit.half * (1 + kRayTolerance) * gy;
  const Mask valid = (square > 0.0) & (gy > 0.0) & (miss <= reach) & (miss >= -reach);
  const Values value = fit.middle + q / (1.0 + root(square));
  const Values far = Values{} + kFar;
  return valid ? value : far;
}

/// wave() to one target, seen from the fit's centre, and where its ray crosses the edge.
struct Ray {
  double arrives, at;
};
inline Ray ray_to(const Fit& fit, double x, double y) {
  const double q = fit.k * (x * x + y * y) + 2 * (fit.uy * y - fit.ux * x);
  const double square = 1 + fit.k * q;
  const double gx = fit.k * x - fit.ux, gy = fit.k * y + fit.uy;
  const double at = x - y * gx / gy, reach = fit.half * (1 + kRayTolerance);
  if (!(square > 0) || !(gy > 0) || !(at <= reach && at >= -reach)) return {kFar, 0};
  return {fit.middle + q / (1 + __builtin_sqrt(square)), at};
}

/// Two planes, one through each half.
inline double kinked(const Fit& fit, double at, double y) {
  const double x = at - fit.centre;
  return least(plane_wave(fit.left, fit.middle, fit.half, x + fit.half, y),
               plane_wave(fit.middle, fit.right, fit.half, x, y));
}

/// The least distance over all paths across the edge, for every target of a register. `nearest`:
/// the least of the front's values.
template <int Width, int Samples>
typename Register<Width>::Values arrival(const Front<Samples>& front, double half,
                                         const typename Register<Width>::Values& x,
                                         const typename Register<Width>::Values& y,
                                         double nearest) {
  using Values = typename Register<Width>::Values;
  const Values yy = y * y;
  const Values from_a = front.a + root((x + half) * (x + half) + yy);
  const Values from_b = front.b + root((x - half) * (x - half) + yy);
  Values best = from_b < from_a ? from_b : from_a;
  if constexpr (Samples == 3) {
    const Values from_middle = front.fits[0].right + root(x * x + yy);
    best = from_middle < best ? from_middle : best;
  }
  for (const Fit& fit : front.fits) {
    if (fit.kind == Fit::Kind::kWave) {
      const Values value = wave<Values, typename Register<Width>::Mask>(fit, x, y, yy);
      best = value < best ? value : best;
    } else if (fit.kind == Fit::Kind::kKinked) {
      for (int i = 0; i < Width; ++i) best[i] = least(best[i], kinked(fit, x[i], y[i]));
    }
  }
  // No wave arrives before it has met the edge, at most half a step from a sample. Fits that would,
  // on slivers, could lower each other without end.
  const Values soonest = Values{} + most(nearest - half / (Samples + 1), 0);
  return best > soonest ? best : soonest;
}

/// The label of the way that gave `value` at a target: that of the point of the edge next to
/// where the way crosses it.
template <int Samples>
Index label_of(const Front<Samples>& front, double half, double x, double y, double value) {
  const double margin = 1e-12 * value;
  if (front.a + __builtin_sqrt((x + half) * (x + half) + y * y) <= value + margin) {
    return front.label_a;
  }
  if (front.b + __builtin_sqrt((x - half) * (x - half) + y * y) <= value + margin) {
    return front.label_b;
  }
  double at = 0;  // where the path crosses, from -half to half
  const auto take_plane = [&](double at_0, double at_length, double begin, double length) {
    if (!(plane_wave(at_0, at_length, length, x - begin, y) <= value + margin)) return;
    const double ux = (at_length - at_0) / length;
    at = x - y * ux / __builtin_sqrt(1 - ux * ux);
  };
  for (const Fit& fit : front.fits) {
    if (fit.kind == Fit::Kind::kKinked) {
      take_plane(fit.middle, fit.right, fit.centre, fit.half);
      take_plane(fit.left, fit.middle, fit.centre - fit.half, fit.half);
    } else if (fit.kind == Fit::Kind::kWave) {
      const Ray ray = ray_to(fit, x - fit.centre, y);
      if (ray.arrives <= value + margin) at = fit.centre + ray.at;
    }
  }
  const double step = (at + half) / (2 * half) * (Samples + 1);
  const int node = static_cast<int>(__builtin_lround(step));
  if (node <= 0) return front.label_a;
  return node > Samples ? front.label_b : front.labels[node - 1];
}

}  // namespace
}  // namespace geotherm::GEOTHERM_KERNEL_NAMESPACE
