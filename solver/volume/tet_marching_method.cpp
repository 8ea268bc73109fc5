// SPDX-License-Identifier: MIT
#include "solver/volume/tet_marching_method.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "solver/core/stopwatch.h"
#include "solver/geometry/cell_mesh.h"
#include "solver/method/marching_method.h"
#include "solver/volume/clean_tets.h"
#include "solver/volume/reentrant_lines.h"
#include "solver/volume/tet_source.h"
#include "solver/volume/tet_update.h"

namespace geotherm {
namespace {

/// What fast marching walks over.
struct MarchedTets {
  std::shared_ptr<const TetMesh> mesh;
  double straight_reach;
  std::vector<Tet> tets;             ///< clean
  std::vector<Index> original;       ///< their numbers in the mesh, ascending
  CellTable around;                  ///< the clean tets around each vertex
  std::vector<double> longest_edge;  ///< V
  ReentrantLines reentrant;
};

MarchedTets marched_tets(std::shared_ptr<const TetMesh> mesh, CleanTets clean,
                         double straight_reach) {
  MarchedTets out{std::move(mesh),
                  straight_reach,
                  std::move(clean.tets),
                  std::move(clean.original),
                  {},
                  {},
                  {}};
  out.around = CellTable(out.mesh->vertex_count(), static_cast<Index>(out.tets.size()), 1,
                         [&out](Index t) -> const Tet& { return out.tets[t]; });
  const auto positions = out.mesh->positions();
  out.longest_edge.assign(positions.size(), 0);
  for (const Tet& tet : out.tets) {
    for (const Index v : tet) {
      for (const Index w : tet) {
        const double edge = (positions[v] - positions[w]).norm();
        out.longest_edge[v] = std::max(out.longest_edge[v], edge);
      }
    }
  }
  out.reentrant = reentrant_lines(positions, out.tets, out.around);
  return out;
}

/// One query. Two kinds of news spread, in the order of distance: that a vertex sees a source, and
/// that its distance became less. A vertex near a ridge, where sources meet, sees those behind it
/// as well: the lines to vertices before the ridge may cross faces with corners behind it. Round a
/// straight re-entrant edge of the border ways bend: with the part before it turned into the plane
/// of the part behind it they are straight lines, too, so that the edge is a source of its own
/// behind which vertices are seen.
class TetMarch {
 public:
  explicit TetMarch(const MarchedTets& tets) : m_(tets) {
    const std::size_t count = m_.mesh->positions().size();
    out_.distances.assign(count, kUnreached);
    out_.nearest.assign(count, kNoIndex);
    straight_.assign(count, 0);
    first_sight_.assign(count, kNoIndex);
    sights_of_.assign(count, 0);
  }

  Result<void> add_vertex(Index v, double offset) {
    if (v < 0 || v >= m_.mesh->vertex_count()) {
      return Error{ErrorCode::kBadInput, "source vertex " + std::to_string(v) + " is not one of " +
                                             std::to_string(m_.mesh->vertex_count()) + " vertices"};
    }
    if (m_.around.at(v).empty()) {
      return Error{ErrorCode::kBadInput, "source vertex " + std::to_string(v) + " is in no tet"};
    }
    see(v, add_source(at(v), offset));
    return {};
  }

  Result<void> add_point(const CellPoint& point) {
    const std::string name = "tet " + std::to_string(point.cell);
    if (!std::ranges::binary_search(m_.original, point.cell)) {
      return Error{ErrorCode::kBadInput, "source " + name + " is not there, or was left out"};
    }
    if (auto valid = check_weights(point.weights, 4, name); !valid) return valid;
    const Tet& tet = m_.mesh->tets()[point.cell];
    Vec3 place = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) place += point.weights[k] * at(tet[k]);
    const Index source = add_source(place, 0);
    for (const Index v : tet) see(v, source);
    return {};
  }

