// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>
#include <string>
#include <utility>

#include "solver/core/text.h"
#include "solver/directions/directions_state.h"
#include "solver/directions/wave_directions.h"
#include "solver/method/reach.h"
#include "solver/polyhedral/propagation.h"

namespace geotherm {
namespace {

using Turn = StartDirections::Turn;

/// Beside waves windows go as far, in mean edges.
constexpr double kNear = 40;
/// The share of vertices in doubt from which on a map by waves says so.
constexpr double kMaxDoubt = 0.01;

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

/// How directions are measured at the point.
struct Start {
  StartDirections starts;
  double scale = 1;  ///< from angles there to directions
  bool turns_round = true;
};

Start start_of(const Directions::State& state, const SurfacePoint& clean,
               const SourceSeeds& seeds) {
  Start out;
  if (clean.is_vertex()) {
    out.starts.vertex = clean.vertex;
    out.starts.of_opposite = turns_at(clean.vertex, state.windows, state.fans);
    out.scale = state.fans.vertex(clean.vertex).scale();
    out.turns_round = state.fans.vertex(clean.vertex).kind == TangentFans::Kind::kInner;
  }
  for (const auto& piece : seeds.pieces) {
    Turn turn = state.face_turn(clean.face);
    if (piece.face != clean.face) {
      // The point is on the side opposite to the corner whose weight is none or next to it.
      const int k = next_corner(
          static_cast<int>(std::ranges::min_element(clean.weights) - clean.weights.begin()));
      turn = turn_across(state.paths, turn, clean.face, k, state.layout(clean.face), piece.face,
                         state.layout(piece.face));
    }
    out.starts.of_piece.push_back(turn);
  }
  return out;
}

Result<LogMap> by_windows(const Directions::State& state, const SourceSeeds& seeds,
                          const Start& start, const LogMapOptions& options,
                          const Progress& progress) {
  const double unit = state.surface->base.length_unit();
  std::vector<Index> targets = options.targets;
  for (Index& v : targets) v = state.paths.mesh()->standing_for(v);
  Propagation windows(state.windows);
  windows.follow_directions(start.starts);
  if (auto done = windows.run(seeds, progress, options.max_distance / unit, targets); !done) {
    Error error = done.error();
    if (error.code != ErrorCode::kCancelled) {
      error.hint = {"use ", SettingHint{"method", {"wavefront"}}};
    }
    return error;
  }
  LogMap map;
  for (const auto& vertex : windows.vertices()) map.distances.push_back(unit * vertex.distance);
  map.directions = windows.directions();
  return map;
}

/// The faces at the point, for waves.
WaveStart wave_start(const Directions::State& state, const SourceSeeds& seeds, const Start& start) {
  WaveStart out;
  for (std::size_t i = 0; i < seeds.pieces.size(); ++i) {
    const auto& piece = seeds.pieces[i];
    out.faces.push_back({piece.face, piece.from, {1, 0}, start.starts.of_piece[i]});
  }
  out.period = 2 * std::numbers::pi;
  const Index v = start.starts.vertex;
  if (v == kNoIndex) return out;
  out.period = start.turns_round ? state.fans.vertex(v).angle : 0;
  for (const Side side : state.fans.corners_at(v)) {
    const auto& corner = state.fans.corner(side);
    const auto at = state.layout(face_of(side));
    const int k = corner_of(side);
    const double begin = corner.against ? corner.begin + corner.angle : corner.begin;
    out.faces.push_back(
        {face_of(side), at[k], at[next_corner(k)] - at[k], {begin, corner.against}});
  }
  return out;
}

/// How many samples inside an edge the waves of this method have.
int samples_of(MethodKind waves) { return waves == MethodKind::kWavefront ? 1 : 3; }

Warning in_doubt(Index vertices, std::int64_t of, MethodKind method) {
  Hint hint = {"use ", SettingHint{"method", {"exact"}}};
  if (method == MethodKind::kWavefront) {
    hint = {"use ", SettingHint{"method", {"exact", "wavefront-fine"}}};
  }
  return {"the directions of " + std::to_string(vertices) + " of " + std::to_string(of) +
              " vertices hang on which of two paths is the shorter, and these waves cannot tell "
              "lengths that differ by less than " +
              rounded_text(100 * close_share(samples_of(method))) + " %",
          std::move(hint)};
}

Result<LogMap> by_waves(const Directions::State& state, const SourceSeeds& seeds,
                        const Start& start, const LogMapOptions& options,
                        const Progress& progress) {
  std::call_once(state.tables_made, [&state] {
    state.tables = std::make_unique<const WaveTables>(build_wave_tables(*state.surface));
  });
  const double unit = state.surface->base.length_unit();
  const int samples = samples_of(options.method);
  std::vector<Index> ranks;
  for (const Index v : options.targets) {
    const Index rank = state.tables->rank_of_vertex[state.paths.mesh()->standing_for(v)];
    if (rank != kNoIndex) ranks.push_back(rank);
  }
  WaveFront front(*state.tables, samples);
  const auto outcome =
      front.run(*state.surface, seeds, false, progress, {options.max_distance / unit, ranks});
  if (outcome == WaveFront::Outcome::kCancelled) return cancelled_error();
  if (outcome == WaveFront::Outcome::kEndless) {
    return Error{ErrorCode::kBudgetEnded,
                 "the waves of a log map fall for ever on this mesh",
                 {"use ", SettingHint{"method", {"exact"}}}};
  }
  // Near the point what waves get wrong would be wrong all the way behind it.
  WaveStart begin = wave_start(state, seeds, start);
  Propagation windows(state.windows);
  windows.follow_directions(start.starts);
  constexpr double kBeyond = 1.01;  // the error of waves, so that windows say where it ends
  const double reach = std::min(kNear, kBeyond * options.max_distance / unit);
  const auto near = windows.run(seeds, progress, reach);
  begin.known.assign(state.tables->rank_of_vertex.size(), std::numeric_limits<double>::quiet_NaN());
  const auto is_near = [&](std::size_t v) {
    return near && windows.vertices()[v].distance <= reach;
  };
  for (std::size_t v = 0; v < begin.known.size(); ++v) {
    if (is_near(v)) begin.known[v] = windows.directions()[v];
  }
  LogMap map;
  WaveDirections found = wave_directions(*state.surface, *state.tables, front, samples, begin);
  const auto known = std::ranges::count_if(found.of, [](double x) { return !std::isnan(x); });
  map.directions = std::move(found.of);
  map.in_doubt = found.in_doubt;
  if (static_cast<double>(found.in_doubt) > kMaxDoubt * static_cast<double>(known)) {
    map.warnings.push_back(in_doubt(found.in_doubt, known, options.method));
  }
  map.distances.assign(map.directions.size(), kUnreached);
  for (std::size_t rank = 0; rank < state.tables->vertex_of_rank.size(); ++rank) {
    const auto v = static_cast<std::size_t>(state.tables->vertex_of_rank[rank]);
    map.distances[v] =
        unit * (is_near(v) ? windows.vertices()[v].distance : front.distances()[rank]);
  }
  return map;
}

Result<void> check_options(const LogMapOptions& options, const TriangleMesh& mesh) {
  if (options.method == MethodKind::kHeat || options.method == MethodKind::kFastMarching) {
    return Error{ErrorCode::kNotAvailable,
                 "directions are not carried along by the method " + to_text(options.method),
                 {"use ", SettingHint{"method", {"exact", "wavefront", "wavefront-fine"}}}};
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

  const Start start = start_of(state, *clean, *seeds);
  auto found = options.method == MethodKind::kExact
                   ? by_windows(state, *seeds, start, options, progress)
                   : by_waves(state, *seeds, start, options, progress);
  if (!found) return found.error();
  LogMap map = *std::move(found);
  map.frame = state.frame_at(*clean);
  for (double& angle : map.directions) {
    angle *= start.scale;
    if (start.turns_round) angle = std::remainder(angle, 2 * std::numbers::pi);
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
