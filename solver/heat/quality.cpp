// SPDX-License-Identifier: MIT
#include "solver/heat/quality.h"

#include <algorithm>
#include <cmath>

namespace geotherm {

double heat_residual(const FemOperator& matrix, const HeatField& heat, const Block& b,
                     Eigen::Index column) {
  const auto n = static_cast<std::size_t>(matrix.size());
  std::vector<double> u(n), product(n);
  for (std::size_t i = 0; i < n; ++i) {
    u[i] = heat.u(static_cast<Eigen::Index>(i), column);
    if (heat.level.empty()) continue;
    const int level =
        heat.level[i * static_cast<std::size_t>(heat.u.cols()) + static_cast<std::size_t>(column)];
    for (int k = 0; k < level && u[i] != 0; ++k) u[i] *= heat.step;
  }
  matrix.apply_free(u, product);
  double error = 0, norm = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (matrix.is_held(static_cast<Index>(i))) continue;
    const double right = b(static_cast<Eigen::Index>(i), column);
    error += (product[i] - right) * (product[i] - right);
    norm += right * right;
  }
  return norm > 0 ? std::sqrt(error / norm) : std::sqrt(error);
}

double poisson_residual(const OperatorMesh& mesh, std::span<const double> phi, const Block& b,
                        Eigen::Index column, const SourceAnchors& anchors, bool skip_anchors) {
  std::vector<double> product(phi.size(), 0.0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Face& face = mesh.faces[f];
    const auto g = gradient(mesh.layout[f], phi[face[0]], phi[face[1]], phi[face[2]]);
    const auto d = divergence(mesh.layout[f], g[0], g[1]);
    for (int k = 0; k < 3; ++k) product[face[k]] += d[k];
  }
  double error = 0, norm = 0;
  auto anchor = anchors.anchors.begin();
  for (std::size_t i = 0; i < phi.size(); ++i) {
    const bool here = anchor != anchors.anchors.end() && anchor->row == static_cast<Index>(i);
    if (here) ++anchor;
    const auto& at = anchors.components;
    if (!std::binary_search(at.begin(), at.end(), mesh.components.of[i])) continue;
    if (here && skip_anchors) continue;
    const double right = b(static_cast<Eigen::Index>(i), column);
    error += (product[i] - right) * (product[i] - right);
    norm += right * right;
  }
  return norm > 0 ? std::sqrt(error / norm) : std::sqrt(error);
}

FaceCounts inspect_faces(const OperatorMesh& mesh, const UnitField& field,
                         std::span<const double> phi, Eigen::Index column,
                         const SourceAnchors& anchors, std::span<const char> held_at_zero,
                         Quality& quality) {
  std::vector<char> held(phi.size(), 0);
  std::ranges::copy(held_at_zero, held.begin());
  for (const auto& anchor : anchors.anchors) held[anchor.row] = 1;
  std::vector<char> holds(static_cast<std::size_t>(mesh.components.count), 0);
  for (const Index c : anchors.components) holds[c] = 1;
  double error = 0, area = 0;
  FaceCounts faces;
  Index lost = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Face& face = mesh.faces[f];
    if (!holds[mesh.components.of[face[0]]]) continue;
    // In halves, since a face of a tufted cover is half of one of the surface.
    const Index halves = mesh.is_doubled(mesh.components.of[face[0]]) ? 1 : 2;
    faces.in_reach += halves;
    const auto x = field.of_face(f, column);
    const bool known = held[face[0]] && held[face[1]] && held[face[2]];
    if (x[0] == 0 && x[1] == 0) {
      faces.without_direction += halves;
      if (!known) lost += halves;
    }
    const auto g = gradient(mesh.layout[f], phi[face[0]], phi[face[1]], phi[face[2]]);
    const double face_area = mesh.layout[f].base * mesh.layout[f].height / 2;
    error += face_area * std::abs(std::hypot(g[0], g[1]) - 1);
    area += face_area;
  }
  faces.in_reach = (faces.in_reach + 1) / 2;
  faces.without_direction = (faces.without_direction + 1) / 2;
  quality.zero_gradient_faces = (lost + 1) / 2;
  quality.eikonal_error_mean = area > 0 ? error / area : 0.0;
  return faces;
}

}  // namespace geotherm