  Result<Marched> march(const Progress& progress) {
    constexpr std::int64_t kMaxVisits = 1000, kReported = 4096;
    const auto vertices = static_cast<std::int64_t>(out_.distances.size());
    std::int64_t visits = 0;
    while (!queue_.empty()) {
      const News next = queue_.top();
      queue_.pop();
      const double slack = next.source == kNoIndex ? 0 : slack_at(next.vertex, next.source);
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
    for (Index& source : out_.nearest) {
      if (source != kNoIndex) source = sources_[source].root;
    }
    return std::move(out_);
  }

 private:
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
  static constexpr Index kMaxSights = 16;

  const Vec3& at(Index v) const { return m_.mesh->positions()[v]; }

  Index add_source(const Vec3& place, double offset) {
    const auto number = static_cast<Index>(sources_.size());
    sources_.push_back({place, offset, number, number});
    ++given_;
    return number;
  }

  /// So much farther than the nearest source may be one that a vertex sees.
  double slack_at(Index v, Index source) const {
    constexpr Index kFew = 8;
    constexpr double kOfEdge = 2, kOfMany = 4;
    if (sources_.size() == 1) return 0;
    if (sources_[source].line != kNoIndex) return kOfEdge * m_.longest_edge[v];
    return given_ > kFew ? kOfMany * m_.longest_edge[v] : kUnreached;
  }

  double line_from(Index source, Index v) const { return sources_[source].line_to(at(v)); }

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
    if (line > held + slack_at(v, source)) return;
    if (sights_of_[v] >= kMaxSights && line >= held) return;
    ++sights_of_[v];
    sights_.push_back({source, first_sight_[v]});
    first_sight_[v] = static_cast<Index>(sights_.size()) - 1;
    queue_.push({line, v, source});
    const bool is_nearer = line < held || (line == held && straight_[v] == 0);
    if (is_nearer) {
      straight_[v] = 1;
      set(v, line, source);
    }
    if (line > out_.distances[v]) return;
    for (const auto& end : m_.reentrant.at(v)) see_round(v, source, end.line);
  }

  /// The vertex on this re-entrant line sees the source: what is behind it is seen round the line.
  void see_round(Index v, Index source, Index number) {
    constexpr double kRoundOff = 1e-9;
    const ReentrantLines::Line& line = m_.reentrant.lines[number];
    for (const Index known : sources_[source].behind) {
      if (sources_[known].line != number) continue;
      if (!sees(v, known)) see(v, known);
      return;
    }
    const TetSource& s = sources_[source];
    const bool is_edge = s.line != kNoIndex;
    // Round two lines ways are straight in one plane where these are parallel.
    if (is_edge && (s.line == number || s.direction.cross(line.direction).norm() > kRoundOff)) {
      return;
    }
    const Vec3 way = s.place - line.place;
    const double along = way.dot(line.direction);
    const double off = (way - along * line.direction).norm();
    if (!(off > kRoundOff * m_.longest_edge[v])) return;
    const auto bent = static_cast<Index>(sources_.size());
    sources_.push_back({line.place + along * line.direction, s.offset, source, s.root, number,
                        line.direction, s.before + off});
    sources_[source].behind.push_back(bent);
    see(v, bent);
  }

  void set(Index v, double distance, Index source) {
    out_.distances[v] = distance;
    out_.nearest[v] = source;
    queue_.push({distance, v, kNoIndex});
  }

  /// Offers what a vertex knows to the other corners of its tets.
  void spread(const News& news) {
    for (const Index t : m_.around.at(news.vertex)) {
      const Tet& tet = m_.tets[t];
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

  enum class Passage { kBefore, kInside, kHidden };
  /// How the line from a vertex to a source passes an edge that the source sees: it ends before the
  /// edge, or is on the inside of the border there, or is not.
  Passage passage(Index v, const TetSource& source, const TetSource& edge) const {
    const Vec3& inward = m_.reentrant.lines[edge.line].inward;
    const Vec3 across = edge.direction.cross(inward);
    const Vec3 from = source.place - edge.place, to = at(v) - edge.place;
    const double before = from.dot(across), behind = to.dot(across);
    if (before * behind >= 0) return Passage::kBefore;
    const double inside = (before * to - behind * from).dot(inward) * before;
    return inside > 0 ? Passage::kInside : Passage::kHidden;
  }

  /// Whether the line from v passes on the inside of all edges that the source sees, and of one by
  /// which the source is hidden from a corner beside it. What hides it from the corner may hide it
  /// from v else.
  bool passes_edges(Index corner, Index v, Index source) const {
    const TetSource& s = sources_[source];
    if (s.line != kNoIndex) return false;
    const auto hides = [&](Index edge) {
      const TetSource& e = sources_[edge];
      return edge != source && e.parent == source && passage(corner, s, e) == Passage::kHidden &&
             passage(v, s, e) == Passage::kInside;
    };
    bool is_hidden = false;
    for (Index i = first_sight_[corner]; i != kNoIndex && !is_hidden; i = sights_[i].next) {
      is_hidden = hides(sights_[i].source);
    }
    return is_hidden && std::ranges::none_of(s.behind, [&](Index edge) {
             return passage(v, s, sources_[edge]) == Passage::kHidden;
           });
  }

  void offer_line(Index v, const Face& face, Index source) {
    if (sees(v, source)) return;
    const Vec3 to_source = sources_[source].target(at(v)) - at(v);
    if (!(to_source.norm() <= m_.straight_reach)) return;
    const FaceCrossing crossing =
        cross_face({at(face[0]) - at(v), at(face[1]) - at(v), at(face[2]) - at(v)}, to_source);
    if (!crossing.crosses) return;
    bool one_sees = false;  // on the inside of the edges that hide the source from others
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(crossing.weights[i] > 0)) continue;
      if (sees(face[i], source)) {
        one_sees = true;
      } else if (!passes_edges(face[i], v, source)) {
        return;
      }
    }
    if (!one_sees) return;
    see(v, source);
  }

