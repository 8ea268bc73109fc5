// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geotherm/progress.h"
#include "solver/polyhedral/window.h"
#include "solver/polyhedral/window_mesh.h"
#include "solver/polyhedral/window_queue.h"

namespace geotherm {

/// How directions at a source are measured, where windows are to carry them along.
struct StartDirections {
  /// In the frame of a side (Window), of the source's lines: turn + angle, or minus where mirrored.
  struct Turn {
    double turn = 0;
    bool mirrored = false;
  };
  Index vertex = kNoIndex;        ///< where the source is one
  std::vector<Turn> of_opposite;  ///< its opposite sides, their frames with the vertex below
  std::vector<Turn> of_piece;     ///< of the layouts of the faces that hold the source
};

/// Exact distances from one source set by windows that spread from face to face, nearest first
/// (Chen, Han 1990; Xin, Wang 2009). Windows are trimmed by comparing them with paths that exist
/// (window.h), so that no order of events loses a shortest path. The distance at a vertex is the
/// length of a path at all times.
class Propagation {
 public:
  struct VertexState {
    double distance = kUnreached;
    double sent = kUnreached;  ///< the distance with which it was last put into the queue
    Index group = kNoIndex;
  };

  /// run() gives up at so many bytes of windows: 1.5 GiB.
  static constexpr std::size_t kMaxBytes = std::size_t{3} << 29;

  /// Keeps a reference.
  explicit Propagation(const WindowMesh& mesh, std::size_t most_bytes = kMaxBytes);

  /// Follows start directions as well, for a source that is one point. Keeps a reference. To be
  /// called before run().
  void follow_directions(const StartDirections& starts);

  /// Propagates from the seeds to the end; to be called once. Lengths as those of the surface;
  /// until the end they are measured from the least offset, so that they keep their digits. Ends
  /// when the vertices within `radius` have their distance, or all targets do; the others may have
  /// too large ones then.
  /// `progress` is asked now and then, as stage "solve". Errors: kCancelled, kBudgetEnded (windows
  /// that multiply without end), kOutOfMemory. Throws std::bad_alloc.
  Result<void> run(const SourceSeeds& seeds, const Progress& progress, double radius = kUnreached,
                   std::span<const Index> targets = {});

  const std::vector<VertexState>& vertices() const { return vertices_; }
  std::int64_t windows() const { return windows_; }  ///< that were followed
  /// V, where they are followed: of the shortest path to each vertex, as StartDirections measures
  /// them; 0 at the source, no number where it cannot be.
  const std::vector<double>& directions() const { return directions_; }

 private:
  void seed(const SourceSeeds& seeds, double base);
  Result<void> spread(const Progress& progress);
  bool has_all();
  void seed_point(const SourceSeeds::Piece& piece, const StartDirections::Turn* turn = nullptr);
  void seed_segment(const SourceSeeds::Piece& piece);
  bool reach(Index vertex, double distance, Index group, bool send_anyway = false);
  void reach_by(const Window& window, Index vertex, double x, double y, double distance);
  void send_from(Index vertex, double distance, Index group);
  void follow(Window window);
  void send_left(const Window& window, bool from_apex);
  void send_right(const Window& window, bool from_apex);
  void cross(Side side, Window window, bool against);
  bool merges_with_waiting(const Window& window, double length);
  bool is_early_at_branch(Side side, Window& window, bool against);
  Result<void> check(const Progress& progress);
  double distance_at(Index vertex) const {
    return vertices_[static_cast<std::size_t>(vertex)].distance;
  }

  const WindowMesh& mesh_;
  std::size_t most_bytes_;
  WindowQueue queue_;
  std::vector<VertexState> vertices_;
  const StartDirections* starts_ = nullptr;
  std::vector<double> directions_;
  std::vector<Leader> leaders_;                   ///< of sides
  std::vector<Window*> waiting_;                  ///< of sides: the last window in the queue
  std::vector<std::vector<Window>> at_branches_;  ///< of non-manifold edges: what crossed them
  std::int64_t windows_ = 0;
  std::int64_t work_ = 0, next_check_ = 1 << 18;
  double radius_ = kUnreached;
  std::span<const Index> targets_;
  std::size_t has_ = 0;  ///< so many targets have their distance
  Index reached_ = 0;
  std::size_t crossed_ = 0;  ///< windows in at_branches_
};

}  // namespace geotherm
