// SPDX-License-Identifier: MIT
#include "app/session/sources.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>

#include "app/session/surface_curve.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/mesh.h"
#include "solver/geometry/clean_faces.h"
#include "solver/mesh/closest_point_tree.h"
#include "solver/mesh/connectivity.h"

namespace geotherm::app {
namespace {

/// A point farther from the surface than this share of the model's size is worth a word.
constexpr double kFarAway = 0.01;

/// Of so many places one asks the progress.
constexpr std::size_t kAskEach = 16;

/// splitmix64 (Steele, Lea, Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t below(std::uint64_t bound) {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return (z ^ (z >> 31)) % bound;
  }

 private:
  std::uint64_t state_;
};

Error misplaced(std::string message, std::string hint) {
  return {ErrorCode::kBadInput, std::move(message), {std::move(hint)}};
}

/// There is no such thing; there are `count` of them, from 0.
Error out_of_range(const std::string& one, const std::string& many, Index asked, Index count) {
  return misplaced("there is no " + one + " " + std::to_string(asked),
                   many + " are 0 to " + std::to_string(count - 1));
}

std::string cell_word(const SourceSpace& space) {
  return space.space != nullptr ? space.space->words().cell : "face";
}

/// Flags the vertices from which distance can start.
std::vector<char> usable_vertices(const SourceSpace& space) {
  if (space.space != nullptr) return space.space->used();
  return vertices_in_faces(space.mesh.vertex_count(), space.mesh.faces());
}

class Resolver {
 public:
  Resolver(const SourceSpace& space, const Progress& progress)
      : space_(space), mesh_(space.mesh), progress_(progress), used_(usable_vertices(space)) {}

  Result<void> operator()(const VertexList& list) {
    for (const Index v : list.vertices) {
      if (auto added = add_vertex(v, list.offset); !added) return added;
    }
    return {};
  }

  Result<void> operator()(const RandomVertices& random) {
    auto vertices = random_vertices(space_, random.count, random.seed);
    if (!vertices) return vertices.error();
    return (*this)(VertexList{*std::move(vertices), random.offset});
  }

  Result<void> operator()(const WholeBoundary&) {
    if (space_.space != nullptr) {
      VertexList border{space_.space->boundary_vertices()};
      if (!border.vertices.empty()) return (*this)(border);
      return misplaced("the " + std::string(space_.space->words().body) + " has no boundary",
                       "choose vertices instead");
    }
    const EdgeTable& edges = clean().edges;
    bool found = false;
    for (Index e = 0; e < edges.edge_count(); ++e) {
      if (edges.sides(e).size() != 1) continue;
      found = true;
      set_.add_edge(edges.low(e), edges.high(e));
    }
    if (found) return {};
    return misplaced("the surface has no boundary (each of its " + grouped(edges.edge_count()) +
                         " edges has two faces or more)",
                     "choose vertices instead");
  }

  Result<void> operator()(const FacePoint& point) {
    if (point.face >= mesh_.face_count()) {
      return out_of_range("face", "faces", point.face, mesh_.face_count());
    }
    const Face& face = mesh_.faces()[point.face];
    if (repeats_corner(face)) {
      return misplaced("face " + std::to_string(point.face) + " repeats a corner and has no inside",
                       "choose another");
    }
    for (int k = 0; k < 3; ++k) {
      if (point.weights[k] == 1.0) return add_vertex(face[k], point.offset);
    }
    if (space_.space != nullptr) {
      Vec3 at = Vec3::Zero();
      for (int k = 0; k < 3; ++k) at += point.weights[k] * mesh_.positions()[face[k]];
      return add_in_space(at, point.offset);
    }
    set_.add(SurfacePoint::in_face(point.face, point.weights), point.offset);
    return {};
  }

  Result<void> operator()(const SpacePoint& point) {
    if (places_++ % kAskEach == 0 && !report(progress_, "sources", -1)) return cancelled_error();
    if (space_.space != nullptr) return add_in_space(point.position, point.offset);
    const auto found = closest_to(point.position);
    if (!found) return found.error();
    note_distance("the closest point of the surface", found->distance);
    if (found->point.is_vertex()) return add_vertex(found->point.vertex, point.offset);
    set_.add(found->point, point.offset);
    return {};
  }

  Result<void> operator()(const GridSample& sample) {
    const auto size = space_.space != nullptr ? space_.space->size() : std::array<Index, 3>();
    if (size[0] == 0) {
      return misplaced("a sample is a source of grids alone", "give a vertex or xyz:x:y:z");
    }
    for (std::size_t e = 0; e < 3; ++e) {
      if (sample.place[e] < size[e]) continue;
      return misplaced(
          "there is no sample " + std::to_string(sample.place[e]) + " along " + "xyz"[e],
          "samples are 0 to " + std::to_string(size[e] - 1));
    }
    const auto [i, j, k] = sample.place;
    return add_vertex(i + size[0] * (j + size[1] * k), sample.offset);
  }

