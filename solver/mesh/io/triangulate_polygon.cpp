// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "solver/mesh/io/raw_mesh.h"

namespace geotherm::io {
namespace {

constexpr std::size_t kMostCorners = 512;  // bounds the time a hostile file can ask for

/// One polygon seen along its normal.
class EarCutter {
 public:
  EarCutter(std::span<const Vec3> positions, const Vec3& normal, std::vector<Index> corners)
      : positions_(positions), normal_(normal), corners_(std::move(corners)) {}

  /// Cuts one ear off; false when there is none. The last three corners always are one.
  bool cut(Face& ear) {
    const std::size_t count = corners_.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Face candidate = {corners_[(i + count - 1) % count], corners_[i],
                              corners_[(i + 1) % count]};
      if (count > 3 && !is_ear(candidate)) continue;
      ear = candidate;
      corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(i));
      return true;
    }
    return false;
  }

 private:
  const Vec3& at(Index v) const { return positions_[static_cast<std::size_t>(v)]; }

  double turn(Index a, Index b, Index c) const {
    return (at(b) - at(a)).cross(at(c) - at(a)).dot(normal_);
  }

  bool is_ear(const Face& t) const { return turn(t[0], t[1], t[2]) > 0 && !holds_a_corner(t); }

  bool holds_a_corner(const Face& t) const {
    for (const Index v : corners_) {
      if (at(v) == at(t[0]) || at(v) == at(t[1]) || at(v) == at(t[2])) continue;
      if (turn(t[0], t[1], v) >= 0 && turn(t[1], t[2], v) >= 0 && turn(t[2], t[0], v) >= 0) {
        return true;
      }
    }
    return false;
  }

  std::span<const Vec3> positions_;
  Vec3 normal_;
  std::vector<Index> corners_;
};

}  // namespace

void triangulate_polygon(std::span<const Vec3> positions, std::span<Face> fan) {
  const auto cross = [&](const Face& f) -> Vec3 {
    const auto at = [&](int k) -> const Vec3& {
      return positions[static_cast<std::size_t>(f[static_cast<std::size_t>(k)])];
    };
    return (at(1) - at(0)).cross(at(2) - at(0));
  };
  Vec3 normal = Vec3::Zero();
  for (const Face& f : fan) normal += cross(f);
  const bool folded =
      std::ranges::any_of(fan, [&](const Face& f) { return !(cross(f).dot(normal) > 0); });
  if (!folded || fan.size() + 2 > kMostCorners || !(normal.norm() > 0)) return;

  std::vector<Index> corners = {fan[0][0], fan[0][1]};
  for (const Face& f : fan) corners.push_back(f[2]);
  EarCutter cutter(positions, normal.normalized(), std::move(corners));
  std::vector<Face> ears(fan.size());
  for (Face& ear : ears) {
    if (!cutter.cut(ear)) return;
  }
  std::ranges::copy(ears, fan.begin());
}

}  // namespace geotherm::io
