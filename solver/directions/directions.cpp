// SPDX-License-Identifier: MIT
#include "geotherm/directions.h"

#include <Eigen/Geometry>
#include <cmath>
#include <new>
#include <numbers>
#include <string>

#include "solver/directions/directions_state.h"
#include "solver/geometry/face_gradient.h"

namespace geotherm {
namespace {

/// The axes with this normal whose first is nearest to `along`.
void set_axes(TangentFrame& frame, const Vec3& normal, const Vec3& along) {
  frame.normal = normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3::UnitZ();
  const Vec3 flat = along - along.dot(frame.normal) * frame.normal;
  constexpr double kAlongNormal = 1e-12;
  frame.e1 = flat.norm() > kAlongNormal * along.norm() ? Vec3(flat.normalized())
                                                       : frame.normal.unitOrthogonal();
  frame.e2 = frame.normal.cross(frame.e1);
}

}  // namespace

Vec3 TangentFrame::vector(double direction, double length) const {
  return length * (std::cos(direction) * e1 + std::sin(direction) * e2);
}

Directions::Directions(std::unique_ptr<const State> state) : state_(std::move(state)) {}
Directions::~Directions() = default;

Result<std::shared_ptr<const Directions>> Directions::build(
    std::shared_ptr<const TriangleMesh> mesh, const Progress& progress) try {
  auto base = build_intrinsic_surface(mesh, {.strictness = Strictness::kHeights},
                                      part_of(progress, 0, 0.5));
  if (!base) return base.error();
  auto waves = build_wave_surface(std::make_shared<const IntrinsicSurface>(*std::move(base)),
                                  part_of(progress, 0.5, 1));
  if (!waves) return waves.error();
  auto state = std::make_unique<const State>(std::move(mesh), *std::move(waves));
  return std::shared_ptr<const Directions>(new Directions(std::move(state)));
} catch (const std::bad_alloc&) {
  return directions_out_of_memory(mesh ? mesh->face_count() : 0);
}

Result<SurfacePoint> Directions::State::point(const SurfacePoint& given) const {
  SourceSet set;
  set.points.push_back(given);
  if (auto valid = check_sources(surface->base, set); !valid) return valid.error();
  const SurfacePoint clean = clean_point(surface->base, given);
  if (clean.is_vertex() && fans.vertex(clean.vertex).kind == TangentFans::Kind::kSplit) {
    return Error{ErrorCode::kBadInput,
                 "the faces at vertex " + std::to_string(clean.vertex) +
                     " are no single fan, so that directions there have no order",
                 {"choose another point"}};
  }
  return clean;
}

StartDirections::Turn Directions::State::face_turn(Index f) const {
  const Face& listed = paths.mesh()->faces()[paths.file_face(f)];
  const auto at = layout(f);
  const int first = paths.corner_of_vertex(f, paths.mesh()->standing_for(listed[0]));
  const int second = paths.corner_of_vertex(f, paths.mesh()->standing_for(listed[1]));
  const double along = angle_of(at[second] - at[first]);
  const bool mirrored = second != next_corner(first);
  return {mirrored ? along : -along, mirrored};
}

TangentFrame Directions::State::frame_at(const SurfacePoint& clean) const {
  const auto positions = paths.mesh()->positions();
  TangentFrame frame;
  frame.angle = 2 * std::numbers::pi;
  if (!clean.is_vertex()) {
    const Face& face = paths.mesh()->faces()[paths.file_face(clean.face)];
    const Vec3 &a = positions[face[0]], &b = positions[face[1]], &c = positions[face[2]];
    set_axes(frame, unit_normal(a, b, c), (b - a).stableNormalized());
    return frame;
  }
  const auto& vertex = fans.vertex(clean.vertex);
  frame.angle = vertex.angle;
  frame.on_boundary = vertex.kind == TangentFans::Kind::kBoundary;
  // Corners without an order begin with any one; those of no face have none.
  const auto corners = fans.corners_at(clean.vertex);
  if (corners.empty()) return frame;
  frame.first = fans.first_end(vertex.first != kNoSide ? vertex.first : corners.front());
  Vec3 normal = Vec3::Zero();
  for (const Side c : corners) {
    const Face& face = paths.face(face_of(c));
    const Vec3 own = unit_normal(positions[face[0]], positions[face[1]], positions[face[2]]);
    normal += (fans.corner(c).against ? -1 : 1) * fans.corner(c).angle * own;
  }
  const Vec3 along = positions[frame.first] - positions[clean.vertex];
  set_axes(frame, normal, along.stableNormalized());
  return frame;
}

Result<TangentFrame> Directions::frame_at(const SurfacePoint& point) const {
  const auto clean = state_->point(point);
  if (!clean) return clean.error();
  return state_->frame_at(*clean);
}

}  // namespace geotherm
