// SPDX-License-Identifier: MIT
#include "solver/distributed/mesh_block.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/core/sorting.h"
#include "solver/core/text.h"
#include "solver/linear/backend_registry.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {
namespace {

/// Rings beyond those that are solved for, in turn, in which triangulations may differ.
constexpr int kMargins[] = {4, 12, 36};
/// Heat falls by e over a ring or less; fewer than this would take many rounds.
constexpr int kMinRings = 6;

/// What a block says of the triangles at a vertex, in MeshPart::unit: others must say the same.
struct BlockStar {
  double stiffness = 0, mass = 0, corners = 0;

  bool agrees(const BlockStar& other) const {
    constexpr double kRoundOff = 1e-6;
    return std::abs(mass - other.mass) <= kRoundOff * mass &&
           std::abs(corners - other.corners) <= kRoundOff * corners &&
           std::abs(stiffness - other.stiffness) <= kRoundOff * std::abs(stiffness);
  }
};

/// A number between 1 and 2 that hardly any other vertex has.
double mark_of(GlobalIndex id) {
  auto x = static_cast<std::uint64_t>(id) * 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 31)) * 0xbf58476d1ce4e5b9U;
  return 1 + static_cast<double>(x >> 11) * 0x1p-53;
}

/// The star of each row.
std::vector<BlockStar> stars_of(const MeshPart& part, const MeshBlock& block) {
  const OperatorMesh& mesh = *block.surface->operators;
  const double square = block.surface->unit * block.surface->unit;
  std::vector<BlockStar> stars(static_cast<std::size_t>(mesh.size()));
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Face& face = mesh.faces[f];
    const double area = mesh.layout[f].base * mesh.layout[f].height * square / 2;
    double marks = 0;
    for (const Index row : face) marks += mark_of(part.id[block.part_vertex(row)]);
    for (const Index row : face) stars[row].corners += area * marks;
  }
  for (Index row = 0; row < mesh.size(); ++row) {
    stars[row].stiffness = mesh.stiffness_diagonal[row];
    stars[row].mass = mesh.mass[row] * square;
  }
  return stars;
}

class BlockBuilder {
 public:
  BlockBuilder(const MeshPart& part, const BlockRules& rules)
      : part_(part),
        rules_(rules),
        at_(part.size(), part.corners),
        here_(static_cast<std::size_t>(part.size()), kNoIndex) {}

  Result<MeshBlock> build(Index first, Index end, int rings) {
    MeshBlock block;
    block.first = first;
    block.end = end;
    for (Index v = first; v < end; ++v) take(v, block);
    for (Index begin = 0; std::ssize(block.ring_begin) <= rings;) {
      const auto last = static_cast<Index>(block.vertex.size());
      block.ring_begin.push_back(last);
      for (; begin < last; ++begin) {
        for (const Side side : at_.at(block.vertex[begin])) {
          for (const Index v : part_.corners[face_of(side)]) take(v, block);
        }
      }
    }
    std::vector<Face> faces;
    std::vector<Vec3> positions;
    for (const Index v : block.vertex) {
      positions.push_back(part_.positions[v]);
      for (const Side side : at_.at(v)) {
        const Face& face = part_.corners[face_of(side)];
        const Face local = {here_[face[0]], here_[face[1]], here_[face[2]]};
        const bool inside = std::ranges::none_of(local, [](Index i) { return i == kNoIndex; });
        if (inside && !repeats_corner(local) && std::ranges::min(local) == here_[v]) {
          faces.push_back(local);
        }
      }
    }
    for (const Index v : block.vertex) here_[v] = kNoIndex;
    if (faces.empty()) return block;
    auto mesh = TriangleMesh::build(std::move(positions), std::move(faces));
    if (!mesh) return mesh.error();
    auto surface = build_surface(
        std::make_shared<const TriangleMesh>(*std::move(mesh)), *native_backend(),
        rules_.flip ? LaplacianKind::kIntrinsicDelaunay : LaplacianKind::kCotan, rules_.threads);
    if (!surface) return surface.error();
    block.surface = *std::move(surface);
    return block;
  }

 private:
  void take(Index v, MeshBlock& block) {
    if (here_[v] != kNoIndex) return;
    here_[v] = static_cast<Index>(block.vertex.size());
    block.vertex.push_back(v);
  }

  const MeshPart& part_;
  const BlockRules& rules_;
  CornerTable at_;
  std::vector<Index> here_;  ///< of each vertex of the part: its number in the block
};

