// SPDX-License-Identifier: MIT
// Tables of a surface that has moved. Its flips leave everything in its place but the faces that
// they, or those from before, have made others: only these find their corners and edges anew.
#include <algorithm>
#include <utility>
#include <vector>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"
#include "solver/polyhedral/wave_corners.h"
#include "solver/polyhedral/wave_sides.h"
#include "solver/polyhedral/wave_tables.h"

namespace geotherm {
namespace {

/// Gives the faces that were changed their corners and edges. Edges between two of them are
/// numbered anew, by the numbers of those that are gone.
class FaceCarrier {
 public:
  FaceCarrier(const WaveTables& earlier, const WaveSurface& before, const WaveSurface& surface,
              WaveTables& tables)
      : earlier_(earlier),
        old_(before.base.intrinsic),
        mesh_(surface.base.intrinsic),
        tables_(tables),
        changed_(earlier.faces.size(), 0) {
    for (const auto* edits : {&before.base.edits, &surface.base.edits}) {
      for (const Edit& edit : *edits) {
        for (const Index f : {edit.f, edit.g}) {
          if (differs(f)) changed_[rank(f)] = 1;
        }
      }
    }
  }

  /// A flag for each face that has changed, by the faces' numbers in the tables.
  const std::vector<char>& changed() const { return changed_; }

  void run() {
    for_each_with_value(changed_, char{1}, [this](Index i) { let_go(i); });
    std::ranges::sort(lone_);
    for_each_with_value(changed_, char{1}, [this](Index i) { carry(i); });
  }

 private:
  /// Whether a face has other corners or other neighbours than before; most flips are those from
  /// before.
  bool differs(Index f) const {
    if (old_.faces[f] != mesh_.faces[f]) return true;
    for (Side side = 3 * f; side < 3 * f + 3; ++side) {
      if (old_.twin[side] != mesh_.twin[side]) return true;
    }
    return false;
  }
  bool is_changed(Index face) const { return changed_[face] != 0; }
  Index rank(Index face) const { return earlier_.rank_of_face[face]; }

  void let_go(Index i) {
    for (int k = 0; k < 3; ++k) {
      const Side side = 3 * earlier_.intrinsic_face[i] + k, twin = old_.twin[side];
      const Index edge = earlier_.faces[i].edge[k];
      if (twin == kNoSide) {
        lone_.emplace_back(ends_of(old_, side), edge);
      } else if (side < twin && is_changed(rank(face_of(twin)))) {
        free_.push_back(edge);
      }
    }
  }

  void carry(Index i) {
    WaveFace& face = tables_.faces[i];
    const Index f = earlier_.intrinsic_face[i];
    face.reversed = 0;
    for (int k = 0; k < 3; ++k) {
      face.vertex[k] = earlier_.rank_of_vertex[mesh_.faces[f][k]];
      // Flips leave the fans at a vertex as they are.
      if (fans_touch(earlier_, face.vertex[k])) {
        face.reversed = static_cast<std::uint16_t>(face.reversed | 1U << (kFanBits + k));
      }
      const Side side = 3 * f + k, twin = mesh_.twin[side];
      if (twin == kNoSide) {
        face.edge[k] =
            std::ranges::lower_bound(lone_, std::pair(ends_of(mesh_, side), Index{0}))->second;
        continue;
      }
      const Index other = rank(face_of(twin));
      if (!is_changed(other)) {
        face.edge[k] = earlier_.faces[other].edge[corner_of(twin)];
      } else if (side < twin) {
        face.edge[k] = tables_.faces[other].edge[corner_of(twin)] = free_[next_++];
      }
    }
  }

  const WaveTables& earlier_;
  const IntrinsicMesh &old_, &mesh_;
  WaveTables& tables_;
  std::vector<char> changed_;
  std::vector<Index> free_;  ///< edges between two of the faces, before
  /// Their edges whose sides have no twins, by the ends of these.
  std::vector<std::pair<std::pair<Index, Index>, Index>> lone_;
  std::size_t next_ = 0;
};

}  // namespace

bool can_move_tables(const IntrinsicSurface& before, const IntrinsicSurface& now) {
  const auto is_plain = [](const IntrinsicSurface& surface) {
    return surface.refinement.points == 0 && !surface.tufted;
  };
  return before.kept == now.kept && is_plain(before) && is_plain(now);
}

WaveTables moved_wave_tables(const WaveTables& earlier, const WaveSurface& before,
                             const WaveSurface& surface, int threads, WaveTables memory) {
  WaveTables tables = std::move(memory);
  tables.rank_of_vertex = earlier.rank_of_vertex;
  tables.vertex_of_rank = earlier.vertex_of_rank;
  tables.rank_of_face = earlier.rank_of_face;
  tables.intrinsic_face = earlier.intrinsic_face;
  tables.faces.resize(earlier.faces.size());
  tables.sides = earlier.sides;
  tables.more = earlier.more;
  FaceCarrier carrier(earlier, before, surface, tables);
  carrier.run();
  const auto blocks = sums_of_blocks<SideLengths>(
      threads, std::ssize(tables.faces), [&](std::int64_t begin, std::int64_t end) {
        SideLengths lengths;
        for (std::int64_t i = begin; i < end; ++i) {
          const Index ahead = tables.intrinsic_face[std::min(i + kFetchedAhead, end - 1)];
          __builtin_prefetch(&surface.base.intrinsic.lengths[ahead]);
          WaveFace& face = tables.faces[i];
          if (carrier.changed()[i] == 0) {
            const WaveFace& old = earlier.faces[i];
            face.vertex = old.vertex;
            face.edge = old.edge;
            face.reversed = old.reversed;
          }
          face.touching = 0;
          set_lengths(surface.base.intrinsic.lengths[tables.intrinsic_face[i]], face, lengths);
        }
        return lengths;
      });
  sum_up(blocks, tables);
  rejoin_sides(surface.base, carrier.changed(), threads, tables);
  list_corners(tables, threads);
  mark_touching(tables, threads, surface.base);
  return tables;
}

}  // namespace geotherm
