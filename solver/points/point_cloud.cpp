// SPDX-License-Identifier: MIT
#include "geotherm/domains.h"

#include <limits>

#include "solver/core/text.h"

namespace geotherm {

Result<PointCloud> PointCloud::build(std::vector<Vec3> positions, std::vector<Vec3> normals) {
  if (positions.empty()) {
    return Error{ErrorCode::kBadInput, "the point cloud has no points"};
  }
  if (positions.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max())) {
    return Error{ErrorCode::kBadInput,
                 std::to_string(positions.size()) + " points are more than can be numbered"};
  }
  if (!normals.empty() && normals.size() != positions.size()) {
    return Error{ErrorCode::kBadInput,
                 "there are " + counted_text(normals.size(), "normal", "normals") + " for " +
                     counted_text(positions.size(), "point", "points") +
                     "; each needs one, or none has"};
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!positions[i].allFinite()) {
      return Error{ErrorCode::kBadInput,
                   "a coordinate of point " + std::to_string(i) + " is not finite"};
    }
  }
  return PointCloud(std::move(positions), std::move(normals));
}

}  // namespace geotherm