  Result<void> operator()(const VertexCurve& curve) {
    if (space_.space != nullptr) return no_curve();
    for (std::size_t i = 0; i < curve.vertices.size(); ++i) {
      if (auto added = add_vertex(curve.vertices[i], 0); !added) {
        return about(place(curve, i), added.error());
      }
    }
    const EdgeGraph graph(mesh_.positions(), clean().edges);
    Index gaps = 0;
    std::size_t first_gap = 0;
    for (std::size_t i = 1; i < curve.vertices.size(); ++i) {
      const Index a = mesh_.standing_for(curve.vertices[i - 1]);
      const Index b = mesh_.standing_for(curve.vertices[i]);
      if (a == b) continue;
      if (graph.adjacent(a, b)) {
        set_.add_edge(a, b);
        continue;
      }
      const auto path = graph.shortest_path(a, b);
      if (!path) return about(place(curve, i), path.error());
      if (gaps++ == 0) first_gap = i;
      for (std::size_t j = 1; j < path->size(); ++j) set_.add_edge((*path)[j - 1], (*path)[j]);
    }
    if (gaps > 0) note_gaps(curve, gaps, first_gap);  // a mistake as often as not
    return {};
  }

  Result<void> operator()(const SurfaceCurve& curve) {
    if (space_.space != nullptr) return no_curve();
    std::vector<SurfacePoint> points;
    for (const FacePoint& point : curve.points) {
      if (point.face >= mesh_.face_count()) return (*this)(point);  // says what is wrong
      points.push_back(SurfacePoint::in_face(point.face, point.weights));
    }
    CurveJoiner& joiner = space_.joiner != nullptr ? *space_.joiner : own_joiner_;
    auto segments = joiner.join(points);
    if (!segments) return segments.error();
    if (segments->empty()) return (*this)(curve.points.front());
    SourceSet whole;
    whole.segments = *std::move(segments);
    set_.add(whole);
    return {};
  }

  Result<void> add(const Source& source) {
    where_ = source.where;
    const auto placed = std::visit(*this, source.spec);
    if (placed || placed.error().code == ErrorCode::kCancelled) return placed;
    return about(where_, placed.error(), source.blame);
  }

  /// What was added since the last call.
  ResolvedSources finish() { return {set_.take(), std::exchange(warnings_, {})}; }

 private:
  /// The first few places are looked for among all faces, further ones by a tree over them, which
  /// takes about as long to make as that many searches.
  Result<ClosestPoint> closest_to(const Vec3& place) {
    constexpr std::size_t kFew = 8;
    if (places_ <= kFew) return closest_point(mesh_, place);
    if (!tree_) {
      auto made = ClosestPointTree::build(
          mesh_, [this](std::string_view, double) { return report(progress_, "sources", -1); });
      if (!made) return made.error();
      tree_ = *std::move(made);
    }
    return tree_->to(place);
  }

  Result<void> add_in_space(const Vec3& position, double offset) {
    auto found = space_.space->closest_point(position);
    if (!found) return found.error();
    const SpaceWords& words = space_.space->words();
    note_distance(found->vertex == kNoIndex  // polygons and grids take no others
                      ? "the closest point of the " + std::string(words.body)
                      : "vertex " + std::to_string(found->vertex) + ", which stands for it,",
                  found->distance);
    if (found->vertex != kNoIndex) return add_vertex(found->vertex, offset);
    if (offset > 0) {
      return misplaced("a point inside a " + std::string(words.cell) + " takes no offset",
                       "give a vertex, or leave it out");
    }
    set_.add(std::move(found->in_cell));
    return {};
  }

  Error no_curve() const {
    return misplaced("a curve is a source on surfaces alone, and this is a " +
                         std::string(space_.space->words().body),
                     "name its vertices one by one");
  }

  void note_distance(const std::string& what, double distance) {
    if (!(distance > kFarAway * model_size())) return;
    warnings_.push_back({where_ + ": " + what + " is " + significant(distance) +
                         " away (the model's size is " + significant(model_size()) + ")"});
  }

  Result<void> add_vertex(Index v, double offset) {
    if (v < 0 || v >= mesh_.vertex_count()) {
      return out_of_range("vertex", "vertices", v, mesh_.vertex_count());
    }
    v = mesh_.standing_for(v);
    if (!used_[v]) {
      // Those that a mask leaves out repeat it, too.
      const bool some_repeat = std::ranges::any_of(mesh_.faces(), repeats_corner);
      return misplaced(
          "vertex " + std::to_string(v) + " belongs to no " + cell_word(space_) +
              (some_repeat ? " (those that repeat a corner or that a mask leaves out are none)"
                           : "") +
              ", and no distance is there",
          "choose another");
    }
    set_.add(SurfacePoint::at_vertex(v), offset);
    return {};
  }

  /// Where the i-th vertex stands.
  static std::string place(const VertexCurve& curve, std::size_t i) {
    return curve.lines.empty() ? "number " + std::to_string(i + 1) + " of the curve"
                               : "line " + std::to_string(curve.lines[i]);
  }

