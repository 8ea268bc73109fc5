// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "geotherm/types.h"

namespace geotherm {

/// Where straight lines come from in a march over tets: a point, or a re-entrant edge of the border
/// round which a point is seen, with what is before the edge turned into the plane of what is
/// behind it.
struct TetSource {
  Vec3 place;  ///< of an edge: the point on its line that is nearest to what is before it
  double offset;
  Index parent;                    ///< of an edge: the source before it
  Index root;                      ///< the source that was given
  Index line = kNoIndex;           ///< of an edge
  Vec3 direction = Vec3::Zero();   ///< of the line, of length 1
  double before = 0;               ///< how far what is before lies from the line
  std::vector<Index> behind = {};  ///< the edges that it sees, as sources

  double line_to(const Vec3& at) const {
    const Vec3 way = at - place;
    if (line == kNoIndex) return offset + way.norm();
    const double along = way.dot(direction);
    return offset + std::hypot(before + (way - along * direction).norm(), along);
  }

  /// Where the straight line from a place goes: to the point, or to where it bends.
  Vec3 target(const Vec3& at) const {
    if (line == kNoIndex) return place;
    const Vec3 way = at - place;
    const double along = way.dot(direction);
    const double across = (way - along * direction).norm();
    return place + along * before / (before + across) * direction;
  }
};

}  // namespace geotherm
