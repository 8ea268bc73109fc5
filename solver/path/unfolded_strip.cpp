// SPDX-License-Identifier: MIT
#include "solver/path/unfolded_strip.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace geotherm {

Funnel::Funnel(const std::vector<Vec2>& points, int start, int left, int right)
    : points_(points),
      deque_(2 * points.size() + 3, -1),
      before_(points.size(), -1),
      front_(points.size()),
      back_(points.size() + 2),
      apex_(points.size() + 1) {
  deque_[front_] = left;
  deque_[apex_] = start;
  deque_[back_] = right;
  before_[static_cast<std::size_t>(left)] = before_[static_cast<std::size_t>(right)] = start;
}

double Funnel::turn(int a, int b, int c) const {
  const Vec2 along = points_[static_cast<std::size_t>(b)] - points_[static_cast<std::size_t>(a)];
  const Vec2 to = points_[static_cast<std::size_t>(c)] - points_[static_cast<std::size_t>(a)];
  return along.x() * to.y() - along.y() * to.x();
}

void Funnel::add_left(int post) {
  while (front_ < back_) {
    const double side = turn(deque_[front_], deque_[front_ + 1], post);
    if (front_ < apex_ ? side < 0 : side >= 0) break;  // what is outermost is in the way
    if (front_ == apex_) ++apex_;
    ++front_;
  }
  before_[static_cast<std::size_t>(post)] = deque_[front_];
  deque_[--front_] = post;
}

void Funnel::add_right(int post) {
  while (front_ < back_) {
    const double side = turn(deque_[back_], deque_[back_ - 1], post);
    if (back_ > apex_ ? side > 0 : side <= 0) break;
    if (back_ == apex_) --apex_;
    --back_;
  }
  before_[static_cast<std::size_t>(post)] = deque_[back_];
  deque_[++back_] = post;
}

std::vector<int> Funnel::path_to(int end) {
  add_left(end);
  std::vector<int> path;
  for (int at = end; at >= 0; at = before_[static_cast<std::size_t>(at)]) path.push_back(at);
  std::reverse(path.begin(), path.end());
  return path;
}

namespace {

/// Where the third corner of a triangle lies over its base: along it from its first end, and away
/// from it.
struct OverBase {
  double along, away;
};

OverBase over_base(const Vec3& first, const Vec3& second, const Vec3& third) {
  const Vec3 base = second - first, to = third - first;
  const double length = base.norm();
  if (!(length > 0)) return {0, to.norm()};
  return {base.dot(to) / length, base.cross(to).norm() / length};
}

class StripLayout {
 public:
  explicit StripLayout(const PathSurface& surface) : surface_(surface) {}

  void place_first(Index face, int apex) {
    const Face& f = surface_.face(face);
    const int a = next_corner(apex), b = previous_corner(apex);
    const Vec3 &pa = surface_.position(f[a]), &pb = surface_.position(f[b]);
    const OverBase third = over_base(pa, pb, surface_.position(f[apex]));
    add(f[a], {0, 0});
    add(f[b], {(pb - pa).norm(), 0});
    add(f[apex], {third.along, third.away});
    out.faces.push_back({});
    out.faces.back()[static_cast<std::size_t>(a)] = 0;
    out.faces.back()[static_cast<std::size_t>(b)] = 1;
    out.faces.back()[static_cast<std::size_t>(apex)] = 2;
  }

  /// The way goes on downwards, through the base of the first face.
  void open_first_gate() { open({1, 0}); }

  /// Lays out the face behind the last gate.
  void place_next(Index face) {
    const UnfoldedStrip::Gate gate = out.gates.back();
    const Index left = out.corners[at(gate.left)].vertex;
    const Index right = out.corners[at(gate.right)].vertex;
    const Face& f = surface_.face(face);
    int apex = 0;
    while (f[apex] == left || f[apex] == right) ++apex;
    const OverBase third =
        over_base(surface_.position(right), surface_.position(left), surface_.position(f[apex]));
    const Vec2 base = out.points[at(gate.left)] - out.points[at(gate.right)];
    const double length = base.norm();
    const Vec2 along = length > 0 ? Vec2(base / length) : Vec2(1, 0);
    const Vec2 forward(along.y(), -along.x());
    const int corner =
        add(f[apex], out.points[at(gate.right)] + third.along * along + third.away * forward);
    out.faces.push_back({});
    for (std::size_t k = 0; k < 3; ++k) {
      out.faces.back()[k] = f[k] == left ? gate.left : f[k] == right ? gate.right : corner;
    }
  }

  /// Opens the next gate, to a face that holds one of the last gate's posts.
  void open_next_gate(Index next_face) {
    const UnfoldedStrip::Gate gate = out.gates.back();
    const int apex = static_cast<int>(out.corners.size()) - 1;
    const bool keeps_left =
        surface_.corner_of_vertex(next_face, out.corners[at(gate.left)].vertex) >= 0 &&
        surface_.corner_of_vertex(next_face, out.corners[at(apex)].vertex) >= 0;
    open(keeps_left ? UnfoldedStrip::Gate{gate.left, apex} : UnfoldedStrip::Gate{apex, gate.right});
  }

  void add_end(const SurfacePoint& point, Index face, const std::array<int, 3>& corners) {
    Vec2 place = Vec2::Zero();
    if (point.is_vertex()) {
      place = out.points[at(corners[at(surface_.corner_of_vertex(face, point.vertex))])];
    } else {
      for (std::size_t k = 0; k < 3; ++k) place += point.weights[k] * out.points[at(corners[k])];
    }
    out.points.push_back(place);
  }

  UnfoldedStrip out;

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  int add(Index vertex, const Vec2& place) {
    out.corners.push_back({vertex, static_cast<int>(out.gates.size()), -1});
    out.points.push_back(place);
    return static_cast<int>(out.corners.size()) - 1;
  }

  void open(UnfoldedStrip::Gate gate) {
    const int number = static_cast<int>(out.gates.size());
    out.corners[at(gate.left)].last_gate = out.corners[at(gate.right)].last_gate = number;
    out.gates.push_back(gate);
  }

  const PathSurface& surface_;
};

}  // namespace

UnfoldedStrip unfold(const PathSurface& surface, const SurfacePoint& from, const SurfacePoint& to,
                     const std::vector<Index>& faces) {
  StripLayout layout(surface);
  layout.out.points.reserve(faces.size() + 4);
  layout.out.corners.reserve(faces.size() + 2);
  int apex = 0;
  if (faces.size() > 1) {
    const Index edge = surface.shared_edge(faces[0], faces[1]);
    while (surface.edge_at(3 * faces[0] + next_corner(apex)) != edge) ++apex;
  }
  layout.place_first(faces[0], apex);
  for (std::size_t k = 1; k < faces.size(); ++k) {
    if (k == 1) {
      layout.open_first_gate();
    } else {
      layout.open_next_gate(faces[k]);
    }
    layout.place_next(faces[k]);
  }
  layout.add_end(from, faces.front(), layout.out.faces.front());
  layout.add_end(to, faces.back(), layout.out.faces.back());
  return std::move(layout.out);
}

}  // namespace geotherm
