// SPDX-License-Identifier: MIT
#include "solver/geometry/orient_by_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "solver/geometry/clean_faces.h"

namespace geotherm {
namespace {

/// The order of places by their coordinates.
bool less(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

/// The sum of the cotangents opposite to an edge of two faces, at 0 and below the less Delaunay; of
/// faces without area that of any sign.
double cotangents_at(std::span<const Vec3> positions, const std::vector<Face>& faces,
                     std::span<const Side> sides) {
  double sum = 0;
  for (const Side side : sides) {
    const Face& face = faces[face_of(side)];
    const int k = corner_of(side);
    const Vec3& apex = positions[face[previous_corner(k)]];
    const Vec3 a = (positions[face[k]] - apex).stableNormalized();
    const Vec3 b = (positions[face[next_corner(k)]] - apex).stableNormalized();
    sum += a.dot(b) / std::max(a.cross(b).norm(), std::numeric_limits<double>::min());
  }
  return sum;
}

/// Whether a face is turned, relative to the first of those that it is joined with.
class TurnedFaces {
 public:
  explicit TurnedFaces(std::size_t count) : parent_(count), size_(count, 1), turned_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  bool is_turned(Index f) const {
    char turned = 0;
    for (; parent_[f] != f; f = parent_[f]) turned = static_cast<char>(turned ^ turned_[f]);
    return turned != 0;
  }
  /// The face that stands for all that hang together.
  Index root(Index f) const {
    while (parent_[f] != f) f = parent_[f];
    return f;
  }
  /// Joins what hangs together with `a` to what does with `b`, so that they agree; not where they
  /// hang together already.
  void join(Index a, Index b, bool disagree) {
    const bool turn = is_turned(a) != is_turned(b);
    const Index root_a = root(a), root_b = root(b);
    if (root_a == root_b) return;
    const bool swapped = size_[root_a] < size_[root_b];  // paths stay short
    const Index above = swapped ? root_b : root_a, below = swapped ? root_a : root_b;
    parent_[below] = above;
    size_[above] += size_[below];
    turned_[below] = static_cast<char>(turn != disagree);
  }

 private:
  std::vector<Index> parent_, size_;
  std::vector<char> turned_;  ///< relative to the parent
};

/// The corners' places of a face from the least on, by coordinates, as they follow each other.
std::array<Vec3, 3> from_least(std::span<const Vec3> positions, const Face& face) {
  std::array<Vec3, 3> out = {positions[face[0]], positions[face[1]], positions[face[2]]};
  std::ranges::rotate(out, std::ranges::min_element(out, less));
  return out;
}

/// Of all faces that hang together the one whose places come first is kept in the turn in which
/// they ascend.
std::vector<char> turned_roots(std::span<const Vec3> positions, const std::vector<Face>& faces,
                               const TurnedFaces& turned) {
  using Places = std::array<double, 9>;
  std::vector<Places> least(faces.size());
  std::vector<char> found(faces.size(), 0), out(faces.size(), 0);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    auto [a, b, c] = from_least(positions, faces[f]);
    const bool descends = less(c, b);
    if (descends) std::swap(b, c);
    const Places places = {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]};
    const auto root = static_cast<std::size_t>(turned.root(static_cast<Index>(f)));
    if (found[root] != 0 && !(places < least[root])) continue;
    found[root] = 1;
    least[root] = places;
    out[root] = static_cast<char>(descends != turned.is_turned(static_cast<Index>(f)));
  }
  return out;
}

/// What makes an edge agree before others, by the shape alone: first its cotangents, rounded so
/// that those of a regular mesh are the same, then its place.
using Rank = std::array<double, 7>;
Rank rank_of(std::span<const Vec3> positions, const std::vector<Face>& faces,
             const EdgeTable& edges, Index e) {
  constexpr double kSteps = 1e6;
  Vec3 a = positions[edges.low(e)], b = positions[edges.high(e)];
  if (less(b, a)) std::swap(a, b);
  return {std::round(kSteps * cotangents_at(positions, faces, edges.sides(e))),
          a[0],
          a[1],
          a[2],
          b[0],
          b[1],
          b[2]};
}

}  // namespace

void orient_by_shape(std::span<const Vec3> positions, std::vector<Face>& faces,
                     const EdgeTable& edges) {
  std::vector<std::pair<Rank, Index>> order;
  for (Index e = 0; e < edges.edge_count(); ++e) {
    if (edges.sides(e).size() == 2) order.emplace_back(rank_of(positions, faces, edges, e), e);
  }
  std::ranges::sort(order);
  TurnedFaces turned(faces.size());
  for (const auto& [rank, e] : order) {
    const auto sides = edges.sides(e);
    turned.join(face_of(sides[0]), face_of(sides[1]), !sides_agree(faces, sides[0], sides[1]));
  }
  const std::vector<char> whole = turned_roots(positions, faces, turned);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto here = static_cast<Index>(f);
    const bool with_all = whole[static_cast<std::size_t>(turned.root(here))] != 0;
    if (turned.is_turned(here) != with_all) std::swap(faces[f][1], faces[f][2]);
  }
}

}  // namespace geotherm
