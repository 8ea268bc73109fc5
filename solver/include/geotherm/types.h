// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>

// The numbers of the library. Lengths are in the model's own units, everywhere.
namespace geotherm {

/// Number of a vertex or a face: 0-based, in the order of the file.
using Index = std::int32_t;
inline constexpr Index kNoIndex = -1;

/// A point or a vector in the model's own units.
using Vec3 = Eigen::Vector3d;

/// The three corners of a triangle, as vertex numbers.
using Face = std::array<Index, 3>;

/// Distance of a vertex that no source can reach.
inline constexpr double kUnreached = std::numeric_limits<double>::infinity();

}  // namespace geotherm
