// SPDX-License-Identifier: MIT
#include "solver/path/funnel.h"

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

}  // namespace geotherm
