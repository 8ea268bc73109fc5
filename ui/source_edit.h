// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "app/session/command.h"
#include "app/session/explored.h"

// What the mouse does to sources, without the mouse.
namespace geotherm::ui {

/// A point as a source.
app::SourceSpec source_at(const SurfacePoint& point);

/// The point of a model with so many faces; none: it does not lie on it.
std::optional<SurfacePoint> surface_point(const app::FacePoint& point, Index faces);

/// A point of a face with weights in thousandths: logs hold many of a curve or a stroke, and nobody
/// sees the rest.
app::FacePoint short_point(const SurfacePoint& point);

/// Whether the mouse can move a place: those of points, not those of curves and the boundary.
bool is_movable(const app::Explored& explored, const app::SourcePlace& place);

/// The sources with the entry of a place taken apart into its single places.
struct Apart {
  std::vector<app::SourceSpec> sources;
  int entry = 0;  ///< where the place is among them
};
/// Preconditions: `place` is an index into Explored::places; is_movable.
Apart taken_apart(const app::Explored& explored, std::size_t place);

/// Removes one place, and no other: a curve or the boundary as a whole. The same precondition.
app::Command removal(const app::Explored& explored, std::size_t place);

/// The place nearest to a position, if there is any.
std::optional<std::size_t> nearest_place(const app::Explored& explored, const Vec3& position);

}  // namespace geotherm::ui
