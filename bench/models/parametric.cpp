// SPDX-License-Identifier: MIT
#include "bench/models/draft_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace geotherm::generate {
namespace {

using Counts = std::array<int, 3>;

/// Squares along each edge direction: as equal as they can be with 4 (ab + bc + ca) nearest to
/// the faces asked for.
Counts best_counts(Index faces) {
  const int side = static_cast<int>(std::sqrt(faces / 12.0));
  Counts best{};
  double best_error = std::numeric_limits<double>::infinity();
  for (int a = side; a <= side + 2; ++a) {
    for (int b = a; b <= side + 2; ++b) {
      for (int c = b; c <= side + 2; ++c) {
        const double count = 4.0 * (static_cast<double>(a) * b + static_cast<double>(b) * c +
                                    static_cast<double>(c) * a);
        const double error = std::abs(count - faces) + (c - a);  // of equals the most even
        if (error >= best_error) continue;
        best_error = error;
        best = {a, b, c};
      }
    }
  }
  return best;
}

/// Numbers the points of the box's surface in the order in which they are first asked for.
class BoxSurface {
 public:
  explicit BoxSurface(const Counts& counts) : counts_(counts) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t points = static_cast<std::size_t>(counts[(axis + 1) % 3] + 1) *
                                 static_cast<std::size_t>(counts[(axis + 2) % 3] + 1);
      numbers_[2 * axis].assign(points, kNoIndex);
      numbers_[2 * axis + 1].assign(points, kNoIndex);
    }
  }

  Index number(const Counts& p) {
    Index found = kNoIndex;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (on_side(p, axis)) found = std::max(found, slot(p, axis));
    }
    if (found == kNoIndex) {
      found = static_cast<Index>(mesh.positions.size());
      mesh.positions.emplace_back(place(p, 0), place(p, 1), place(p, 2));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (on_side(p, axis)) slot(p, axis) = found;
    }
    return found;
  }

  /// The side where `axis` has its largest (`high`) or smallest value.
  void add_side(std::size_t axis, bool high) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (int j = 0; j < counts_[v]; ++j) {
      for (int i = 0; i < counts_[u]; ++i) {
        const auto corner = [&](int di, int dj) {
          Counts p{};
          p[axis] = high ? counts_[axis] : 0;
          p[u] = i + di;
          p[v] = j + dj;
          return number(p);
        };
        std::array<Index, 4> ring = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
        if (!high) std::swap(ring[1], ring[3]);
        // The diagonals change direction from square to square, so that none is preferred.
        const std::size_t k = (i + j) % 2 == 0 ? 0 : 1;
        mesh.faces.push_back({ring[k], ring[k + 1], ring[k + 2]});
        mesh.faces.push_back({ring[k], ring[k + 2], ring[(k + 3) % 4]});
      }
    }
  }

  DraftMesh mesh;

 private:
  bool on_side(const Counts& p, std::size_t axis) const {
    return p[axis] == 0 || p[axis] == counts_[axis];
  }
  double place(const Counts& p, std::size_t axis) const {
    return 2.0 * p[axis] / counts_[axis] - 1;
  }
  Index& slot(const Counts& p, std::size_t axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    const auto width = static_cast<std::size_t>(counts_[u] + 1);
    return numbers_[2 * axis + (p[axis] == 0 ? 0 : 1)]
                   [static_cast<std::size_t>(p[u]) + width * static_cast<std::size_t>(p[v])];
  }

  Counts counts_;
  std::array<std::vector<Index>, 6> numbers_;  ///< per side, point by point
};

}  // namespace

Result<DraftMesh> make_cube(Index faces, const Progress& progress) {
  BoxSurface box(best_counts(faces));
  for (std::size_t side = 0; side < 6; ++side) {
    if (!report(progress, "building", static_cast<double>(side) / 6)) {
      return cancelled_error();
    }
    box.add_side(side / 2, side % 2 == 1);
  }
  return std::move(box.mesh);
}

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLength = 2.6;
constexpr double kElbow = 1.35;  // along the arm, from the shoulder
constexpr double kBend = 1.65;   // radians
constexpr double kCuff = kLength - 0.26;

