// SPDX-License-Identifier: MIT
#include "solver/geometry/intrinsic_mesh.h"

#include <algorithm>
#include <cmath>

#include "solver/core/parallel.h"

namespace geotherm {
namespace {

/// Minimum edges per thread.
constexpr std::int64_t kGrain = 1 << 14;

/// Four times the area by Kahan's formula, which stays accurate for needles: a >= b >= c.
double four_areas(double a, double b, double c) {
  if (a < b) std::swap(a, b);
  if (b < c) std::swap(b, c);
  if (a < b) std::swap(a, b);
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return std::sqrt(std::max(product, 0.0));
}

}  // namespace

double mean_edge_length(std::span<const Vec3> positions, const EdgeTable& edges, int threads) {
  const Index count = edges.edge_count();
  const double sum = parallel_sum(threads, count, [&](std::int64_t begin, std::int64_t end) {
    double part = 0;
    for (auto e = static_cast<Index>(begin); e < static_cast<Index>(end); ++e) {
      part += safe_norm(positions[edges.low(e)] - positions[edges.high(e)]);
    }
    return part;
  });
  return count > 0 ? sum / count : 0.0;
}

IntrinsicMesh build_intrinsic_mesh(std::span<const Vec3> positions, const CleanFaces& clean,
                                   double unit, int threads) {
  IntrinsicMesh mesh;
  mesh.unit = unit;
  mesh.faces = clean.faces;
  mesh.lengths.resize(mesh.faces.size());
  mesh.twin.resize(3 * mesh.faces.size());
  const EdgeTable& edges = clean.edges;
  parallel_for(threads, edges.edge_count(), kGrain, [&](std::int64_t begin, std::int64_t end) {
    for (auto e = static_cast<Index>(begin); e < static_cast<Index>(end); ++e) {
      // One value for all sides of an edge: they must agree to the last bit.
      const double length = ((positions[edges.low(e)] - positions[edges.high(e)]) / unit).norm();
      const auto sides = edges.sides(e);
      const bool twins = sides.size() == 2 && sides_agree(mesh.faces, sides[0], sides[1]);
      for (std::size_t i = 0; i < sides.size(); ++i) {
        mesh.lengths[face_of(sides[i])][corner_of(sides[i])] = length;
        mesh.twin[sides[i]] = twins ? sides[1 - i] : kNoSide;
      }
    }
  });
  mesh.mollified = mollify(mesh.lengths, clean, threads);
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
