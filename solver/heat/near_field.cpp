// SPDX-License-Identifier: MIT
#include "solver/heat/near_field.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>

#include "solver/wave/wave_front.h"

namespace geotherm {
namespace {

/// The radius, in lengths that the triangulation resolves (ComponentSize).
constexpr double kRadius = 8;
/// Up to this share of the radius the near-exact distances count alone.
constexpr double kInner = 0.5;
/// Faces that a wave walks over for one source: in proportion to the share of vertices that had to
/// be inserted, up to the most; many sources walk over a tenth of all faces together.
constexpr double kFacesOfShare = 5000, kMost = 800, kShareOfMany = 0.1;
/// Fewer faces than lie around a vertex and its neighbours tell nothing.
constexpr double kFewest = 24;

std::size_t faces_worth_walking(const Surface& surface, std::size_t sources) {
  const double inserted = static_cast<double>(surface.refinement.points) / surface.vertex_count();
  const double one = std::min(kFacesOfShare * inserted, kMost);
  if (one < kFewest) return 0;
  const double many = kShareOfMany * surface.intrinsic.face_count();
  return static_cast<std::size_t>(
      std::max(one, std::min(one * static_cast<double>(sources), many)));
}

constexpr int kSamples = 1;  ///< on each edge

/// Gives keys the numbers 0, 1, ... as they come: a hash table with open addressing, which hundreds
/// of keys pass a few times each.
class Numbering {
 public:
  /// The number of a key, and whether it is new.
  std::pair<Index, bool> add(Index key) {
    if (2 * keys_.size() >= slots_.size()) grow();
    Index& slot = slots_[find_slot(key)];
    if (slot != kNoIndex) return {slot, false};
    slot = static_cast<Index>(keys_.size());
    keys_.push_back(key);
    return {slot, true};
  }
  Index find(Index key) const { return slots_[find_slot(key)]; }
  const std::vector<Index>& keys() const { return keys_; }

 private:
  static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;  ///< 2^64 over the golden ratio

  std::size_t find_slot(Index key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = (static_cast<std::uint64_t>(key) * kGolden >> 32) & mask;
    while (slots_[at] != kNoIndex && keys_[slots_[at]] != key) at = (at + 1) & mask;
    return at;
  }
  void grow() {
    slots_.assign(2 * slots_.size(), kNoIndex);
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      slots_[find_slot(keys_[i])] = static_cast<Index>(i);
    }
  }

  std::vector<Index> keys_;
  std::vector<Index> slots_ = std::vector<Index>(1024, kNoIndex);  ///< a power of two
};

/// The faces around the sources as a surface of their own. Rows and faces have numbers of their own
/// here.
class Neighbourhood {
 public:
  Neighbourhood(const Surface& surface, const SourceAnchors& anchors)
      : surface_(surface), mesh_(*surface.operators), anchors_(anchors) {}

  /// Takes in about so many faces by the distance of their vertices along edges, up to the radius.
  void gather(std::size_t most) {
    for (const auto& anchor : anchors_.anchors) reach(anchor.row, anchor.offset);
    double last = 0;
    while (!queue_.empty()) {
      const auto [key, number] = queue_.top();
      if (faces_.keys().size() >= most && key > last) return;  // no order among equals
      last = key;
      queue_.pop();
      if (vertices_[number].whole) continue;
      vertices_[number].whole = true;
      const double from = vertices_[number].along_edges;
      for (const Side corner : mesh_.corners.at(rows_.keys()[number])) {
        const Index f = face_of(corner), face = mesh_.intrinsic_face[f];
        const int k = corner_of(corner);
        const auto& l = surface_.intrinsic.lengths[face];
        reach(mesh_.faces[f][next_corner(k)], from + l[k]);
        reach(mesh_.faces[f][previous_corner(k)], from + l[previous_corner(k)]);
        if (faces_.add(face).second) operator_face_.push_back(f);
      }
    }
  }

  Result<std::shared_ptr<const WaveSurface>> surface() const {
    auto out = std::make_shared<IntrinsicSurface>();
    IntrinsicMesh& mesh = out->intrinsic;
    for (std::size_t i = 0; i < operator_face_.size(); ++i) {
      const Index face = faces_.keys()[i];
      mesh.lengths.push_back(surface_.intrinsic.lengths[face]);
      Face& corners = mesh.faces.emplace_back();
      for (int k = 0; k < 3; ++k) {
        corners[k] = rows_.find(mesh_.faces[operator_face_[i]][k]);
        const Side twin = surface_.intrinsic.twin[3 * face + k];
        const Index beyond = twin == kNoSide ? kNoIndex : faces_.find(face_of(twin));
        mesh.twin.push_back(beyond == kNoIndex ? kNoSide : 3 * beyond + corner_of(twin));
      }
    }
    std::vector<Vec3> positions;
    for (const Index row : rows_.keys()) positions.push_back(position(surface_.vertex_of_row[row]));
    auto built = TriangleMesh::build(std::move(positions), mesh.faces);
    if (!built) return built.error();
    out->mesh = std::make_shared<const TriangleMesh>(*std::move(built));
    return build_wave_surface(std::shared_ptr<const IntrinsicSurface>(std::move(out)));
  }

