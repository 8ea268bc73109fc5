// SPDX-License-Identifier: MIT
#include "solver/directions/tangent_fans.h"

#include <cmath>

#include "solver/polyhedral/window_mesh.h"

namespace geotherm {
namespace {

double corner_angle(const IntrinsicMesh& mesh, Side corner) {
  const auto& l = mesh.lengths[static_cast<std::size_t>(face_of(corner))];
  const int k = corner_of(corner);
  const FaceLayout p = lay_out({l[k], l[next_corner(k)], l[previous_corner(k)]});
  return std::atan2(p.height, p.x);
}

}  // namespace

TangentFans::TangentFans(const WaveSurface& surface)
    : surface_(surface),
      table_(surface.base.mesh->vertex_count(), surface.base.intrinsic.faces),
      corners_(3 * surface.base.intrinsic.faces.size()),
      vertices_(static_cast<std::size_t>(surface.base.mesh->vertex_count())) {
  for (Side c = 0; c < static_cast<Side>(corners_.size()); ++c) {
    corners_[static_cast<std::size_t>(c)].angle = corner_angle(surface.base.intrinsic, c);
  }
  for (Index v = 0; v < surface.base.mesh->vertex_count(); ++v) find_fan(v);
}

Index TangentFans::first_end(Side c) const {
  const Face& face = surface_.base.intrinsic.faces[static_cast<std::size_t>(face_of(c))];
  return corner(c).against ? face[previous_corner(corner_of(c))] : face[next_corner(corner_of(c))];
}

Side TangentFans::corner_at(Index v, double angle) const {
  const Vertex& at = vertex(v);
  if (at.kind == Kind::kInner) angle -= std::floor(angle / at.angle) * at.angle;
  constexpr double kRounding = 1e-12;
  if (angle < -kRounding || angle > at.angle + kRounding) return kNoSide;
  Side last = at.first;
  for (const Side c : corners_at(v)) {
    if (angle >= corner(c).begin && corner(c).begin >= corner(last).begin) last = c;
  }
  return last;
}

/// Where the boundary is, the fan begins there; orientation of its first face is that of the fan.
void TangentFans::find_fan(Index v) {
  const auto corners = corners_at(v);
  Vertex& at = vertices_[static_cast<std::size_t>(v)];
  if (corners.empty()) return;
  at.kind = Kind::kSplit;
  Side begin = kNoSide, end = kNoSide;
  for (const Side c : corners) {
    const auto faces = [&](Side s) { return surface_.sides_of(surface_.edge_of_side(s)).size(); };
    if (faces(c) > 2 || faces(previous_side(c)) > 2) return;
    if (faces(c) == 1 && begin == kNoSide) begin = c;
    if (faces(previous_side(c)) == 1 && end == kNoSide) end = c;
  }
  const bool open = begin != kNoSide || end != kNoSide;
  const Side start = begin != kNoSide ? begin : (open ? end : corners.front());
  at.first = start;
  if (walk(v, start, begin == kNoSide && open)) at.kind = open ? Kind::kBoundary : Kind::kInner;
}

/// Whether one way round the vertex meets all of its corners.
bool TangentFans::walk(Index v, Side start, bool against) {
  const auto& faces = surface_.base.intrinsic.faces;
  Vertex& at = vertices_[static_cast<std::size_t>(v)];
  std::size_t met = 0;
  for (Side c = start;;) {
    Corner& here = corners_[static_cast<std::size_t>(c)];
    here.begin = at.angle;
    here.against = against;
    at.angle += here.angle;
    if (++met > corners_at(v).size()) return false;
    const Side leave = against ? c : previous_side(c);
    const auto sides = surface_.sides_of(surface_.edge_of_side(leave));
    if (sides.size() != 2) break;
    const Side enter = sides[0] == leave ? sides[1] : sides[0];
    against = faces[static_cast<std::size_t>(face_of(enter))][corner_of(enter)] != v;
    c = against ? next_side(enter) : enter;
    if (c == start) break;
  }
  return met == corners_at(v).size();
}

}  // namespace geotherm
