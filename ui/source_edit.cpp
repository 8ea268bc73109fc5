// SPDX-License-Identifier: MIT
#include "ui/source_edit.h"

#include <algorithm>
#include <limits>

#include "app/session/sources.h"

namespace geotherm::ui {

app::SourceSpec source_at(const SurfacePoint& point) {
  if (point.is_vertex()) return app::VertexList{{point.vertex}};
  return app::FacePoint{point.face, point.weights};
}

std::optional<SurfacePoint> surface_point(const app::FacePoint& point, Index faces) {
  if (point.face < 0 || point.face >= faces) return std::nullopt;
  return SurfacePoint::in_face(point.face, point.weights);
}

Index nearest_corner(const TriangleMesh& mesh, const SurfacePoint& point) {
  if (point.is_vertex()) return point.vertex;
  const Vec3 position = position_at(mesh, point);
  const Face& face = mesh.faces()[point.face];
  return *std::min_element(face.begin(), face.end(), [&](Index a, Index b) {
    return (mesh.positions()[a] - position).squaredNorm() <
           (mesh.positions()[b] - position).squaredNorm();
  });
}

bool is_movable(const app::Explored& explored, const app::SourcePlace& place) {
  if (place.alone) return true;
  const app::SourceSpec& source = explored.sources[place.entry];
  return !std::holds_alternative<app::WholeBoundary>(source) &&
         !std::holds_alternative<app::VertexCurve>(source);
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
