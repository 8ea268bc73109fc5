// SPDX-License-Identifier: MIT
#include "solver/method/straight_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace geotherm {
namespace {

/// So many pieces are looked at one after the other sooner than a tree is walked.
constexpr std::size_t kFew = 8;

float round_down(double x) {
  const auto f = static_cast<float>(x);
  return f <= x ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}

float round_up(double x) { return -round_down(-x); }

/// The straight line from a place to a box.
double length_to(const FloatBox& box, const Vec3& place) {
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    const double outside = std::max({box.low[k] - place[k], place[k] - box.high[k], 0.0});
    square += outside * outside;
  }
  return std::sqrt(square);
}

/// A source point's position; the first corner of its face where it is no vertex.
Vec3 position_of(const TriangleMesh& mesh, const SurfacePoint& point) {
  if (point.is_vertex()) return mesh.positions()[point.vertex];
  const Face& face = mesh.faces()[point.face];
  const Vec3 first = mesh.positions()[face[0]];
  // Differences first: far from the origin no digits are lost.
  return first + point.weights[1] * (mesh.positions()[face[1]] - first) +
         point.weights[2] * (mesh.positions()[face[2]] - first);
}

}  // namespace

StraightLine::StraightLine(const TriangleMesh& mesh, const SourceSet& sources, double unit)
    : scale_(1 / unit) {
  const auto positions = mesh.positions();
  origin_ = sources.points.empty() ? positions[sources.edges.front()[0]]
                                   : position_of(mesh, sources.points.front());
  for (std::size_t i = 0; i < sources.points.size(); ++i) {
    const Vec3 at = place(position_of(mesh, sources.points[i]));
    add(at, at, sources.offsets.empty() ? 0.0 : sources.offsets[i] * scale_);
  }
  for (const auto& [a, b] : sources.edges) add(place(positions[a]), place(positions[b]), 0.0);
  if (pieces_.size() <= kFew) return;
  std::vector<BoxItem> items(pieces_.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    items[i].id = static_cast<Index>(i);
    const Vec3 from = pieces_[i].from, to = from + pieces_[i].along;
    for (int k = 0; k < 3; ++k) {
      items[i].box.low[k] = round_down(std::min(from[k], to[k]));
      items[i].box.high[k] = round_up(std::max(from[k], to[k]));
    }
  }
  tree_ = *build_box_tree(std::move(items), {});  // fails where its progress ends it alone
}

void StraightLine::add(const Vec3& from, const Vec3& to, double offset) {
  const Vec3 along = to - from;
  const double square = along.squaredNorm();
  pieces_.push_back({from, along, square > 0 ? 1 / square : 0.0, offset});
}

double StraightLine::length_to(const Piece& piece, const Vec3& place) const {
  const Vec3 apart = place - piece.from;
  if (piece.inverse_square == 0) return apart.norm() + piece.offset;
  const double share = std::clamp(apart.dot(piece.along) * piece.inverse_square, 0.0, 1.0);
  return (apart - share * piece.along).norm() + piece.offset;
}

Index StraightLine::find(const Vec3& place, double& reach, bool any) const {
  Index found = kNoIndex;
  const auto look_at = [&](Index i) {
    const double length = length_to(pieces_[static_cast<std::size_t>(i)], place);
    if (!(length <= reach)) return false;
    reach = length;
    found = i;
    return any;
  };
  if (tree_.nodes.empty()) {
    for (Index i = 0; i < static_cast<Index>(pieces_.size()); ++i) {
      if (look_at(i)) break;
    }
    return found;
  }
  std::array<std::pair<double, std::uint32_t>, BoxTree::kMaxDepth + 2> waiting;
  std::size_t count = 0;
  waiting[count++] = {geotherm::length_to(tree_.nodes[0].box, place), 0};
  while (count > 0) {
    const auto [far, at] = waiting[--count];
    if (far > reach) continue;
    const BoxNode& node = tree_.nodes[at];
    for (std::uint32_t k = 0; k < node.count; ++k) {
      if (look_at(tree_.ids[node.first + k])) return found;
    }
    if (node.count > 0) continue;
    std::pair<double, std::uint32_t> near{geotherm::length_to(tree_.nodes[node.first].box, place),
                                          node.first};
    std::pair<double, std::uint32_t> other{
        geotherm::length_to(tree_.nodes[node.first + 1].box, place), node.first + 1};
    if (other < near) std::swap(near, other);
    waiting[count++] = other;
    waiting[count++] = near;
  }
  return found;
}

bool StraightLine::find_within(const Vec3& place, double reach, Index& hint) const {
  if (length_to(pieces_[static_cast<std::size_t>(hint)], place) <= reach) return true;
  if (pieces_.size() == 1) return false;
  const Index found = find(place, reach, true);
  if (found == kNoIndex) return false;
  hint = found;
  return true;
}

double StraightLine::length(const Vec3& place) const {
  double reach = kUnreached;
  find(place, reach, false);
  return reach;
}

}  // namespace geotherm
