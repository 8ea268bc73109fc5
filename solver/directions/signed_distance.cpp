// SPDX-License-Identifier: MIT
// Signed distance to curves that separate the surface.
#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <optional>
#include <utility>

#include "solver/core/sorting.h"
#include "solver/directions/curve_pieces.h"
#include "solver/directions/directions_state.h"
#include "solver/geometry/edit.h"
#include "solver/polyhedral/propagation.h"

namespace geotherm {
namespace {

using Point2 = Eigen::Vector2d;
using CurveLayout = std::array<Point2, 3>;

/// Which parts the curves cut the surface into, and on which side of them each is.
class Parts {
 public:
  Parts(const Directions::State& state, const CurvePieces& curves)
      : state_(state),
        curves_(curves),
        parts_(curves.on_curve.size()),
        sides_(curves.on_curve.size()),
        votes_(curves.on_curve.size()) {}

  enum class Sides {
    kFound,
    kNone,         ///< on a component of the surface the curves go there and back
    kContrary,     ///< a part is left of one curve and right of another
    kNotSeparate,  ///< a part is on both sides of one curve
  };

  Sides find() {
    const EdgeTable& edges = state_.paths.edges();
    for (Index e = 0; e < edges.edge_count(); ++e) {
      if (curves_.touched[e] == 0 && !on_curve(edges.low(e)) && !on_curve(edges.high(e))) {
        parts_.join(edges.low(e), edges.high(e));
      }
    }
    if (go_there_and_back()) return Sides::kNone;
    bool fits = true;
    for (Index e = 0; e < edges.edge_count(); ++e) {
      const Index a = edges.low(e), b = edges.high(e);
      if (curves_.touched[e] == 0 || on_curve(a) || on_curve(b)) continue;
      const bool crossed = curves_.crossings[e] % 2 != 0;
      fits = fits && crossed == (sign(a) != sign(b));
    }
    const auto on_both = [](const auto& each) { return each.second == (kLeft | kRight); };
    if (std::ranges::any_of(beside_, on_both)) return Sides::kNotSeparate;
    if (std::ranges::count(sides_, kLeft | kRight) > 0) return Sides::kContrary;
    return fits ? Sides::kFound : Sides::kNotSeparate;
  }

  /// Whether a component of the surface has corners beside the curves and all of them are on
  /// neither side.
  bool go_there_and_back() {
    vote();
    const EdgeTable& edges = state_.paths.edges();
    DisjointSets components(votes_.size());
    for (Index e = 0; e < edges.edge_count(); ++e) components.join(edges.low(e), edges.high(e));
    std::vector<int> of_component(votes_.size());
    for (Index v = 0; v < static_cast<Index>(votes_.size()); ++v) {
      of_component[components.root(v)] |= votes_[v];
    }
    return std::ranges::count(of_component, kSideless) > 0;
  }

  /// -1 to the left of the curves, 1 to the right, 0 where they are not.
  int sign(Index v) {
    const int sides = sides_[parts_.root(v)];
    return (sides & kLeft) != 0 ? -1 : (sides & kRight) != 0 ? 1 : 0;
  }

 private:
  enum : int { kLeft = 1, kRight = 2 };
  enum : int { kSided = 1, kSideless = 2 };

  bool on_curve(Index v) const { return curves_.on_curve[v] != 0; }

  /// The corners of a face are on the side of the piece nearest to them there; where two meet, on
  /// that of their mean normal.
  void vote() {
    std::vector<CurvePiece> pieces = curves_.pieces;
    std::ranges::stable_sort(pieces, {}, &CurvePiece::face);
    for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
      const Index face = pieces[begin].face;
      while (end < pieces.size() && pieces[end].face == face) ++end;
      const CurveLayout at = state_.layout(face);
      for (int k = 0; k < 3; ++k) {
        if (on_curve(state_.paths.face(face)[k])) continue;
        const auto [side, curve] = side_of(at, at[k], {pieces.data() + begin, pieces.data() + end});
        const Index v = state_.paths.face(face)[k];
        votes_[v] |= side == 0 ? kSideless : kSided;
        if (side == 0) continue;
        const Index part = parts_.root(v);
        beside_[{part, curve}] |= side > 0 ? kLeft : kRight;
        sides_[part] |= side > 0 ? kLeft : kRight;
      }
    }
  }

  /// Above 0 to the left, and of which curve. A piece that is short beside its distance knows its
  /// direction, and so the side of p, the less well.
  static std::pair<double, std::size_t> side_of(const CurveLayout& at, const Point2& p,
                                                std::span<const CurvePiece> pieces) {
    constexpr double kAsNear = 1e-9, kOnTheLine = 1e-12;
    double nearest = kUnreached, side = 0, rounding = 0;
    std::size_t curve = 0;
    const double size = (at[1] - at[0]).norm() + (at[2] - at[0]).norm();
    for (const CurvePiece& piece : pieces) {
      const Point2 from = place_of(at, piece.from), along = place_of(at, piece.to) - from;
      const double length = along.norm();
      if (!(length > 0)) continue;
      const double t = std::clamp(along.dot(p - from) / (length * length), 0.0, 1.0);
      const double distance = (p - from - t * along).norm();
      if (distance > nearest + kAsNear * size) continue;
      if (distance < nearest - kAsNear * size) side = rounding = 0;
      nearest = std::min(nearest, distance);
      curve = piece.curve;
      side += cross(along, p - from) / length;
      rounding += kOnTheLine * size * (1 + (p - from).norm() / length);
    }
    return {std::abs(side) > rounding ? side : 0, curve};
  }

