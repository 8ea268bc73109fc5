// SPDX-License-Identifier: MIT
#include "solver/distributed/block_waves.h"

#include <cmath>
#include <tuple>

#include "solver/polyhedral/wave_surface.h"

namespace geotherm {
namespace {

/// Two lengths of one edge, as two blocks have them, differ by no more than this share.
constexpr double kSameSeedLength = 1e-6;

/// Marks faces at own vertices, and those beyond where two cut sides have the same ends: they would
/// be taken for one edge.
std::vector<char> faces_of_piece(const IntrinsicMesh& mesh, Index own) {
  std::vector<char> in(mesh.faces.size(), 0);
  for (std::size_t f = 0; f < in.size(); ++f) {
    in[f] = std::ranges::any_of(mesh.faces[f], [own](Index v) { return v < own; });
  }
  struct Cut {
    std::pair<Index, Index> ends;
    Side side;
  };
  for (bool grows = true; grows;) {
    grows = false;
    std::vector<Cut> cuts;
    for (Side side = 0; side < static_cast<Side>(mesh.twin.size()); ++side) {
      const Side twin = mesh.twin[side];
      if (!in[face_of(side)] || (twin != kNoSide && in[face_of(twin)])) continue;
      cuts.push_back({ends_of(mesh, side), side});
    }
    std::ranges::sort(cuts, {}, &Cut::ends);
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      if (cuts[i].ends != cuts[i - 1].ends) continue;
      for (const Side side : {cuts[i - 1].side, cuts[i].side}) {
        if (mesh.twin[side] == kNoSide) continue;
        in[face_of(mesh.twin[side])] = 1;
        grows = true;
      }
    }
  }
  return in;
}

/// The faces at own vertices as a surface of their own, with the block's vertices.
Result<std::shared_ptr<const WaveSurface>> piece_of(const MeshBlock& block) {
  const IntrinsicMesh& whole = block.surface->intrinsic;
  auto piece = std::make_shared<IntrinsicSurface>();
  auto kept = std::make_shared<KeptFaces>();
  kept->on_surface.assign(block.vertex.size(), 0);
  IntrinsicMesh& mesh = piece->intrinsic;
  mesh.unit = whole.unit;
  const std::vector<char> in = faces_of_piece(whole, block.own());
  std::vector<Index> number(in.size(), kNoIndex);
  for (std::size_t f = 0; f < in.size(); ++f) {
    if (!in[f]) continue;
    number[f] = mesh.face_count();
    mesh.faces.push_back(whole.faces[f]);
    mesh.lengths.push_back(whole.lengths[f]);
    for (const Index v : whole.faces[f]) kept->on_surface[v] = 1;
  }
  for (std::size_t f = 0; f < in.size(); ++f) {
    for (std::size_t side = 3 * f; in[f] && side < 3 * f + 3; ++side) {
      const Side twin = whole.twin[side];
      const Index other = twin == kNoSide ? kNoIndex : number[face_of(twin)];
      mesh.twin.push_back(other == kNoIndex ? kNoSide : 3 * other + corner_of(twin));
    }
  }
  piece->mesh = block.surface->mesh;
  piece->kept = std::move(kept);
  return build_wave_surface(std::shared_ptr<const IntrinsicSurface>(std::move(piece)));
}

bool is_same(const EdgeName& a, const EdgeName& b) {
  return a.low == b.low && a.high == b.high &&
         std::abs(a.length - b.length) <= kSameSeedLength * a.length;
}

}  // namespace

Result<std::unique_ptr<BlockWaves>> BlockWaves::build(const MeshPart& part, const MeshBlock& block,
                                                      std::span<const char> is_source) {
  auto surface = piece_of(block);
  if (!surface) return surface.error();
  auto out = std::unique_ptr<BlockWaves>(new BlockWaves(block, **surface));
  if (out->tables_.faces.empty()) return out;
  out->name_edges(part);
  out->leave_others_alone();
  SourceSeeds seeds;
  for (const Index v : out->tables_.vertex_of_rank) {
    if (is_source[static_cast<std::size_t>(block.vertex[v])]) seeds.vertices.push_back({v, 0, 0});
  }
  out->front_.begin(**surface, seeds);
  return out;
}

BlockWaves::BlockWaves(const MeshBlock& block, const WaveSurface& surface)
    : block_(block),
      unit_(surface.base.length_unit()),
      tables_(surface.face_count() > 0 ? build_wave_tables(surface) : WaveTables()),
      front_(tables_, 1) {}

Index BlockWaves::find(const EdgeName& name) const {
  const auto key = std::pair(name.low, name.high);
  const auto ends = [](const NamedEdge& each) { return std::pair(each.name.low, each.name.high); };
  auto at = std::ranges::lower_bound(edges_, key, {}, ends);
  for (; at != edges_.end() && ends(*at) == key; ++at) {
    if (is_same(at->name, name)) return at->edge;
  }
  return kNoIndex;
}

std::vector<double> BlockWaves::distances() const {
  std::vector<double> out(block_.vertex.size(), kUnreached);
  for (std::size_t rank = 0; rank < tables_.vertex_of_rank.size(); ++rank) {
    // Fitted waves may undercut the sources by rounding.
    out[tables_.vertex_of_rank[rank]] = std::max(front_.distances()[rank], 0.0);
  }
  return out;
}

void BlockWaves::note(Item item, double value) {
  if (item >= 0) {
    vertices_.push_back({item, value / unit_});
  } else {
    samples_.push_back({-1 - item, value / unit_});
  }
}

void BlockWaves::hear() {
  if (!vertices_.empty() || !samples_.empty()) front_.hear(vertices_, samples_, is_shared_);
  vertices_.clear();
  samples_.clear();
}

bool BlockWaves::go_on(double from, double until) {
  return tables_.faces.empty() ||
         front_.go_on(from / unit_, until / unit_) == WaveFront::Outcome::kDone;
}

/// A vertex that hands its distance on by itself does so where all its faces are.
void BlockWaves::leave_others_alone() {
  for (WaveFace& face : tables_.faces) {
    for (int k = 0; k < 3; ++k) {
      if (tables_.vertex_of_rank[face.vertex[k]] < block_.own()) continue;
      face.touching = static_cast<std::uint16_t>(face.touching & ~(1U << k));
    }
  }
}

void BlockWaves::name_edges(const MeshPart& part) {
  std::vector<NamedEdge> all;
  for (const WaveFace& face : tables_.faces) {
    const auto vertex = [&](int k) { return tables_.vertex_of_rank[face.vertex[k]]; };
    if (std::max({vertex(0), vertex(1), vertex(2)}) < block_.own()) continue;
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(
          {part.id[block_.vertex[vertex(k)]], part.id[block_.vertex[vertex(next_corner(k))]]});
      all.push_back({{low, high, face.length[k] * unit_}, face.edge[k]});
    }
  }
  std::ranges::sort(all, {}, [](const NamedEdge& each) {
    return std::tuple(each.name.low, each.name.high, each.name.length, each.edge);
  });
  const auto same_edge = [](const NamedEdge& a, const NamedEdge& b) { return a.edge == b.edge; };
  all.erase(std::unique(all.begin(), all.end(), same_edge), all.end());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool before = i > 0 && is_same(all[i - 1].name, all[i].name);
    const bool after = i + 1 < all.size() && is_same(all[i].name, all[i + 1].name);
    if (!before && !after) edges_.push_back(all[i]);
  }
  is_shared_.assign(static_cast<std::size_t>(tables_.edge_count()), 0);
  for (const NamedEdge& each : edges_) is_shared_[each.edge] = 1;
}

}  // namespace geotherm
