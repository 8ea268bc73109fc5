// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geotherm/types.h"

namespace geotherm {

/// Where a place lies among triangles.
struct PlaceInTriangle {
  std::size_t triangle;           ///< that is nearest to the place
  std::array<double, 3> weights;  ///< of its corners: none below 0, and 1 in all
  Vec3 at;                        ///< the point of the triangle with these weights
};

/// Precondition: there are triangles. Those without an area are passed over; where all are such,
/// the place is at the first corner of the first.
PlaceInTriangle find_triangle(std::span<const std::array<Vec3, 3>> triangles, const Vec3& place);

/// A source on a side of a face, which the face beyond has as well.
struct SourceOnSide {
  std::int64_t from, to;  ///< numbers of the side's ends
  std::int64_t number;
  Vec3 place;
};

/// The triangles of one face. Sources inside the face may become corners of them.
class FaceTriangles {
 public:
  void add(const std::array<std::int64_t, 3>& corners, const std::array<Vec3, 3>& at);

  /// Makes the nearest point of the face a corner with this number: of the triangle that it is in,
  /// or of the two at an edge that it is on, or nearly so. Returns false, and changes nothing,
  /// where that point is a corner already. A source on a side of the face is added to `on_sides`.
  bool insert(std::int64_t number, const Vec3& place, std::vector<SourceOnSide>& on_sides);

  /// Makes a source on a side a corner of the triangle at that side, if there is one.
  void split(const SourceOnSide& source) { (void)split_at(source); }

  std::size_t size() const { return at_.size(); }
  const std::array<std::int64_t, 3>& corners(std::size_t triangle) const {
    return corners_[triangle];
  }
  const std::array<Vec3, 3>& at(std::size_t triangle) const { return at_[triangle]; }

 private:
  /// Returns how many triangles have this edge.
  int split_at(const SourceOnSide& source);
  /// Replaces one by those that have the place in place of one of these corners.
  void replace(std::size_t triangle, std::span<const std::size_t> instead_of, std::int64_t number,
               const Vec3& place);

  std::vector<std::array<std::int64_t, 3>> corners_;
  std::vector<std::array<Vec3, 3>> at_;  ///< their places
};

}  // namespace geotherm