  const Directions::State& state_;
  const CurvePieces& curves_;
  DisjointSets parts_;
  std::vector<int> sides_;  ///< of curves that a part is on, at its root
  std::vector<int> votes_;  ///< of a corner beside curves: whether it is on a side of them
  std::map<std::pair<Index, std::size_t>, int> beside_;  ///< sides of a curve that a part is on
};

/// Every piece, and every point of the curves: there they may bend.
SourceSeeds seeds_of(const Directions::State& state, const CurvePieces& curves) {
  SourceSeeds seeds;
  for (const CurvePiece& piece : curves.pieces) {
    const CurveLayout at = state.layout(piece.face);
    seeds.pieces.push_back({piece.face, place_of(at, piece.from), place_of(at, piece.to), 0, 0});
  }
  for (Index v = 0; v < static_cast<Index>(curves.on_curve.size()); ++v) {
    if (curves.on_curve[v] != 0) seeds.vertices.push_back({v, 0, 0});
  }
  for (const SurfacePoint& point : curves.points) {
    if (point.is_vertex()) continue;
    for (const Index face : state.paths.faces_at(point)) {
      const Point2 there = place_of(state.layout(face), state.paths.express(point, face)->weights);
      seeds.pieces.push_back({face, there, there, 0, 0});
    }
  }
  return seeds;
}

Error no_left_and_right() {
  return {ErrorCode::kBadInput,
          "the curves have no left and right, for they go there and back",
          {"give each piece once"}};
}

}  // namespace

Result<void> refuse_there_and_back(const Directions::State& state, const CurvePieces& curves) {
  if (Parts(state, curves).go_there_and_back()) return no_left_and_right();
  return {};
}

Result<SignedDistance> Directions::signed_distance(std::span<const SurfacePath> curves,
                                                   const Progress& progress) const try {
  const State& state = *state_;
  const auto pieces = curve_pieces(state.paths, curves);
  if (!pieces) return pieces.error();
  Parts parts(state, *pieces);
  switch (parts.find()) {
    case Parts::Sides::kFound:
      break;
    case Parts::Sides::kNone:
      return no_left_and_right();
    case Parts::Sides::kContrary:
      return Error{ErrorCode::kBadInput,
                   "part of the surface is left of one curve and right of another",
                   {"turn some of them round, or ask for one at a time"}};
    case Parts::Sides::kNotSeparate:
      return Error{ErrorCode::kBadInput,
                   "the curves do not separate the surface into what is left and right of them",
                   {"close them, or use ", SettingHint{"rule", {"heat"}}}};
  }
  Propagation windows(state.windows);
  if (auto done = windows.run(seeds_of(state, *pieces), progress); !done) return done.error();
  SignedDistance out;
  const double unit = state.surface->base.length_unit();
  for (Index v = 0; v < state.paths.mesh()->vertex_count(); ++v) {
    const Index own = state.paths.mesh()->standing_for(v);
    const double distance = unit * windows.vertices()[static_cast<std::size_t>(own)].distance;
    out.distances.push_back(std::isfinite(distance) && parts.sign(own) < 0 ? -distance : distance);
  }
  return out;
} catch (const std::bad_alloc&) {
  return directions_out_of_memory(state_->paths.mesh()->face_count());
}

Result<SignedDistance> signed_distance(const SignedSetup& setup,
                                       std::span<const SurfacePath> curves, SideRule rule,
                                       const Progress& progress) {
  std::optional<Error> no_sides;
  if (rule != SideRule::kHeat) {
    const auto directions = setup.directions(part_of(progress, 0, 0.1));
    if (!directions) return directions.error();
    auto found = (*directions)->signed_distance(curves, part_of(progress, 0.1, 1));
    if (found || rule == SideRule::kSides || found.error().code == ErrorCode::kCancelled) {
      return found;
    }
    // Where the hint does not offer the other rule, the curves are wrong by either.
    const auto is_rule = [](const auto& part) {
      const auto* const setting = std::get_if<SettingHint>(&part);
      return setting != nullptr && setting->name == "rule";
    };
    const bool bad_input = found.error().code == ErrorCode::kBadInput;
    if (bad_input && std::ranges::none_of(found.error().hint, is_rule)) return found;
    no_sides = found.error();
  }
  const auto heat = setup.heat(part_of(progress, 0, 0.7));
  if (!heat) return heat.error();
  auto found = (*heat)->signed_distance(curves, part_of(progress, 0.7, 1));
  if (!no_sides) return found;
  if (found) {
    found->warnings.insert(found->warnings.begin(),
                           {no_sides->message + "; the signed heat method answers instead"});
  } else if (found.error().code == ErrorCode::kBadInput &&
             found.error().message != no_sides->message) {
    Error both = found.error();
    both.message = no_sides->message + ", and " + both.message;
    return both;
  }
  return found;
}

Result<SignedDistance> signed_distance(const std::shared_ptr<const TriangleMesh>& mesh,
                                       std::span<const SurfacePath> curves, SideRule rule,
                                       const SpreadOptions& options, const Progress& progress) {
  const SignedSetup setup = {
      [&](const Progress& part) { return Directions::build(mesh, part); },
      [&](const Progress& part) { return VectorHeat::build(mesh, options, part); }};
  return signed_distance(setup, curves, rule, progress);
}

}  // namespace geotherm