  void note_gaps(const VertexCurve& curve, Index gaps, std::size_t first) {
    warnings_.push_back({where_ + ": " + grouped(gaps) + " of " +
                         counted(static_cast<Index>(curve.vertices.size()) - 1, "step", "steps") +
                         " of the curve " + (gaps == 1 ? "is" : "are") +
                         " no mesh edge and became the shortest path along edges (" +
                         (gaps == 1 ? "" : "the first: ") + "vertex " +
                         std::to_string(curve.vertices[first - 1]) + " to " +
                         std::to_string(curve.vertices[first]) + ", " + place(curve, first) + ")"});
  }

  const CleanFaces& clean() {
    if (!clean_) clean_ = clean_faces(mesh_);
    return *clean_;
  }

  double model_size() {
    if (size_ >= 0) return size_;
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    for (std::size_t v = 0; v < used_.size(); ++v) {
      if (!used_[v]) continue;
      low = low.cwiseMin(mesh_.positions()[v]);
      high = high.cwiseMax(mesh_.positions()[v]);
    }
    return size_ = (high - low).stableNorm();
  }

  const SourceSpace space_;
  const TriangleMesh& mesh_;
  const Progress& progress_;
  std::vector<char> used_;
  std::size_t places_ = 0;  ///< that were looked for
  std::optional<ClosestPointTree> tree_;
  std::optional<CleanFaces> clean_;
  /// Whoever places sources keeps the mesh meanwhile.
  CurveJoiner own_joiner_{std::shared_ptr<const TriangleMesh>(std::shared_ptr<void>(), &mesh_)};
  double size_ = -1;
  std::string where_;
  SetUnion set_;
  std::vector<Warning> warnings_;
};

}  // namespace

Result<ResolvedSources> resolve_sources(std::span<const Source> sources, const SourceSpace& space,
                                        const Progress& progress) {
  if (sources.empty()) return ResolvedSources{};
  Resolver resolver(space, progress);
  for (const Source& source : sources) {
    if (auto added = resolver.add(source); !added) return added.error();
  }
  return resolver.finish();
}

Result<EachSource> resolve_each(std::span<const Source> sources, const SourceSpace& space,
                                const Progress& progress) {
  EachSource each;
  if (sources.empty()) return each;
  Resolver resolver(space, progress);
  const auto place = [&](const Source& one) -> Result<void> {
    if (auto added = resolver.add(one); !added) return added;
    ResolvedSources placed = resolver.finish();
    each.sets.push_back(std::move(placed.set));
    each.warnings.insert(each.warnings.end(), placed.warnings.begin(), placed.warnings.end());
    return {};
  };
  for (const Source& source : sources) {
    VertexList list;
    if (const auto* named = std::get_if<VertexList>(&source.spec)) list = *named;
    if (const auto* random = std::get_if<RandomVertices>(&source.spec)) {
      auto vertices = random_vertices(space, random->count, random->seed);
      if (!vertices) return about(source.where, vertices.error(), source.blame);
      list = {*std::move(vertices), random->offset};
    }
    Source one{source.spec, source.where, source.blame};
    if (list.vertices.empty()) {
      if (auto placed = place(one); !placed) return placed.error();
    }
    for (const Index v : list.vertices) {
      one.spec = VertexList{{v}, list.offset};
      if (auto placed = place(one); !placed) return placed.error();
    }
  }
  return each;
}

std::vector<std::int64_t> draw_numbers(std::int64_t pool, Index count, std::uint64_t seed) {
  std::unordered_map<std::int64_t, std::int64_t> moved;  // what stands where another stood
  const auto at = [&](std::int64_t i) {
    const auto found = moved.find(i);
    return found == moved.end() ? i : found->second;
  };
  Random random(seed);
  std::vector<std::int64_t> out;
  for (std::int64_t i = 0; i < count; ++i) {
    const auto other =
        i + static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(pool - i)));
    out.push_back(at(other));
    moved[other] = at(i);
  }
  return out;
}

Result<std::vector<Index>> random_vertices(const SourceSpace& space, Index count,
                                           std::uint64_t seed) {
  const std::vector<char> used = usable_vertices(space);
  std::vector<Index> pool;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) pool.push_back(static_cast<Index>(v));
  }
  if (static_cast<std::size_t>(count) > pool.size()) {
    return misplaced(
        grouped(count) + " different vertices were asked for",
        grouped(static_cast<std::int64_t>(pool.size())) + " belong to a " + cell_word(space));
  }
  std::vector<Index> out;
  for (const std::int64_t i : draw_numbers(std::ssize(pool), count, seed)) out.push_back(pool[i]);
  return out;
}

Result<void> check_pin(const Constraint& constraint, const SourceSpace& space) {
  if (constraint.mode != ConstraintMode::kPinVertex || constraint.pin_vertex == kNoIndex) return {};
  const Source pin{VertexList{{constraint.pin_vertex}}, "constraint " + to_text(constraint),
                   ErrorCode::kBadInput};
  const auto placed = resolve_sources({&pin, 1}, space);
  if (!placed) return placed.error();
  return {};
}

}  // namespace geotherm::app
