// SPDX-License-Identifier: MIT
#include "solver/mesh/generate/gargoyle_parts.h"

namespace geotherm::generate {
namespace {

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

}  // namespace

void add_head(Sculpture& s) {
  s.add(tube({{{0, 1.00, 0.02}, 0.24}, {{0, 1.16, 0.18}, 0.19}, {{0, 1.30, 0.36}, 0.17}}), 0.08);
  s.add(Ellipsoid{{0, 1.38, 0.42}, {0.205, 0.19, 0.225}}, 0.06);
  add_face(s);
  add_eyes(s);
  add_horns_and_ears(s);
}

}  // namespace geotherm::generate