/// Finds how far a block's triangles are those of the owners, and holds what lies beyond. False
/// where that is not far enough.
bool hold_beyond(const MeshPart& part, const std::vector<BlockStar>& owners, int rings,
                 MeshBlock& block) {
  const Surface& surface = *block.surface;
  const OperatorMesh& mesh = *surface.operators;
  const std::vector<BlockStar> stars = stars_of(part, block);
  const auto ring_of = [&](Index here) {
    return static_cast<int>(std::ranges::upper_bound(block.ring_begin, here) -
                            block.ring_begin.begin());
  };
  block.free_rings = rings;
  for (Index row = 0; row < mesh.size(); ++row) {
    const int ring = ring_of(surface.vertex_of_row[row]);
    if (ring == 0 || ring > block.free_rings) continue;
    if (!stars[row].agrees(owners[block.part_vertex(row)])) block.free_rings = ring - 1;
  }
  std::vector<char> is_free(static_cast<std::size_t>(mesh.size()), 0), is_edge = is_free;
  for (Index row = 0; row < mesh.size(); ++row) {
    is_free[row] = ring_of(surface.vertex_of_row[row]) <= block.free_rings;
    if (!is_free[row]) block.held.push_back(row);
  }
  bool covers_own = true;
  for (const Face& face : mesh.faces) {
    const bool touches = std::ranges::any_of(face, [&](Index row) { return is_free[row] != 0; });
    const bool own = std::ranges::any_of(
        face, [&](Index row) { return surface.vertex_of_row[row] < block.own(); });
    for (const Index row : face) {
      if (is_free[row]) continue;
      is_edge[row] = is_edge[row] || touches;
      covers_own = covers_own && !own;
    }
  }
  for (const Index row : block.held) {
    if (is_edge[row]) block.edge.push_back(row);
  }
  return covers_own && block.free_rings >= std::min(rings, kMinRings);
}

}  // namespace

Result<std::vector<MeshBlock>> build_blocks(const RankGroup& ranks, const BlockRules& rules,
                                            MeshPart& part) {
  const int count = static_cast<int>((part.own + rules.most - 1) / rules.most);
  for (const int margin : kMargins) {
    // Without flips all triangles at a vertex are there when the ring behind it is.
    const int rings = rules.rings + 1 + (rules.flip || margin != kMargins[0] ? margin : 0);
    grow_halo(ranks, rings, part);
    BlockBuilder builder(part, rules);
    std::vector<MeshBlock> blocks;
    const auto build_all = [&]() -> Result<void> {
      for (int b = 0; b < count; ++b) {
        auto block = builder.build(static_cast<Index>(share_begin(part.own, b, count)),
                                   static_cast<Index>(share_begin(part.own, b + 1, count)), rings);
        if (!block) return block.error();
        blocks.push_back(*std::move(block));
      }
      return {};
    };
    if (auto built = ranks.agree(build_all()); !built) return built.error();
    std::vector<BlockStar> owners(static_cast<std::size_t>(part.size()));
    for (const MeshBlock& block : blocks) {
      if (!block.surface) continue;
      const std::vector<BlockStar> stars = stars_of(part, block);
      for (Index here = 0; here < block.own(); ++here) {
        if (block.row(here) != kNoIndex) owners[block.vertex[here]] = stars[block.row(here)];
      }
    }
    std::vector<Index> others;
    for (Index v = part.own; v < part.size(); ++v) others.push_back(v);
    Halo(ranks, part, others).fetch(ranks, owners);
    bool agrees = true;
    for (MeshBlock& block : blocks) {
      if (block.surface) agrees = hold_beyond(part, owners, rules.rings, block) && agrees;
    }
    if (ranks.max(agrees ? 0 : 1) == 0) return blocks;
  }
  return Error{ErrorCode::kNumericalFailure,
               "ranks do not come to one triangulation where their shares meet",
               {"use ", SettingHint{"laplacian", {"cotan"}}, ", or one process"}};
}

std::vector<char> own_faces(const MeshPart& part, const MeshBlock& block) {
  const OperatorMesh& mesh = *block.surface->operators;
  std::vector<char> own(static_cast<std::size_t>(mesh.face_count()));
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto first = std::ranges::min(mesh.faces[f], {},
                                        [&](Index row) { return part.id[block.part_vertex(row)]; });
    own[f] = block.surface->vertex_of_row[first] < block.own();
  }
  return own;
}

namespace {

/// The lengths of the edges that this rank counts, and how many, by components.
void add_edges(const MeshPart& part, SharedComponents& out) {
  std::vector<std::pair<Index, Index>> edges;
  for (const Face& face : std::span(part.corners).first(static_cast<std::size_t>(part.own_faces))) {
    if (repeats_corner(face)) continue;
    for (int k = 0; k < 3; ++k) {
      std::pair<Index, Index> edge{face[k], face[next_corner(k)]};
      if (part.id[edge.first] > part.id[edge.second]) std::swap(edge.first, edge.second);
      if (edge.first < part.own) edges.push_back(edge);
    }
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& [a, b] : edges) {
    ComponentSize& size = out.sizes[out.of[a]];
    size.mean_edge += safe_norm(part.positions[a] - part.positions[b]);
    ++size.cells;  // edges, for now
  }
}

}  // namespace

