// SPDX-License-Identifier: MIT
#include "geotherm/path.h"

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/progress.h"
#include "solver/core/text.h"
#include "solver/path/crossing_graph.h"
#include "solver/path/path_surface.h"
#include "solver/path/shorten.h"
#include "solver/path/streamline.h"
#include "solver/path/within_memory.h"

namespace geotherm {
namespace {

/// Vertices are tried while the distances to both ends say that a path through them is longer than
/// the best so far by less than this share, which is more than the error of such distances.
constexpr double kDistanceError = 1e-3;

/// Most vertices tried; of hundreds of paths on rough scans none gained by more.
constexpr int kMaxTries = 16;

/// Paths of the crossing graph are tried while they are longer than the best so far by less than
/// this share, which is more than they lose by their few points on each edge.
constexpr double kGraphError = 0.04;

/// Most of them tried, and most faces that these may run through in all beyond the first: many
/// short ones on coarse meshes, a few long ones on fine meshes.
constexpr std::size_t kMaxRoutes = 300, kMaxFaces = 20000;

class PathSearch {
 public:
  /// `known`: a path no longer than that is the shortest; negative: none is known to be.
  PathSearch(const PathSurface& surface, const GeodesicEnds& ends, double known,
             const Progress& progress)
      : surface_(surface),
        ends_(ends),
        known_(known),
        progress_(progress),
        seen_(static_cast<std::size_t>(surface.mesh()->vertex_count()), 0) {}

  Result<SurfacePath> run() {
    auto along_edges = edge_path(surface_, ends_.from, ends_.to);
    if (!along_edges) return along_edges.error();
    if (auto tried = shorten_from(*along_edges); !tried) return tried.error();
    if (is_found()) return best_;
    auto down = streamline(ends_.to, ends_.from, ends_.from_distances);
    if (!down) return down.error();
    if (auto tried = shorten_from(reversed(*std::move(down))); !tried) return tried.error();
    if (is_found()) return best_;
    auto up = streamline(ends_.from, ends_.to, ends_.to_distances);
    if (!up) return up.error();
    if (auto tried = shorten_from(*up); !tried) return tried.error();
    if (auto tried = through_vertices(); !tried) return tried.error();
    if (auto tried = through_edges(); !tried) return tried.error();
    return best_;
  }

 private:
  bool is_found() const { return best_.length <= known_; }

  Result<SurfacePath> streamline(const SurfacePoint& from, const SurfacePoint& to,
                                 std::span<const double> distances) const {
    auto line = trace_streamline(surface_, {distances}, from, to);
    if (!line) return line.error();
    return std::move(line->path);
  }

  Result<void> shorten_from(const SurfacePath& start) {
    auto path = shorten(surface_, start, true, progress_);
    if (!path) return path.error();
    mark(start);
    mark(*path);
    if (best_.points.empty() || path->length < best_.length) best_ = *std::move(path);
    return {};
  }

  /// Vertices beside a path are not tried: the path has been shortened past them.
  void mark(const SurfacePath& path) {
    for (const Index f : path.faces) {
      for (const Index v : surface_.mesh()->faces()[f]) seen_[v] = 1;
    }
  }

  double length_through(Index v) const { return ends_.from_distances[v] + ends_.to_distances[v]; }

  Result<void> through_vertices() {
    const double most = best_.length * (1 + kDistanceError);
    std::vector<std::pair<double, Index>> near;
    for (Index v = 0; v < surface_.mesh()->vertex_count(); ++v) {
      if (length_through(v) < most) near.emplace_back(length_through(v), v);
    }
    std::ranges::sort(near);
    int tries = 0;
    for (const auto& [length, v] : near) {
      if (is_found()) return {};
      if (tries == kMaxTries || length > best_.length * (1 + kDistanceError)) break;
      if (seen_[v] || surface_.corners_at(v).empty()) continue;
      ++tries;
      const SurfacePoint vertex = SurfacePoint::at_vertex(v);
      auto in = streamline(vertex, ends_.from, ends_.from_distances);
      if (!in) return in.error();
      const auto out = streamline(vertex, ends_.to, ends_.to_distances);
      if (!out) return out.error();
      SurfacePath through = reversed(*std::move(in));
      append(through, *out);
      if (auto tried = shorten_from(through); !tried) return tried;
    }
    return {};
  }

