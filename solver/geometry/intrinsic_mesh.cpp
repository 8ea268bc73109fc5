// SPDX-License-Identifier: MIT
#include "solver/geometry/intrinsic_mesh.h"

#include <algorithm>
#include <cmath>

namespace geotherm {
namespace {

/// Four times the area by Kahan's formula, which stays accurate for needles: a >= b >= c.
double four_areas(double a, double b, double c) {
  if (a < b) std::swap(a, b);
  if (b < c) std::swap(b, c);
  if (a < b) std::swap(a, b);
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return std::sqrt(std::max(product, 0.0));
}

}  // namespace

double mean_edge_length(std::span<const Vec3> positions, const EdgeTable& edges) {
  double sum = 0;
  for (Index e = 0; e < edges.edge_count(); ++e) {
    sum += (positions[edges.low(e)] - positions[edges.high(e)]).stableNorm();
  }
  return edges.edge_count() > 0 ? sum / edges.edge_count() : 0.0;
}

IntrinsicMesh build_intrinsic_mesh(std::span<const Vec3> positions, const CleanFaces& clean,
                                   double unit) {
  IntrinsicMesh mesh;
  mesh.unit = unit;
  mesh.faces = clean.faces;
  mesh.lengths.resize(mesh.faces.size());
  mesh.twin.assign(3 * mesh.faces.size(), kNoSide);
  for (Index e = 0; e < clean.edges.edge_count(); ++e) {
    // One value for all sides of an edge: they must agree to the last bit.
    const double length =
        ((positions[clean.edges.low(e)] - positions[clean.edges.high(e)]) / unit).norm();
    const auto sides = clean.edges.sides(e);
    for (const Side side : sides) mesh.lengths[face_of(side)][corner_of(side)] = length;
    if (sides.size() != 2 || !sides_agree(mesh.faces, sides[0], sides[1])) continue;
    mesh.twin[sides[0]] = sides[1];
    mesh.twin[sides[1]] = sides[0];
  }
  mesh.mollified = mollify(mesh.lengths, clean);
  return mesh;
}

FaceLayout lay_out(const std::array<double, 3>& l) {
  const double base = l[0];
  const double x = (base * base + (l[2] - l[1]) * (l[2] + l[1])) / (2 * base);
  return {base, x, four_areas(l[0], l[1], l[2]) / (2 * base)};
}

double opposite_cotangent(const std::array<double, 3>& l, int side) {
  const double a = l[side];
  const double b = l[next_corner(side)];
  const double c = l[previous_corner(side)];
  return (b * b + (c - a) * (c + a)) / four_areas(a, b, c);
}

}  // namespace geotherm
