// SPDX-License-Identifier: MIT
#include "solver/polyhedral/wave_surface.h"

#include <algorithm>
#include <array>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"
#include "solver/geometry/edit.h"

namespace geotherm {
namespace {

/// What the set-up takes at least for each face.
constexpr double kSurfaceNanosecondsPerFace = 400;

/// Numbers the edges, which of_side names by their first sides, from 0 in the order of these, and
/// lists their sides.
void list_sides(WaveEdges& edges) {
  auto& edge = edges.of_side;
  Index count = 0;
  for (Side side = 0; side < static_cast<Side>(edge.size()); ++side) {
    // The edge of a lower side is numbered already.
    edge[side] = edge[side] == side ? count++ : edge[edge[side]];
  }
  const auto emit = [&edge](std::size_t side, const auto& put) {
    put(edge[side], static_cast<Side>(side));
  };
  edges.sides =
      counting_sort<Side>(edge.size(), static_cast<std::size_t>(count), 1, emit, edges.side_start);
}

using Weights = std::array<double, 3>;

/// Offset and group of what a piece came from.
struct Origin {
  double offset;
  Index group;
};

/// The corner that a point is, if it is one.
std::optional<int> corner_at(const Weights& w) {
  for (int k = 0; k < 3; ++k) {
    if (w[k] == 1) return k;
  }
  return std::nullopt;
}

class Seeder {
 public:
  Seeder(const WaveSurface& surface, const SourceSet& sources)
      : surface_(surface), sources_(sources), groups_(source_groups(sources)) {}

  SourceSeeds run() {
    for (std::size_t i = 0; i < sources_.points.size(); ++i) add_point(i);
    for (std::size_t i = 0; i < sources_.edges.size(); ++i) add_edge(i);
    for (std::size_t i = 0; i < sources_.segments.size(); ++i) add_segment(i);
    const auto carried =
        carry_pieces(surface_.base.edits, surface_.face_count(), std::move(pieces_));
    for (const FacePiece& piece : carried) add_carried(piece);
    return std::move(seeds_);
  }

 private:
  void add_point(std::size_t i) {
    const double offset =
        sources_.offsets.empty() ? 0.0 : sources_.offsets[i] / surface_.base.length_unit();
    const Origin origin{offset, groups_.of_point[i]};
    const SurfacePoint point = clean_point(surface_.base, sources_.points[i]);
    if (point.is_vertex()) {
      add_vertex(point.vertex, origin);
    } else {
      add_piece({point.face, point.weights, point.weights}, origin);
    }
  }

  void add_edge(std::size_t i) {
    const auto [a, b] = sources_.edges[i];
    const Origin origin{0.0, groups_.of_edge[i]};
    add_vertex(a, origin);
    add_vertex(b, origin);
    if (a == b) return;
    const Index edge = find_clean_edge(surface_.base, a, b);
    const Side side = surface_.base.kept->edges.sides(edge).front();
    FacePiece piece{face_of(side), {}, {}};
    piece.from[corner_of(side)] = piece.to[next_corner(corner_of(side))] = 1;
    add_piece(piece, origin);
  }

  void add_segment(std::size_t i) {
    const FaceSegment segment = clean_segment(surface_.base, sources_.segments[i]);
    const Origin origin{0.0, groups_.of_segment[i]};
    // A plane wave leaves a segment to its sides alone.
    for (const Weights& end : {segment.from, segment.to}) {
      add_piece({segment.face, end, end}, origin);
    }
    if (segment.from != segment.to) add_piece({segment.face, segment.from, segment.to}, origin);
  }

  void add_vertex(Index v, const Origin& origin) {
    const auto [at, fresh] = seed_of_.try_emplace(v, seeds_.vertices.size());
    if (fresh) {
      seeds_.vertices.push_back({v, origin.offset, origin.group});
    } else if (auto& seed = seeds_.vertices[at->second]; origin.offset < seed.offset) {
      seed = {v, origin.offset, origin.group};
    }
  }

  void add_piece(FacePiece piece, const Origin& origin) {
    piece.source = origins_.size();
    origins_.push_back(origin);
    pieces_.push_back(piece);
  }

  /// A piece in the triangulation: once in its face or, on a side, in every face at that edge.
  void add_carried(const FacePiece& piece) {
    if (piece.from == piece.to) {
      if (const auto corner = corner_at(piece.from)) {
        // A piece of length 0 at the end of a curve's edge is that end, which is there already.
        add_vertex(surface_.base.intrinsic.faces[piece.face][*corner], origins_[piece.source]);
        return;
      }
    }
    for (int k = 0; k < 3; ++k) {
      if (piece.from[k] != 0 || piece.to[k] != 0) continue;
      add_on_side(piece, 3 * piece.face + next_corner(k));
      return;
    }
    add_in_face(piece.face, piece.from, piece.to, origins_[piece.source]);
  }

