// SPDX-License-Identifier: MIT
// Source sets as wholes: several as one, and what one is made of.
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "app/session/sources.h"

namespace geotherm::app {

void SetUnion::add(const SurfacePoint& point, double offset) {
  if (point.is_vertex()) {
    const auto [known, fresh] = vertices_.try_emplace(point.vertex, set_.points.size());
    if (!fresh) {
      set_.offsets[known->second] = std::min(set_.offsets[known->second], offset);
      return;
    }
  }
  set_.points.push_back(point);
  set_.offsets.push_back(offset);
}

void SetUnion::add(const SourceSet& more) {
  for (std::size_t i = 0; i < more.points.size(); ++i) {
    add(more.points[i], more.offsets.empty() ? 0 : more.offsets[i]);
  }
  edges_.insert(more.edges.begin(), more.edges.end());
  std::map<Index, Index> number;
  for (FaceSegment segment : more.segments) {
    const auto [at, fresh] = number.try_emplace(segment.curve, curves_);
    curves_ += fresh;
    segment.curve = at->second;
    set_.segments.push_back(segment);
  }
  for (const CellPoint& point : more.cell_points) add(point);
}

SourceSet SetUnion::take() {
  set_.edges.assign(edges_.begin(), edges_.end());
  if (std::ranges::all_of(set_.offsets, [](double x) { return x == 0; })) set_.offsets.clear();
  vertices_.clear();
  edges_.clear();
  curves_ = 0;
  return std::exchange(set_, {});
}

const SurfacePoint* only_point(const SourceSet& set) {
  const bool other = !set.edges.empty() || !set.segments.empty() || !set.cell_points.empty();
  return other || set.points.size() != 1 ? nullptr : &set.points.front();
}

std::vector<Index> vertices_of(const SourceSet& set) {
  std::set<Index> vertices;
  for (const SurfacePoint& point : set.points) {
    if (point.is_vertex()) vertices.insert(point.vertex);
  }
  for (const auto& edge : set.edges) vertices.insert(edge.begin(), edge.end());
  return {vertices.begin(), vertices.end()};
}

}  // namespace geotherm::app
