// SPDX-License-Identifier: MIT
#include "solver/polyhedral/window_mesh.h"

#include <cmath>
#include <numbers>

#include "solver/core/sorting.h"

namespace geotherm {
namespace {

/// Angles up to this much above that of a plane count as flat: a shadow so narrow is lit from its
/// boundaries with an error of its square.
constexpr double kFlatVertex = 1e-9;

/// Two sides of an edge that are twins run opposite ways, also where both ends are one vertex; all
/// others are edges of the mesh itself, whose ends differ.
bool runs_opposite(const IntrinsicMesh& mesh, Side s, Side t) {
  if (mesh.twin[s] == t) return true;
  return mesh.faces[face_of(s)][corner_of(s)] != mesh.faces[face_of(t)][corner_of(t)];
}

/// The first corner of the fan that each corner belongs to.
std::vector<Index> fan_of_corners(const WaveSurface& surface) {
  DisjointSets fans(surface.edges().of_side.size());
  for (Index e = 0; e < surface.edge_count(); ++e) {
    const auto around = surface.sides_of(e);
    for (std::size_t i = 1; i < around.size(); ++i) {
      const Side s = around[0], t = around[i];
      const bool opposite = runs_opposite(surface.base.intrinsic, s, t);
      // Side s begins at corner s and ends at the next.
      const Side begin = opposite ? next_side(t) : t, end = opposite ? t : next_side(t);
      fans.join(s, begin);
      fans.join(next_side(s), end);
    }
  }
  return std::move(fans).roots();
}

}  // namespace

WindowMesh::WindowMesh(const WaveSurface& surface) : surface_(&surface) {
  lay_out_sides();
  find_corners();
  find_bends();
}

void WindowMesh::lay_out_sides() {
  const IntrinsicMesh& mesh = surface_->base.intrinsic;
  sides_.resize(3 * mesh.faces.size());
  for (Side s = 0; s < side_count(); ++s) {
    const auto& l = mesh.lengths[face_of(s)];
    const int k = corner_of(s);
    const FaceLayout layout = lay_out({l[k], l[next_corner(k)], l[previous_corner(k)]});
    std::int32_t across = kBoundary;
    const auto around = surface_->sides_of(surface_->edge_of_side(s));
    if (around.size() == 2) {
      const Side other = around[0] == s ? around[1] : around[0];
      across = 2 * other + (runs_opposite(mesh, s, other) ? 1 : 0);
    }
    sides_[s] = {layout.base,   1 / layout.base,           layout.x,
                 layout.height, mesh.faces[face_of(s)][k], across};
  }
  for (Index e = 0; e < surface_->edge_count(); ++e) {
    const auto around = surface_->sides_of(e);
    if (around.size() <= 2) continue;
    for (const Side s : around) sides_[s].across = kBranch - branch_count_;
    ++branch_count_;
  }
}

void WindowMesh::find_corners() {
  const auto vertices = static_cast<std::size_t>(surface_->base.mesh->vertex_count());
  const auto emit = [this](std::size_t s, const auto& put) {
    put(sides_[s].origin, next_side(static_cast<Side>(s)));
  };
  opposite_ = counting_sort<Side>(sides_.size(), vertices, 1, emit, first_opposite_);
  for (std::size_t v = 0; v < vertices; ++v) {
    vertices_in_use_ += first_opposite_[v] < first_opposite_[v + 1] ? 1 : 0;
  }
}

void WindowMesh::find_bends() {
  const std::vector<Index> fan = fan_of_corners(*surface_);
  const auto vertices = static_cast<std::size_t>(surface_->base.mesh->vertex_count());
  std::vector<double> angle(vertices, 0.0);
  std::vector<double> straight(vertices, 2 * std::numbers::pi);
  std::vector<Index> fan_of(vertices, kNoIndex);
  sends_.assign(vertices, 0);
  for (Side s = 0; s < side_count(); ++s) {
    const SideFrame& frame = side(s);
    const Index v = frame.origin, w = side(next_side(s)).origin;
    angle[v] += std::atan2(frame.apex_y, frame.apex_x);
    if (fan_of[v] == kNoIndex) fan_of[v] = fan[s];
    if (fan_of[v] != fan[s]) sends_[v] = 1;
    if (frame.across <= kBranch) sends_[v] = sends_[w] = 1;
    if (frame.across == kBoundary) straight[v] = straight[w] = std::numbers::pi;
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    if (angle[v] > straight[v] * (1 + kFlatVertex)) sends_[v] = 1;
  }
}

double WindowMesh::bytes() const {
  return static_cast<double>(sides_.size() * sizeof(SideFrame) + opposite_.size() * sizeof(Side) +
                             first_opposite_.size() * sizeof(std::uint32_t) + sends_.size());
}

}  // namespace geotherm
