// SPDX-License-Identifier: MIT
#include "solver/path/geodesic_search.h"

#include <algorithm>
#include <utility>
#include <vector>

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

class Search {
 public:
  Search(const PathSurface& surface, const GeodesicEnds& ends, const Progress& progress)
      : surface_(surface),
        ends_(ends),
        progress_(progress),
        seen_(static_cast<std::size_t>(surface.mesh()->vertex_count()), 0) {}

  Result<SurfacePath> run() {
    auto along_edges = edge_path(surface_, ends_.from, ends_.to);
    if (!along_edges) return along_edges.error();
    if (auto tried = shorten_from(*along_edges); !tried) return tried.error();
    auto down = streamline(ends_.to, ends_.from, ends_.from_distances);
    if (!down) return down.error();
    if (auto tried = shorten_from(reversed(*std::move(down))); !tried) return tried.error();
    auto up = streamline(ends_.from, ends_.to, ends_.to_distances);
    if (!up) return up.error();
    if (auto tried = shorten_from(*up); !tried) return tried.error();
    if (auto tried = through_vertices(); !tried) return tried.error();
    if (auto tried = through_edges(); !tried) return tried.error();
    return best_;
  }

 private:
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
    if (!(best_.length > 0)) return {};
    const CrossingGraph graph(surface_, ends_, best_.length);
    std::size_t faces = 0;
    for (const SurfacePath& route : graph.routes(best_.length * (1 + kGraphError), kMaxRoutes)) {
      if (faces > kMaxFaces || route.length > best_.length * (1 + kGraphError)) break;
      faces += route.faces.size();
      if (auto tried = shorten_from(route); !tried) return tried;
    }
    return {};
  }

  const PathSurface& surface_;
  const GeodesicEnds& ends_;
  const Progress& progress_;
  std::vector<char> seen_;
  SurfacePath best_;
};

}  // namespace

Result<SurfacePath> search_geodesic(const PathSurface& surface, const GeodesicEnds& ends,
                                    const Progress& progress) {
  return within_memory("a geodesic", *surface.mesh(), progress, [&](const Progress& watched) {
    return Search(surface, ends, watched).run();
  });
}

}  // namespace geotherm
