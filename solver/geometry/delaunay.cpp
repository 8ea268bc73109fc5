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

Edit flip(IntrinsicMesh& mesh, Side side) {
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
  Edit out{f,
           g,
           Edit::Kind::kFlip,
           static_cast<std::int8_t>(i),
           static_cast<std::int8_t>(j),
           {lf[i], lf[next_corner(i)], lf[previous_corner(i)], lg[next_corner(j)],
            lg[previous_corner(j)]}};
  const FlipDiamond diamond = unfold(out.numbers);
  const double cd = (diamond.c - diamond.d).norm();
  const auto [ab, bc, ca, ad, db] = out.numbers;

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
  mesh.set_face(f, {c, a, d}, {ca, ad, cd}, {twin_ca, twin_ad, 3 * g + 2});
  mesh.set_face(g, {d, b, c}, {db, bc, cd}, {twin_db, twin_bc, 3 * f + 2});
  return out;
}

/// Each flip lowers the Dirichlet energy, so that flipping ends; the bound guards against
/// round-off.
std::size_t most_flips(const IntrinsicMesh& mesh) { return 100 * mesh.twin.size() + 1000; }

/// Takes a side from the queue and flips its edge if that is not Delaunay. Whether it did.
bool flip_next(IntrinsicMesh& mesh, std::vector<Side>& queue, std::vector<Edit>& edits) {
  const Side side = queue.back();
  queue.pop_back();
  const Side other = mesh.twin[side];
  if (other == kNoSide || face_of(other) == face_of(side)) return false;
  if (!(weight(mesh, side) < -kTolerance)) return false;
  const Edit made = flip(mesh, side);
  edits.push_back(made);
  for (const Index face : {made.f, made.g}) {
    for (int k = 0; k < 2; ++k) queue.push_back(3 * face + k);
  }
  return true;
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

Result<std::vector<Edit>> flip_to_delaunay(IntrinsicMesh& mesh, const Progress& progress) {
  return flip_to_delaunay(mesh, non_delaunay_sides(mesh), progress);
}

Result<std::vector<Edit>> flip_to_delaunay(IntrinsicMesh& mesh, std::vector<Side> queue,
                                           const Progress& progress) {
  std::vector<Edit> flips;
  const std::size_t most = most_flips(mesh);
  for (std::size_t call = 0; !queue.empty() && flips.size() < most;) {
    if (!flip_next(mesh, queue, flips)) continue;
    if (++call % kFlipsBetweenCalls == 1 && !report(progress, "operators", 0.0)) {
      return cancelled_error();
    }
  }
  return flips;
}

bool restore_delaunay(IntrinsicMesh& mesh, std::vector<Side>& queue, std::vector<Edit>& edits) {
  const std::size_t most = edits.size() + most_flips(mesh);
  while (!queue.empty() && edits.size() < most) flip_next(mesh, queue, edits);
  return queue.empty();
}

}  // namespace geotherm
