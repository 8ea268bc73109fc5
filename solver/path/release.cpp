// SPDX-License-Identifier: MIT
#include "solver/path/release.h"

#include <numbers>
#include <string>
#include <utility>

#include "solver/path/vertex_link.h"

namespace geotherm {
namespace {

/// A path that turns by less than this (radians) gains less than round-off by being straightened.
constexpr double kStraight = 1e-8;

/// A step must shorten the legs by more than this share of their length, or it is round-off.
constexpr double kMinGain = 1e-14;

Error outside_face(std::size_t piece) {
  return {ErrorCode::kBadInput,
          "piece " + std::to_string(piece) + " of the path does not lie in its face",
          {"give two points of one face each"}};
}

/// The piece's face among the clean ones: the same, or another that holds both points where the
/// file's was left out.
std::optional<Index> clean_piece(const PathSurface& surface, const SurfacePoint& a,
                                 const SurfacePoint& b, Index file_face) {
  std::optional<Index> found;
  for (const Index f : surface.faces_at(a)) {
    if (!surface.express(b, f)) continue;
    if (surface.file_face(f) == file_face) return f;
    if (!found) found = f;
  }
  return found;
}

}  // namespace

ShortenBudget::ShortenBudget(const PathSurface& surface, const Progress& progress)
    : progress_(progress), most_(1000 + 4 * surface.faces().size()) {}

Result<void> ShortenBudget::spend() {
  constexpr std::size_t kAskEvery = 64;
  if (spent_ % kAskEvery == 0 && !report(progress_, "shortening the path", -1)) {
    return cancelled_error();
  }
  if (++spent_ <= most_) return {};
  return Error{ErrorCode::kBudgetEnded,
               "the path was not straight after " + std::to_string(most_) + " steps",
               {"choose nearer points or way-points"}};
}

Result<std::vector<Leg>> tight_legs(const PathSurface& surface, const SurfacePath& path) {
  std::vector<SurfacePoint> points;
  for (const SurfacePoint& point : path.points) {
    const auto inside = surface.into(point);
    if (!inside) return inside.error();
    points.push_back(*inside);
  }
  std::vector<Leg> legs;
  std::size_t from = 0;
  std::vector<Index> strip;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto face = i < path.faces.size()
                          ? clean_piece(surface, points[i], points[i + 1], path.faces[i])
                          : std::nullopt;
    if (!face) return outside_face(i);
    if (!strip.empty() && strip.back() != *face &&
        surface.shared_edge(strip.back(), *face) == kNoIndex) {
      return outside_face(i);
    }
    strip.push_back(*face);
    if (!points[i + 1].is_vertex() && i + 2 < points.size()) continue;
    for (Leg& leg : pull_tight(surface, points[from], points[i + 1], std::move(strip))) {
      legs.push_back(std::move(leg));
    }
    from = i + 1;
    strip.clear();
  }
  return legs;
}

std::optional<std::vector<Index>> strip_past(const PathSurface& surface, const Leg& in,
                                             const Leg& out, std::span<const Index> closed) {
  const auto way =
      narrowest_way(surface, in.to.vertex, {in.faces.back(), in.to_angle},
                    {out.faces.front(), out.from_angle}, std::numbers::pi - kStraight, closed);
  if (!way) return std::nullopt;
  std::vector<Index> strip = in.faces;
  strip.insert(strip.end(), way->faces.begin(), way->faces.end());
  strip.insert(strip.end(), out.faces.begin(), out.faces.end());
  return strip;
}

bool is_shorter(double length, double before) { return length < before * (1 - kMinGain); }

Result<void> release_bends(const PathSurface& surface, std::vector<Leg>& legs,
                           ShortenBudget& budget) {
  std::size_t i = 0;
  while (i + 1 < legs.size()) {
    if (auto spent = budget.spend(); !spent) return spent;
    auto strip = strip_past(surface, legs[i], legs[i + 1]);
    const double before = legs[i].length + legs[i + 1].length;
    std::vector<Leg> shorter;
    if (strip) shorter = pull_tight(surface, legs[i].from, legs[i + 1].to, *std::move(strip));
    if (!strip || !is_shorter(length_of(shorter), before)) {
      ++i;
      continue;
    }
    const auto first = legs.erase(legs.begin() + static_cast<std::ptrdiff_t>(i),
                                  legs.begin() + static_cast<std::ptrdiff_t>(i) + 2);
    legs.insert(first, std::make_move_iterator(shorter.begin()),
                std::make_move_iterator(shorter.end()));
    if (i > 0) --i;
  }
  return {};
}

SurfacePath path_of(const PathSurface& surface, const std::vector<Leg>& legs,
                    const SurfacePoint& start) {
  std::vector<SurfacePoint> points = {legs.empty() ? start : legs.front().from};
  std::vector<Index> faces;
  for (const Leg& leg : legs) append_points(surface, leg, points, faces);
  SurfacePath path;
  for (const SurfacePoint& point : points) path.points.push_back(surface.out_of(point));
  for (const Index face : faces) path.faces.push_back(surface.file_face(face));
  path.length = length_of(*surface.mesh(), path.points);
  return path;
}

}  // namespace geotherm