/// Radius of the arm's cloth at `s` along it: wide at the shoulder, narrow at the cuff, both
/// flared.
double radius_at(double s) {
  const double t = s / kLength;
  const double arm = 0.41 - 0.19 * smooth_step(-0.1, 0.9, t) + 0.05 * std::exp(-s / 0.16);
  const double cuff = smooth_step(kCuff - 0.012, kCuff + 0.012, s);
  const double gather = 0.05 * std::exp(-(s - kCuff + 0.2) * (s - kCuff + 0.2) / 0.02);
  const double band = 0.235 + 0.035 * smooth_step(kCuff, kLength, s);
  return (1 - cuff) * (arm + gather) + cuff * band;
}

/// The cloth as a function of s, the way along the arm, and the angle around it, which is 0 on the
/// inside of the elbow.
class Cloth {
 public:
  Cloth() {
    Vec3 p(0, 0, 0);
    double conformal = 0;
    for (int i = 0; i <= kSteps; ++i) {
      const double s = kLength * i / kSteps;
      const double turn = direction(s);
      centers_.push_back(p);
      conformal_.push_back(conformal);
      p += kLength / kSteps * Vec3(std::sin(turn), -std::cos(turn), 0);
      conformal += kLength / kSteps / radius_at(s);
    }
  }

  /// Length in units of the radius: steps of equal such length make triangles of equal shape.
  double conformal_length() const { return conformal_.back(); }
  double s_at_conformal(double c) const {
    const auto above = std::upper_bound(conformal_.begin(), conformal_.end() - 1, c);
    const auto i = static_cast<double>(above - conformal_.begin()) - 1;
    const double low = *(above - 1);
    return kLength / kSteps * (i + (c - low) / (*above - low));
  }

  Vec3 point(double s, double angle) const {
    // The shoulder's opening is cut aslant: high on the outside, low under the arm.
    const double across = std::cos(angle);
    const double slant = 0.17 * (0.3 + across) * (1 - smooth_step(0.0, 1.0, s));
    const double at = s + slant;
    const double turn = direction(at);
    const Vec3 inwards(std::cos(turn), std::sin(turn), 0);
    const Vec3 sideways(0, 0, 1);
    const double radius = radius_at(s) * (1 + folds(s, angle));
    // The elbow pulls the cloth flat against the arm's outside.
    const double pulled = 0.10 * std::exp(-square((at - kElbow) / 0.30));
    return center(at) + radius * ((across * (1 - 0.5 * pulled) - 0.6 * pulled) * inwards +
                                  std::sin(angle) * (1 + 0.4 * pulled) * sideways);
  }

 private:
  static constexpr int kSteps = 1024;
  static double square(double x) { return x * x; }
  static double direction(double s) {
    return -0.35 + kBend * smooth_step(kElbow - 0.48, kElbow + 0.48, s);
  }

  Vec3 center(double s) const {
    if (s <= 0) return s * Vec3(std::sin(direction(0)), -std::cos(direction(0)), 0);
    const double x = std::clamp(s / kLength, 0.0, 1.0) * kSteps;
    const auto i = std::min<std::size_t>(static_cast<std::size_t>(x), kSteps - 1);
    const double t = x - static_cast<double>(i);
    const Vec3 beyond = std::max(s - kLength, 0.0) *
                        Vec3(std::sin(direction(kLength)), -std::cos(direction(kLength)), 0);
    return (1 - t) * centers_[i] + t * centers_[i + 1] + beyond;
  }

