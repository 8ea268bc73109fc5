// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "geotherm/error.h"
#include "solver/distributed/mesh_block.h"
#include "solver/polyhedral/wave_front.h"

namespace geotherm {

/// An edge, as all blocks name it.
struct EdgeName {
  GlobalIndex low = 0, high = 0;  ///< its ends
  double length = 0;              ///< model units
};

/// The waves of one block, over the faces at its own vertices. Distances in model units, but for
/// distances().
class BlockWaves {
 public:
  /// Keeps a reference to the block. Precondition: it has its whole surface. Errors: those of
  /// build_wave_surface().
  static Result<std::unique_ptr<BlockWaves>> build(const MeshPart& part, const MeshBlock& block,
                                                   std::span<const char> is_source);

  const MeshBlock& block() const { return block_; }
  /// The tables of the faces that it has; vertices are numbered as in the block.
  const WaveTables& tables() const { return tables_; }

  struct NamedEdge {
    EdgeName name;
    Index edge;
  };
  /// Edges of faces that other blocks have as well, but for those that share ends and length with
  /// another edge here.
  std::span<const NamedEdge> edges() const { return edges_; }
  /// kNoIndex where there is none.
  Index find(const EdgeName& name) const;

  /// The distances of the block's vertices, in its units; kUnreached where it has none.
  std::vector<double> distances() const;

  /// A vertex by its rank, or an edge e as -1 - e, of which the sample in the middle is meant.
  using Item = Index;
  double value_at(Item item) const {
    return unit_ * (item >= 0 ? front_.distances()[static_cast<std::size_t>(item)]
                              : front_.sample_distances()[static_cast<std::size_t>(-1 - item)]);
  }
  /// Keeps what others found until hear(), after which edges wait again from wake() on.
  void note(Item item, double value);
  void hear();
  void wake() { front_.wake(); }
  /// WaveFront::go_on(); false where distances fall without end.
  bool go_on(double from, double until);
  /// At most the least key that waits; kUnreached where nothing does.
  double next() const { return tables_.faces.empty() ? kUnreached : front_.next_key() * unit_; }
  double visits() const { return static_cast<double>(front_.visits()); }

 private:
  BlockWaves(const MeshBlock& block, const WaveSurface& surface);
  void name_edges(const MeshPart& part);
  void leave_others_alone();

  const MeshBlock& block_;
  double unit_;
  WaveTables tables_;
  WaveFront front_;
  std::vector<NamedEdge> edges_;
  std::vector<char> is_shared_;  ///< of each edge: it is in edges_
  std::vector<WaveFront::Heard> vertices_, samples_;
};

}  // namespace geotherm
