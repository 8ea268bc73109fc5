// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "solver/mesh/io/raw_mesh.h"

namespace geotherm::io {
namespace {

/// Corners by where they lie in the plane of their polygon, in cells of about one corner each.
class CornerGrid {
 public:
  using Point = Eigen::Vector2d;

  explicit CornerGrid(std::vector<Point> points) : points_(std::move(points)) {
    low_ = high_ = points_.front();
    for (const Point& p : points_) {
      low_ = low_.cwiseMin(p);
      high_ = high_.cwiseMax(p);
    }
    const double size = std::max((high_ - low_).maxCoeff(), 1e-300);
    slack_ = kRounding * size;
    side_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(points_.size()))));
    per_length_ = side_ / size;
    starts_.assign(static_cast<std::size_t>(side_ * side_) + 1, 0);
    for (const Point& p : points_) ++starts_[cell(p) + 1];
    for (std::size_t c = 1; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
    order_.resize(points_.size());
    ends_.assign(starts_.begin(), starts_.end() - 1);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      order_[static_cast<std::size_t>(ends_[cell(points_[i])]++)] = {points_[i],
                                                                     static_cast<int>(i)};
    }
  }

  /// Precondition: the corner is there.
  void remove(int corner) {
    const std::size_t at_cell = cell(at(corner));
    const auto first = order_.begin() + starts_[at_cell];
    *std::find_if(first, order_.end(), [&](const Entry& e) { return e.corner == corner; }) =
        order_[static_cast<std::size_t>(--ends_[at_cell])];
  }

  /// A corner in or close to the triangle of three of them for which `is_found`, or -1. `tests`
  /// becomes less by the cells and corners that were looked at.
  template <class IsFound>
  int find(int a, int b, int c, std::int64_t& tests, const IsFound& is_found) const {
    const Point room = Point::Constant(slack_);
    const Point low = at(a).cwiseMin(at(b)).cwiseMin(at(c)) - room;
    const Point high = at(a).cwiseMax(at(b)).cwiseMax(at(c)) + room;
    const Side sides[] = {{at(a), at(b), slack_}, {at(b), at(c), slack_}, {at(c), at(a), slack_}};
    const int right = column(high.x(), low_.x()), top = column(high.y(), low_.y());
    for (int y = column(low.y(), low_.y()); y <= top; ++y) {
      for (int x = column(low.x(), low_.x()); x <= right; ++x) {
        const auto at_cell = static_cast<std::size_t>(y * side_ + x);
        tests -= 1 + ends_[at_cell] - starts_[at_cell];
        for (int k = starts_[at_cell]; k < ends_[at_cell]; ++k) {
          const auto& [p, corner] = order_[static_cast<std::size_t>(k)];
          if (sides[0].is_beyond(p) || sides[1].is_beyond(p) || sides[2].is_beyond(p)) continue;
          if (is_found(corner)) return corner;
        }
      }
    }
    return -1;
  }

 private:
  static constexpr double kRounding = 1e-9;  ///< of the polygon's size: more than turns are off by

  struct Entry {
    Point point;
    int corner;
  };

  /// The line through two points, counterclockwise around a triangle.
  struct Side {
    Side(const Point& from, const Point& to, double slack)
        : outwards(to.y() - from.y(), from.x() - to.x()),
          most(outwards.dot(from) + slack * outwards.lpNorm<1>()) {}

    bool is_beyond(const Point& p) const { return outwards.dot(p) > most; }

    Point outwards;
    double most;
  };

  const Point& at(int corner) const { return points_[static_cast<std::size_t>(corner)]; }
  int column(double x, double low) const {
    return static_cast<int>(std::clamp((x - low) * per_length_, 0.0, side_ - 1.0));
  }
  std::size_t cell(const Point& p) const {
    return static_cast<std::size_t>(column(p.y(), low_.y()) * side_ + column(p.x(), low_.x()));
  }

  std::vector<Point> points_;
  Point low_, high_;
  double slack_ = 0, per_length_ = 0;
  int side_ = 1;
  std::vector<int> starts_, ends_;
  std::vector<Entry> order_;  ///< the corners that are left, cell by cell
};

std::vector<CornerGrid::Point> in_plane(std::span<const Vec3> positions, const Vec3& normal,
                                        std::span<const Index> corners) {
  const Vec3 right = normal.unitOrthogonal(), up = normal.cross(right);
  const Vec3& origin = positions[static_cast<std::size_t>(corners[0])];
  std::vector<CornerGrid::Point> points;
  points.reserve(corners.size());
  for (const Index v : corners) {
    const Vec3 p = positions[static_cast<std::size_t>(v)] - origin;
    points.emplace_back(p.dot(right), p.dot(up));
  }
  return points;
}

/// One polygon seen along its normal. Corners are numbered in their order; those that are left form
/// a ring. Whether one is an ear changes with its neighbours, and where the corner that lay in its
/// triangle is gone: only then is it looked at again.
class EarCutter {
 public:
  EarCutter(std::span<const Vec3> positions, const Vec3& normal, std::vector<Index> corners)
      : positions_(positions),
        normal_(normal),
        corners_(std::move(corners)),
        grid_(in_plane(positions, normal, corners_)),
        ring_(corners_.size()) {
    const int count = static_cast<int>(corners_.size());
    for (int i = 0; i < count; ++i) {
      ring_[static_cast<std::size_t>(i)].before = (i + count - 1) % count;
      ring_[static_cast<std::size_t>(i)].after = (i + 1) % count;
    }
  }