Result<SharedComponents> name_components(const RankGroup& ranks, const MeshPart& part) {
  DisjointSets names(static_cast<std::size_t>(part.size()));
  std::vector<char> used(static_cast<std::size_t>(part.size()), 0);
  for (const Face& face : part.corners) {
    if (repeats_corner(face)) continue;
    for (const Index v : face) used[v] = 1;
    names.join(face[0], face[1]);
    names.join(face[0], face[2]);
  }
  std::vector<Index> others;
  for (Index v = part.own; v < part.size(); ++v) others.push_back(v);
  const Halo halo(ranks, part, others);
  std::vector<GlobalIndex> name(part.id), of_all(part.id.size());
  for (Index v = 0; v < part.size(); ++v) {
    name[names.root(v)] = std::min(name[names.root(v)], part.id[v]);
  }
  for (bool changed = true; changed;) {
    for (Index v = 0; v < part.own; ++v) of_all[v] = name[names.root(v)];
    halo.fetch(ranks, of_all);
    changed = false;
    for (const Index v : others) {
      GlobalIndex& mine = name[names.root(v)];
      changed = changed || of_all[v] < mine;
      mine = std::min(mine, of_all[v]);
    }
    changed = ranks.max(changed ? 1 : 0) > 0;
  }
  std::vector<GlobalIndex> roots;
  for (Index v = 0; v < part.own; ++v) {
    if (used[v] && name[names.root(v)] == part.id[v]) roots.push_back(part.id[v]);
  }
  roots = ranks.all_gather(roots);  // ascending, as the ranks' vertices are
  SharedComponents out;
  out.of.assign(name.size(), kNoIndex);
  for (Index v = 0; v < part.size(); ++v) {
    if (!used[v]) continue;
    out.of[v] =
        static_cast<Index>(std::ranges::lower_bound(roots, name[names.root(v)]) - roots.begin());
  }
  out.sizes.resize(roots.size());
  for (ComponentSize& size : out.sizes) size.mean_edge = 0;
  add_edges(part, out);
  std::vector<double> sums;
  for (const ComponentSize& size : out.sizes) {
    sums.push_back(size.mean_edge);
    sums.push_back(size.cells);
  }
  ranks.all_reduce(sums, RankGroup::Reduction::kSum);
  double length = 0, edges = 0;
  for (std::size_t c = 0; c < roots.size(); ++c) {
    out.sizes[c] = {.mean_edge = sums[2 * c] / sums[2 * c + 1],
                    .area = 0,
                    .cells = 0,
                    .inserted = 0,
                    .grading = 1};
    length += sums[2 * c];
    edges += sums[2 * c + 1];
  }
  out.mean_edge = length / edges;
  for (ComponentSize& size : out.sizes) {
    if (!(size.mean_edge > 0)) size.mean_edge = out.mean_edge;  // a part that is a point
  }
  if (out.mean_edge > 0 && std::isfinite(out.mean_edge)) return out;
  return Error{
      ErrorCode::kBadInput,
      "the mesh has no face with area (mean edge length " + rounded_text(out.mean_edge) + ")",
      {"check how it was exported"}};
}

void measure_components(const RankGroup& ranks, const MeshPart& part,
                        std::span<const MeshBlock> blocks, SharedComponents& components) {
  std::vector<double> sums(2 * components.sizes.size(), 0.0);
  for (const MeshBlock& block : blocks) {
    if (!block.surface) continue;
    const OperatorMesh& mesh = *block.surface->operators;
    const double square = block.surface->unit * block.surface->unit;
    const std::vector<char> own = own_faces(part, block);
    for (Index f = 0; f < mesh.face_count(); ++f) {
      if (!own[f]) continue;
      const auto c = static_cast<std::size_t>(components.of[block.part_vertex(mesh.faces[f][0])]);
      sums[2 * c] += mesh.layout[f].base * mesh.layout[f].height * square / 2;
      sums[2 * c + 1] += 1;
    }
  }
  ranks.all_reduce(sums, RankGroup::Reduction::kSum);
  for (std::size_t c = 0; c < components.sizes.size(); ++c) {
    components.sizes[c].area = sums[2 * c];
    components.sizes[c].cells = static_cast<Index>(sums[2 * c + 1]);
  }
}

}  // namespace geotherm
