// SPDX-License-Identifier: MIT
#include "solver/volume/fast_marching_tets.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <queue>
#include <string>
#include <utility>

#include "solver/core/sorting.h"
#include "solver/volume/tet_update.h"

namespace geotherm {

TetFastMarching::TetFastMarching(std::shared_ptr<const TetMesh> mesh, CleanTets clean)
    : mesh_(std::move(mesh)),
      tets_(std::move(clean.tets)),
      original_(std::move(clean.original)),
      notes_(clean.notes()) {
  const auto emit = [this](std::size_t t, const auto& put) {
    for (const Index v : tets_[t]) put(v, static_cast<Index>(t));
  };
  const RawVector<Index> around = counting_sort<Index>(
      tets_.size(), static_cast<std::size_t>(mesh_->vertex_count()), 1, emit, first_);
  around_.assign(around.begin(), around.end());
  longest_edge_.assign(mesh_->positions().size(), 0);
  for (const Tet& tet : tets_) {
    for (const Index v : tet) {
      for (const Index w : tet) {
        const double edge = (mesh_->positions()[v] - mesh_->positions()[w]).norm();
        longest_edge_[v] = std::max(longest_edge_[v], edge);
      }
    }
  }
}

Result<TetFastMarching> TetFastMarching::build(std::shared_ptr<const TetMesh> mesh) {
  try {
    CleanTets clean = clean_tets(*mesh);
    if (clean.tets.empty()) {
      return Error{ErrorCode::kBadInput,
                   "none of the " + std::to_string(mesh->tet_count()) + " tetrahedra has a volume"};
    }
    return TetFastMarching(std::move(mesh), std::move(clean));
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, "not enough memory for fast marching on the tetrahedra"};
  }
}

/// One query. Two kinds of news spread, in the order of distance: that a vertex sees a source, and
/// that its distance became less. A vertex near a ridge, where sources meet, sees those behind it
/// as well: the lines to vertices before the ridge may cross faces with corners behind it.
class TetMarch {
 public:
  TetMarch(const TetFastMarching& method, const TetMarchingOptions& options)
      : m_(method), reach_(options.straight_reach) {
    const auto count = static_cast<std::size_t>(m_.mesh_->vertex_count());
    out_.distances.assign(count, kUnreached);
    out_.nearest.assign(count, kNoIndex);
    straight_.assign(count, 0);
    first_sight_.assign(count, kNoIndex);
    sights_of_.assign(count, 0);
  }

  Result<void> add(const VolumePoint& point, double offset) {
    const auto place = place_of(point);
    if (!place) return place.error();
    sources_.push_back(Source{*place, offset});
    const auto source = static_cast<Index>(sources_.size()) - 1;
    if (point.is_vertex()) {
      see(point.vertex, source);
    } else {
      for (const Index v : m_.mesh_->tets()[point.tet]) see(v, source);
    }
    return {};
  }

  Result<TetDistances> march(const Progress& progress) {
    constexpr std::int64_t kMaxVisits = 1000, kReported = 4096;
    const auto vertices = static_cast<std::int64_t>(out_.distances.size());
    std::int64_t visits = 0;
    while (!queue_.empty()) {
      const News next = queue_.top();
      queue_.pop();
      const double slack = next.source == kNoIndex ? 0 : slack_at(next.vertex);
      if (next.distance > out_.distances[next.vertex] + slack) continue;  // nearer meanwhile
      if (++visits % kReported == 0 &&
          !report(progress, "marching", std::min(1.0, 0.5 * double(visits) / double(vertices)))) {
        return cancelled_error();
      }
      if (visits > kMaxVisits * vertices) {
        return Error{ErrorCode::kBudgetEnded,
                     "fast marching visited each of " + std::to_string(vertices) + " vertices " +
                         std::to_string(kMaxVisits) + " times in the mean without an end"};
      }
      spread(next);
    }
    out_.straight = static_cast<Index>(std::ranges::count(straight_, 1));
    return std::move(out_);
  }

 private:
  struct Source {
    Vec3 place;
    double offset;
  };
  struct News {
    double distance;
    Index vertex;
    Index source;                              ///< that it sees; kNoIndex: its distance became less
    bool operator<(const News& other) const {  // the queue's top is its largest
      if (distance != other.distance) return distance > other.distance;
      return vertex != other.vertex ? vertex > other.vertex : source > other.source;
    }
  };
  struct Sight {
    Index source, next;
  };
  /// Sources that a vertex sees are noted up to this many; of more, as at the centre of a ball
  /// whose border is the source, only those count that are nearer than all before.
  static constexpr Index kMaxSights = 8;

  const Vec3& at(Index v) const { return m_.mesh_->positions()[v]; }

  /// So much farther than the nearest source may be one that a vertex sees.
  double slack_at(Index v) const { return sources_.size() > 1 ? 2 * m_.longest_edge_[v] : 0; }

  double line_from(Index source, Index v) const {
    return sources_[source].offset + (sources_[source].place - at(v)).norm();
  }

