// SPDX-License-Identifier: MIT
#include "solver/mesh/generate/gargoyle_parts.h"

namespace geotherm::generate {

void add_plinth(Sculpture& s) {
  s.add(RoundBox{{0, -0.07, -0.08}, {0.82, 0.07, 0.86}, 0.025}, 0.01);
  s.add(RoundBox{{0, -0.22, -0.08}, {0.74, 0.12, 0.78}, 0.02}, 0.03);
  s.add(RoundBox{{0, -0.37, -0.08}, {0.86, 0.06, 0.90}, 0.03}, 0.03);
}

void add_torso(Sculpture& s) {
  s.add(Ellipsoid{{0, 0.30, -0.34}, {0.32, 0.29, 0.31}}, 0.04);
  s.add(Ellipsoid{{0, 0.58, -0.22}, {0.27, 0.34, 0.25}, frame({1, 0, 0}, {0, 1, 0.3})}, 0.15);
  // The chest, broad and bent forward, and the hump of the shoulders.
  s.add(Ellipsoid{{0, 0.88, -0.02}, {0.34, 0.31, 0.27}, frame({1, 0, 0}, {0, 1, 0.35})}, 0.12);
  s.add(Ellipsoid{{0, 1.06, -0.08}, {0.36, 0.19, 0.22}}, 0.10);
  s.add_pair(Ellipsoid{{0.14, 0.90, 0.17}, {0.16, 0.12, 0.09}, frame({1, -0.2, -0.4}, {0, 1, 0})},
             0.03);
  s.add_pair(Ellipsoid{{0.36, 1.01, 0.02}, {0.155, 0.165, 0.16}}, 0.05);  // shoulders
  for (int i = 0; i < 3; ++i) {  // ribs, and the belly's folds
    const double y = 0.76 - 0.085 * i;
    s.add_pair(tube({{{0.10, y - 0.02, 0.17 - 0.055 * i}, 0.016},
                     {{0.23, y, 0.12 - 0.06 * i}, 0.026},
                     {{0.31 - 0.015 * i, y + 0.05, -0.04 - 0.05 * i}, 0.024},
                     {{0.28 - 0.015 * i, y + 0.10, -0.18 - 0.04 * i}, 0.014}}),
               0.025);
    s.add_pair(Ellipsoid{{0.065, 0.66 - 0.10 * i, 0.055 - 0.065 * i}, {0.07, 0.055, 0.05}}, 0.02);
  }
  // Spikes along the spine, from the neck to the tail.
  const Tube spine = tube({{{0, 1.33, 0.10}, 0},
                           {{0, 1.20, -0.20}, 0},
                           {{0, 0.94, -0.37}, 0},
                           {{0, 0.60, -0.50}, 0},
                           {{0, 0.32, -0.66}, 0}},
                          3);
  for (std::size_t i = 1; i + 1 < spine.points.size(); ++i) {
    const Vec3 p = spine.points[i];
    const Vec3 along = (spine.points[i + 1] - spine.points[i - 1]).normalized();
    const Vec3 out = Vec3(0, -along.z(), along.y()) * (along.z() < 0 ? 1 : -1);
    s.add(tube({{p - 0.05 * out, 0.055},
                {p + 0.06 * out + 0.02 * along, 0.032},
                {p + 0.13 * out + 0.07 * along, 0.010}},
               2),
          0.03);
  }
}

namespace {

/// Toes or fingers with claws: spread from `root` forwards over the plinth.
void add_claws(Sculpture& s, const Vec3& root, double reach, double thickness, double spread,
               double drop) {
  for (int i = -1; i <= 1; ++i) {
    const Vec3 along = Vec3(0.12 + spread * i, 0, 1).normalized();
    const Vec3 knuckle = root + 0.45 * reach * along + Vec3(0, 0.25 * thickness, 0);
    const Vec3 end = root + reach * along + Vec3(0, -0.45 * thickness - 0.4 * drop, 0);
    s.add_pair(tube({{root, 1.15 * thickness}, {knuckle, 1.1 * thickness}, {end, thickness}}, 3),
               0.02);
    s.add_pair(tube({{end + Vec3(0, 0.5 * thickness, 0), 0.8 * thickness},
                     {end + 1.5 * thickness * along + Vec3(0, 0.35 * thickness - 0.2 * drop, 0),
                      0.6 * thickness},
                     {end + 3.0 * thickness * along + Vec3(0, -0.5 * thickness - drop, 0),
                      0.15 * thickness}},
                    3),
               0.012);
  }
}

}  // namespace

void add_limbs(Sculpture& s) {
  // Hind legs: the knees drawn up and apart, heels under the hips.
  s.add_pair(tube({{{0.20, 0.36, -0.34}, 0.23},
                   {{0.42, 0.50, -0.12}, 0.215},
                   {{0.56, 0.60, 0.14}, 0.155},
                   {{0.57, 0.59, 0.22}, 0.13}}),
             0.05);
  s.add_pair(Ellipsoid{{0.58, 0.62, 0.25}, {0.09, 0.09, 0.08}}, 0.03);
  s.add_pair(tube({{{0.57, 0.56, 0.20}, 0.125},
                   {{0.57, 0.40, 0.06}, 0.135},
                   {{0.55, 0.20, -0.03}, 0.085},
                   {{0.54, 0.10, -0.04}, 0.085}}),
             0.03);
  s.add_pair(
      tube(
          {{{0.54, 0.09, -0.08}, 0.085}, {{0.54, 0.12, 0.12}, 0.085}, {{0.55, 0.08, 0.30}, 0.075}}),
      0.04);
  add_claws(s, {0.55, 0.075, 0.27}, 0.20, 0.055, 0.38, 0);
  // Arms: straight down between the knees, hands on the plinth's front edge.
  s.add_pair(tube({{{0.39, 1.00, 0.04}, 0.135},
                   {{0.42, 0.84, 0.08}, 0.130},
                   {{0.40, 0.66, 0.14}, 0.092},
                   {{0.38, 0.57, 0.18}, 0.088}}),
             0.04);
  s.add_pair(Ellipsoid{{0.385, 0.58, 0.13}, {0.07, 0.07, 0.07}}, 0.03);
  s.add_pair(tube({{{0.38, 0.58, 0.18}, 0.085},
                   {{0.345, 0.44, 0.30}, 0.105},
                   {{0.29, 0.22, 0.46}, 0.070},
                   {{0.265, 0.11, 0.54}, 0.062}}),
             0.03);
  s.add_pair(Ellipsoid{{0.26, 0.075, 0.59}, {0.10, 0.06, 0.10}}, 0.03);
  add_claws(s, {0.26, 0.065, 0.62}, 0.13, 0.042, 0.42, 0.06);
}

void add_tail(Sculpture& s) {
  s.add(tube({{{0, 0.24, -0.52}, 0.15},
              {{0.10, 0.12, -0.72}, 0.105},
              {{0.36, 0.075, -0.84}, 0.085},
              {{0.66, 0.075, -0.74}, 0.072},
              {{0.76, 0.07, -0.44}, 0.062},
              {{0.74, 0.065, -0.18}, 0.052}},
             8),
        0.05);
  const Vec3 tip(0.745, 0.07, -0.15);  // an arrow head
  s.add(tube({{tip, 0.05},
              {tip + Vec3(-0.005, 0.05, 0.12), 0.03},
              {tip + Vec3(-0.01, 0.12, 0.24), 0.012}},
             3),
        0.02);
  s.add(tube({{tip + Vec3(0, 0.01, 0.05), 0.045}, {tip + Vec3(0.10, 0.03, -0.06), 0.014}}, 3),
        0.02);
  s.add(tube({{tip + Vec3(0, 0.01, 0.05), 0.045}, {tip + Vec3(-0.10, 0.07, -0.06), 0.014}}, 3),
        0.02);
}

}  // namespace geotherm::generate