  /// Cuts the first ear off again and again. False: there was none, or `tests` points were tested,
  /// which becomes what is left of them.
  bool cut(std::span<Face> out, std::int64_t& tests) {
    for (int i = 0; i < static_cast<int>(ring_.size()); ++i) look_at(i, tests);
    for (std::size_t cuts = 0; cuts < out.size(); ++cuts) {
      if (tests < 0) return false;
      const int ear = cuts + 1 == out.size() ? first_left() : take_first_ear();
      if (ear < 0) return false;
      out[cuts] = triangle_at(ear);
      remove(ear, tests);
    }
    return true;
  }

 private:
  struct Corner {
    int before = 0, after = 0;
    bool left = true, is_ear = false;
    int blocker = -1;              ///< found in this one's triangle
    int blocked = -1;              ///< the first of those in whose triangles this one was found
    int previous = -1, next = -1;  ///< in the list of the blocker
  };

  Corner& corner(int i) { return ring_[static_cast<std::size_t>(i)]; }
  Index vertex(int i) const { return corners_[static_cast<std::size_t>(i)]; }
  const Vec3& at(Index v) const { return positions_[static_cast<std::size_t>(v)]; }
  Face triangle_at(int i) { return {vertex(corner(i).before), vertex(i), vertex(corner(i).after)}; }

  double turn(Index a, Index b, Index c) const {
    return (at(b) - at(a)).cross(at(c) - at(a)).dot(normal_);
  }

  bool holds(const Face& t, Index v) const {
    if (!(turn(t[0], t[1], v) >= 0 && turn(t[1], t[2], v) >= 0 && turn(t[2], t[0], v) >= 0)) {
      return false;
    }
    return at(v) != at(t[0]) && at(v) != at(t[1]) && at(v) != at(t[2]);
  }

  void look_at(int i, std::int64_t& tests) {
    Corner& c = corner(i);
    c.is_ear = false;
    unlink(i);
    if (tests < 0) return;
    const Face t = triangle_at(i);
    if (!(turn(t[0], t[1], t[2]) > 0)) return;
    const int blocker =
        grid_.find(c.before, i, c.after, tests, [&](int k) { return holds(t, vertex(k)); });
    if (blocker >= 0) {
      link(i, blocker);
    } else {
      c.is_ear = true;
      ears_.push(i);
    }
  }

  void link(int i, int blocker) {
    Corner& c = corner(i);
    c.blocker = blocker;
    c.previous = -1;
    c.next = std::exchange(corner(blocker).blocked, i);
    if (c.next >= 0) corner(c.next).previous = i;
  }

  void unlink(int i) {
    Corner& c = corner(i);
    if (c.blocker < 0) return;
    (c.previous >= 0 ? corner(c.previous).next : corner(c.blocker).blocked) = c.next;
    if (c.next >= 0) corner(c.next).previous = c.previous;
    c.blocker = -1;
  }

  int take_first_ear() {
    while (!ears_.empty()) {
      const int i = ears_.top();
      ears_.pop();
      if (corner(i).left && corner(i).is_ear) return i;
    }
    return -1;
  }

  int first_left() const {
    const auto found = std::ranges::find(ring_, true, &Corner::left);
    return static_cast<int>(found - ring_.begin());
  }

  void remove(int i, std::int64_t& tests) {
    Corner& c = corner(i);
    c.left = false;
    grid_.remove(i);
    unlink(i);
    corner(c.before).after = c.after;
    corner(c.after).before = c.before;
    look_at(c.before, tests);
    look_at(c.after, tests);
    while (c.blocked >= 0) look_at(c.blocked, tests);
  }

  std::span<const Vec3> positions_;
  Vec3 normal_;
  std::vector<Index> corners_;
  CornerGrid grid_;
  std::vector<Corner> ring_;
  /// The first in the order of corners comes first; some are no ears any more.
  std::priority_queue<int, std::vector<int>, std::greater<>> ears_;
};

}  // namespace

bool PolygonCutter::triangulate(std::span<const Vec3> positions, std::span<Face> fan) {
  const auto cross = [&](const Face& f) -> Vec3 {
    const auto at = [&](int k) -> const Vec3& {
      return positions[static_cast<std::size_t>(f[static_cast<std::size_t>(k)])];
    };
    return (at(1) - at(0)).cross(at(2) - at(0));
  };
  Vec3 normal = Vec3::Zero();
  for (const Face& f : fan) normal += cross(f);
  const bool folded =
      std::ranges::any_of(fan, [&](const Face& f) { return !(cross(f).dot(normal) > 0); });
  // Beyond the range of doubles no place in the plane is known: the fan stays.
  const double area = normal.norm();
  if (!folded || !(area > 0) || !std::isfinite(area)) return true;
  if (tests_ < 0) return false;

  std::vector<Index> corners = {fan[0][0], fan[0][1]};
  for (const Face& f : fan) corners.push_back(f[2]);
  EarCutter cutter(positions, normal.normalized(), std::move(corners));
  std::vector<Face> ears(fan.size());
  if (cutter.cut(ears, tests_)) std::ranges::copy(ears, fan.begin());
  return tests_ >= 0;
}

}  // namespace geotherm::io
