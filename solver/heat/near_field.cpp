// SPDX-License-Identifier: MIT
#include "solver/heat/source_anchors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <queue>
#include <span>
#include <utility>

#include "solver/heat/near_march.h"
#include "solver/heat/surface.h"
#include "solver/polyhedral/wave_front.h"
#include "solver/polyhedral/wave_surface.h"

namespace geotherm {
namespace {

/// The radius, in lengths that the triangulation resolves (ComponentSize).
constexpr double kRadius = 8;
/// Faces that a wave walks over for one source of a component: in proportion to the share of its
/// vertices that had to be inserted, up to the most; many sources walk over a tenth of its faces
/// together, or over those at the sources.
constexpr double kFacesOfShare = 5000, kMax = 800, kShareOfMany = 0.1;
/// Fewer faces than lie around a vertex and its neighbours tell nothing.
constexpr double kMin = 24;

std::size_t faces_worth_walking(const ComponentSize& component, std::size_t sources) {
  const double one = std::min(kFacesOfShare * component.inserted, kMax);
  if (one < kMin) return 0;
  const double many = std::min(one * static_cast<double>(sources), kShareOfMany * component.cells);
  return static_cast<std::size_t>(std::max(one, many));
}

constexpr int kSamples = 1;  ///< on each edge

/// Ways along edges whose lengths differ by no more than round-off are equal: what is near a source
/// must not change with the unit of the model.
constexpr double kEqual = 1 + 1e-9;

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

/// The faces around the sources of a component as a surface of their own. Rows and faces have
/// numbers of their own here.
class Surroundings {
 public:
  Surroundings(const Surface& surface, const SourceAnchors& anchors, Index component)
      : surface_(surface),
        mesh_(*surface.operators),
        per_length_(1 / (surface.component_sizes[component].mean_edge *
                         std::sqrt(surface.component_sizes[component].grading))) {
    const auto is_here = [&](Index row) { return mesh_.components.of[row] == component; };
    for (const auto& anchor : anchors.anchors) {
      if (is_here(anchor.row)) anchors_.push_back(anchor);
    }
    for (const auto& piece : anchors.pieces) {
      if (is_here(mesh_.faces[piece.face][0])) pieces_.push_back(piece);
    }
  }

  std::size_t source_count() const { return anchors_.size(); }

  /// Takes in the faces at the sources, then about so many in all by the distance of their vertices
  /// along edges, up to the radius.
  void gather(std::size_t most) {
    for (const auto& anchor : anchors_) reach(anchor.row, anchor.offset);
    for (const auto& piece : pieces_) {
      for (const Index row : mesh_.faces[piece.face]) reach(row, kUnreached);
      add_face(piece.face);
    }
    double last = 0;
    while (!queue_.empty()) {
      const auto [distance, number] = queue_.top();
      if (faces_.keys().size() >= most && distance > kEqual * last) break;  // no order among equals
      last = distance;
      queue_.pop();
      if (vertices_[number].whole) continue;
      vertices_[number].whole = true;
      for (const Side corner : mesh_.corners.at(rows_.keys()[number])) {
        const Index f = face_of(corner);
        const int k = corner_of(corner);
        const auto& l = surface_.intrinsic.lengths[mesh_.intrinsic_face[f]];
        reach(mesh_.faces[f][next_corner(k)], distance + l[k]);
        reach(mesh_.faces[f][previous_corner(k)], distance + l[previous_corner(k)]);
        add_face(f);
      }
    }
    number_by_mesh();
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
    for (const Index row : rows_.keys())
      positions.push_back(surface_.position(surface_.vertex_of_row[row]));
    auto built = TriangleMesh::build(std::move(positions), mesh.faces);
    if (!built) return built.error();
    out->mesh = std::make_shared<const TriangleMesh>(*std::move(built));
    return build_wave_surface(std::shared_ptr<const IntrinsicSurface>(std::move(out)));
  }

