// SPDX-License-Identifier: MIT
#include "solver/mesh/box_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "solver/mesh/connectivity.h"

namespace geotherm {
namespace {

constexpr double kBoxPad = 1e-13;  // units of the frame
constexpr int kSplitBins = 16;
constexpr std::size_t kBoxLeaf = 4;         // most items of a leaf
constexpr float kStepCost = 1.0F;           // of a node, in tests of an item
constexpr float kMinLength = 1e-30F;        // of centres that bins can tell apart
constexpr int kHalvesFrom = 40;             // depth; 2^31 items have at most 31 levels of halves
constexpr std::size_t kAskFrom = 1U << 12;  // splits of so many items ask the progress

/// Twice the centre: only differences and ratios of it matter.
float centre(const FloatBox& box, std::size_t axis) { return box.low[axis] + box.high[axis]; }

float area(const FloatBox& box) {
  const float x = box.high[0] - box.low[0];
  const float y = box.high[1] - box.low[1];
  const float z = box.high[2] - box.low[2];
  return x < 0 ? 0.0F : x * y + y * z + z * x;
}

struct BoxExtent {
  FloatBox boxes, centres;
};

BoxExtent extent_of(std::span<const BoxItem> items) {
  BoxExtent out;
  for (const BoxItem& item : items) {
    out.boxes.add(item.box);
    FloatBox point;
    for (std::size_t k = 0; k < 3; ++k) point.low[k] = point.high[k] = centre(item.box, k);
    out.centres.add(point);
  }
  return out;
}

/// Maps centres along an axis to bins.
struct BoxBins {
  std::size_t axis = 0;
  float low = 0, scale = 0;

  explicit BoxBins(const FloatBox& centres) {
    float length = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(centres.high[k] - centres.low[k] > length)) continue;
      length = centres.high[k] - centres.low[k];
      axis = k;
    }
    low = centres.low[axis];
    scale = length > kMinLength ? kSplitBins * (1 - 1e-5F) / length : 0.0F;
  }
  int of(const FloatBox& box) const {
    return std::clamp(static_cast<int>((centre(box, axis) - low) * scale), 0, kSplitBins - 1);
  }
};

struct BinCut {
  int bin = -1;  // the first of the right part; -1: no cut has items on both sides
  float cost = std::numeric_limits<float>::infinity();  // area times items
};

BinCut best_cut(std::span<const BoxItem> items, const BoxBins& bins) {
  std::array<FloatBox, kSplitBins> boxes;
  std::array<std::size_t, kSplitBins> counts{};
  for (const BoxItem& item : items) {
    const auto bin = static_cast<std::size_t>(bins.of(item.box));
    boxes[bin].add(item.box);
    ++counts[bin];
  }
  std::array<float, kSplitBins> left_cost{};
  FloatBox box;
  std::size_t count = 0;
  for (std::size_t b = 1; b < kSplitBins; ++b) {
    box.add(boxes[b - 1]);
    count += counts[b - 1];
    left_cost[b] = area(box) * static_cast<float>(count);
  }
  BinCut best;
  box = {};
  count = 0;
  for (std::size_t b = kSplitBins - 1; b > 0; --b) {
    box.add(boxes[b]);
    count += counts[b];
    if (count == 0 || count == items.size()) continue;
    const float cost = left_cost[b] + area(box) * static_cast<float>(count);
    if (cost < best.cost) best = {static_cast<int>(b), cost};
  }
  return best;
}

/// The size of the left part after `items` are put in order; 0: they should be a leaf.
std::size_t split(std::span<BoxItem> items, const BoxExtent& extent, int depth) {
  if (items.size() <= 1) return 0;
  const BoxBins bins(extent.centres);
  const BinCut cut = depth < kHalvesFrom && bins.scale > 0 ? best_cut(items, bins) : BinCut{};
  if (items.size() <= kBoxLeaf) {
    const float whole = area(extent.boxes);
    const float as_leaf = whole * static_cast<float>(items.size());
    if (!(cut.cost + kStepCost * whole < as_leaf)) return 0;
  }
  if (cut.bin >= 0) {
    const auto middle = std::partition(items.begin(), items.end(), [&](const BoxItem& item) {
      return bins.of(item.box) < cut.bin;
    });
    return static_cast<std::size_t>(middle - items.begin());
  }
  const std::size_t half = items.size() / 2;
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   [&](const BoxItem& a, const BoxItem& b) {
                     return centre(a.box, bins.axis) < centre(b.box, bins.axis);
                   });
  return half;
}

struct Task {
  std::size_t node, begin, end;
  int depth;
};

}  // namespace

BoxFrame frame_of(const TriangleMesh& mesh) {
  constexpr double kMax = std::numeric_limits<double>::max();
  Vec3 low = Vec3::Constant(kMax), high = Vec3::Constant(-kMax);
  for (const Face& face : mesh.faces()) {
    if (repeats_corner(face)) continue;
    for (const Index v : face) {
      low = low.cwiseMin(mesh.positions()[v]);
      high = high.cwiseMax(mesh.positions()[v]);
    }
  }
  BoxFrame frame;
  if (!(low[0] <= high[0])) return frame;
  frame.centre = low / 2 + high / 2;
  std::frexp((high / 2 - low / 2).maxCoeff(), &frame.exponent);
  frame.exponent = std::max(frame.exponent, -1022);  // 2^1022 is the largest scale in range
  frame.scale = std::ldexp(1.0, -frame.exponent);
  return frame;
}

FloatBox box_of(const std::array<Vec3, 3>& corners) {
  FloatBox box;
  for (int k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax({corners[0][k], corners[1][k], corners[2][k]});
    box.low[k] = round_down(low - kBoxPad);
    box.high[k] = -round_down(-high - kBoxPad);
  }
  return box;
}

Result<BoxTree> build_box_tree(std::vector<BoxItem> items, const Progress& progress) {
  BoxTree tree;
  if (items.empty()) return tree;
  tree.nodes.reserve(items.size());
  tree.nodes.emplace_back();
  std::vector<Task> tasks = {{0, 0, items.size(), 0}};
  while (!tasks.empty()) {
    const auto [node, begin, end, depth] = tasks.back();
    tasks.pop_back();
    // Parts are finished from the left: all before `begin` are leaves.
    if (end - begin >= kAskFrom &&
        !report(progress, "ray tree",
                static_cast<double>(begin) / static_cast<double>(items.size()))) {
      return cancelled_error();
    }
    const std::span<BoxItem> part(items.data() + begin, end - begin);
    const BoxExtent extent = extent_of(part);
    const std::size_t left = split(part, extent, depth);
    const std::size_t first = left == 0 ? begin : tree.nodes.size();
    tree.nodes[node] = {extent.boxes, static_cast<std::uint32_t>(first),
                        static_cast<std::uint32_t>(left == 0 ? part.size() : 0)};
    if (left == 0) continue;
    tree.nodes.resize(first + 2);
    tasks.push_back({first + 1, begin + left, end, depth + 1});
    tasks.push_back({first, begin, begin + left, depth + 1});
  }
  tree.nodes.shrink_to_fit();
  tree.ids.reserve(items.size());
  for (const BoxItem& item : items) tree.ids.push_back(item.id);
  return tree;
}

}  // namespace geotherm
