// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

#include "solver/polyhedral/wave_tables.h"
#include "solver/polyhedral/window.h"

namespace geotherm {

/// The distances of a wave at vertices and at the samples of edges, with the groups of the sources
/// that gave them where somebody asks for these.
struct WaveValues {
  int samples;                  ///< on each edge
  double *distance, *sample;    ///< n; E x samples, in the direction of the edge
  Index *label, *sample_label;  ///< the same; null where nobody asks

  /// True where the vertex had no value as small before.
  bool lower_vertex(Index vertex, double value, Index group) const {
    return lower(distance[vertex], label != nullptr ? label + vertex : nullptr, value, group);
  }
  /// Sample `i` of a face's side, counted in the direction of that side.
  void lower_sample(const WaveFace& face, int side, int i, double value, Index group) const {
    const bool reversed = (face.reversed >> side & 1U) != 0;
    const auto at = static_cast<std::size_t>(samples) * static_cast<std::size_t>(face.edge[side]) +
                    static_cast<std::size_t>(reversed ? samples - 1 - i : i);
    lower(sample[at], label != nullptr ? sample_label + at : nullptr, value, group);
  }
  /// Lowers what is on a face to its straight distances to a piece of a source in the face, plus
  /// `offset`.
  void lower_face(const WaveFace& face, const SourceSeeds::Piece& piece, double offset) const;

  static bool lower(double& value, Index* label, double candidate, Index group) {
    if (!(candidate < value)) return false;
    value = candidate;
    if (label != nullptr) *label = group;
    return true;
  }
};

/// The distances near to curves, by windows as ExactMethod has them. The distance from a curve has
/// a kink where an edge crosses it, and bends where the nearest point of a piece leaves its inside
/// for an end: no wave fits the values along an edge that is long beside its distance from these.
/// Windows are cut at such places. They go as far as the longest side that they meet: beyond, a
/// wave goes on as well from a curve as from a point. Keeps references.
class NearWindows {
 public:
  NearWindows(const WaveTables& tables, const WaveValues& values)
      : tables_(tables), values_(values) {}

  /// A source at a vertex, and a piece in a face, whose own values are lowered already.
  void add_vertex(Index rank, double offset, Index group);
  void add_piece(const SourceSeeds::Piece& piece, double offset);

  /// Follows the windows, nearest first. All values below the one that it returns are those of
  /// shortest paths; kUnreached where all are.
  double run();

  /// After run(): the edges of all faces that windows came through, once each.
  const std::vector<Index>& edges() const { return edges_; }
  /// The longest side of these faces.
  double longest() const { return longest_; }
  /// Whether a wave has to cross the edge: not everything in its faces is below `radius`.
  bool is_waiting(Index edge, double radius) const;

 private:
  struct Sent {
    Window window;  ///< in the direction of the edge; its side is a SideCode, that where it left
    bool followed = false;
  };

  template <class Visit>
  void for_each_side(Index edge, const Visit& visit) const;
  void meet(const WaveFace& face);
  void notice(Index vertex);
  bool bends(Index vertex) const;
  void leave(SideCode side, Window window);
  bool is_known(const Window& window, int number, double margin);
  void follow(const Window& window);
  void enter(SideCode side, Window window);

  const WaveTables& tables_;
  WaveValues values_;
  std::vector<Sent> sent_;
  std::unordered_map<Index, std::vector<int>> on_edge_;  ///< numbers of what has left over it
  /// Of each vertex that was met: with what distance it sent windows last; below all where paths
  /// cannot bend there.
  std::unordered_map<Index, double> bends_;
  /// The least distance of a window, with its number, or that of a vertex, with ~vertex.
  using Key = std::pair<double, int>;
  std::priority_queue<Key, std::vector<Key>, std::greater<>> queue_;
  std::vector<Index> edges_;
  double longest_ = 0;
};

}  // namespace geotherm
