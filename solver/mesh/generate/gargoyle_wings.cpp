// SPDX-License-Identifier: MIT
#include "solver/mesh/generate/gargoyle_parts.h"

namespace geotherm::generate {
namespace {

using Vec2 = Eigen::Vector2d;

/// From `from` to `to`, drawn in towards `center` between them: the rim of a membrane.
void add_scallop(std::vector<Vec2>& outline, const Vec2& from, const Vec2& to, const Vec2& center,
                 double depth) {
  constexpr int kSteps = 7;
  for (int i = 0; i < kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    const Vec2 p = (1 - t) * from + t * to;
    outline.push_back(p + 4 * depth * t * (1 - t) * (center - p));
  }
}

}  // namespace

void add_wings(Sculpture& s) {
  // In the wing's plane, from the shoulder: u outwards, v upwards.
  const Vec2 shoulder(0, 0);
  const Vec2 wrist(0.52, 0.86);
  const Vec2 hip(0.02, -0.42);
  const std::vector<Vec2> tips = {{1.16, 1.12}, {1.26, 0.50}, {1.02, -0.02}, {0.60, -0.34}};

  Sheet wing;
  wing.origin = {0.15, 1.04, -0.24};
  wing.axes = frame({0.90, 0, -0.44}, {0.05, 1, -0.12});
  wing.half = 0.021;
  wing.bow = -0.12;
  wing.lean = -0.10;
  wing.billow = 0.05;
  wing.outline = {shoulder, wrist};
  std::reverse(wing.outline.begin(),
               wing.outline.end());  // the rim runs wrist, tips, hip, shoulder
  wing.outline.pop_back();
  for (std::size_t i = 0; i < tips.size(); ++i) {
    wing.rods.push_back({wrist, tips[i], 0.050, 0.022});
    if (i + 1 < tips.size()) add_scallop(wing.outline, tips[i], tips[i + 1], wrist, 0.24);
  }
  add_scallop(wing.outline, tips.back(), hip, wrist, 0.14);
  wing.outline.push_back(hip);
  wing.outline.push_back(shoulder);
  wing.rods.push_back({shoulder, wrist, 0.085, 0.055});
  wing.rods.push_back({shoulder, hip, 0.07, 0.05});
  wing.rods.push_back({wrist, wrist + Vec2(-0.02, 0.20), 0.055, 0.012});  // the thumb's claw
  s.add_pair(wing, 0.05);
  s.add_pair(tube({{{0.10, 0.98, -0.16}, 0.14}, {{0.18, 1.06, -0.26}, 0.10}}, 2), 0.06);
}

}  // namespace geotherm::generate
