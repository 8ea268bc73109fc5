// SPDX-License-Identifier: MIT
#include "solver/heat/heat_direction.h"

#include <algorithm>
#include <cmath>

namespace geotherm {

std::vector<Vec3> heat_directions(const TriangleMesh& mesh, std::span<const double> log_heat) {
  const std::span<const Vec3> positions = mesh.positions();
  std::vector<Vec3> out;
  out.reserve(static_cast<std::size_t>(mesh.face_count()));
  for (const auto& [a, b, c] : mesh.faces()) {
    const double largest = std::max({log_heat[a], log_heat[b], log_heat[c]});
    if (!std::isfinite(largest)) {
      out.push_back(Vec3::Zero());
      continue;
    }
    // A factor that all corners share does not turn the gradient, and brings u back into range.
    const auto heat = [&](Index v) { return std::exp(log_heat[v] - largest); };
    const Vec3 gradient =
        triangle_gradient({positions[a], positions[b], positions[c]}, {heat(a), heat(b), heat(c)});
    out.push_back(gradient.isZero(0) ? Vec3::Zero() : Vec3(-gradient.stableNormalized()));
  }
  return out;
}

}  // namespace geotherm
