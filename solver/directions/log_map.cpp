// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <new>
#include <numbers>
#include <string>
#include <utility>

#include "solver/directions/directions_state.h"
#include "solver/method/reach.h"
#include "solver/polyhedral/propagation.h"

namespace geotherm {
namespace {

using Turn = StartDirections::Turn;

/// Directions of the lines from a vertex, in the frames of the sides opposite to it.
std::vector<Turn> turns_at(Index v, const WindowMesh& windows, const TangentFans& fans) {
  std::vector<Turn> turns;
  for (const Side side : windows.opposite_sides(v)) {
    const auto& frame = windows.side(side);
    const auto& corner = fans.corner(previous_side(side));
    const double to_origin = std::atan2(frame.apex_y, -frame.apex_x);
    if (corner.against) {
      turns.push_back({corner.begin + corner.angle - to_origin, false});
    } else {
      turns.push_back({corner.begin + to_origin, true});
    }
  }
  return turns;
}

/// The turn of the layout of a face beyond side `k` of `own`, whose turn is known.
Turn turn_across(const PathSurface& paths, const Turn& turn, Index own, int k,
                 const std::array<Eigen::Vector2d, 3>& own_layout, Index other,
                 const std::array<Eigen::Vector2d, 3>& other_layout) {
  const Index a = paths.face(own)[k], b = paths.face(own)[next_corner(k)];
  const int from = paths.corner_of_vertex(other, a), to = paths.corner_of_vertex(other, b);
  const double here = angle_of(own_layout[next_corner(k)] - own_layout[k]);
  const double there = angle_of(other_layout[to] - other_layout[from]);
  const bool agree = from == next_corner(to);
  const double moved = agree ? here - there : here + there;
  return {turn.mirrored ? turn.turn - moved : turn.turn + moved, turn.mirrored == agree};
}

Error no_order() {
  return {
      ErrorCode::kBadInput,
      "the point is on an edge with three faces or more, so that directions there have no order",
      {"choose another point"}};
}

Result<void> check_options(const LogMapOptions& options, const TriangleMesh& mesh) {
  if (options.method != MethodKind::kExact) {
    return Error{ErrorCode::kNotAvailable,
                 "directions are not carried along by the method " + to_text(options.method),
                 {"use ", SettingHint{"method", {"exact"}}}};
  }
  return check_reach({options.max_distance, options.targets, false}, mesh.vertex_count());
}

/// Leaves out what is too far, or not among the targets.
void keep_asked(const LogMapOptions& options, LogMap& map) {
  std::vector<char> asked(map.distances.size(), options.targets.empty() ? 1 : 0);
  for (const Index v : options.targets) asked[static_cast<std::size_t>(v)] = 1;
  for (std::size_t v = 0; v < map.distances.size(); ++v) {
    if (asked[v] != 0 && map.distances[v] <= options.max_distance) continue;
    map.distances[v] = kUnreached;
    map.directions[v] = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

Result<LogMap> Directions::log_map(const SurfacePoint& point, const LogMapOptions& options,
                                   const Progress& progress) const try {
  const State& state = *state_;
  const auto clean = state.point(point);
  if (!clean) return clean.error();
  if (auto can = check_options(options, *state.paths.mesh()); !can) return can.error();
  SourceSet set;
  set.points.push_back(point);
  const auto seeds = seed_sources(*state.surface, set);
  if (!seeds) return seeds.error();
  if (seeds->pieces.size() > 2) return no_order();

  StartDirections starts;
  double scale = 1;
  bool turns_round = true;
  if (clean->is_vertex()) {
    starts.vertex = clean->vertex;
    starts.of_opposite = turns_at(clean->vertex, state.windows, state.fans);
    scale = state.fans.vertex(clean->vertex).scale();
    turns_round = state.fans.vertex(clean->vertex).kind == TangentFans::Kind::kInner;
  }
  for (const auto& piece : seeds->pieces) {
    Turn turn = state.face_turn(clean->face);
    if (piece.face != clean->face) {
      // The point is on the side opposite to the corner without weight.
      const int k = next_corner(
          static_cast<int>(std::ranges::find(clean->weights, 0.0) - clean->weights.begin()));
      turn = turn_across(state.paths, turn, clean->face, k, state.layout(clean->face), piece.face,
                         state.layout(piece.face));
    }
    starts.of_piece.push_back(turn);
  }

  Propagation windows(state.windows);
  windows.follow_directions(starts);
  const double unit = state.surface->base.length_unit();
  std::vector<Index> targets = options.targets;
  for (Index& v : targets) v = state.paths.mesh()->standing_for(v);
  if (auto done = windows.run(*seeds, progress, options.max_distance / unit, targets); !done) {
    Error error = done.error();
    if (error.code != ErrorCode::kCancelled) error.hint = {"take a mesh with fewer faces"};
    return error;
  }
  LogMap map;
  map.frame = state.frame_at(*clean);
  for (const auto& vertex : windows.vertices()) map.distances.push_back(unit * vertex.distance);
  map.directions = windows.directions();
  for (double& angle : map.directions) {
    angle *= scale;
    if (turns_round) angle = std::remainder(angle, 2 * std::numbers::pi);
  }
  const auto same = state.paths.mesh()->same_as();
  for (std::size_t v = 0; v < same.size(); ++v) {
    map.distances[v] = map.distances[static_cast<std::size_t>(same[v])];
    map.directions[v] = map.directions[static_cast<std::size_t>(same[v])];
  }
  keep_asked(options, map);
  return map;
} catch (const std::bad_alloc&) {
  return directions_out_of_memory(state_->paths.mesh()->face_count());
}

}  // namespace geotherm
