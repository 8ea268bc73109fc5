// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "app/session/sources.h"
#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/names.h"
#include "solver/mesh/connectivity.h"

// A surface that is sculpted by hand: strokes as values, and what they do to its vertices.
namespace geotherm::app {

enum class SculptTool {
  kPull,    ///< out of the surface, along the mean normal of the patch
  kPush,    ///< into it
  kSmooth,  ///< each vertex towards the mean of its neighbours; on the boundary of those there
};
inline NamedValues<SculptTool> named_values(SculptTool) {
  using enum SculptTool;
  return {"there is no tool '*'", {{kPull, "pull"}, {kPush, "push"}, {kSmooth, "smooth"}}};
}

/// What the brush does from press to release: a touch at one point after the other.
struct Stroke {
  SculptTool tool = SculptTool::kPull;
  double radius = 0;    ///< of the patch that a touch moves, model units; above 0
  double strength = 0;  ///< 0 to 1: how far the middle moves, in radii, or towards the mean
  std::vector<FacePoint> points;
  bool operator==(const Stroke&) const = default;
};

/// All strokes since the model was opened, the oldest first. Copies share them.
struct Sculpture {
  std::vector<std::shared_ptr<const Stroke>> strokes;  ///< none is null
  friend bool operator==(const Sculpture& a, const Sculpture& b);
};

/// Moves the vertices of a mesh as strokes say. The same strokes lead to the same bits, whatever
/// was done and taken back in between. For one thread at a time.
class Sculptor {
 public:
  explicit Sculptor(std::shared_ptr<const TriangleMesh> mesh);

  /// Takes back what `wanted` has not, and does what it has more. A touch moves the patch around
  /// its point: vertices that edges lead to, whose straight distance, and whose way over edges
  /// divided by sqrt(2), are below the radius r; both, so that a circle is round on any
  /// triangulation and the far side of a thin sheet stays. One at the distance d moves by
  /// (1 - (d/r)^2)^2 of what the middle does. Errors: kBadInput (no such face, or one that repeats
  /// a corner); what was done before it stays. Cost: O(n log n) a touch on n vertices.
  Result<void> follow(const Sculpture& wanted);

  /// V, model units.
  const std::vector<Vec3>& positions() const { return positions_; }

 private:
  struct Done {
    Stroke stroke;                               ///< as far as it has been done
    std::vector<std::pair<Index, Vec3>> before;  ///< where vertices were that it has moved
    std::uint32_t number = 0;
  };
  struct Moved {
    Index vertex;
    double weight;
  };
  Result<void> touch(Done& stroke, const FacePoint& point);
  std::vector<Moved> patch(const FacePoint& point, double radius);
  Vec3 normal(const std::vector<Moved>& patch, double radius) const;
  Vec3 mean_of_neighbours(Index vertex) const;
  void take_back(const Done& stroke);
  void join_welded();

  std::shared_ptr<const TriangleMesh> mesh_;
  CornerTable corners_;
  std::vector<Vec3> positions_;
  std::vector<double> way_;              ///< V: infinite between touches
  std::vector<std::uint32_t> moved_in_;  ///< V: the last stroke that moved each; 0: none has
  std::uint32_t last_number_ = 0;
  std::vector<Done> done_;
};

}  // namespace geotherm::app
