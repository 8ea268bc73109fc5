// SPDX-License-Identifier: MIT
#include "ui/source_edit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/session/sources.h"

namespace geotherm::ui {

app::SourceSpec source_at(const SurfacePoint& point) {
  if (point.is_vertex()) return app::VertexList{{point.vertex}};
  return app::FacePoint{point.face, point.weights};
}

app::FacePoint short_point(const SurfacePoint& point) {
  constexpr long kParts = 1000;
  const long a = std::lround(point.weights[0] * kParts);
  const long b = std::min(std::lround(point.weights[1] * kParts), kParts - a);
  const auto part = [](long parts) { return static_cast<double>(parts) / kParts; };
  return {point.face, {part(a), part(b), part(kParts - a - b)}};
}

std::optional<SurfacePoint> surface_point(const app::FacePoint& point, Index faces) {
  if (point.face < 0 || point.face >= faces) return std::nullopt;
  return SurfacePoint::in_face(point.face, point.weights);
}

bool is_movable(const app::Explored& explored, const app::SourcePlace& place) {
  if (place.alone) return true;
  const app::SourceSpec& source = explored.sources[place.entry];
  return !std::holds_alternative<app::WholeBoundary>(source) &&
         !std::holds_alternative<app::VertexCurve>(source) &&
         !std::holds_alternative<app::SurfaceCurve>(source);
}

Apart taken_apart(const app::Explored& explored, std::size_t place) {
  const int entry = explored.places[place].entry;
  Apart apart;
  for (int i = 0; i < static_cast<int>(explored.sources.size()); ++i) {
    if (i != entry) {
      apart.sources.push_back(explored.sources[i]);
      continue;
    }
    for (std::size_t k = 0; k < explored.places.size(); ++k) {
      if (explored.places[k].entry != entry) continue;
      if (k == place) apart.entry = static_cast<int>(apart.sources.size());
      apart.sources.push_back(source_at(explored.places[k].point));
    }
  }
  return apart;
}

app::Command removal(const app::Explored& explored, std::size_t place) {
  const app::SourcePlace& gone = explored.places[place];
  if (gone.alone || !is_movable(explored, gone)) return app::command::RemoveSource{gone.entry};
  Apart apart = taken_apart(explored, place);
  apart.sources.erase(apart.sources.begin() + apart.entry);
  if (apart.sources.empty()) return app::command::ClearSources{};
  return app::command::SetSources{std::move(apart.sources)};
}

std::optional<std::size_t> nearest_place(const app::Explored& explored, const Vec3& position) {
  std::optional<std::size_t> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < explored.places.size(); ++i) {
    const double distance = (explored.places[i].position - position).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

}  // namespace geotherm::ui
