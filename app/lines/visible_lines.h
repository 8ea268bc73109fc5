// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "app/lines/surface_tones.h"

namespace geotherm::app {

/// What of lines on a surface is seen: the surface does not hide it.
class LineSight {
 public:
  LineSight(const RayTree& tree, const LineView& view) : tree_(tree), view_(view) {}

  bool sees(const Vec3& point) const;

  /// The visible parts of a polyline, pixels; where they end is found to a small part of a piece.
  std::vector<Outline> visible_parts(std::span<const Vec3> points) const;

 private:
  Vec3 last_seen(Vec3 seen, Vec3 hidden) const;

  const RayTree& tree_;
  const LineView& view_;
};

/// Borders, and the edges where the surface turns away from the eye: visible parts, pixels.
std::vector<Outline> visible_contours(const TriangleMesh& mesh, const LineSight& sight,
                                      const LineView& view);

}  // namespace geotherm::app
