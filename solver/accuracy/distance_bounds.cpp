// SPDX-License-Identifier: MIT
#include "solver/accuracy/distance_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "solver/core/parallel.h"
#include "solver/core/text.h"

namespace geotherm {
namespace {

/// So many pieces are looked at one after the other sooner than a tree is walked.
constexpr std::size_t kFew = 8;

/// What computing a straight line may leave, in mean edges and of the line: a source stays at 0.
constexpr double kRounding = 1e-12;

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

/// The least coordinates of all, whatever their order.
Vec3 least_corner(std::span<const LineSource> sources) {
  Vec3 least = sources.front().from;
  for (const LineSource& source : sources) least = least.cwiseMin(source.from).cwiseMin(source.to);
  return least;
}

std::vector<LineSource> lines_of(const TriangleMesh& mesh, const SourceSet& sources) {
  std::vector<LineSource> out;
  for (std::size_t i = 0; i < sources.points.size(); ++i) {
    const Vec3 at = position_of(mesh, sources.points[i]);
    out.push_back({at, at, sources.offsets.empty() ? 0.0 : sources.offsets[i]});
  }
  const auto positions = mesh.positions();
  for (const auto& [a, b] : sources.edges) out.push_back({positions[a], positions[b], 0.0});
  for (const FaceSegment& segment : sources.segments) {
    out.push_back({position_of(mesh, SurfacePoint::in_face(segment.face, segment.from)),
                   position_of(mesh, SurfacePoint::in_face(segment.face, segment.to)), 0.0});
  }
  return out;
}

}  // namespace

StraightLine::StraightLine(const TriangleMesh& mesh, const SourceSet& sources, double unit)
    : StraightLine(lines_of(mesh, sources), unit) {}

StraightLine::StraightLine(std::span<const LineSource> sources, double unit)
    : origin_(least_corner(sources)), scale_(1 / unit) {
  for (const LineSource& source : sources) {
    add(place(source.from), place(source.to), source.offset * scale_);
  }
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
  if (std::ranges::lexicographical_compare(to, from)) return add(to, from, offset);
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

namespace {

/// What the vertices say.
struct LineFigures {
  Index reached = 0, below = 0;
  double most = 0;   ///< share of the straight line that is missing, of those below
  double reach = 0;  ///< straight line to the farthest vertex at distance 0

  void add(const LineFigures& other) {
    reached += other.reached;
    below += other.below;
    most = std::max(most, other.most);
    reach = std::max(reach, other.reach);
  }
};

std::string percent(double share) { return rounded_text(100 * share) + " %"; }

/// What to use instead of a method whose answer is wrong.
Hint remedy(MethodKind method) {
  switch (method) {
    case MethodKind::kHeat:
    case MethodKind::kFastMarching:
      return {"use ", SettingHint{"method", {"wavefront"}}};
    case MethodKind::kWavefront:
    case MethodKind::kWavefrontFine:
      return {"use ", SettingHint{"method", {"exact"}}};
    case MethodKind::kExact:
      break;
  }
  return {"look at what is wrong with the mesh"};
}

}  // namespace

BoundTolerance bound_tolerance(MethodKind method) {
  switch (method) {
    case MethodKind::kHeat:
      return {0.1, 2, 1, 0.1};
    case MethodKind::kFastMarching:
      return {0.05, 0.5, 0.5, 0.1};
    case MethodKind::kWavefront:
    case MethodKind::kWavefrontFine:
      return {0.05, 0.1, 0.5, 0.1};
    case MethodKind::kExact:
      break;
  }
  return {1e-6, 1e-6, 1e-6, 1e-6};
}

void apply_straight_line_bound(const IntrinsicSurface& surface, const SourceSet& sources,
                               double unit, const BoundTolerance& tolerance, BelowLine below,
                               int threads, DistanceResult& result) {
  apply_straight_line_bound(surface.mesh->positions(),
                            StraightLine(*surface.mesh, sources, surface.mean_edge),
                            surface.mean_edge, unit, tolerance, below, threads, result);
}

void apply_straight_line_bound(std::span<const Vec3> positions, const StraightLine& straight,
                               double mean_edge, double unit, const BoundTolerance& tolerance,
                               BelowLine below, int threads, DistanceResult& result) {
  const bool raises = below == BelowLine::kRaised;
  const double to_edges = unit / mean_edge, from_edges = mean_edge / unit;
  const double per_share = 1 / (1 - tolerance.line_share);
  const bool clamped = result.quality.clamped_vertices > 0;
  const auto is_more = [](double line, double distance) {
    return line > distance + kRounding * (1 + line);
  };
  // One source, as most are: by some vertices at once without branches, few of which are below.
  constexpr std::size_t kAtOnce = 8;
  const auto raise_to_point = [&](std::int64_t begin, std::int64_t end) {
    LineFigures sum;
    const auto last = static_cast<std::size_t>(end);
    for (auto first = static_cast<std::size_t>(begin); first < last; first += kAtOnce) {
      const std::size_t next = std::min(first + kAtOnce, last);
      bool some = false;
      for (std::size_t v = first; v < next; ++v) {
        const double distance = result.distances[v] * to_edges;
        sum.reached += distance < kUnreached ? 1 : 0;
        some |= straight.square_to_point(straight.place(positions[v])) > distance * distance;
      }
      for (std::size_t v = first; v < (some ? next : first); ++v) {
        const double distance = result.distances[v] * to_edges;
        const double line = std::sqrt(straight.square_to_point(straight.place(positions[v])));
        if (!(line < kUnreached)) continue;  // beyond the range of doubles
        if (is_more(line, distance)) result.distances[v] = line * from_edges;
        if (!(line > (distance + tolerance.line_edges) * per_share)) continue;
        ++sum.below;
        sum.most = std::max(sum.most, 1 - distance / line);
      }
    }
    return sum;
  };
  LineFigures all;
  for (const LineFigures& part : sums_of_blocks<LineFigures>(
           threads, std::ssize(positions), [&](std::int64_t begin, std::int64_t end) {
             if (raises && !clamped && straight.is_point()) return raise_to_point(begin, end);
             LineFigures sum;
             Index hint = 0;
             for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end);
                  ++v) {
               const double distance = result.distances[v] * to_edges;
               if (!(distance < kUnreached)) continue;
               ++sum.reached;
               const double most = (distance + tolerance.line_edges) * per_share;
               const Vec3 place = straight.place(positions[v]);
               if (distance == 0 && clamped)
                 sum.reach = std::max(sum.reach, straight.length(place));
               const double line = straight.length_beyond(place, raises ? distance : most, hint);
               if (!(line > 0 && line < kUnreached)) continue;  // beyond the range of doubles
               if (raises && is_more(line, distance)) result.distances[v] = line * from_edges;
               if (!(line > most)) continue;
               ++sum.below;
               sum.most = std::max(sum.most, 1 - distance / line);
             }
             return sum;
           })) {
    all.add(part);
  }
  result.quality.reached_vertices = all.reached;
  result.quality.below_straight_line = all.below;
  result.quality.most_below_straight_line = all.most;
  result.quality.clamped_reach = all.reach / to_edges;
  result.quality.lines_checked = true;
}

void add_bound_warnings(MethodKind method, DistanceResult& result, BelowLine below) {
  const Quality& q = result.quality;
  if (q.below_straight_line > 0) {
    result.warnings.push_back(
        {"the distance of " +
             counted_text(static_cast<std::size_t>(q.below_straight_line), "vertex", "vertices") +
             " (" + percent(static_cast<double>(q.below_straight_line) / q.reached_vertices) +
             ") came out below the straight line to the nearest source, by up to " +
             percent(q.most_below_straight_line) + " of it" +
             (below == BelowLine::kRaised
                  ? ", and was raised to it: where ways bend it may still be too short"
                  : "; it is wrong around there"),
         remedy(method)});
  }
  if (q.steep_edges > 0) {
    result.warnings.push_back(
        {"along " + counted_text(static_cast<std::size_t>(q.steep_edges), "edge", "edges") +
             " the distance differs by more than their length, by up to " +
             rounded_text(q.steepest_edge) + " times that; it is wrong around them",
         remedy(method)});
  }
}

}  // namespace geotherm
