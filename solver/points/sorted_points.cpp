// SPDX-License-Identifier: MIT
#include "solver/points/sorted_points.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <nanoflann.hpp>

#include "solver/core/parallel.h"
#include "solver/core/sorting.h"

namespace geotherm {
namespace {

constexpr std::int64_t kPointsPerThread = 1 << 14;

/// The place on the curve of a point in the cube from -1 to 1.
std::uint64_t place_on_curve(const Vec3& p) {
  constexpr double kCells = 1 << 21;
  std::uint64_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::clamp((p[axis] + 1) / 2 * kCells, 0.0, kCells - 1);
    place |= spread_bits(static_cast<std::uint64_t>(cell)) << axis;
  }
  return place;
}

struct PlacedPoint {
  std::uint64_t place;
  Index number;
};

/// The box of all points: its middle and half of its longest side.
void measure_box(std::span<const Vec3> positions, Vec3& middle, double& half) {
  Vec3 low = positions.front(), high = low;
  for (const Vec3& p : positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  middle = low / 2 + high / 2;
  half = (high / 2 - low / 2).maxCoeff();
}

}  // namespace

SortedPoints sort_points(std::span<const Vec3> positions, int threads) {
  SortedPoints out;
  Vec3 middle;
  measure_box(positions, middle, out.unit);
  if (!(out.unit > 0)) out.unit = 1;
  const std::size_t count = positions.size();
  std::vector<Vec3> scaled(count);
  std::vector<PlacedPoint> order(count);
  parallel_each<std::size_t>(threads, std::ssize(positions), kPointsPerThread, [&](std::size_t i) {
    // Plus 0 makes 0 of -0: the two are one place.
    scaled[i] = ((positions[i] - middle) / out.unit).array() + 0.0;
    order[i] = {place_on_curve(scaled[i]), static_cast<Index>(i)};
  });
  std::ranges::sort(order, [&](const PlacedPoint& a, const PlacedPoint& b) {
    if (a.place != b.place) return a.place < b.place;
    const Vec3 &p = scaled[static_cast<std::size_t>(a.number)],
               &q = scaled[static_cast<std::size_t>(b.number)];
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] != q[axis]) return p[axis] < q[axis];
    }
    return a.number < b.number;
  });
  out.positions.reserve(count);
  out.number.reserve(count);
  for (const PlacedPoint& placed : order) {
    const Vec3& p = scaled[static_cast<std::size_t>(placed.number)];
    if (!out.positions.empty() && out.positions.back() == p) continue;
    out.positions.push_back(p);
    out.number.push_back(placed.number);
  }
  if (out.positions.size() == count) return out;
  out.same_as.resize(count);
  std::size_t at = 0;
  for (const PlacedPoint& placed : order) {
    const auto i = static_cast<std::size_t>(placed.number);
    if (scaled[i] != out.positions[at]) ++at;
    out.same_as[i] = out.number[at];
  }
  return out;
}

/// What nanoflann asks of a set of points.
struct NeighbourTree::Tree {
  using Number = std::uint32_t;

  const std::vector<Vec3>& points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }

  using Metric = nanoflann::L2_Simple_Adaptor<double, Tree, double, Number>;
  nanoflann::KDTreeSingleIndexAdaptor<Metric, Tree, 3, Number> index{
      3, *this, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafPoints)};

  static constexpr std::size_t kLeafPoints = 12;
};

NeighbourTree::NeighbourTree(const std::vector<Vec3>& points) : tree_(new Tree{points}) {}

NeighbourTree::~NeighbourTree() = default;

int NeighbourTree::nearest(Index point, int count, Index* numbers, double* squares) const {
  assert(count <= kMaxNeighbours);
  std::uint32_t found[kMaxNeighbours + 1];
  const std::size_t total =
      tree_->index.knnSearch(tree_->points[static_cast<std::size_t>(point)].data(),
                             static_cast<std::size_t>(count) + 1, found, squares);
  int kept = 0;
  for (std::size_t i = 0; i < total && kept < count; ++i) {
    const auto number = static_cast<Index>(found[i]);
    if (number == point) continue;
    numbers[kept] = number;
    squares[kept++] = squares[i];
  }
  return kept;
}

}  // namespace geotherm
