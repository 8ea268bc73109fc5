// SPDX-License-Identifier: MIT
#include "app/lines/visible_lines.h"

#include <Eigen/Geometry>

#include "solver/geometry/clean_faces.h"

namespace geotherm::app {
namespace {

/// What lies before a point by less than this, in radii of the model, is the surface it lies on.
constexpr double kOnSurface = 4e-3;

}  // namespace

bool LineSight::sees(const Vec3& point) const {
  const LineView::Ray ray = view_.ray_to(point);
  const auto hit = tree_.first_hit(ray.origin, ray.direction);
  return !hit || (1 - hit->distance) * ray.direction.stableNorm() < kOnSurface * view_.radius();
}

Vec3 LineSight::last_seen(Vec3 seen, Vec3 hidden) const {
  constexpr int kHalvings = 5;
  for (int i = 0; i < kHalvings; ++i) {
    const Vec3 middle = seen / 2 + hidden / 2;
    (sees(middle) ? seen : hidden) = middle;
  }
  return seen;
}

std::vector<Outline> LineSight::visible_parts(std::span<const Vec3> points) const {
  std::vector<Outline> out;
  bool before = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool now = sees(points[i]);
    if (now && !before) {
      out.emplace_back();
      if (i > 0) out.back().push_back(view_.project(last_seen(points[i], points[i - 1])));
    }
    if (now) out.back().push_back(view_.project(points[i]));
    if (!now && before) out.back().push_back(view_.project(last_seen(points[i - 1], points[i])));
    before = now;
  }
  return out;
}

std::vector<Outline> visible_contours(const TriangleMesh& mesh, const LineSight& sight,
                                      const LineView& view) {
  const CleanFaces clean = clean_faces(mesh);
  const auto at = [&mesh](Index v) -> const Vec3& { return mesh.positions()[v]; };
  std::vector<char> faces_eye;
  for (const auto& [a, b, c] : clean.faces) {
    const Vec3 normal = ((at(b) - at(a)) / view.radius()).cross((at(c) - at(a)) / view.radius());
    faces_eye.push_back(static_cast<char>(normal.dot(view.ray_to(at(a)).direction) < 0));
  }
  std::vector<Outline> out;
  for (Index e = 0; e < clean.edges.edge_count(); ++e) {
    const auto sides = clean.edges.sides(e);
    const bool inner = sides.size() == 2;
    if (inner) {
      const Index f = face_of(sides[0]), g = face_of(sides[1]);
      const bool same_way = clean.faces[f][corner_of(sides[0])] !=
                            clean.faces[g][corner_of(sides[1])];  // or on a Moebius strip
      if (!same_way || faces_eye[f] == faces_eye[g]) continue;
    }
    const Vec3 ends[] = {at(clean.edges.low(e)), at(clean.edges.high(e))};
    if (!sight.sees(ends[0] / 2 + ends[1] / 2)) continue;
    out.push_back({view.project(ends[0]), view.project(ends[1])});
  }
  return out;
}

}  // namespace geotherm::app
