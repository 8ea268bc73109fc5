// SPDX-License-Identifier: MIT
#include "solver/directions/flipped_directions.h"

#include <cmath>

#include "solver/polyhedral/window_mesh.h"

namespace geotherm {
namespace {

double turn_between(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return std::atan2(cross(from, to), from.dot(to));
}

/// Angles at which sides begin, carried over a flip: those of the four outer sides stay, and the
/// new ones lie beside them.
void carry(const Edit& flip, std::vector<double>& begin) {
  const Side f = 3 * flip.f, g = 3 * flip.g;
  const int i = flip.start_f, j = flip.start_g;
  const double bc = begin[f + next_corner(i)], ca = begin[f + previous_corner(i)];
  const double ad = begin[g + next_corner(j)], db = begin[g + previous_corner(j)];
  const FlipDiamond at = unfold(flip.numbers);
  begin[f] = ca;
  begin[f + 1] = ad;
  begin[f + 2] = db + turn_between(at.b - at.d, at.c - at.d);  // from d to c
  begin[g] = db;
  begin[g + 1] = bc;
  begin[g + 2] = ca + turn_between(at.a - at.c, at.d - at.c);  // from c to d
}

}  // namespace

FlippedDirections flip_directions(const IntrinsicSurface& flipped, const TangentFans& fans) {
  FlippedDirections out;
  const IntrinsicMesh& mesh = flipped.intrinsic;
  const auto sides = static_cast<Side>(mesh.twin.size());
  out.at_begin.resize(static_cast<std::size_t>(sides));
  out.at_end.resize(out.at_begin.size());
  for (Side s = 0; s < sides; ++s) {
    const auto& corner = fans.corner(s);
    const Index v = flipped.kept->faces[face_of(s)][corner_of(s)];
    if (!out.broken && (corner.against || fans.vertex(v).kind == TangentFans::Kind::kSplit)) {
      out.broken = v;
    }
    out.at_begin[s] = corner.begin;
  }
  for (const Edit& flip : flipped.edits) carry(flip, out.at_begin);
  for (Index v = 0; v < flipped.mesh->vertex_count(); ++v) {
    out.scale.push_back(fans.vertex(v).scale());
  }
  for (Side s = 0; s < sides; ++s) {
    const Side twin = mesh.twin[s], next = next_side(s);
    if (twin != kNoSide) {
      out.at_end[s] = out.at_begin[twin];
      continue;
    }
    const auto& l = mesh.lengths[face_of(next)];
    const int k = corner_of(next);
    const FaceLayout p = lay_out({l[k], l[next_corner(k)], l[previous_corner(k)]});
    out.at_end[s] = out.at_begin[next] + std::atan2(p.height, p.x);
  }
  for (Side s = 0; s < sides; ++s) {
    const Face& face = mesh.faces[face_of(s)];
    out.at_begin[s] *= out.scale[face[corner_of(s)]];
    out.at_end[s] *= out.scale[face[next_corner(corner_of(s))]];
  }
  return out;
}

}  // namespace geotherm