  Result<void> through_edges() {
    if (is_found() || !(best_.length > 0)) return {};
    const CrossingGraph graph(surface_, ends_, best_.length);
    std::size_t faces = 0;
    for (const SurfacePath& route : graph.routes(best_.length * (1 + kGraphError), kMaxRoutes)) {
      if (is_found()) break;
      if (faces > kMaxFaces || route.length > best_.length * (1 + kGraphError)) break;
      faces += route.faces.size();
      if (auto tried = shorten_from(route); !tried) return tried;
    }
    return {};
  }

  const PathSurface& surface_;
  const GeodesicEnds& ends_;
  double known_;
  const Progress& progress_;
  std::vector<char> seen_;
  SurfacePath best_;
};

/// The shortest path that is found from one point to the other, from several starts: the shortest
/// path along edges, the streamlines of both distances, those through vertices whose distances say
/// that there may be a shorter path, and the shortest paths of a CrossingGraph, which need pass
/// near no vertex. Never longer than the path along edges. Nothing proves that it is the shortest
/// of all; docs/paths.md has the measured rate. Errors: kOutOfMemory, those of shorten() and
/// trace_streamline().
Result<SurfacePath> search_geodesic(const PathSurface& surface, const GeodesicEnds& ends,
                                    double known, const Progress& progress) {
  return within_memory("a geodesic", *surface.mesh(), progress, [&](const Progress& watched) {
    return PathSearch(surface, ends, known, watched).run();
  });
}

/// A path that is longer than an exact distance by less than this share is the shortest: both lose
/// fewer digits.
constexpr double kSameLength = 1e-9;

/// An order of points that does not depend on which of them a path comes from.
bool stands_before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

std::string place_text(const Vec3& p) {
  return "(" + rounded_text(p.x()) + ", " + rounded_text(p.y()) + ", " + rounded_text(p.z()) + ")";
}

/// The share by which a path is longer than a distance of that method only where it is not the
/// shortest; more than any of methods that are not near exact.
double error_of(MethodKind kind) {
  constexpr double kOfExact = 1e-4, kOfWaves = 0.01;
  switch (kind) {
    case MethodKind::kExact:
      return kOfExact;
    case MethodKind::kWavefront:
    case MethodKind::kWavefrontFine:
      return kOfWaves;
    case MethodKind::kHeat:
    case MethodKind::kFastMarching:
      break;
  }
  return kUnreached;
}

/// The straight piece between two places of one face: on the surface nothing is shorter.
std::optional<SurfacePath> straight_piece(const PathSurface& surface, const SurfacePoint& a,
                                          const SurfacePoint& b) {
  const std::vector<Index> at_b = surface.faces_at(b);
  for (const Index face : surface.faces_at(a)) {
    if (std::ranges::find(at_b, face) == at_b.end()) continue;
    SurfacePath path;
    path.points = {surface.out_of(a), surface.out_of(b)};
    path.faces = {surface.file_face(face)};
    path.length = length_of(*surface.mesh(), path.points);
    return path.length > 0 ? std::optional(std::move(path)) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

/// The answers for the two points that were asked for last.
struct PathFinder::Recent {
  using Answer = std::shared_ptr<const DistanceResult>;
  struct Entry {
    SurfacePoint source;
    bool heat = false;
    Answer answer;
  };

  /// Null where it is not there.
  Answer find(const SurfacePoint& source, bool heat) {
    const std::lock_guard lock(mutex);
    for (Entry& entry : entries) {
      if (!entry.answer || !(entry.source == source) || entry.heat != heat) continue;
      std::swap(entry, entries.front());
      return entries.front().answer;
    }
    return nullptr;
  }
  void keep(const SurfacePoint& source, bool heat, Answer answer) {
    const std::lock_guard lock(mutex);
    std::swap(entries.front(), entries.back());
    entries.front() = {source, heat, std::move(answer)};
  }

  std::mutex mutex;
  std::array<Entry, 2> entries;  ///< the last one in front
};

PathFinder::PathFinder(std::shared_ptr<const TriangleMesh> mesh,
                       std::shared_ptr<const DistanceMethod> method)
    : surface_(std::make_shared<const PathSurface>(std::move(mesh))),
      method_(std::move(method)),
      recent_(std::make_shared<Recent>()) {}

Result<FoundPath> PathFinder::find(std::span<const SurfacePoint> points, const PathOptions& options,
                                   const Progress& progress) const {
  return within_memory("a path", *surface_->mesh(), progress,
                       [&](const Progress& watched) { return through(points, options, watched); });
}

Result<FoundPath> PathFinder::through(std::span<const SurfacePoint> points,
                                      const PathOptions& options, const Progress& progress) const {
  if (points.size() < 2) {
    return Error{ErrorCode::kBadInput,
                 "a path needs two points or more, and " + std::to_string(points.size()) +
                     (points.size() == 1 ? " was given" : " were given"),
                 {"give another one"}};
  }
  std::vector<SurfacePoint> stops(points.begin(), points.end());
  if (options.closed) stops.push_back(stops.front());
  const bool loose =
      options.closed && options.field == PathField::kGeodesic && !options.hold_points;
  const double found = loose ? 0.9 : 1.0;  // of the work, when all pieces are
  const double share = found / static_cast<double>(stops.size() - 1);
  FoundPath out;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const auto part = static_cast<double>(i);
    auto next = piece(stops[i], stops[i + 1], options.field,
                      part_of(progress, part * share, (part + 1) * share));
    if (!next) return next.error();
    append(out.path, next->path);
    out.warnings.insert(out.warnings.end(), next->warnings.begin(), next->warnings.end());
  }
  out.path.closed = options.closed;
  if (!loose) return out;
  auto loop = shorten(*surface_, out.path, false, part_of(progress, found, 1));
  if (!loop) return loop.error();
  out.path = *std::move(loop);
  out.warnings.clear();  // they are of pieces that are gone
  if (out.path.points.size() == 1) {
    out.warnings.push_back(
        {"the loop can be drawn together to a point, and was",
         {"lead it round a hole or a handle with way-points, or hold it at its points"}});
  }
  return out;
}

Result<FoundPath> PathFinder::piece(const SurfacePoint& from, const SurfacePoint& to,
                                    PathField field, const Progress& progress) const {
  if (field != PathField::kGeodesic) return streamline(from, to, field, progress);
  const auto a = surface_->into(from), b = surface_->into(to);
  if (!a) return a.error();
  if (!b) return b.error();
  if (auto path = straight_piece(*surface_, *a, *b)) return FoundPath{*std::move(path), {}};
  if (method_->kind() == MethodKind::kExact && b->is_vertex()) {
    auto path = as_long_as_known(from, surface_->out_of(*b), part_of(progress, 0, 0.3));
    if (!path) return path.error();
    if (*path) return FoundPath{**std::move(path), {}};
  }
  if (!stands_before(surface_->position(*b), surface_->position(*a))) {
    return geodesic(from, to, progress);
  }
  auto found = geodesic(to, from, progress);
  if (found) found->path = reversed(std::move(found->path));
  return found;
}

Result<std::shared_ptr<const DistanceResult>> PathFinder::distances(
    const SurfacePoint& source, bool heat, const Progress& progress) const {
  if (auto known = recent_->find(source, heat)) return known;
  SourceSet set;
  set.points = {source};
  QueryOptions query;
  query.quality = false;
  query.fields = heat;
  auto solved = method_->solve(set, query, progress);
  if (!solved) return solved.error();
  auto answer = std::make_shared<const DistanceResult>(*std::move(solved));
  recent_->keep(source, heat, answer);
  return answer;
}

Result<FoundPath> PathFinder::streamline(const SurfacePoint& from, const SurfacePoint& to,
                                         PathField field, const Progress& progress) const {
  const bool heat = field == PathField::kHeat;
  if (heat && !method_->heat()) {
    return Error{ErrorCode::kBadInput,
                 "the field heat is one of the method heat, not of " + to_text(method_->kind()),
                 {"choose the method heat or the field distance"}};
  }
  if (auto way = edge_path(*surface_, from, to); !way) return way.error();
  const auto solved = distances(from, heat, progress);
  if (!solved) return solved.error();
  const DescentField down{heat ? (*solved)->log_heat : (*solved)->distances, heat};
  auto line = trace_streamline(*surface_, down, to, from);
  if (!line) return line.error();
  FoundPath out{reversed(std::move(line->path)), {}};
  if (line->stuck) {
    out.warnings.push_back({"the streamline of " + to_text(field) + " from " +
                                place_text(position_at(*surface_->mesh(), to)) +
                                " stopped before its goal and went on along edges",
                            {"the field geodesic has no such stops"}});
  }
  return out;
}

Result<std::optional<SurfacePath>> PathFinder::as_long_as_known(const SurfacePoint& from,
                                                                const SurfacePoint& to,
                                                                const Progress& progress) const {
  auto along_edges = edge_path(*surface_, from, to);
  if (!along_edges) return along_edges.error();
  const auto solved = distances(from, false, progress);
  if (!solved) return solved.error();
  const std::span<const double> known = (*solved)->distances;
  const double longest = known[static_cast<std::size_t>(to.vertex)] * (1 + kSameLength);
  auto shortened = shorten(*surface_, *along_edges, true, progress);
  if (!shortened) return shortened.error();
  if (shortened->length <= longest) return std::optional(*std::move(shortened));
  const auto down = trace_streamline(*surface_, {known}, to, from);
  if (!down) return down.error();
  shortened = shorten(*surface_, reversed(down->path), true, progress);
  if (!shortened) return shortened.error();
  if (shortened->length <= longest) return std::optional(*std::move(shortened));
  return std::optional<SurfacePath>();
}

Result<FoundPath> PathFinder::geodesic(const SurfacePoint& from, const SurfacePoint& to,
                                       const Progress& progress) const {
  if (auto way = edge_path(*surface_, from, to); !way) return way.error();
  const auto there = distances(from, false, part_of(progress, 0, 0.4));
  if (!there) return there.error();
  const auto back = distances(to, false, part_of(progress, 0.4, 0.8));
  if (!back) return back.error();
  const auto at = [](const DistanceResult& distances, const SurfacePoint& point) {
    return point.is_vertex() ? distances.distances[static_cast<std::size_t>(point.vertex)]
                             : kUnreached;
  };
  const double distance = to.is_vertex() ? at(**there, to) : at(**back, from);
  const bool is_exact = method_->kind() == MethodKind::kExact && to.is_vertex();
  auto path =
      search_geodesic(*surface_, {from, to, (*there)->distances, (*back)->distances},
                      is_exact ? distance * (1 + kSameLength) : -1, part_of(progress, 0.8, 1));
  if (!path) return path.error();
  FoundPath found{*std::move(path), {}};
  if (found.path.length > distance * (1 + error_of(method_->kind()))) {
    const TriangleMesh& mesh = *surface_->mesh();
    found.warnings.push_back({"between " + place_text(position_at(mesh, from)) + " and " +
                              place_text(position_at(mesh, to)) +
                              " no path was found that is as short as the distance, " +
                              rounded_text(distance) + " by the method " +
                              to_text(method_->kind()) + ": this one has " +
                              rounded_text(found.path.length)});
  }
  return found;
}

}  // namespace geotherm
