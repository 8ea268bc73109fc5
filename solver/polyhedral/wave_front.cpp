// SPDX-License-Identifier: MIT
#include "solver/polyhedral/wave_front.h"

#include <algorithm>

#include "solver/polyhedral/wave_surface.h"

namespace geotherm {
namespace {

/// Bucket numbers are capped at this, since offsets can be of any size.
constexpr double kLast = 1e18;
constexpr std::int64_t kMinBuckets = 64;

/// A bucket's width in mean sides, and what the ring spans in longest sides: a wave never puts an
/// edge further ahead.
constexpr double kBucketWidth = 0.5;
constexpr double kRingSpan = 4;
/// What lies this far behind the front, in longest sides of the faces that were crossed, has its
/// final distance. Values lag behind the front by up to a side where a wave has to wait for the far
/// end of an edge, and by as much again where that was known too large at first.
constexpr double kSettled = 4;
/// Visits between two calls of progress: a few milliseconds.
constexpr std::size_t kVisitsBetweenCalls = 1 << 14;
/// A wave ends as kEndless after so many visits for each edge, and at least so many in all. Broken
/// meshes take up to some dozens an edge.
constexpr std::size_t kMaxVisits = 500, kMaxOfFew = 1 << 20;

using Point2 = Eigen::Vector2d;

}  // namespace

BucketRing::BucketRing(double width, double span) : per_length_(1 / width) {
  std::int64_t count = kMinBuckets;
  while (count < kMax && static_cast<double>(count) * width < span) count *= 2;
  buckets_.resize(static_cast<std::size_t>(count));
  storage_.resize(buckets_.size());
}

void BucketRing::begin(WavePass& pass) {
  for (std::size_t i = 0; i < buckets_.size(); ++i) {
    buckets_[i] = {storage_[i].data(), 0, static_cast<Index>(storage_[i].size())};
  }
  outside_.clear();
  let_in_ = 0;
  pass.buckets = buckets_.data();
  pass.bucket_mask = static_cast<std::int64_t>(buckets_.size()) - 1;
  pass.current = -1;
  pass.waiting = 0;
  pass.per_length = per_length_;
  pass.floor = -kUnreached;
  pass.longest = 0;
  pass.place = 0;
  pass.context = this;
  pass.grow = [](void* ring, WaveBucket& bucket) { static_cast<BucketRing*>(ring)->grow(bucket); };
}

void BucketRing::add_seeds(const std::vector<std::pair<double, Index>>& seeds) {
  for (const auto& [key, edge] : seeds) {
    outside_.emplace_back(static_cast<std::int64_t>(std::min(key * per_length_, kLast)), edge);
  }
  std::ranges::sort(outside_);
}

bool BucketRing::advance(WavePass& pass) {
  const double front = static_cast<double>(pass.current) / per_length_;
  pass.floor = std::max(pass.floor, front - kSettled * pass.longest);
  ++pass.current;
  if (pass.waiting == 0) {
    if (let_in_ == outside_.size()) return false;
    pass.current = std::max(pass.current, outside_[let_in_].first);
  }
  let_in(pass);
  while (buckets_[static_cast<std::size_t>(pass.current & pass.bucket_mask)].size == 0 &&
         pass.waiting > 0) {
    ++pass.current;
    let_in(pass);
  }
  return true;
}

void BucketRing::let_in(WavePass& pass) {
  WaveBucket& bucket = buckets_[static_cast<std::size_t>(pass.current & pass.bucket_mask)];
  for (; let_in_ < outside_.size() && outside_[let_in_].first <= pass.current; ++let_in_) {
    const Index edge = outside_[let_in_].second;
    if (pass.queued[edge] != 0) continue;
    if (bucket.size == bucket.capacity) grow(bucket);
    bucket.edges[bucket.size++] = edge;
    pass.queued[edge] = 1;
    ++pass.waiting;
  }
}

void BucketRing::grow(WaveBucket& bucket) {
  auto& edges = storage_[static_cast<std::size_t>(&bucket - buckets_.data())];
  edges.resize(std::max<std::size_t>(2 * edges.size(), 16));
  bucket.edges = edges.data();
  bucket.capacity = static_cast<Index>(edges.size());
}

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
                                  const Progress& progress, const WaveReach& reach) {
  reset(labels);
  WavePass pass = this->pass();
  ring_.begin(pass);
  seed(surface, seeds);
  has_ = 0;
  const auto edges = static_cast<std::size_t>(tables_.edge_count());
  std::size_t next_call = kVisitsBetweenCalls;
  while (ring_.advance(pass) && !has_all(pass, reach)) {
    do {
      visits_ += visit_current_bucket(pass, samples_, kVisitsBetweenCalls, set_);
      if (visits_ < next_call) continue;
      next_call = visits_ + kVisitsBetweenCalls;
      const double share = std::min(static_cast<double>(visits_) / static_cast<double>(edges), 1.0);
      if (!report(progress, "solve", share)) return Outcome::kCancelled;
      if (visits_ > kMaxOfFew + kMaxVisits * edges) return Outcome::kEndless;
    } while (pass.place > 0);
  }
  return Outcome::kDone;
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
    const auto& sides = tables_.sides[edges.back()];
    edges.pop_back();
    add_face(sides[0]);
    if (sides[1] >= 0) {
      add_face(sides[1]);
    } else if (sides[1] != kNoSideCode) {
      const SideCode* list = &tables_.more[static_cast<std::size_t>(-2 - sides[1])];
      for (SideCode i = 1; i <= list[0]; ++i) add_face(list[i]);
    }
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

void WaveFront::seed(const WaveSurface& surface, const SourceSeeds& seeds) {
  base_ = least_offset(seeds);
  keys_.clear();
  for (const auto& vertex : seeds.vertices) {
    for (const SideCode code : tables_.corners_at(tables_.rank_of_vertex[vertex.vertex])) {
      const Index f = tables_.intrinsic_face[face_of_code(code)];
      const Point2 at =
          corners_of(lay_out(surface.base.intrinsic.lengths[f]))[corner_of_code(code)];
      seed_face(surface, {f, at, at, vertex.offset, vertex.group});
    }
  }
  for (const auto& piece : seeds.pieces) seed_face(surface, piece);
  for (auto& [key, edge] : keys_) {
    const WaveFace& face = tables_.faces[face_of_code(tables_.sides[edge][0])];
    const int k = corner_of_code(tables_.sides[edge][0]);
    key = std::max({distance_[face.vertex[k]], distance_[face.vertex[next_corner(k)]],
                    sample_[samples_ * edge + samples_ / 2]});
  }
  ring_.add_seeds(keys_);
}

/// Lowers the distances at the vertices and samples of the piece's face to the straight ones.
void WaveFront::seed_face(const WaveSurface& surface, const SourceSeeds::Piece& piece) {
  const WaveFace& face = tables_.faces[tables_.rank_of_face[piece.face]];
  const auto at = corners_of(lay_out(surface.base.intrinsic.lengths[piece.face]));
  const double offset = piece.offset - base_;
  const bool labels = !label_.empty();
  for (int k = 0; k < 3; ++k) {
    const Index v = face.vertex[k];
    lower(distance_[v], labels ? &label_[v] : nullptr, offset + distance_to(piece, at[k]),
          piece.group);
    const Point2 side = at[next_corner(k)] - at[k];
    const bool reversed = (face.reversed >> k & 1U) != 0;
    for (int i = 0; i < samples_; ++i) {
      const Point2 p = at[k] + (i + 1.0) / (samples_ + 1) * side;
      const auto s = static_cast<std::size_t>(samples_) * static_cast<std::size_t>(face.edge[k]) +
                     static_cast<std::size_t>(reversed ? samples_ - 1 - i : i);
      lower(sample_[s], labels ? &sample_label_[s] : nullptr, offset + distance_to(piece, p),
            piece.group);
    }
    keys_.emplace_back(0.0, face.edge[k]);
  }
}

double WaveFront::least_on(Index edge) const {
  const SideCode code = tables_.sides[edge][0];
  const WaveFace& face = tables_.faces[face_of_code(code)];
  const int k = corner_of_code(code);
  double least = std::min(distance_[face.vertex[k]], distance_[face.vertex[next_corner(k)]]);
  for (int i = 0; i < samples_; ++i) least = std::min(least, sample_[samples_ * edge + i]);
  return least;
}

void WaveFront::lower(double& value, Index* label, double candidate, Index group) {
  if (!(candidate < value)) return;
  value = candidate;
  if (label != nullptr) *label = group;
}

}  // namespace geotherm
