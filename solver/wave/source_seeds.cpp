// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>
#include <unordered_map>

#include "solver/geometry/edit.h"
#include "solver/wave/wave_surface.h"

namespace geotherm {
namespace {

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
    const auto carried =
        carry_pieces(surface_.base.edits, surface_.face_count(), std::move(pieces_));
    for (const FacePiece& piece : carried) add_carried(piece);
    return std::move(seeds_);
  }

 private:
  void add_point(std::size_t i) {
    const double offset =
        sources_.offsets.empty() ? 0.0 : sources_.offsets[i] / surface_.base.mean_edge;
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
    const Side side = surface_.base.clean_edges.sides(edge).front();
    FacePiece piece{face_of(side), {}, {}};
    piece.from[corner_of(side)] = piece.to[next_corner(corner_of(side))] = 1;
    add_piece(piece, origin);
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
    for (const Side other : surface_.sides_of(surface_.edge_of_side[side])) {
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

Result<SourceSeeds> seed_sources(const WaveSurface& surface, const SourceSet& sources) {
  if (const auto valid = check_sources(surface.base, sources); !valid) return valid.error();
  return Seeder(surface, sources).run();
}

}  // namespace geotherm