  /// Relative change of the radius by the folds.
  static double folds(double s, double angle) {
    const double inside = 0.5 + 0.5 * std::cos(angle);
    const Vec3 around(std::cos(angle), std::sin(angle), 0);
    const double wobble = fractal_noise(1.3 * around + Vec3(0.5, 0.5, 1.6 * s), 2, 61);
    // Creases across the inside of the elbow, where the cloth is pushed together.
    const double crease = std::cos(2 * kPi * (s - kElbow) / 0.26 + 1.6 * wobble);
    const double elbow = std::exp(-square((s - kElbow) / 0.38)) * (0.12 + 0.88 * inside * inside);
    // Pulls that run slantwise from the elbow up and down the arm.
    const double twist = s < kElbow ? 1 : -1;
    const double slanted = std::cos(3 * (angle + twist * 2.1 * (s - kElbow)) + 2.6 * wobble);
    const double arm = smooth_step(0.0, 0.5, s) * (1 - smooth_step(kCuff - 0.5, kCuff - 0.15, s));
    // Where the cloth is gathered into the cuff: rings above it, pleats at its rim.
    const double ring = std::cos(2 * kPi * s / 0.19 + 2.8 * wobble + 1.3 * std::cos(angle + 1));
    const double gathered = std::exp(-square((s - (kCuff - 0.24)) / 0.17));
    const double pleat = std::cos(11 * angle + 3 * wobble);
    const double rim =
        std::exp(-square((s - kCuff + 0.05) / 0.07)) * (1 - smooth_step(kCuff - 0.02, kCuff, s));
    const double hem = std::exp(-square((s - (kLength - 0.05)) / 0.012)) +
                       std::exp(-square((s - (kCuff + 0.045)) / 0.012)) +
                       std::exp(-square((s - 0.06) / 0.014));
    const double soft = fractal_noise(2.2 * around + Vec3(0.2, 0.7, 2.4 * s), 3, 71);
    const double on_arm = 1 - smooth_step(kCuff - 0.02, kCuff + 0.02, s);
    return on_arm * (0.15 * elbow * sharpened(crease) + 0.060 * arm * sharpened(slanted) +
                     0.085 * gathered * sharpened(ring) + 0.03 * rim * pleat + 0.03 * soft) +
           0.006 * soft - 0.022 * hem;
  }

  /// A wave from -1 to 1 with the round crests and the sharp valleys of folded cloth.
  static double sharpened(double wave) { return 2 * std::sqrt(0.5 + 0.498 * wave) - 1; }

  std::vector<Vec3> centers_;
  std::vector<double> conformal_;
};

struct Place {
  double s, angle;
};

/// Moves `place` along the cloth so that its point comes nearest to `target`: one Newton step.
void follow(const Cloth& cloth, const Vec3& target, Place& place) {
  constexpr double kStep = 1e-4;
  const Vec3 at = cloth.point(place.s, place.angle);
  Eigen::Matrix<double, 3, 2> tangents;
  tangents.col(0) = (cloth.point(place.s + kStep, place.angle) - at) / kStep;
  tangents.col(1) = (cloth.point(place.s, place.angle + kStep) - at) / kStep;
  const Eigen::Matrix2d metric = tangents.transpose() * tangents;
  const Eigen::Vector2d move = metric.inverse() * (tangents.transpose() * (target - at));
  place.s = std::clamp(place.s + move[0], 0.0, kLength);
  place.angle += move[1];
}

}  // namespace

Result<DraftMesh> make_sleeve(Index faces, const Progress& progress) {
  const Cloth cloth;
  // Rows of equilateral triangles: `around` to a row, each row half a step on from the last.
  const double shape = cloth.conformal_length() / (2 * kPi * std::sqrt(0.75));
  const int around = static_cast<int>(std::lround(std::sqrt(faces / (2 * shape))));
  const int rows = static_cast<int>(std::lround(faces / (2.0 * around)));
  DraftMesh mesh;
  std::vector<Place> places;
  for (int j = 0; j <= rows; ++j) {
    const double s = cloth.s_at_conformal(cloth.conformal_length() * j / rows);
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * kPi * (i + 0.5 * (j % 2)) / around;
      places.push_back({s, angle});
      mesh.positions.push_back(cloth.point(s, angle));
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < around; ++i) {
      const Index a = j * around + i;
      const Index b = j * around + (i + 1) % around;
      const Index c = a + around;
      const Index d = b + around;
      if (j % 2 == 0) {
        mesh.faces.push_back({a, b, c});
        mesh.faces.push_back({b, d, c});
      } else {
        mesh.faces.push_back({a, d, c});
        mesh.faces.push_back({a, b, d});
      }
    }
  }
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    if (!report(progress, "smoothing", static_cast<double>(round) / kRounds)) {
      return cancelled_error();
    }
    relax(mesh, [&](Index v, const Vec3& target, const Vec3&) -> Vec3 {
      Place& place = places[static_cast<std::size_t>(v)];
      if (v >= around && v < rows * around) follow(cloth, target, place);
      return cloth.point(place.s, place.angle);
    });
  }
  return mesh;
}

}  // namespace geotherm::generate
