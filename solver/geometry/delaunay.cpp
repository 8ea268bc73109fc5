// SPDX-License-Identifier: MIT
#include "solver/geometry/delaunay.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/core/parallel.h"
#include "solver/geometry/flip_diamond.h"

namespace geotherm {
namespace {

/// Cotangent sums down to this are accepted. Cocircular corners, as in every mesh of rectangles,
/// would flip to and fro, and as rounding of the coordinates (1e-7 of an edge for a model that
/// stands a million sizes away) would have it.
constexpr double kTolerance = 1e-6;

/// Flips between two calls of progress: a few milliseconds.
constexpr std::size_t kFlipsBetweenCalls = 1 << 14;

double weight(const IntrinsicMesh& mesh, Side side) {
  const Side other = mesh.twin[side];
  return opposite_cotangent(mesh.lengths[face_of(side)], corner_of(side)) +
         opposite_cotangent(mesh.lengths[face_of(other)], corner_of(other));
}

void set_face(IntrinsicMesh& mesh, Index f, const Face& corners,
              const std::array<double, 3>& lengths, const std::array<Side, 3>& twins) {
  mesh.faces[f] = corners;
  mesh.lengths[f] = lengths;
  for (int k = 0; k < 3; ++k) {
    mesh.twin[3 * f + k] = twins[k];
    if (twins[k] != kNoSide) mesh.twin[twins[k]] = 3 * f + k;
  }
}

Flip flip(IntrinsicMesh& mesh, Side side) {
  const Side other = mesh.twin[side];
  const Index f = face_of(side);
  const Index g = face_of(other);
  const int i = corner_of(side);
  const int j = corner_of(other);
  const Index a = mesh.faces[f][i];
  const Index b = mesh.faces[g][j];
  const Index c = mesh.faces[f][previous_corner(i)];
  const Index d = mesh.faces[g][previous_corner(j)];
  const auto& lf = mesh.lengths[f];
  const auto& lg = mesh.lengths[g];
  Flip out{f,
           g,
           static_cast<std::int8_t>(i),
           static_cast<std::int8_t>(j),
           {lf[i], lf[next_corner(i)], lf[previous_corner(i)], lg[next_corner(j)],
            lg[previous_corner(j)]}};
  const FlipDiamond diamond = unfold(out.lengths);
  const double cd = (diamond.c - diamond.d).norm();
  const auto [ab, bc, ca, ad, db] = out.lengths;

  // A twin may be a side of these two faces themselves; then it moves with the flip.
  const Side old_bc = 3 * f + next_corner(i);
  const Side old_ca = 3 * f + previous_corner(i);
  const Side old_ad = 3 * g + next_corner(j);
  const Side old_db = 3 * g + previous_corner(j);
  const auto moved = [&](Side s) {
    if (s == old_ca) return Side{3 * f};
    if (s == old_ad) return Side{3 * f + 1};
    if (s == old_db) return Side{3 * g};
    if (s == old_bc) return Side{3 * g + 1};
    return s;
  };
  const Side twin_bc = moved(mesh.twin[old_bc]);
  const Side twin_ca = moved(mesh.twin[old_ca]);
  const Side twin_ad = moved(mesh.twin[old_ad]);
  const Side twin_db = moved(mesh.twin[old_db]);
  set_face(mesh, f, {c, a, d}, {ca, ad, cd}, {twin_ca, twin_ad, 3 * g + 2});
  set_face(mesh, g, {d, b, c}, {db, bc, cd}, {twin_db, twin_bc, 3 * f + 2});
  return out;
}

}  // namespace

std::vector<Side> non_delaunay_sides(const IntrinsicMesh& mesh, int threads) {
  constexpr std::int64_t kGrain = 1 << 15;  // sides a thread must have to be worth starting
  const auto count = static_cast<std::int64_t>(mesh.twin.size());
  const int pieces = piece_count(threads, count, kGrain);
  std::vector<std::vector<Side>> found(static_cast<std::size_t>(pieces));
  for_pieces(pieces, count, [&](int piece, std::int64_t begin, std::int64_t end) {
    for (auto side = static_cast<Side>(begin); side < static_cast<Side>(end); ++side) {
      const Side other = mesh.twin[side];
      if (other <= side) continue;
      // Two angles of at most 90 degrees, as at most edges: their cotangents need not be known.
      const bool in_doubt = may_be_obtuse(mesh.lengths[face_of(side)], corner_of(side)) ||
                            may_be_obtuse(mesh.lengths[face_of(other)], corner_of(other));
      if (in_doubt && weight(mesh, side) < -kTolerance) {
        found[static_cast<std::size_t>(piece)].push_back(side);
      }
    }
  });
  std::vector<Side> sides = std::move(found.front());
  for (std::size_t p = 1; p < found.size(); ++p) {
    sides.insert(sides.end(), found[p].begin(), found[p].end());
  }
  return sides;
}

Index count_non_delaunay(const IntrinsicMesh& mesh, int threads) {
  return static_cast<Index>(non_delaunay_sides(mesh, threads).size());
}

Result<std::vector<Flip>> flip_to_delaunay(IntrinsicMesh& mesh, const Progress& progress) {
  return flip_to_delaunay(mesh, non_delaunay_sides(mesh), progress);
}

Result<std::vector<Flip>> flip_to_delaunay(IntrinsicMesh& mesh, std::vector<Side> queue,
                                           const Progress& progress) {
  std::vector<Flip> flips;
  // Each flip lowers the Dirichlet energy, so the loop ends; the bound guards against round-off.
  const std::size_t most = 100 * mesh.twin.size() + 1000;
  while (!queue.empty() && flips.size() < most) {
    const Side side = queue.back();
    queue.pop_back();
    const Side other = mesh.twin[side];
    if (other == kNoSide || face_of(other) == face_of(side)) continue;
    if (!(weight(mesh, side) < -kTolerance)) continue;
    if (flips.size() % kFlipsBetweenCalls == 0 && !report(progress, "operators", 0.0)) {
      return cancelled_error();
    }
    const Flip made = flip(mesh, side);
    flips.push_back(made);
    for (const Index face : {made.f, made.g}) {
      for (int k = 0; k < 2; ++k) queue.push_back(3 * face + k);
    }
  }
  return flips;
}

SurfacePoint carry_through_flips(const std::vector<Flip>& flips, SurfacePoint point) {
  for (const Flip& flip : flips) {
    if (point.face != flip.f && point.face != flip.g) continue;
    const bool in_f = point.face == flip.f;
    const int start = in_f ? flip.start_f : flip.start_g;
    const FlipDiamond q = unfold(flip.lengths);
    const double w0 = point.weights[start];
    const double w1 = point.weights[next_corner(start)];
    const double w2 = point.weights[previous_corner(start)];
    const Eigen::Vector2d p = in_f ? Eigen::Vector2d(w0 * q.a + w1 * q.b + w2 * q.c)
                                   : Eigen::Vector2d(w0 * q.b + w1 * q.a + w2 * q.d);
    const bool side_of_a = cross(q.c - q.d, p - q.d) >= 0;
    point.face = side_of_a ? flip.f : flip.g;
    point.weights =
        side_of_a ? clipped_weights(q.c, q.a, q.d, p) : clipped_weights(q.d, q.b, q.c, p);
  }
  return point;
}

}  // namespace geotherm