  /// Where an edge begins to hide its source the fronts of both touch each other smoothly: two
  /// vertices that have straight lines from these are of one front.
  bool are_of_one_front(Index v, Index w) const {
    const Index a = out_.nearest[v], b = out_.nearest[w];
    if (a == b) return true;
    if (a == kNoIndex || straight_[v] == 0 || straight_[w] == 0) return false;
    return sources_[a].parent == b || sources_[b].parent == a;
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
      const bool same = are_of_one_front(face[i], changed);
      known[i] = {at(face[i]) - at(v), same ? out_.distances[face[i]] : kUnreached};
    }
    const double distance = std::max(updated_distance(known), line_from(sources_[source].root, v));
    if (!(distance < out_.distances[v] * (1 - kRoundOff))) return;
    straight_[v] = 0;
    set(v, distance, source);
  }

  const MarchedTets& m_;
  std::vector<TetSource> sources_;  ///< those that were given, then edges
  Index given_ = 0;
  std::vector<Index> first_sight_;  ///< V: into sights_, a list for each vertex
  std::vector<Sight> sights_;
  std::vector<Index> sights_of_;        ///< V: how many
  std::vector<std::uint8_t> straight_;  ///< V: whether the distance is a line from `nearest`
  Marched out_;
  std::priority_queue<News> queue_;
};

class TetMarchingMethod final : public MarchingMethod {
 public:
  TetMarchingMethod(MarchedTets tets, const std::vector<std::string>& notes, double setup_ms,
                    int threads)
      : MarchingMethod(tets.mesh->vertex_count(), kBytesOfTet * tets.mesh->tet_count() / (1 << 20),
                       setup_ms, threads, kNanosecondsOfVertex),
        tets_(std::move(tets)) {
    for (const std::string& note : notes) warnings_.push_back({note});
  }

 private:
  static constexpr double kBytesOfTet = 35, kNanosecondsOfVertex = 2000;

  Result<Marched> march(const SourceSet& sources, const Progress& progress) const override {
    if (auto valid = check_space_sources(sources, "vertices or points of tets"); !valid) {
      return valid.error();
    }
    TetMarch march(tets_);
    for (std::size_t i = 0; i < sources.points.size(); ++i) {
      const double offset = sources.offsets.empty() ? 0 : sources.offsets[i];
      if (auto added = march.add_vertex(sources.points[i].vertex, offset); !added) {
        return added.error();
      }
    }
    for (const CellPoint& point : sources.cell_points) {
      if (auto added = march.add_point(point); !added) return added.error();
    }
    return march.march(progress);
  }

  double eikonal_error(std::span<const double> distances) const override {
    const auto positions = tets_.mesh->positions();
    double error = 0, volume = 0;
    for (const Tet& tet : tets_.mesh->tets()) {
      const TetGradient element =
          tet_gradient(positions[tet[0]], positions[tet[1]], positions[tet[2]], positions[tet[3]]);
      Vec3 gradient = Vec3::Zero();
      for (std::size_t k = 0; k < 4; ++k) gradient += distances[tet[k]] * element.gradients[k];
      if (!(element.volume > 0) || !gradient.allFinite()) continue;
      error += element.volume * std::abs(gradient.norm() - 1);
      volume += element.volume;
    }
    return volume > 0 ? error / volume : 0.0;
  }

  MarchedTets tets_;
};

}  // namespace

Result<std::shared_ptr<const DistanceMethod>> build_tet_marching(
    std::shared_ptr<const TetMesh> mesh, int threads, const Progress& progress,
    double straight_reach) {
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  const Stopwatch watch;
  CleanTets clean = clean_tets(*mesh);
  if (clean.tets.empty()) {
    return Error{ErrorCode::kBadInput,
                 "none of the " + std::to_string(mesh->tet_count()) + " tetrahedra has a volume"};
  }
  const std::vector<std::string> notes = clean.notes();
  MarchedTets tets = marched_tets(std::move(mesh), std::move(clean), straight_reach);
  return std::shared_ptr<const DistanceMethod>(std::make_shared<const TetMarchingMethod>(
      std::move(tets), notes, watch.milliseconds(), threads));
}

}  // namespace geotherm