  Result<Vec3> place_of(const VolumePoint& point) const {
    if (point.is_vertex()) {
      if (point.vertex < 0 || point.vertex >= m_.mesh_->vertex_count()) {
        return Error{ErrorCode::kBadInput,
                     "source vertex " + std::to_string(point.vertex) + " is not one of " +
                         std::to_string(m_.mesh_->vertex_count()) + " vertices"};
      }
      if (m_.first_[point.vertex] == m_.first_[point.vertex + 1]) {
        return Error{ErrorCode::kBadInput,
                     "source vertex " + std::to_string(point.vertex) + " is in no tet"};
      }
      return at(point.vertex);
    }
    if (!std::ranges::binary_search(m_.original_, point.tet)) {
      return Error{ErrorCode::kBadInput, "source tetrahedron " + std::to_string(point.tet) +
                                             " is not there, or was left out"};
    }
    Vec3 place = Vec3::Zero();
    double sum = 0;
    bool valid = true;
    for (std::size_t k = 0; k < 4; ++k) {
      valid = valid && point.weights[k] >= 0;
      sum += point.weights[k];
      place += point.weights[k] * at(m_.mesh_->tets()[point.tet][k]);
    }
    if (!valid || !(std::abs(sum - 1) < 1e-9)) {
      return Error{ErrorCode::kBadInput, "the weights of a source in tetrahedron " +
                                             std::to_string(point.tet) +
                                             " are negative or do not sum to 1"};
    }
    return place;
  }

  bool sees(Index v, Index source) const {
    for (Index i = first_sight_[v]; i != kNoIndex; i = sights_[i].next) {
      if (sights_[i].source == source) return true;
    }
    return false;
  }

  /// The vertex sees the source, which it did not. The straight line is the least there can be.
  void see(Index v, Index source) {
    const double line = line_from(source, v);
    double& held = out_.distances[v];
    if (line > held + slack_at(v)) return;
    if (sights_of_[v] >= kMaxSights && line >= held) return;
    ++sights_of_[v];
    sights_.push_back({source, first_sight_[v]});
    first_sight_[v] = static_cast<Index>(sights_.size()) - 1;
    queue_.push({line, v, source});
    if (line > held || (line == held && straight_[v] != 0)) return;
    straight_[v] = 1;
    set(v, line, source);
  }

  void set(Index v, double distance, Index source) {
    out_.distances[v] = distance;
    out_.nearest[v] = source;
    queue_.push({distance, v, kNoIndex});
  }

  /// Offers what a vertex knows to the other corners of its tets.
  void spread(const News& news) {
    for (std::uint32_t i = m_.first_[news.vertex]; i < m_.first_[news.vertex + 1]; ++i) {
      const Tet& tet = m_.tets_[m_.around_[i]];
      for (int k = 0; k < 4; ++k) {
        if (tet[k] == news.vertex) continue;
        const Face face = face_opposite(tet, k);
        if (news.source == kNoIndex) {
          offer_plane(tet[k], face, news.vertex);
        } else {
          offer_line(tet[k], face, news.source);
        }
      }
    }
  }

  void offer_line(Index v, const Face& face, Index source) {
    const Vec3 to_source = sources_[source].place - at(v);
    if (!(to_source.norm() <= reach_) || sees(v, source)) return;
    const FaceCrossing crossing =
        cross_face({at(face[0]) - at(v), at(face[1]) - at(v), at(face[2]) - at(v)}, to_source);
    if (!crossing.crosses) return;
    for (std::size_t i = 0; i < 3; ++i) {
      if (crossing.weights[i] > 0 && !sees(face[i], source)) return;
    }
    see(v, source);
  }

  /// From the corners that have the same nearest source alone: distance has a ridge where sources
  /// meet, and a plane through both sides of it would lie below. Nothing is nearer to a source than
  /// the straight line.
  void offer_plane(Index v, const Face& face, Index changed) {
    constexpr double kRoundOff = 1e-13;
    const Index source = out_.nearest[changed];
    if (straight_[v] != 0 && out_.nearest[v] == source) return;
    std::array<KnownCorner, 3> known;
    for (std::size_t i = 0; i < 3; ++i) {
      const bool same = out_.nearest[face[i]] == source;
      known[i] = {at(face[i]) - at(v), same ? out_.distances[face[i]] : kUnreached};
    }
    const double distance = std::max(updated_distance(known), line_from(source, v));
    if (!(distance < out_.distances[v] * (1 - kRoundOff))) return;
    straight_[v] = 0;
    set(v, distance, source);
  }

  const TetFastMarching& m_;
  double reach_;
  std::vector<Source> sources_;
  std::vector<Index> first_sight_;  ///< V: into sights_, a list for each vertex
  std::vector<Sight> sights_;
  std::vector<Index> sights_of_;        ///< V: how many
  std::vector<std::uint8_t> straight_;  ///< V: the distance is the line to `nearest`
  TetDistances out_;
  std::priority_queue<News> queue_;
};

Result<TetDistances> TetFastMarching::solve(std::span<const VolumePoint> points,
                                            std::span<const double> offsets,
                                            const TetMarchingOptions& options,
                                            const Progress& progress) const {
  if (points.empty()) return Error{ErrorCode::kBadInput, "there is no source"};
  if (!offsets.empty() && offsets.size() != points.size()) {
    return Error{ErrorCode::kBadInput, std::to_string(offsets.size()) + " offsets for " +
                                           std::to_string(points.size()) + " sources"};
  }
  try {
    TetMarch march(*this, options);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double offset = offsets.empty() ? 0 : offsets[i];
      if (!(offset >= 0 && offset < kUnreached)) {
        return Error{ErrorCode::kBadInput,
                     "the offset of source " + std::to_string(i) + " is negative or not finite"};
      }
      if (auto added = march.add(points[i], offset); !added) return added.error();
    }
    return march.march(progress);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, "not enough memory for the distances of " +
                                              std::to_string(mesh_->vertex_count()) + " vertices"};
  }
}

}  // namespace geotherm