  SourceSeeds sources() const {
    SourceSeeds out;
    for (const auto& anchor : anchors_) {
      if (anchor.offset == 0) out.vertices.push_back({rows_.find(anchor.row), 0.0, 0});
    }
    for (const auto& piece : pieces_) {
      const Index face = faces_.find(mesh_.intrinsic_face[piece.face]);
      out.pieces.push_back({face, piece.from, piece.to, 0.0, 0});
    }
    return out;
  }

  /// The sides beyond which there are other faces.
  std::vector<Side> ends() const {
    std::vector<Side> sides;
    for (Side side = 0; side < 3 * static_cast<Side>(operator_face_.size()); ++side) {
      if (is_end(face_of(side), corner_of(side))) sides.push_back(side);
    }
    return sides;
  }

  SourceSeeds seeds_on(std::span<const Side> sides) const {
    SourceSeeds out;
    for (const Side side : sides) {
      const auto at = corners_of(mesh_.layout[operator_face_[face_of(side)]]);
      const int k = corner_of(side);
      out.pieces.push_back({face_of(side), at[k], at[next_corner(k)], 0.0, 0});
    }
    return out;
  }

  /// A way through other faces is at least as long as the shortest way to an end, and from any end
  /// to the vertex: distances up to there are those of the whole surface.
  void add_to(std::vector<NearVertex>& out, const WaveTables& tables, const WaveFront& wave,
              double outward, const WaveFront& inward) const {
    for (std::size_t rank = 0; rank < tables.vertex_of_rank.size(); ++rank) {
      const double distance = std::max(wave.distances()[rank], 0.0);
      const double limit = std::min(kRadius / per_length_, outward + inward.distances()[rank]);
      if (!(distance < limit)) continue;
      out.push_back(
          {rows_.keys()[tables.vertex_of_rank[rank]], distance, share_of_heat(distance, limit)});
    }
  }

 private:
  struct Vertex {
    double along_edges;  ///< from the nearest source
    bool whole = false;  ///< all its faces are here
  };
  using Entry = std::pair<double, Index>;

  /// Numbers vertices and faces in the order of the mesh, so that waves, which meet them in the
  /// order of their numbers where places are equal, do not depend on the elimination order.
  void number_by_mesh() {
    std::vector<std::pair<Index, Index>> order;  // by the mesh, and here
    for (const Index row : rows_.keys()) {
      order.emplace_back(surface_.vertex_of_row[row], static_cast<Index>(order.size()));
    }
    std::ranges::sort(order);
    const Numbering rows = std::exchange(rows_, {}), faces = std::exchange(faces_, {});
    const std::vector<Vertex> vertices = std::exchange(vertices_, {});
    for (const auto& [vertex, here] : order) {
      rows_.add(rows.keys()[here]);
      vertices_.push_back(vertices[here]);
    }
    order.clear();
    for (const Index face : faces.keys()) {
      order.emplace_back(face, static_cast<Index>(order.size()));
    }
    std::ranges::sort(order);
    const std::vector<Index> operator_face = std::exchange(operator_face_, {});
    for (const auto& [face, here] : order) {
      faces_.add(face);
      operator_face_.push_back(operator_face[here]);
    }
  }

  /// Notes a way to a row along edges.
  void reach(Index row, double distance) {
    const auto [number, is_new] = rows_.add(row);
    if (is_new) vertices_.push_back({kUnreached});
    Vertex& vertex = vertices_[number];
    if (!(distance < vertex.along_edges)) return;
    vertex.along_edges = distance;
    if (distance * per_length_ <= kEqual * kRadius) queue_.emplace(distance, number);
  }

  /// A face whose corners have been reached.
  void add_face(Index f) {
    if (faces_.add(mesh_.intrinsic_face[f]).second) operator_face_.push_back(f);
  }

