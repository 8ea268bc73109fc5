// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geotherm/mesh.h"
#include "geotherm/types.h"

namespace geotherm {

/// To the side from which the corners run counter-clockwise; zero where the triangle has no area.
/// The same in any unit of lengths.
Vec3 unit_normal(const Vec3& a, const Vec3& b, const Vec3& c);

/// Gradient of the function that is linear on a triangle and has these values at its corners: the
/// vector g in its plane with g . e = (difference of the values) along every side e. Units: value
/// over length. The same to rounding in any unit of lengths and values. Zero where the triangle has
/// no area (height below 1e-14 of its longest side) or a value is not finite.
Vec3 triangle_gradient(const std::array<Vec3, 3>& corners, const std::array<double, 3>& values);

/// The gradient on every face: `values` has one entry a vertex (V), the result one vector a face
/// (F). Cost: O(F). Source: Botsch et al., Polygon Mesh Processing (2010), equation 3.8.
std::vector<Vec3> face_gradients(const TriangleMesh& mesh, std::span<const double> values);

}  // namespace geotherm
