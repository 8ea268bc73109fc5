// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "solver/core/types.h"

namespace geotherm::io {

/// A face with more than three corners, kept as a fan: its triangles are (c0, c1, c2),
/// (c0, c2, c3), ... so that the corners can be read off them once all positions are known.
struct Polygon {
  std::size_t first_face;
  std::size_t face_count;  ///< corners - 2
};

/// What a reader hands over; every corner is in range, every coordinate finite.
struct RawMesh {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  std::vector<Polygon> polygons;
  std::size_t welded = 0;
  std::vector<std::string> notes;
};

/// Gathers the corners of one face into a fan of triangles.
class FanBuilder {
 public:
  explicit FanBuilder(std::vector<Face>& faces) : faces_(faces) {}

  void add(Index corner) {
    if (count_ == 0) {
      first_ = corner;
    } else if (count_ >= 2) {
      faces_.push_back({first_, last_, corner});
    }
    last_ = corner;
    ++count_;
  }

  std::size_t corners() const { return count_; }

  /// Ends the face; one of more than three corners is noted as a polygon.
  void end(std::vector<Polygon>& polygons) {
    if (count_ > 3) polygons.push_back({faces_.size() - (count_ - 2), count_ - 2});
    count_ = 0;
  }

 private:
  std::vector<Face>& faces_;
  Index first_ = kNoIndex;
  Index last_ = kNoIndex;
  std::size_t count_ = 0;
};

/// Replaces the fan of a polygon by other triangles where the fan folds over itself: ears are cut
/// off, in the plane of the polygon. A convex polygon keeps its fan, and so does one that crosses
/// itself or has more than 512 corners. Cost: O(n) for a good fan, else O(n^2) in practice.
void triangulate_polygon(std::span<const Vec3> positions, std::span<Face> fan);

}  // namespace geotherm::io
