// SPDX-License-Identifier: MIT
#include "solver/polyhedral/wave_front.h"

#include <algorithm>

#include "solver/polyhedral/wave_surface.h"

namespace geotherm {
namespace {

/// A bucket's width in mean sides, and what the ring spans in longest sides: a wave never puts an
/// edge further ahead.
constexpr double kBucketWidth = 0.5;
constexpr double kRingSpan = 4;

/// Visits between two calls of progress: a few milliseconds.
constexpr std::size_t kVisitsBetweenCalls = 1 << 14;
/// A wave ends as kEndless after so many visits for each edge, and at least so many in all. Broken
/// meshes take up to some dozens an edge.
constexpr std::size_t kMaxVisits = 500, kMaxOfFew = 1 << 20;

using Point2 = Eigen::Vector2d;

}  // namespace

WaveFront::WaveFront(const WaveTables& tables, int samples, InstructionSet set)
    : tables_(tables),
      samples_(samples),
      set_(set),
      ring_(kBucketWidth * tables.mean_side, kRingSpan * tables.longest_side) {}

WaveFront::WaveFront(const WaveTables& tables, WaveFront&& spare)
    : WaveFront(tables, spare.samples_, spare.set_) {
  distance_ = std::move(spare.distance_);
  sample_ = std::move(spare.sample_);
  queued_ = std::move(spare.queued_);
  spread_below_ = std::move(spare.spread_below_);
}

WaveFront::Outcome WaveFront::run(const WaveSurface& surface, const SourceSeeds& seeds, bool labels,
                                  const Progress& progress, const WaveReach& reach,
                                  CurveStart curves) {
  start(surface, seeds, labels, curves);
  const auto edges = static_cast<std::size_t>(tables_.edge_count());
  std::size_t next_call = kVisitsBetweenCalls;
  while (ring_.advance(pass_) && !has_all(pass_, reach)) {
    do {
      visits_ += visit_current_bucket(pass_, samples_, kVisitsBetweenCalls, set_);
      if (visits_ < next_call) continue;
      next_call = visits_ + kVisitsBetweenCalls;
      const double share = std::min(static_cast<double>(visits_) / static_cast<double>(edges), 1.0);
      if (!report(progress, "solve", share)) return Outcome::kCancelled;
      if (visits_ > kMaxOfFew + kMaxVisits * edges) return Outcome::kEndless;
    } while (pass_.place > 0);
  }
  return Outcome::kDone;
}

void WaveFront::start(const WaveSurface& surface, const SourceSeeds& seeds, bool labels,
                      CurveStart curves) {
  reset(labels);
  pass_ = pass();
  ring_.begin(pass_);
  seed(surface, seeds, curves);
  has_ = 0;
}

void WaveFront::begin(const WaveSurface& surface, const SourceSeeds& seeds) {
  start(surface, seeds, false, CurveStart::kStraight);
  keys_.clear();
  pass_.longest = tables_.longest_side;  // others cross faces, too
}

WaveFront::Outcome WaveFront::go_on(double from, double until) {
  const auto edges = static_cast<std::size_t>(tables_.edge_count());
  ring_.go_back(pass_, from);
  while (ring_.advance_within(pass_, from, until)) {
    do {
      visits_ += visit_current_bucket(pass_, samples_, kVisitsBetweenCalls, set_);
      if (visits_ > kMaxOfFew + kMaxVisits * edges) return Outcome::kEndless;
    } while (pass_.place > 0);
  }
  ring_.go_back(pass_, from);
  return Outcome::kDone;
}

void WaveFront::hear(std::span<const Heard> vertices, std::span<const Heard> edges,
                     const std::vector<char>& is_shared) {
  for (const auto& [rank, value] : vertices) {
    const double before = distance_[rank];
    if (!(value < before)) continue;
    distance_[rank] = value;
    for (const SideCode code : tables_.corners_at(rank)) {
      const WaveFace& face = tables_.faces[face_of_code(code)];
      for (const int k : {corner_of_code(code), previous_corner(corner_of_code(code))}) {
        if (!(value < before - kNotice * face.length[k])) continue;
        const int corner = corner_of_code(code), other = k == corner ? next_corner(k) : k;
        if ((face.touching >> corner & 1U) != 0) {  // a visit of any edge hands it on
          WaveValues::lower(distance_[face.vertex[other]], nullptr, value + face.length[k],
                            kNoIndex);
          WaveValues::lower(sample_[face.edge[k]], nullptr, value + face.length[k] / 2, kNoIndex);
        } else if (!is_shared[face.edge[k]]) {
          continue;
        }
        keys_.emplace_back(0.0, face.edge[k]);
      }
    }
  }
  for (const auto& [edge, value] : edges) {
    const SideCode code = tables_.sides[edge][0];
    const double length = tables_.faces[face_of_code(code)].length[corner_of_code(code)];
    if (value < sample_[edge] - kNotice * length) keys_.emplace_back(0.0, edge);
    WaveValues::lower(sample_[edge], nullptr, value, kNoIndex);
  }
}

void WaveFront::wake() {
  for (auto& [key, edge] : keys_) key = key_of(edge);
  std::ranges::sort(keys_);
  keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
  for (const auto& [key, edge] : keys_) {
    if (key < kUnreached) ring_.add(pass_, key, edge);
  }
  keys_.clear();
}

/// Whether no later visit can change what is within reach.
bool WaveFront::has_all(const WavePass& pass, const WaveReach& reach) {
  if (!reach.is_bounded()) return false;
  if (base_ + pass.floor > reach.radius) return true;
  if (reach.ranks.empty()) return false;
  while (has_ < reach.ranks.size() && distance_[reach.ranks[has_]] <= pass.floor) ++has_;
  return has_ == reach.ranks.size();
}

/// False where it has no value.
bool WaveFront::take_corner(Index rank, std::vector<Reached>& out) {
  if (distance_[rank] == kUnreached) return false;
  out.push_back({rank, distance_[rank], label_.empty() ? kNoIndex : label_[rank]});
  distance_[rank] = spread_below_[rank] = kUnreached;
  if (!label_.empty()) label_[rank] = kNoIndex;
  return true;
}

/// False where it has no value.
bool WaveFront::clear_edge(Index edge) {
  const auto first = static_cast<std::size_t>(samples_) * static_cast<std::size_t>(edge);
  if (sample_[first] == kUnreached) return false;
  for (std::size_t i = first; i < first + static_cast<std::size_t>(samples_); ++i) {
    sample_[i] = kUnreached;
    if (!sample_label_.empty()) sample_label_[i] = kNoIndex;
  }
  queued_[edge] = 0;
  return true;
}

/// Walks from the seeds over the edges that have values: all those of a face that was crossed, and
/// from fan to fan where a vertex has handed its distance on by itself.
std::vector<WaveFront::Reached> WaveFront::take_reached() {
  std::vector<Reached> out;
  std::vector<Index> edges;
  const auto add = [&](Index edge) {
    if (clear_edge(edge)) edges.push_back(edge);
  };
  const auto add_face = [&](SideCode code) {
    const WaveFace& face = tables_.faces[face_of_code(code)];
    for (int k = 0; k < 3; ++k) {
      add(face.edge[k]);
      if (!take_corner(face.vertex[k], out) || (face.touching >> k & 1U) == 0) continue;
      for (const SideCode corner : tables_.corners_at(face.vertex[k])) {
        for (const Index edge : tables_.faces[face_of_code(corner)].edge) add(edge);
      }
    }
  };
  for (const auto& [key, edge] : keys_) add(edge);
  while (!edges.empty()) {
    const Index edge = edges.back();
    edges.pop_back();
    add_face(tables_.sides[edge][0]);
    for (const SideCode side : tables_.other_sides(edge)) add_face(side);
  }
  clean_ = true;
  return out;
}

void WaveFront::reset(bool labels) {
  visits_ = 0;
  if (clean_ && labels != label_.empty()) {
    clean_ = false;
    return;
  }
  clean_ = false;
  const auto vertices = static_cast<std::size_t>(tables_.vertex_count());
  const auto edges = static_cast<std::size_t>(tables_.edge_count());
  const std::size_t samples = edges * static_cast<std::size_t>(samples_);
  distance_.assign(vertices, kUnreached);
  sample_.assign(samples, kUnreached);
  queued_.assign(edges, 0);
  spread_below_.assign(vertices, kUnreached);
  label_.assign(labels ? vertices : 0, kNoIndex);
  sample_label_.assign(labels ? samples : 0, kNoIndex);
}

WavePass WaveFront::pass() {
  WavePass pass{};
  pass.faces = tables_.faces.data();
  pass.sides = tables_.sides.data();
  pass.more = tables_.more.data();
  pass.corner_start = tables_.corner_start.data();
  pass.corners = tables_.corners.data();
  pass.distance = distance_.data();
  pass.sample = sample_.data();
  pass.label = label_.empty() ? nullptr : label_.data();
  pass.sample_label = sample_label_.empty() ? nullptr : sample_label_.data();
  pass.queued = queued_.data();
  pass.spread_below = spread_below_.data();
  return pass;
}

void WaveFront::seed(const WaveSurface& surface, const SourceSeeds& seeds, CurveStart curves) {
  base_ = least_offset(seeds);
  keys_.clear();
  for (const auto& vertex : seeds.vertices) {
    for (const SideCode code : tables_.corners_at(tables_.rank_of_vertex[vertex.vertex])) {
      const Index rank = face_of_code(code);
      const Point2 at = corners_of(lay_out(tables_.faces[rank].length))[corner_of_code(code)];
      seed_face(rank, {kNoIndex, at, at, vertex.offset, vertex.group});
    }
  }
  for (const auto& piece : seeds.pieces) seed_face(tables_.rank_of_face[piece.face], piece);
  const bool windows =
      curves == CurveStart::kWindows &&
      std::ranges::any_of(seeds.pieces, [](const auto& piece) { return piece.from != piece.to; });
  Keys beyond;
  if (windows) beyond = keys_beyond_windows(seeds);
  Keys& waiting = windows ? beyond : keys_;
  for (auto& [key, edge] : waiting) key = key_of(edge);
  std::ranges::sort(waiting, {}, [&](const auto& pair) {
    return std::pair(pair.first, orders_of(surface, pair.second));
  });
  ring_.add_seeds(waiting);
}

/// Finds the distances near to the sources by windows; the edges where the wave goes on from them.
WaveFront::Keys WaveFront::keys_beyond_windows(const SourceSeeds& seeds) {
  NearWindows near(tables_, values());
  for (const auto& vertex : seeds.vertices) {
    near.add_vertex(tables_.rank_of_vertex[vertex.vertex], vertex.offset - base_, vertex.group);
  }
  for (const auto& piece : seeds.pieces) near.add_piece(piece, piece.offset - base_);
  const double radius = near.run();
  pass_.longest = near.longest();
  Keys beyond;
  for (const Index edge : near.edges()) {
    if (near.is_waiting(edge, radius)) beyond.emplace_back(0.0, edge);
  }
  return beyond;
}

/// The orders of an edge's two ends and of the corner opposite it in its first face. They order
/// edges in a way that does not depend on their numbers.
std::array<WaveOrder, 3> WaveFront::orders_of(const WaveSurface& surface, Index edge) const {
  const SideCode side = tables_.sides[edge][0];
  const WaveFace& face = tables_.faces[face_of_code(side)];
  const int k = corner_of_code(side);
  const auto place = [&](int i) {
    return order_of(surface.base, tables_.vertex_of_rank[face.vertex[i]]);
  };
  return {place(k), place(next_corner(k)), place(previous_corner(k))};
}

/// By which it waits: the largest of the distances at its ends and in its middle.
double WaveFront::key_of(Index edge) const {
  const WaveFace& face = tables_.faces[face_of_code(tables_.sides[edge][0])];
  const int k = corner_of_code(tables_.sides[edge][0]);
  return std::max({distance_[face.vertex[k]], distance_[face.vertex[next_corner(k)]],
                   sample_[samples_ * edge + samples_ / 2]});
}

/// Lowers the distances at the vertices and samples of a piece's face to the straight ones.
void WaveFront::seed_face(Index rank, const SourceSeeds::Piece& piece) {
  const WaveFace& face = tables_.faces[rank];
  values().lower_face(face, piece, piece.offset - base_);
  for (const Index edge : face.edge) keys_.emplace_back(0.0, edge);
}

WaveValues WaveFront::values() {
  const bool labels = !label_.empty();
  return {samples_, distance_.data(), sample_.data(), labels ? label_.data() : nullptr,
          labels ? sample_label_.data() : nullptr};
}

double WaveFront::least_on(Index edge) const {
  const SideCode code = tables_.sides[edge][0];
  const WaveFace& face = tables_.faces[face_of_code(code)];
  const int k = corner_of_code(code);
  double least = std::min(distance_[face.vertex[k]], distance_[face.vertex[next_corner(k)]]);
  for (int i = 0; i < samples_; ++i) least = std::min(least, sample_[samples_ * edge + i]);
  return least;
}

}  // namespace geotherm
