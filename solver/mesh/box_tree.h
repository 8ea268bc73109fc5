// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/progress.h"
#include "geotherm/types.h"

namespace geotherm {

/// The largest float that is not above x.
inline float round_down(double x) {
  const auto f = static_cast<float>(x);
  return f <= x ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}

/// A box in single precision; empty as made.
struct FloatBox {
  std::array<float, 3> low = {kFar, kFar, kFar};
  std::array<float, 3> high = {-kFar, -kFar, -kFar};

  void add(const FloatBox& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = low[k] < other.low[k] ? low[k] : other.low[k];
      high[k] = high[k] > other.high[k] ? high[k] : other.high[k];
    }
  }

 private:
  static constexpr float kFar = std::numeric_limits<float>::infinity();
};

/// Maps the model into [-1, 1]^3: by a power of two, so that nothing over- or underflows and
/// scaling rounds nothing.
struct BoxFrame {
  Vec3 centre = Vec3::Zero();
  int exponent = 0;  ///< the unit is 2^exponent model units
  double scale = 1;

  Vec3 into(const Vec3& p) const { return (p - centre) * scale; }
};

/// That of the faces that repeat no corner.
BoxFrame frame_of(const TriangleMesh& mesh);

/// The box of a triangle in a frame, larger on all sides by more than the round-off of a point that
/// meets a ray (coordinates below 16), so that a face is never met outside of its box.
FloatBox box_of(const std::array<Vec3, 3>& corners);

/// Something with an extent; `id` means something to the caller alone.
struct BoxItem {
  FloatBox box;
  Index id = kNoIndex;
};

struct BoxNode {
  FloatBox box;
  std::uint32_t first = 0;  ///< of a leaf: its first id in BoxTree::ids; else its first child
  std::uint32_t count = 0;  ///< of a leaf: how many ids; 0: two children, `first` and `first` + 1
};

/// A hierarchy of boxes over items: node 0 is the root, and there is none without items.
struct BoxTree {
  static constexpr int kMaxDepth = 72;

  std::vector<BoxNode> nodes;
  std::vector<Index> ids;
};

/// Splits where the surface area heuristic is lowest over 16 bins of box centres on the longest
/// axis (Wald 2007); in halves where the centres tell nothing, and below depth 40, so that no input
/// makes the tree deeper than kMaxDepth. Cost: O(n log n). Errors: kCancelled.
Result<BoxTree> build_box_tree(std::vector<BoxItem> items, const Progress& progress);

}  // namespace geotherm