  /// Whether there are faces beyond a side that are not here. Sides without a twin may have some,
  /// but at an end all of whose faces are here.
  bool is_end(Index number, int k) const {
    const Side twin = surface_.intrinsic.twin[3 * faces_.keys()[number] + k];
    if (twin != kNoSide) return faces_.find(face_of(twin)) == kNoIndex;
    const Face& face = mesh_.faces[operator_face_[number]];
    return !vertices_[rows_.find(face[k])].whole &&
           !vertices_[rows_.find(face[next_corner(k)])].whole;
  }

  const Surface& surface_;
  const OperatorMesh& mesh_;
  const double per_length_;  ///< 1 over the length that the component resolves
  std::vector<SourceAnchors::Anchor> anchors_;
  std::vector<SourceAnchors::Piece> pieces_;
  Numbering rows_;
  Numbering faces_;                   ///< of the intrinsic mesh
  std::vector<Index> operator_face_;  ///< of each
  std::vector<Vertex> vertices_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

/// The least distance from a source to one of these sides, or below it.
double least_distance(const WaveFront& wave, const WaveTables& tables,
                      std::span<const Side> sides) {
  double least = kUnreached;
  for (const Side side : sides) {
    const WaveFace& face = tables.faces[tables.rank_of_face[face_of(side)]];
    const int k = corner_of(side);
    // No point of a side is farther than this from an end of it or a sample.
    const double between = face.length[k] / (2 * (kSamples + 1));
    least = std::min(least, wave.least_on(face.edge[k]) - between);
  }
  return std::max(least, 0.0);
}

/// By a march over the triangulation, where no vertices were inserted; nothing around curves, whose
/// fronts are no circles, nor over faces that are not Delaunay.
void march_in_component(const Surface& surface, const SourceAnchors& anchors, Index component,
                        std::vector<NearVertex>& out) {
  if (!surface.is_delaunay) return;
  const OperatorMesh& mesh = *surface.operators;
  for (const auto& piece : anchors.pieces) {
    if (piece.from != piece.to && mesh.components.of[mesh.faces[piece.face][0]] == component)
      return;
  }
  std::vector<NearDistance> seeds;
  for (const auto& anchor : anchors.anchors) {
    if (mesh.components.of[anchor.row] == component) seeds.push_back({anchor.row, anchor.offset});
  }
  const auto found = march_nearest(mesh.corners, mesh.faces, mesh.layout, seeds,
                                   near_count(anchors.source_count(mesh.components, component),
                                              surface.component_sizes[component].cells));
  for (const NearDistance& near : found) {
    const double share = share_of_heat(near.distance, found.back().distance);
    if (share < 1) out.push_back({static_cast<Index>(near.vertex), near.distance, share});
  }
}

/// Errors: kOutOfMemory.
Result<void> add_component(const Surface& surface, const SourceAnchors& anchors, Index component,
                           std::vector<NearVertex>& out) {
  const ComponentSize& size = surface.component_sizes[component];
  if (faces_worth_walking(size, 1) == 0) {
    march_in_component(surface, anchors, component, out);
    return {};
  }
  Surroundings near(surface, anchors, component);
  const std::size_t faces = faces_worth_walking(size, near.source_count());
  near.gather(faces);
  const auto local = near.surface();
  if (!local) return local.error();
  const WaveTables tables = build_wave_tables(**local);
  WaveFront wave(tables, kSamples), inward(tables, kSamples);
  using Outcome = WaveFront::Outcome;
  if (wave.run(**local, near.sources(), false, {}) != Outcome::kDone) return {};
  const std::vector<Side> ends = near.ends();
  if (inward.run(**local, near.seeds_on(ends), false, {}) != Outcome::kDone) return {};
  near.add_to(out, tables, wave, least_distance(wave, tables, ends), inward);
  return {};
}

}  // namespace

Result<std::vector<NearVertex>> find_near_field(const Surface& surface,
                                                const SourceAnchors& anchors) {
  std::vector<NearVertex> out;
  for (const Index component : anchors.components) {
    if (auto added = add_component(surface, anchors, component, out); !added) return added.error();
  }
  return out;
}

}  // namespace geotherm
