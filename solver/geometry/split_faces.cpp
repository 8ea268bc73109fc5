// SPDX-License-Identifier: MIT
#include "solver/geometry/split_faces.h"

#include <Eigen/Core>
#include <cmath>
#include <span>

namespace geotherm {
namespace {

Index add_faces(IntrinsicMesh& mesh, int count) {
  const Index first = mesh.face_count();
  mesh.faces.resize(mesh.faces.size() + static_cast<std::size_t>(count));
  mesh.lengths.resize(mesh.faces.size());
  mesh.twin.resize(3 * mesh.faces.size(), kNoSide);
  return first;
}

/// A face that a vertex p on its side ab cuts in two: it becomes (a, p, c), `fresh` (p, b, c).
struct Cut {
  Index face, fresh;
  int start;  ///< the corner that is a
  Index a, b, c;
  double share;  ///< |ap| / |ab|
  double ap, pb, bc, ca, cp;
  Side old_bc, old_ca, twin_bc = kNoSide, twin_ca = kNoSide;

  Cut(const IntrinsicMesh& mesh, Side side, double at, Index fresh_face)
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

std::vector<Side> split_side(IntrinsicMesh& mesh, Side side, double share, Index vertex,
                             std::vector<Edit>& edits) {
  const Side other = mesh.twin[side];
  const bool inner = other != kNoSide;
  const Index first = add_faces(mesh, inner ? 2 : 1);
  std::vector<Cut> cuts{Cut(mesh, side, share, first)};
  if (inner) {
    Cut& beyond = cuts.emplace_back(mesh, other, 1 - share, first + 1);
    beyond.ap = cuts[0].pb;  // to the last bit
    beyond.pb = cuts[0].ap;
  }
  // A twin may be a side of the two faces themselves, which moves with the cut.
  const auto moved = [&](Side s) {
    for (const Cut& cut : cuts) {
      if (s == cut.old_bc) return Side{3 * cut.fresh + 1};
      if (s == cut.old_ca) return Side{3 * cut.face + 2};
    }
    return s;
  };
  for (Cut& cut : cuts) {
    cut.twin_bc = moved(mesh.twin[cut.old_bc]);
    cut.twin_ca = moved(mesh.twin[cut.old_ca]);
  }
  std::vector<Side> around;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const Cut& cut = cuts[i];
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
                     0,
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
