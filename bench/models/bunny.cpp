// SPDX-License-Identifier: MIT
#include "bench/models/models.h"
#include "bench/models/noise.h"
#include "bench/models/sculpt.h"

namespace geotherm::generate {
namespace {

Ellipsoid ball(const Vec3& center, double radius) { return {center, Vec3::Constant(radius)}; }

void add_body(Sculpture& s) {
  // The back rises from the rump to the shoulders; the belly rests on the ground.
  s.add(Ellipsoid{{0, 0.50, -0.22}, {0.58, 0.46, 0.42}, frame({0, 0.22, 1}, {0, 1, 0})}, 0.1);
  s.add(Ellipsoid{{0, 0.44, -0.46}, {0.40, 0.42, 0.36}}, 0.15);
  s.add(Ellipsoid{{0, 0.52, 0.24}, {0.33, 0.40, 0.29}}, 0.2);
  s.add(tube({{{0, 0.72, 0.20}, 0.28}, {{0, 0.98, 0.34}, 0.22}}), 0.15);
  s.add(Ellipsoid{{0, 0.20, -0.10}, {0.40, 0.18, 0.55}}, 0.1);  // the belly
  s.add(ball({0, 0.40, -0.90}, 0.17), 0.06);                    // the tail
  // Haunches bulge on both sides, over long hind feet.
  s.add_pair(Ellipsoid{{0.37, 0.44, -0.32}, {0.38, 0.33, 0.19}, frame({0, 0.35, 1}, {0, 1, 0})},
             0.05);
  s.add_pair(Ellipsoid{{0.43, 0.12, -0.03}, {0.38, 0.115, 0.13}, frame({0.06, 0, 1}, {0, 1, 0})},
             0.03);
  // Front legs and paws.
  s.add_pair(
      tube({{{0.19, 0.56, 0.34}, 0.16}, {{0.19, 0.30, 0.44}, 0.125}, {{0.18, 0.14, 0.47}, 0.11}}),
      0.06);
  s.add_pair(Ellipsoid{{0.18, 0.11, 0.55}, {0.11, 0.095, 0.16}}, 0.05);
}

void add_head(Sculpture& s) {
  s.add(Ellipsoid{{0, 1.21, 0.42}, {0.285, 0.285, 0.32}}, 0.10);
  s.add(tube({{{0, 1.15, 0.56}, 0.21}, {{0, 1.11, 0.66}, 0.17}}), 0.14);
  s.add_pair(Ellipsoid{{0.16, 1.07, 0.53}, {0.165, 0.15, 0.17}}, 0.08);    // cheeks
  s.add_pair(Ellipsoid{{0.07, 1.075, 0.76}, {0.09, 0.08, 0.085}}, 0.03);   // muzzle
  s.add(Ellipsoid{{0, 1.17, 0.80}, {0.06, 0.042, 0.05}}, 0.03);            // nose
  s.add(Ellipsoid{{0, 1.00, 0.72}, {0.09, 0.06, 0.09}}, 0.04);             // chin
  s.carve_pair(Ellipsoid{{0.30, 1.27, 0.62}, {0.09, 0.14, 0.15}}, 0.06);   // hollows
  s.add_pair(Ellipsoid{{0.215, 1.285, 0.60}, {0.085, 0.10, 0.10}}, 0.01);  // eyes
}

void add_ears(Sculpture& s) {
  // Spoon-shaped, side by side, leaning back and a little apart; open to the front.
  const Vec3 along = Vec3(0.27, 1, -0.40).normalized();
  const Vec3 root(0.175, 1.39, 0.32);
  const Vec3 front = Vec3(0.40, 0.30, 0.85).normalized();
  const Eigen::Matrix3d axes = frame(along, front);
  s.add_pair(tube({{root, 0.11}, {root + 0.2 * along, 0.11}}), 0.08);
  s.add_pair(Ellipsoid{root + 0.46 * along, {0.46, 0.12, 0.195}, axes}, 0.05);
  s.carve_pair(Ellipsoid{root + 0.47 * along + 0.15 * front, {0.35, 0.10, 0.12}, axes}, 0.04);
}

Sculpture carve_bunny(double spacing) {
  Sculpture s(spacing);
  add_body(s);
  add_head(s);
  add_ears(s);
  // Tufts of fur, where the grid is fine enough to show them.
  const double height = 0.008 * (1 - smooth_step(0.02, 0.06, spacing));
  if (height > 0) {
    s.set_detail(
        [height](const Vec3& p) {
          return height * fractal_noise(Vec3(12 * p.x(), 8 * p.y(), 8 * p.z()), 2, 7);
        },
        2 * height);
  }
  return s;
}

}  // namespace

Result<DraftMesh> make_bunny(Index faces, const Progress& progress) {
  return sculpt({carve_bunny, {-0.8, -0.05, -1.2}, {0.8, 2.5, 1.0}, 8.0}, faces, progress);
}

}  // namespace geotherm::generate
