// SPDX-License-Identifier: MIT
#include "app/picture/surface_tones.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "geotherm/path.h"

namespace geotherm::app {
namespace {

using Eigen::Vector2d;

/// The tone of a grid point that shows no surface; all others are above it.
constexpr double kNothing = -1;

constexpr std::array kLevels = {-0.5, 0.45, 0.6, 0.72, 0.82, 0.9};

/// Pixels between grid points, so many grid points at most.
double step_for(int width, int height) {
  constexpr double kMaxPoints = 90000;
  return std::max(2.0, std::sqrt(width * static_cast<double>(height) / kMaxPoints));
}

std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> out(mesh.positions().size(), Vec3::Zero());
  for (const auto& [a, b, c] : mesh.faces()) {
    const Vec3 to_b = mesh.positions()[b] - mesh.positions()[a];
    const Vec3 to_c = mesh.positions()[c] - mesh.positions()[a];
    const double unit = std::max(to_b.cwiseAbs().maxCoeff(), to_c.cwiseAbs().maxCoeff());
    if (!(unit > 0)) continue;
    const Vec3 normal = (to_b / unit).cross(to_c / unit);
    for (const Index v : {a, b, c}) out[static_cast<std::size_t>(v)] += normal;
  }
  return out;
}

class Grid {
 public:
  Grid(const TriangleMesh& mesh, const RayTree& tree, const LineView& view, int width, int height)
      : mesh_(mesh),
        tree_(tree),
        view_(view),
        normals_(vertex_normals(mesh)),
        step_(step_for(width, height)),
        columns_(static_cast<Index>(std::ceil(width / step_)) + 3),
        rows_(static_cast<Index>(std::ceil(height / step_)) + 3) {
    light_ = (0.45 * view.up() - 0.35 * view.right() + view.back()).normalized();
  }

  Result<std::vector<Tone>> tones(const Progress& progress) {
    std::vector<Vec3> places;
    std::vector<double> values;
    for (Index j = 0; j < rows_; ++j) {
      if (!report(progress, "picture", static_cast<double>(j) / rows_)) return cancelled_error();
      for (Index i = 0; i < columns_; ++i) {
        const bool rim = i == 0 || j == 0 || i + 1 == columns_ || j + 1 == rows_;
        const Vector2d at = place(j * columns_ + i);
        places.emplace_back(at.x(), at.y(), 0);
        values.push_back(rim ? kNothing : brightness(at));
      }
    }
    auto grid = TriangleMesh::build(std::move(places), cells());
    if (!grid) return grid.error();
    std::vector<Tone> out;
    for (const double level : kLevels) out.push_back({std::max(level, 0.0), {}});
    const auto lines = find_isolines(*grid, values, kLevels);
    if (!lines) return lines.error();
    for (const Isoline& line : *lines) {
      const auto tone = std::ranges::find(kLevels, line.value) - kLevels.begin();
      Outline outline;
      for (const SurfacePoint& point : line.path.points) {
        outline.push_back(refined(*grid, values, point));
      }
      out[static_cast<std::size_t>(tone)].outlines.push_back(std::move(outline));
    }
    return out;
  }

 private:
  /// The grid reaches one step beyond the picture, so that all outlines are closed.
  Vector2d place(Index point) const {
    return {(point % columns_ - 1) * step_, (point / columns_ - 1) * step_};
  }

  std::vector<Face> cells() const {
    std::vector<Face> faces;
    for (Index j = 0; j + 1 < rows_; ++j) {
      for (Index i = 0; i + 1 < columns_; ++i) {
        const Index a = j * columns_ + i;
        faces.push_back({a, a + 1, a + columns_ + 1});
        faces.push_back({a, a + columns_ + 1, a + columns_});
      }
    }
    return faces;
  }

  double brightness(const Vector2d& pixel) const {
    const LineView::Ray ray = view_.ray_through(pixel);
    const auto hit = tree_.first_hit(ray.origin, ray.direction);
    if (!hit) return kNothing;
    const Face& face = mesh_.faces()[hit->point.face];
    Vec3 normal = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      normal += hit->point.weights[k] * normals_[static_cast<std::size_t>(face[k])];
    }
    normal.stableNormalize();
    if (normal.dot(ray.direction) > 0) normal = -normal;  // the inner side is lit as well
    return std::clamp(normal.dot(light_), 0.0, 1.0);
  }

  /// Where a contour crosses an edge of the grid that leaves the surface, it is the surface's rim.
  Vector2d refined(const TriangleMesh& grid, const std::vector<double>& values,
                   const SurfacePoint& point) {
    const Vec3 linear = position_at(grid, point);
    if (point.is_vertex()) return linear.head<2>();
    std::vector<Index> ends;
    for (std::size_t k = 0; k < 3; ++k) {
      if (point.weights[k] > 0) ends.push_back(grid.faces()[point.face][k]);
    }
    std::ranges::sort(ends);
    const auto shows = [&](Index v) { return values[static_cast<std::size_t>(v)] != kNothing; };
    if (ends.size() != 2 || shows(ends[0]) == shows(ends[1])) return linear.head<2>();
    const auto [known, is_new] = rim_.try_emplace(std::pair(ends[0], ends[1]));
    if (is_new) {
      if (shows(ends[1])) std::swap(ends[0], ends[1]);
      known->second = rim_between(place(ends[0]), place(ends[1]));
    }
    return known->second;
  }

  Vector2d rim_between(Vector2d inside, Vector2d outside) const {
    constexpr int kHalvings = 6;
    for (int i = 0; i < kHalvings; ++i) {
      const Vector2d middle = (inside + outside) / 2;
      (brightness(middle) != kNothing ? inside : outside) = middle;
    }
    return (inside + outside) / 2;
  }

  const TriangleMesh& mesh_;
  const RayTree& tree_;
  const LineView& view_;
  std::vector<Vec3> normals_;
  double step_;
  Index columns_, rows_;
  Vec3 light_;
  std::map<std::pair<Index, Index>, Vector2d> rim_;
};

}  // namespace

Result<std::vector<Tone>> surface_tones(const TriangleMesh& mesh, const RayTree& tree,
                                        const LineView& view, int width, int height,
                                        const Progress& progress) {
  return Grid(mesh, tree, view, width, height).tones(progress);
}

}  // namespace geotherm::app
