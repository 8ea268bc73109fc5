// SPDX-License-Identifier: MIT
#include "solver/geometry/delaunay.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "solver/core/parallel.h"
#include "solver/geometry/edit.h"

namespace geotherm {
namespace {

/// Cotangent sums down to this are accepted. Cocircular corners, as in every mesh of rectangles,
/// would otherwise flip back and forth, driven by the rounding of the coordinates (1e-7 of an edge
/// for a model that stands a million of its sizes away from the origin). Large cotangents are those
/// of flat triangles, known to 1e-7 where these are 1e-5 of their longest side high.
constexpr double kFlipTolerance = 1e-6;

/// Flips between two calls of progress: a few milliseconds.
constexpr std::size_t kFlipsBetweenCalls = 1 << 14;

bool is_delaunay(const IntrinsicMesh& mesh, Side side) {
  const Side other = mesh.twin[side];
  const double a = opposite_cotangent(mesh.lengths[face_of(side)], corner_of(side));
  const double b = opposite_cotangent(mesh.lengths[face_of(other)], corner_of(other));
  return a + b >= -kFlipTolerance * std::max({1.0, std::abs(a), std::abs(b)});
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

/// Takes a side from the queue and flips its edge if that is not Delaunay; returns whether it did.
bool flip_next(IntrinsicMesh& mesh, std::vector<Side>& queue, std::vector<Edit>& edits) {
  const Side side = queue.back();
  queue.pop_back();
  const Side other = mesh.twin[side];
  if (other == kNoSide || face_of(other) == face_of(side)) return false;
  if (is_delaunay(mesh, side)) return false;
  const Edit made = flip(mesh, side);
  edits.push_back(made);
  for (const Index face : {made.f, made.g}) {
    for (int k = 0; k < 2; ++k) queue.push_back(3 * face + k);
  }
  return true;
}

Index add_faces(IntrinsicMesh& mesh, int count) {
  const Index first = mesh.face_count();
  mesh.faces.resize(mesh.faces.size() + static_cast<std::size_t>(count));
  mesh.lengths.resize(mesh.faces.size());
  mesh.twin.resize(3 * mesh.faces.size(), kNoSide);
  return first;
}

/// A face that a vertex p on its side ab cuts in two: it becomes (a, p, c), `fresh` (p, b, c).
struct SideCut {
  Index face, fresh;
  int start;  ///< the corner that is a
  Index a, b, c;
  double share;  ///< |ap| / |ab|
  double ap, pb, bc, ca, cp;
  Side old_bc, old_ca, twin_bc = kNoSide, twin_ca = kNoSide;

  SideCut(const IntrinsicMesh& mesh, Side side, double at, Index fresh_face)
      : face(face_of(side)), fresh(fresh_face), start(corner_of(side)), share(at) {
    const int i = start, j = next_corner(i), k = previous_corner(i);
    a = mesh.faces[face][i];
    b = mesh.faces[face][j];
    c = mesh.faces[face][k];
    const auto& l = mesh.lengths[face];
    const FaceLayout p = lay_out({l[i], l[j], l[k]});
    ap = share * l[i];
    pb = (1 - share) * l[i];
    bc = l[j];
    ca = l[k];
    cp = std::hypot(p.x - ap, p.height);
    old_bc = 3 * face + j;
    old_ca = 3 * face + k;
  }
};

}  // namespace

std::vector<Side> non_delaunay_sides(const IntrinsicMesh& mesh, int threads) {
  constexpr std::int64_t kGrain = 1 << 15;  // minimum sides per thread
  const auto list = [&mesh](std::int64_t begin, std::int64_t end, std::vector<Side>& found) {
    for (auto side = static_cast<Side>(begin); side < static_cast<Side>(end); ++side) {
      const Side other = mesh.twin[side];
      if (other <= side) continue;
      // Two angles of at most 90 degrees, as at most edges: their cotangents need not be known.
      const bool in_doubt = may_be_obtuse(mesh.lengths[face_of(side)], corner_of(side)) ||
                            may_be_obtuse(mesh.lengths[face_of(other)], corner_of(other));
      if (in_doubt && !is_delaunay(mesh, side)) found.push_back(side);
    }
  };
  return list_in_parallel<Side>(threads, std::ssize(mesh.twin), kGrain, list);
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

std::vector<Side> split_side(IntrinsicMesh& mesh, Side side, double share, Index vertex,
                             std::vector<Edit>& edits) {
  const Side other = mesh.twin[side];
  const bool inner = other != kNoSide;
  const Index first = add_faces(mesh, inner ? 2 : 1);
  std::vector<SideCut> cuts{SideCut(mesh, side, share, first)};
  if (inner) {
    SideCut& beyond = cuts.emplace_back(mesh, other, 1 - share, first + 1);
    beyond.ap = cuts[0].pb;  // to the last bit
    beyond.pb = cuts[0].ap;
  }
  // A twin may be a side of the two faces themselves, which moves with the cut.
  const auto moved = [&](Side s) {
    for (const SideCut& cut : cuts) {
      if (s == cut.old_bc) return Side{3 * cut.fresh + 1};
      if (s == cut.old_ca) return Side{3 * cut.face + 2};
    }
    return s;
  };
  for (SideCut& cut : cuts) {
    cut.twin_bc = moved(mesh.twin[cut.old_bc]);
    cut.twin_ca = moved(mesh.twin[cut.old_ca]);
  }
  std::vector<Side> around;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const SideCut& cut = cuts[i];
    const Side beyond_ap = inner ? 3 * cuts[1 - i].fresh : kNoSide;
    const Side beyond_pb = inner ? 3 * cuts[1 - i].face : kNoSide;
    mesh.set_face(cut.face, {cut.a, vertex, cut.c}, {cut.ap, cut.cp, cut.ca},
                  {beyond_ap, 3 * cut.fresh + 2, cut.twin_ca});
    mesh.set_face(cut.fresh, {vertex, cut.b, cut.c}, {cut.pb, cut.bc, cut.cp},
                  {beyond_pb, cut.twin_bc, 3 * cut.face + 1});
    edits.push_back({cut.face,
                     cut.fresh,
                     Edit::Kind::kSideSplit,
                     static_cast<std::int8_t>(cut.start),
                     static_cast<std::int8_t>(i),
                     {cut.share}});
    around.push_back(3 * cut.face + 2);
    around.push_back(3 * cut.fresh + 1);
  }
  return around;
}

std::vector<Side> split_face(IntrinsicMesh& mesh, Index face, const std::array<double, 3>& weights,
                             Index vertex, std::vector<Edit>& edits) {
  const Face corners = mesh.faces[face];
  const auto lengths = mesh.lengths[face];
  const FaceLayout q = lay_out(lengths);
  using Point2 = Eigen::Vector2d;
  const std::array<Point2, 3> at = {Point2(0, 0), Point2(q.base, 0), Point2(q.x, q.height)};
  const Point2 place = weights[0] * at[0] + weights[1] * at[1] + weights[2] * at[2];
  std::array<double, 3> to{};
  for (int k = 0; k < 3; ++k) to[k] = (place - at[k]).norm();
  const Index first = add_faces(mesh, 2);
  const std::array<Index, 3> part = {face, first, first + 1};  // at side k of the face
  std::array<Side, 3> outer{};
  for (int k = 0; k < 3; ++k) {
    const Side twin = mesh.twin[3 * face + k];
    const bool own = twin != kNoSide && face_of(twin) == face;
    outer[k] = own ? Side{3 * part[corner_of(twin)]} : twin;
  }
  edits.push_back(
      {face, first, Edit::Kind::kFaceSplit, 0, 0, {weights[0], weights[1], weights[2]}});
  std::vector<Side> around;
  for (int k = 0; k < 3; ++k) {
    const int next = next_corner(k), previous = previous_corner(k);
    mesh.set_face(part[k], {corners[k], corners[next], vertex}, {lengths[k], to[next], to[k]},
                  {outer[k], 3 * part[next] + 2, 3 * part[previous] + 1});
    around.push_back(3 * part[k]);
  }
  return around;
}

}  // namespace geotherm
