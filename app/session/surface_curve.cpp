// SPDX-License-Identifier: MIT
#include "app/session/surface_curve.h"

#include <algorithm>
#include <deque>
#include <string>
#include <unordered_map>
#include <utility>

#include "solver/path/path_surface.h"
#include "solver/path/shorten.h"

namespace geotherm::app {
namespace {

/// The fewest faces that lead from a point to another, each sharing an edge with the next; none
/// where no edges lead there.
std::vector<Index> faces_between(const PathSurface& surface, const SurfacePoint& from,
                                 const SurfacePoint& to) {
  const std::vector<Index> goals = surface.faces_at(to);
  std::unordered_map<Index, Index> before;
  std::deque<Index> queue;
  for (const Index f : surface.faces_at(from)) {
    before.emplace(f, kNoIndex);
    queue.push_back(f);
  }
  while (!queue.empty()) {
    const Index f = queue.front();
    queue.pop_front();
    if (std::ranges::find(goals, f) != goals.end()) {
      std::vector<Index> faces;
      for (Index at = f; at != kNoIndex; at = before.at(at)) faces.push_back(at);
      std::ranges::reverse(faces);
      return faces;
    }
    for (int k = 0; k < 3; ++k) {
      for (const Side side : surface.edges().sides(surface.edge_at(3 * f + k))) {
        if (before.try_emplace(face_of(side), f).second) queue.push_back(face_of(side));
      }
    }
  }
  return {};
}

/// A point of a clean face as weights in that face of the file.
std::array<double, 3> weights_in(const PathSurface& surface, const SurfacePoint& point, Index f) {
  SurfacePoint inside = *surface.express(point, f);
  if (inside.is_vertex()) {
    const int corner = surface.corner_of_vertex(f, inside.vertex);
    inside = SurfacePoint::in_face(f, {});
    inside.weights[static_cast<std::size_t>(corner)] = 1;
  }
  return surface.out_of(inside).weights;
}

/// Adds the line from one point to the next; false: no edges lead there.
Result<bool> join_two(const PathSurface& surface, const SurfacePoint& a, const SurfacePoint& b,
                      std::vector<FaceSegment>& out) {
  const auto from = surface.into(a), to = surface.into(b);
  if (!from || !to) return (from ? to : from).error();
  std::vector<Index> strip = faces_between(surface, *from, *to);
  if (strip.empty()) return false;
  auto segments = pull_tight(surface, *from, *to, std::move(strip));
  const Progress nobody;
  StepBudget budget(surface, nobody);
  if (auto done = straighten_bends(surface, segments, budget); !done) return done.error();
  std::vector<SurfacePoint> line = {*from};
  std::vector<Index> faces;
  for (const PathSegment& segment : segments) append_points(surface, segment, line, faces);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    out.push_back({surface.file_face(faces[k]), weights_in(surface, line[k], faces[k]),
                   weights_in(surface, line[k + 1], faces[k])});
  }
  return true;
}

}  // namespace

Result<std::vector<FaceSegment>> CurveJoiner::join(const std::vector<SurfacePoint>& points) {
  if (!surface_) surface_ = std::make_shared<const PathSurface>(mesh_);
  const auto same =
      static_cast<std::size_t>(std::ranges::mismatch(points_, points).in1 - points_.begin());
  points_.resize(same);
  ends_.resize(same);
  segments_.resize(ends_.empty() ? 0 : ends_.back());
  for (std::size_t i = same; i < points.size(); ++i) {
    if (i > 0) {
      const auto joined = join_two(*surface_, points[i - 1], points[i], segments_);
      if (!joined) return joined.error();
      if (!*joined) {
        return Error{ErrorCode::kBadInput,
                     "no edges lead from point " + std::to_string(i) + " of the curve to point " +
                         std::to_string(i + 1),
                     {"begin another curve there"}};
      }
    }
    points_.push_back(points[i]);
    ends_.push_back(segments_.size());
  }
  return segments_;
}

}  // namespace geotherm::app
