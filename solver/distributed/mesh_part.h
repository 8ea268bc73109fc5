// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/types.h"
#include "solver/distributed/rank_group.h"

namespace geotherm {

/// The numbers, counted from 0, at which the share of each of so many parts begins, and the end.
inline std::int64_t share_begin(std::int64_t all, int part, int parts) {
  return all * part / parts;
}
/// The part whose share holds this number.
int part_of_share(std::int64_t number, std::int64_t all, int parts);

/// How many there are in a file.
struct MeshCounts {
  GlobalIndex vertices = 0, faces = 0;
};

/// Reads the head of a binary .ply alone. Errors: those of read_ply_slice() that the head shows.
Result<MeshCounts> count_ply(const std::string& path);

/// Some vertices and faces that follow each other in a file, numbered as there.
struct MeshSlice {
  GlobalIndex vertices = 0, faces = 0;  ///< of the file
  GlobalIndex first_vertex = 0;         ///< of `positions`
  std::vector<Vec3> positions;
  std::vector<std::array<GlobalIndex, 3>> corners;
};

/// Reads the share of one of several parts from a binary .ply of triangles. Errors: kBadFile (what
/// cannot be read, ends early or is no triangle, a corner out of range, a coordinate that is not
/// finite), kBadInput (another format). Cost: the bytes of the share are read, once.
Result<MeshSlice> read_ply_slice(const std::string& path, int part, int parts);

/// The vertices that a rank owns, which follow each other along a space-filling curve, and those
/// around them (the halo) with all faces between. Vertices are numbered here: own ones first, in
/// the order of their global numbers, then the rings of the halo, one after the other.
struct MeshPart {
  GlobalIndex vertices = 0, faces = 0;  ///< of all ranks
  /// The unit of lengths, in model units: a power of two as large as the coordinates, so that no
  /// square of a length leaves the range of doubles.
  double unit = 1;
  std::vector<GlobalIndex> first;    ///< ranks + 1: the first own global number of each
  Index own = 0;                     ///< vertices that this rank owns
  std::vector<GlobalIndex> id;       ///< global number of each vertex here
  std::vector<GlobalIndex> file_id;  ///< own: number in the file
  std::vector<Vec3> positions;       ///< of each vertex here, in `unit`
  std::vector<Face> corners;         ///< first those that touch an own vertex
  Index own_faces = 0;               ///< so many
  std::vector<Index> ring_begin;     ///< the first vertex of each ring from 1 on, and the end
  std::unordered_map<GlobalIndex, Index> halo;  ///< global to here, of those not owned

  Index size() const { return static_cast<Index>(id.size()); }
  int rings() const { return static_cast<int>(ring_begin.size()) - 1; }
  int owner(GlobalIndex global) const {
    return static_cast<int>(std::ranges::upper_bound(first, global) - first.begin()) - 1;
  }
  /// Where a global number is here, kNoIndex where it is not.
  Index local(GlobalIndex global, int rank) const {
    const auto r = static_cast<std::size_t>(rank);
    if (global >= first[r] && global < first[r + 1]) return static_cast<Index>(global - first[r]);
    const auto found = halo.find(global);
    return found == halo.end() ? kNoIndex : found->second;
  }
};

/// Shares the vertices out along the curve and gives each rank its part, with one ring. Errors
/// (the same on all ranks): kBadInput, more vertices a rank than 32 bits number. All ranks call it.
Result<MeshPart> share_mesh(const RankGroup& ranks, MeshSlice slice);

/// Extends the halo to so many rings. All ranks call it. Cost: an exchange a ring.
void grow_halo(const RankGroup& ranks, int rings, MeshPart& part);

/// Values of vertices that others own.
class Halo {
 public:
  /// `wanted`: vertices of the part that are not own. All ranks call it.
  Halo(const RankGroup& ranks, const MeshPart& part, std::span<const Index> wanted);

  /// Brings the values of these vertices from their owners. All ranks call it.
  template <class T>
  void fetch(const RankGroup& ranks, std::vector<T>& values) const {
    PerRank<T> out(send_.size());
    for (std::size_t r = 0; r < send_.size(); ++r) {
      for (const Index v : send_[r]) out[r].push_back(values[static_cast<std::size_t>(v)]);
    }
    const PerRank<T> in = ranks.all_to_all(out);
    for (std::size_t r = 0; r < take_.size(); ++r) {
      for (std::size_t k = 0; k < in[r].size(); ++k) {
        values[static_cast<std::size_t>(take_[r][k])] = in[r][k];
      }
    }
  }

 private:
  PerRank<Index> send_, take_;
};

}  // namespace geotherm