  /// Whether every source is on these faces.
  bool holds_sources() const {
    const auto is_here = [this](const SourceAnchors::Piece& piece) {
      return faces_.find(mesh_.intrinsic_face[piece.face]) != kNoIndex;
    };
    return std::ranges::all_of(anchors_.pieces, is_here);  // vertices are the first to be reached
  }

  SourceSeeds seeds() const {
    SourceSeeds out;
    for (const auto& anchor : anchors_.anchors) {
      if (anchor.offset == 0) out.vertices.push_back({rows_.find(anchor.row), 0.0, 0});
    }
    for (const auto& piece : anchors_.pieces) {
      const Index face = faces_.find(mesh_.intrinsic_face[piece.face]);
      out.pieces.push_back({face, piece.from, piece.to, 0.0, 0});
    }
    return out;
  }

  /// Shortest ways that leave these faces cross a side where they end: up to the least distance
  /// there, all distances are those of the whole surface.
  std::vector<NearVertex> answer(const WaveFront& front, const WaveTables& tables) const {
    double radius = kRadius;
    for (std::size_t rank = 0; rank < tables.faces.size(); ++rank) {
      const WaveFace& face = tables.faces[rank];
      for (int k = 0; k < 3; ++k) {
        if (!ends_at(tables.intrinsic_face[rank], k)) continue;
        // No point of a side is farther than this from an end or a sample.
        const double between = face.length[k] / (2 * (kSamples + 1));
        const double least = front.least_on(face.edge[k]) - between;
        const Index vertex = tables.vertex_of_rank[face.vertex[k]];
        radius = std::min(radius, least * vertices_[vertex].per_length);
      }
    }
    std::vector<NearVertex> out;
    for (std::size_t rank = 0; rank < front.distances().size() && radius > 0; ++rank) {
      const Index vertex = tables.vertex_of_rank[rank];
      const double distance = std::max(front.distances()[rank], 0.0);
      const double part = distance * vertices_[vertex].per_length / radius;
      if (!(part < 1)) continue;
      const double share = std::max(0.0, (part - kInner) / (1 - kInner));
      out.push_back({rows_.keys()[vertex], distance, share});
    }
    return out;
  }

 private:
  struct Vertex {
    double along_edges;  ///< from the nearest source
    double per_length;   ///< 1 over the length that its component resolves
    bool whole = false;  ///< all its faces are here
  };
  using Entry = std::pair<double, Index>;

  /// Notes a way to a row along edges.
  void reach(Index row, double distance) {
    const auto [number, is_new] = rows_.add(row);
    if (is_new) {
      const ComponentSize& size = surface_.components[mesh_.components.of[row]];
      vertices_.push_back({kUnreached, 1 / (size.mean_edge * std::sqrt(size.grading))});
    }
    Vertex& vertex = vertices_[number];
    if (!(distance < vertex.along_edges)) return;
    vertex.along_edges = distance;
    const double key = distance * vertex.per_length;
    if (key <= kRadius) queue_.emplace(key, number);
  }

  const Vec3& position(Index vertex) const {
    const Index own = surface_.mesh->vertex_count();
    return vertex < own ? surface_.mesh->positions()[vertex]
                        : surface_.refinement.positions[vertex - own];
  }

  /// Whether there are faces beyond a side that are not here. Sides without a twin may have some,
  /// but at an end all of whose faces are here.
  bool ends_at(Index number, int k) const {
    const Side twin = surface_.intrinsic.twin[3 * faces_.keys()[number] + k];
    if (twin != kNoSide) return faces_.find(face_of(twin)) == kNoIndex;
    const Face& face = mesh_.faces[operator_face_[number]];
    return !vertices_[rows_.find(face[k])].whole &&
           !vertices_[rows_.find(face[next_corner(k)])].whole;
  }

  const Surface& surface_;
  const OperatorMesh& mesh_;
  const SourceAnchors& anchors_;
  Numbering rows_;
  Numbering faces_;                   ///< of the intrinsic mesh
  std::vector<Index> operator_face_;  ///< of each
  std::vector<Vertex> vertices_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

std::vector<NearVertex> find_near_field(const Surface& surface, const SourceAnchors& anchors) {
  const std::size_t faces = faces_worth_walking(surface, anchors.anchors.size());
  if (faces == 0) return {};
  Neighbourhood near(surface, anchors);
  near.gather(faces);
  if (!near.holds_sources()) return {};
  const auto local = near.surface();
  if (!local) return {};
  const WaveTables tables = build_wave_tables(**local);
  WaveFront front(tables, kSamples);
  if (front.run(**local, near.seeds(), false, {}) != WaveFront::Outcome::kDone) return {};
  return near.answer(front, tables);
}

}  // namespace geotherm