  void add_on_side(const FacePiece& piece, Side side) {
    const int k = corner_of(side);
    const Side twin = surface_.base.intrinsic.twin[side];
    const std::array both = {std::min(side, twin), std::max(side, twin)};
    // Edges are listed when they are first asked for, on a surface that has moved by a query.
    for (const Side other : twin != kNoSide ? std::span<const Side>(both)
                                            : surface_.sides_of(surface_.edge_of_side(side))) {
      const bool same_way = other == side || runs_as(side, other);
      const int first = same_way ? corner_of(other) : next_corner(corner_of(other));
      const int second = same_way ? next_corner(corner_of(other)) : corner_of(other);
      Weights from{}, to{};
      from[first] = piece.from[k];
      from[second] = piece.from[next_corner(k)];
      to[first] = piece.to[k];
      to[second] = piece.to[next_corner(k)];
      add_in_face(face_of(other), from, to, origins_[piece.source]);
    }
  }

  /// Whether two sides of an edge run the same way. Twins never do, whatever their vertices.
  bool runs_as(Side side, Side other) const {
    const IntrinsicMesh& mesh = surface_.base.intrinsic;
    if (mesh.twin[side] == other) return false;
    return mesh.faces[face_of(side)][corner_of(side)] ==
           mesh.faces[face_of(other)][corner_of(other)];
  }

  void add_in_face(Index face, const Weights& from, const Weights& to, const Origin& origin) {
    const FaceLayout p = lay_out(surface_.base.intrinsic.lengths[face]);
    const auto place = [&p](const Weights& w) {
      return Eigen::Vector2d(w[1] * p.base + w[2] * p.x, w[2] * p.height);
    };
    seeds_.pieces.push_back({face, place(from), place(to), origin.offset, origin.group});
  }

  const WaveSurface& surface_;
  const SourceSet& sources_;
  SourceGroups groups_;
  SourceSeeds seeds_;
  std::unordered_map<Index, std::size_t> seed_of_;
  std::vector<FacePiece> pieces_;
  std::vector<Origin> origins_;
};

}  // namespace

const WaveEdges& WaveSurface::edges() const {
  std::call_once(listed_, [this] {
    edges_.of_side = first_sides(base.intrinsic);
    list_sides(edges_);
  });
  return edges_;
}

Error wave_out_of_memory(const char* stage, Index faces) {
  return {
      ErrorCode::kOutOfMemory,
      "the memory ended in the " + std::string(stage) + " of " + std::to_string(faces) + " faces",
      {"take a mesh with fewer faces"}};
}

Result<std::shared_ptr<const WaveSurface>> build_wave_surface(
    std::shared_ptr<const TriangleMesh> mesh, RefineRule refine, const Progress& progress,
    int threads, const WaveSurface* earlier) {
  const Index faces = mesh->face_count();
  threads = threads_worth_starting(threads, kSurfaceNanosecondsPerFace * faces);
  try {
    const ThreadCrew crew(threads);
    auto base = build_intrinsic_surface(
        std::move(mesh),
        {.flip = FlipRule::kAlways, .refine = refine, .strictness = Strictness::kHeights},
        part_of(progress, 0.0, 0.9), threads, earlier != nullptr ? &earlier->base : nullptr);
    if (!base) return base.error();
    auto triangulation = std::make_shared<IntrinsicSurface>(*std::move(base));
    triangulation->corners = {};
    if (earlier != nullptr) {
      return std::shared_ptr<const WaveSurface>(
          std::make_shared<WaveSurface>(std::move(triangulation)));
    }
    return build_wave_surface(std::shared_ptr<const IntrinsicSurface>(std::move(triangulation)),
                              part_of(progress, 0.9, 1.0));
  } catch (const std::bad_alloc&) {
    return wave_out_of_memory("triangulation", faces);
  }
}

Result<std::shared_ptr<const WaveSurface>> build_wave_surface(
    std::shared_ptr<const TriangleMesh> mesh, const Progress& progress, int threads,
    const WaveSurface* earlier) {
  return build_wave_surface(std::move(mesh), RefineRule::kWhereNeeded, progress, threads, earlier);
}

Result<std::shared_ptr<const WaveSurface>> build_wave_surface(
    std::shared_ptr<const IntrinsicSurface> triangulation, const Progress& progress) {
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  const Index faces = triangulation->mesh->face_count();
  try {
    auto surface = std::make_shared<WaveSurface>(std::move(triangulation));
    surface->edges();
    return std::shared_ptr<const WaveSurface>(std::move(surface));
  } catch (const std::bad_alloc&) {
    return wave_out_of_memory("triangulation", faces);
  }
}

Result<std::shared_ptr<const WaveSurface>> without_inserted(
    std::shared_ptr<const WaveSurface> surface, int threads, const Progress& progress) {
  if (surface->base.refinement.points == 0) return surface;
  return build_wave_surface(surface->base.mesh, RefineRule::kNever, progress,
                            thread_count(threads));
}

Result<SourceSeeds> seed_sources(const WaveSurface& surface, const SourceSet& sources) {
  if (const auto valid = check_sources(surface.base, sources); !valid) return valid.error();
  return Seeder(surface, sources).run();
}

}  // namespace geotherm
