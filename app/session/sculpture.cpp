// SPDX-License-Identifier: MIT
#include "app/session/sculpture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <string>

namespace geotherm::app {
namespace {

constexpr double kUnreached = std::numeric_limits<double>::infinity();

/// Whether `whole` is `part` with further points, or the same.
bool goes_on(const Stroke& part, const Stroke& whole) {
  return part.tool == whole.tool && part.radius == whole.radius &&
         part.strength == whole.strength && part.points.size() <= whole.points.size() &&
         std::equal(part.points.begin(), part.points.end(), whole.points.begin());
}

}  // namespace

bool operator==(const Sculpture& a, const Sculpture& b) {
  return std::ranges::equal(a.strokes, b.strokes,
                            [](const auto& x, const auto& y) { return x == y || *x == *y; });
}

Sculptor::Sculptor(std::shared_ptr<const TriangleMesh> mesh)
    : mesh_(std::move(mesh)),
      corners_(mesh_->vertex_count(), mesh_->faces()),
      positions_(mesh_->positions().begin(), mesh_->positions().end()),
      way_(positions_.size(), kUnreached),
      moved_in_(positions_.size(), 0) {}

Result<void> Sculptor::follow(const Sculpture& wanted) {
  const auto& strokes = wanted.strokes;
  std::size_t same = 0;
  while (same < done_.size() && same < strokes.size() &&
         goes_on(done_[same].stroke, *strokes[same])) {
    const bool whole = done_[same].stroke.points.size() == strokes[same]->points.size();
    if (!whole && same + 1 < done_.size()) break;  // others were done on top of it
    ++same;
  }
  for (; done_.size() > same; done_.pop_back()) take_back(done_.back());
  for (std::size_t i = same > 0 ? same - 1 : 0; i < strokes.size(); ++i) {
    if (i == done_.size()) {
      const Stroke& next = *strokes[i];
      done_.push_back({{next.tool, next.radius, next.strength, {}}, {}, ++last_number_});
    }
    const std::vector<FacePoint>& points = strokes[i]->points;
    for (std::size_t k = done_[i].stroke.points.size(); k < points.size(); ++k) {
      if (auto done = touch(done_[i], points[k]); !done) return done;
    }
  }
  join_welded();
  return {};
}

void Sculptor::take_back(const Done& stroke) {
  for (const auto& [v, position] : stroke.before) positions_[v] = position;
}

Result<void> Sculptor::touch(Done& stroke, const FacePoint& point) {
  if (point.face < 0 || point.face >= mesh_->face_count() ||
      repeats_corner(mesh_->faces()[point.face])) {
    return Error{
        ErrorCode::kBadInput,
        "there is no face " + std::to_string(point.face) + " to sculpt",
        {"faces with three corners are among 0 to " + std::to_string(mesh_->face_count() - 1)}};
  }
  const auto& [tool, radius, strength, points] = stroke.stroke;
  const std::vector<Moved> all = patch(point, radius);
  std::vector<Vec3> targets;  // all from where the others are before this touch
  targets.reserve(all.size());
  if (tool == SculptTool::kSmooth) {
    for (const auto& [v, weight] : all) {
      targets.push_back(positions_[v] +
                        strength * weight * (mean_of_neighbours(v) - positions_[v]));
    }
  } else {
    const double sign = tool == SculptTool::kPull ? 1 : -1;
    const Vec3 step = sign * strength * radius * normal(all, radius);
    for (const auto& [v, weight] : all) targets.push_back(positions_[v] + weight * step);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Index v = all[i].vertex;
    if (std::exchange(moved_in_[v], stroke.number) != stroke.number) {
      stroke.before.emplace_back(v, positions_[v]);
    }
    positions_[v] = targets[i];
  }
  stroke.stroke.points.push_back(point);
  return {};
}

/// Dijkstra's ways over edges from the corners of the touched face.
std::vector<Sculptor::Moved> Sculptor::patch(const FacePoint& point, double radius) {
  using Waiting = std::pair<double, Index>;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting;
  std::vector<Index> reached;
  const auto reach = [&](Index v, double way) {
    if (!(way < std::numbers::sqrt2 * radius) || way >= way_[v]) return;
    if (way_[v] == kUnreached) reached.push_back(v);
    way_[v] = way;
    waiting.emplace(way, v);
  };
  const Face& face = mesh_->faces()[point.face];
  Vec3 middle = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) middle += point.weights[k] * positions_[face[k]];
  for (const Index v : face) reach(v, (positions_[v] - middle).norm());
  while (!waiting.empty()) {
    const auto [way, v] = waiting.top();
    waiting.pop();
    if (way > way_[v]) continue;
    for (const Side corner : corners_.at(v)) {
      const Face& around = mesh_->faces()[face_of(corner)];
      const int k = corner_of(corner);
      for (const Index to : {around[next_corner(k)], around[previous_corner(k)]}) {
        reach(to, way + (positions_[to] - positions_[v]).norm());
      }
    }
  }
  std::vector<Moved> moved;
  for (const Index v : reached) {
    const double straight = (positions_[v] - middle).norm();
    const double share = std::max(straight, way_[v] / std::numbers::sqrt2) / radius;
    if (share < 1) moved.push_back({v, (1 - share * share) * (1 - share * share)});
    way_[v] = kUnreached;
  }
  return moved;
}

/// The mean normal of the faces at the patch, by area and weight; 0 where they cancel.
Vec3 Sculptor::normal(const std::vector<Moved>& patch, double radius) const {
  Vec3 sum = Vec3::Zero();
  for (const auto& [v, weight] : patch) {
    for (const Side corner : corners_.at(v)) {
      const Face& face = mesh_->faces()[face_of(corner)];
      const Vec3 a = positions_[face[0]], b = positions_[face[1]], c = positions_[face[2]];
      sum += weight * ((b - a) / radius).cross((c - a) / radius);
    }
  }
  return sum.stableNormalized();
}

Vec3 Sculptor::mean_of_neighbours(Index vertex) const {
  std::vector<Index> around;  // each as often as faces join it to the vertex
  for (const Side corner : corners_.at(vertex)) {
    const Face& face = mesh_->faces()[face_of(corner)];
    if (repeats_corner(face)) continue;
    const int k = corner_of(corner);
    around.push_back(face[next_corner(k)]);
    around.push_back(face[previous_corner(k)]);
  }
  std::ranges::sort(around);
  Vec3 all = Vec3::Zero(), border = Vec3::Zero();
  double count = 0, on_border = 0;
  for (std::size_t i = 0; i < around.size();) {
    const std::size_t begin = i;
    while (i < around.size() && around[i] == around[begin]) ++i;
    all += positions_[around[begin]];
    ++count;
    if (i - begin > 1) continue;
    border += positions_[around[begin]];
    ++on_border;
  }
  if (on_border > 0) return border / on_border;
  return count > 0 ? Vec3(all / count) : positions_[vertex];
}

/// Vertices that another one stands for lie where it does, once it has moved.
void Sculptor::join_welded() {
  for (std::size_t v = 0; v < mesh_->same_as().size(); ++v) {
    const Index low = mesh_->same_as()[v];
    if (static_cast<std::size_t>(low) == v) continue;
    const bool moved = positions_[low] != mesh_->positions()[low];
    positions_[v] = moved ? positions_[low] : mesh_->positions()[v];
  }
}

}  // namespace geotherm::app
