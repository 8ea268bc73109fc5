// SPDX-License-Identifier: MIT
#include "bench/models/draft_mesh.h"

#include "bench/models/sculpture.h"

namespace geotherm::generate {
namespace {

Ellipsoid ball(const Vec3& center, double radius) { return {center, Vec3::Constant(radius)}; }

void add_rabbit_body(Sculpture& s) {
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

void add_rabbit_head(Sculpture& s) {
  s.add(Ellipsoid{{0, 1.21, 0.42}, {0.285, 0.285, 0.32}}, 0.10);
  s.add(tube({{{0, 1.15, 0.56}, 0.21}, {{0, 1.11, 0.66}, 0.17}}), 0.14);
  s.add_pair(Ellipsoid{{0.16, 1.07, 0.53}, {0.165, 0.15, 0.17}}, 0.08);    // cheeks
  s.add_pair(Ellipsoid{{0.07, 1.075, 0.76}, {0.09, 0.08, 0.085}}, 0.03);   // muzzle
  s.add(Ellipsoid{{0, 1.17, 0.80}, {0.06, 0.042, 0.05}}, 0.03);            // nose
  s.add(Ellipsoid{{0, 1.00, 0.72}, {0.09, 0.06, 0.09}}, 0.04);             // chin
  s.carve_pair(Ellipsoid{{0.30, 1.27, 0.62}, {0.09, 0.14, 0.15}}, 0.06);   // hollows
  s.add_pair(Ellipsoid{{0.215, 1.285, 0.60}, {0.085, 0.10, 0.10}}, 0.01);  // eyes
}

void add_rabbit_ears(Sculpture& s) {
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
  add_rabbit_body(s);
  add_rabbit_head(s);
  add_rabbit_ears(s);
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

namespace {

// The gargoyle is about 2 high and faces +Z; the plinth's top is at y = 0.

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
  wing.outline = {wrist};  // the rim runs wrist, tips, hip, shoulder
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

void add_face(Sculpture& s) {
  // Upper jaw and lower jaw, with the open mouth between them.
  s.add(tube({{{0, 1.30, 0.46}, 0.15}, {{0, 1.275, 0.62}, 0.125}, {{0, 1.25, 0.76}, 0.095}}), 0.05);
  s.add(Ellipsoid{{0, 1.275, 0.80}, {0.085, 0.055, 0.055}}, 0.03);
  s.add(tube({{{0, 1.17, 0.38}, 0.14}, {{0, 1.09, 0.54}, 0.10}, {{0, 1.06, 0.69}, 0.075}}), 0.04);
  s.carve(Ellipsoid{{0, 1.16, 0.72}, {0.13, 0.052, 0.20}, frame({1, 0, 0}, {0, 1, 0.12})}, 0.03);
  s.add(tube({{{0, 1.10, 0.52}, 0.045}, {{0, 1.12, 0.61}, 0.038}, {{0, 1.12, 0.67}, 0.022}}), 0.02);
  s.add_pair(tube({{{0.070, 1.21, 0.775}, 0.026},
                   {{0.074, 1.15, 0.79}, 0.02},
                   {{0.074, 1.10, 0.79}, 0.008}},
                  2),
             0.012);  // fangs
  s.add_pair(tube({{{0.060, 1.08, 0.70}, 0.022},
                   {{0.063, 1.12, 0.715}, 0.015},
                   {{0.060, 1.15, 0.715}, 0.008}},
                  2),
             0.012);
  s.carve_pair(Ellipsoid{{0.042, 1.285, 0.845}, {0.022, 0.018, 0.03}}, 0.015);  // nostrils
  for (int i = 0; i < 3; ++i) {  // wrinkles across the snout
    const double z = 0.60 + 0.05 * i;
    s.add(tube({{{-0.10, 1.33 - 0.01 * i, z - 0.03}, 0.012},
                {{0, 1.40 - 0.025 * i, z}, 0.02},
                {{0.10, 1.33 - 0.01 * i, z - 0.03}, 0.012}},
               3),
          0.015);
  }
  s.add(tube({{{0, 1.02, 0.66}, 0.05}, {{0, 0.95, 0.72}, 0.03}, {{0, 0.90, 0.75}, 0.010}}, 3),
        0.03);
}

void add_eyes(Sculpture& s) {
  s.carve_pair(Ellipsoid{{0.125, 1.405, 0.62}, {0.065, 0.05, 0.07}}, 0.03);
  s.add_pair(Ellipsoid{{0.112, 1.40, 0.565}, {0.048, 0.042, 0.045}}, 0.008);
  // The brows slant down to the nose: that is what makes it scowl.
  s.add_pair(tube({{{0.025, 1.405, 0.655}, 0.04},
                   {{0.10, 1.46, 0.63}, 0.045},
                   {{0.20, 1.52, 0.52}, 0.035},
                   {{0.25, 1.56, 0.44}, 0.012}}),
             0.02);
  s.add_pair(
      tube({{{0.08, 1.33, 0.62}, 0.02}, {{0.16, 1.34, 0.57}, 0.035}, {{0.21, 1.38, 0.45}, 0.035}}),
      0.025);  // cheek bones
}

void add_horns_and_ears(Sculpture& s) {
  s.add_pair(tube({{{0.11, 1.50, 0.44}, 0.080},
                   {{0.18, 1.66, 0.36}, 0.070},
                   {{0.28, 1.82, 0.24}, 0.056},
                   {{0.36, 1.98, 0.22}, 0.038},
                   {{0.38, 2.12, 0.30}, 0.012}}),
             0.03);
  const Tube course = tube({{{0.12, 1.53, 0.425}, 0.079},
                            {{0.18, 1.66, 0.36}, 0.070},
                            {{0.28, 1.82, 0.24}, 0.056},
                            {{0.34, 1.93, 0.215}, 0.045}},
                           3);
  for (std::size_t i = 1; i + 1 < course.points.size(); ++i) {  // rings around the horns
    const Vec3 along = (course.points[i + 1] - course.points[i - 1]).normalized();
    s.add_pair(Ellipsoid{course.points[i],
                         {0.016, course.radii[i] + 0.012, course.radii[i] + 0.012},
                         frame(along, {0, 0, 1})},
               0.015);
  }
  // Ears like a bat's, hollow in front.
  const Vec3 out = Vec3(1, 0.42, -0.35).normalized();
  const Vec3 front(0.15, 0.1, 1);
  const Eigen::Matrix3d axes = frame(out, front);
  const Vec3 root(0.19, 1.38, 0.34);
  s.add_pair(Ellipsoid{root + 0.13 * out, {0.20, 0.05, 0.105}, axes}, 0.03);
  s.add_pair(
      tube({{root + 0.22 * out, 0.055}, {root + 0.32 * out, 0.032}, {root + 0.42 * out, 0.010}}, 2),
      0.04);
  s.carve_pair(Ellipsoid{root + 0.16 * out + Vec3(0, 0, 0.05), {0.15, 0.045, 0.065}, axes}, 0.02);
}

void add_head(Sculpture& s) {
  s.add(tube({{{0, 1.00, 0.02}, 0.24}, {{0, 1.16, 0.18}, 0.19}, {{0, 1.30, 0.36}, 0.17}}), 0.08);
  s.add(Ellipsoid{{0, 1.38, 0.42}, {0.205, 0.19, 0.225}}, 0.06);
  add_face(s);
  add_eyes(s);
  add_horns_and_ears(s);
}

/// Weathered stone: shallow pits over a fine grain. Fades where the grid is too coarse for it.
void weather(Sculpture& s) {
  const double fine = 1 - smooth_step(0.012, 0.035, s.spacing());
  if (fine <= 0) return;
  const double height = 0.006 * fine;
  s.set_detail(
      [height](const Vec3& p) {
        const double pits = gradient_noise(8 * p, 11);
        return height * (0.6 * fractal_noise(22 * p, 2, 5) - (pits > 0.2 ? 2 * (pits - 0.2) : 0));
      },
      1.6 * height);
}

Sculpture carve_gargoyle(double spacing) {
  Sculpture s(spacing);
  add_plinth(s);
  add_torso(s);
  add_limbs(s);
  add_tail(s);
  add_wings(s);
  add_head(s);
  weather(s);
  return s;
}

}  // namespace

Result<DraftMesh> make_gargoyle(Index faces, const Progress& progress) {
  return sculpt({carve_gargoyle, {-1.7, -0.45, -1.3}, {1.7, 2.6, 1.3}, 22.4}, faces, progress);
}

}  // namespace geotherm::generate
