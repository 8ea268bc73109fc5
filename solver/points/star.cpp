// SPDX-License-Identifier: MIT
#include "solver/points/star.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace geotherm {
namespace {

/// Weight of a point that decides between triangulations of points on one circle, from 0 to 1: its
/// number's bits, mixed (Steele, Lea, Flood 2014).
double tie_weight(Index number) {
  std::uint64_t z = static_cast<std::uint64_t>(number) + 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/// A convex polygon round the origin of the plane whose sides belong to neighbours.
class PlaneCell {
 public:
  /// A square that reaches `reach` to each side, whose sides are nobody's.
  explicit PlaneCell(double reach) : count_(4), farthest_(2 * reach * reach) {
    corners_[0] = {reach, -reach, kNoIndex};
    corners_[1] = {reach, reach, kNoIndex};
    corners_[2] = {-reach, reach, kNoIndex};
    corners_[3] = {-reach, -reach, kNoIndex};
  }

  /// Square of the distance of the farthest corner from the origin.
  double farthest() const { return farthest_; }

  /// Keeps what lies at x a + y b <= c; the new side is `owner`'s. Precondition: c > 0.
  void cut(double a, double b, double c, Index owner) {
    double beyond[kMaxCorners];
    bool any = false;
    for (int i = 0; i < count_; ++i) {
      beyond[i] = corners_[i].x * a + corners_[i].y * b - c;
      any |= beyond[i] > 0;
    }
    if (!any || count_ + 2 > kMaxCorners) return;
    Corner kept[kMaxCorners + 2];
    int next = 0;
    for (int i = 0; i < count_ && next + 2 <= kMaxCorners; ++i) {
      const int j = i + 1 < count_ ? i + 1 : 0;
      if (beyond[i] <= 0) kept[next++] = corners_[i];
      if ((beyond[i] <= 0) == (beyond[j] <= 0)) continue;
      const double share = beyond[i] / (beyond[i] - beyond[j]);
      kept[next++] = {corners_[i].x + share * (corners_[j].x - corners_[i].x),
                      corners_[i].y + share * (corners_[j].y - corners_[i].y),
                      beyond[i] <= 0 ? owner : corners_[i].side};
    }
    count_ = next;
    farthest_ = 0;
    for (int i = 0; i < count_; ++i) {
      corners_[i] = kept[i];
      farthest_ = std::max(farthest_, square(corners_[i]));
    }
  }

  /// Calls emit(before, after) for each corner within `radius` of the origin at which the sides of
  /// two neighbours meet, counter-clockwise.
  template <class Emit>
  void for_corners_within(double radius, const Emit& emit) const {
    for (int i = 0; i < count_; ++i) {
      const Index before = corners_[i > 0 ? i - 1 : count_ - 1].side, after = corners_[i].side;
      if (before == kNoIndex || after == kNoIndex || before == after) continue;
      if (square(corners_[i]) <= radius * radius) emit(before, after);
    }
  }

 private:
  static constexpr int kMaxCorners = NeighbourTree::kMaxNeighbours + 8;

  struct Corner {
    double x, y;
    Index side;  ///< whose the side is that begins here
  };

  static double square(const Corner& corner) { return corner.x * corner.x + corner.y * corner.y; }

  int count_;
  double farthest_;
  Corner corners_[kMaxCorners];
};

}  // namespace

void find_neighbours(const NeighbourTree& tree, std::span<const Vec3> points, Index point,
                     int count, Neighbourhood& out) {
  Index numbers[NeighbourTree::kMaxNeighbours + 1];
  double squares[NeighbourTree::kMaxNeighbours + 1];
  out.point = point;
  out.count = tree.nearest(point, count, numbers, squares);
  out.radius = out.count > 0 ? std::sqrt(squares[out.count - 1]) : 0.0;
  const Vec3& here = points[static_cast<std::size_t>(point)];
  for (int i = 0; i < out.count; ++i) {
    const Vec3 way = (points[static_cast<std::size_t>(numbers[i])] - here) / out.radius;
    out.all[i] = {way, way.squaredNorm(), numbers[i]};
  }
}

Vec3 fitted_normal(const Neighbourhood& around) {
  // The point itself has the full weight of 1.
  double total = 1;
  Vec3 sum = Vec3::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (const auto& neighbour : around.neighbours()) {
    const double weight = (1 - neighbour.square) * (1 - neighbour.square);
    total += weight;
    sum += weight * neighbour.way;
    products += weight * neighbour.way * neighbour.way.transpose();
  }
  products -= sum * sum.transpose() / total;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  axes.computeDirect(products);
  const Vec3 normal = axes.eigenvectors().col(0);
  const double length = normal.norm();
  return length > 0.5 && length < 2 ? Vec3(normal / length) : Vec3::UnitZ();
}

double sheet_gap(const Neighbourhood& around, const Vec3& normal) {
  // The fourth moment in squares of the second: 1 for two values in equal parts, 1.8 for an even
  // spread, as curvature and creases make it, 3 for noise.
  constexpr double kTwoValues = 1.3;
  constexpr double kFlat = 0.02;  // in units of the neighbourhood
  const double count = around.count;
  double mean = 0, second = 0, fourth = 0;
  for (const auto& neighbour : around.neighbours()) mean += neighbour.way.dot(normal) / count;
  for (const auto& neighbour : around.neighbours()) {
    const double height = neighbour.way.dot(normal) - mean, square = height * height;
    second += square / count;
    fourth += square * square / count;
  }
  const bool is_double = second > kFlat * kFlat && fourth < kTwoValues * second * second;
  return is_double ? 2 * std::sqrt(second) : 0;
}

void find_star(const Neighbourhood& around, const Vec3& normal, Star& star) {
  star.triangles.clear();
  Eigen::Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Vec3 across = normal.cross(Vec3::Unit(least)).normalized(), up = normal.cross(across);
  constexpr double kReach = 1;      // of circumradii
  constexpr double kTies = 1e-7;    // how much weights move sides at most
  constexpr double kAbove = 1e-12;  // a neighbour nearer to the normal than this has no side
  const double own = tie_weight(around.point);
  PlaneCell cell(2 * kReach);
  for (int i = 0; i < around.count; ++i) {
    const auto& neighbour = around.all[i];
    // No point of the plane nearer than half the way is nearer to that neighbour.
    if (neighbour.square > 4 * cell.farthest()) break;
    const double x = neighbour.way.dot(across), y = neighbour.way.dot(up);
    if (!(x * x + y * y > kAbove * kAbove)) continue;
    const double tie = kTies * (own - tie_weight(neighbour.number));
    const double least_tie = -neighbour.square / 2;  // the point stays inside its cell
    cell.cut(x, y, (neighbour.square + std::max(tie, least_tie)) / 2, i);
  }
  star.height = 0;
  cell.for_corners_within(kReach, [&](Index before, Index after) {
    const auto &first = around.all[before], &second = around.all[after];
    star.triangles.push_back({first.number, second.number});
    star.height = std::max(star.height, std::abs(second.way.dot(normal)));
  });
}

}  // namespace geotherm
