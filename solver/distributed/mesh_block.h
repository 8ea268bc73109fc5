// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geotherm/options.h"
#include "solver/distributed/mesh_part.h"
#include "solver/heat/heat_step.h"
#include "solver/heat/surface.h"

namespace geotherm {

/// The connected parts of a mesh that ranks share, numbered on all ranks alike.
struct SharedComponents {
  std::vector<Index> of;             ///< of each vertex of the part; kNoIndex: in no face
  std::vector<ComponentSize> sizes;  ///< in MeshPart::unit; area and cells come by measure()
  double mean_edge = 0;              ///< of all, likewise
};

/// All ranks call it. Errors (the same on all): kBadInput, nothing has a length. Cost: exchanges
/// until each part has one name, at most as many as ranks lie along one.
Result<SharedComponents> name_components(const RankGroup& ranks, const MeshPart& part);

/// Some of a rank's vertices, which it solves for together, and what lies around them.
struct MeshBlock {
  Index first = 0, end = 0;       ///< own: these vertices of the part
  std::vector<Index> vertex;      ///< the vertex of the part that each one here is, own first
  std::vector<Index> ring_begin;  ///< here, of rings from 1 on, and the end
  std::shared_ptr<const Surface> surface;  ///< null: no face is here
  int free_rings = 0;                      ///< rings whose triangles are those of their owners
  std::vector<Index> held;                 ///< rows beyond: others have their values
  std::vector<Index> edge;  ///< those of them that share a face with one that is free
  std::shared_ptr<const LinearSystem> heat;

  Index own() const { return end - first; }
  /// The row of a vertex here, kNoIndex where it has none.
  Index row(Index here) const {
    return surface ? surface->row_of_vertex[static_cast<std::size_t>(here)] : kNoIndex;
  }
  /// The vertex of the part at a row.
  Index part_vertex(Index row) const {
    return vertex[static_cast<std::size_t>(surface->vertex_of_row[static_cast<std::size_t>(row)])];
  }
  /// A number for each component of the surface, f of the component of all that it is a piece of.
  template <class F>
  auto per_component(const SharedComponents& all, const F& f) const {
    const Components& parts = surface->operators->components;
    std::vector<decltype(f(Index{0}))> out(static_cast<std::size_t>(parts.count));
    for (Index row = 0; row < surface->size(); ++row) {
      out[static_cast<std::size_t>(parts.of[static_cast<std::size_t>(row)])] =
          f(all.of[static_cast<std::size_t>(part_vertex(row))]);
    }
    return out;
  }
};

/// Vertices of a block, at most: so that its factor stays in proportion and heat does not fall too
/// far within it.
inline constexpr Index kMaxBlock = 150'000;

/// How a rank's share is cut and triangulated.
struct BlockRules {
  bool flip = true;        ///< to intrinsic Delaunay
  int rings = 16;          ///< around a block, which it solves for, too
  Index most = kMaxBlock;  ///< vertices of a block
  int threads = 1;
};

/// The blocks of a rank. Intrinsic Delaunay triangulations are made by each block for itself, with
/// more rings than it needs; where two blocks disagree on the triangles at a vertex that one of
/// them owns, all are made again with a wider halo, which grows in `part`. Errors (the same on all
/// ranks): kNumericalFailure (they do not come to agree), those of build_surface(). All ranks call
/// it.
Result<std::vector<MeshBlock>> build_blocks(const RankGroup& ranks, const BlockRules& rules,
                                            MeshPart& part);

/// Area and faces of the components. All ranks call it.
void measure_components(const RankGroup& ranks, const MeshPart& part,
                        std::span<const MeshBlock> blocks, SharedComponents& components);

/// Whether a face counts as this block's: its first corner by global numbers is own.
std::vector<char> own_faces(const MeshPart& part, const MeshBlock& block);

}  // namespace geotherm
