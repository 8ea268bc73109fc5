// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/picture/picture_data.h"

// How much of its surroundings a surface sees: what shades hollows in pictures (ambient occlusion).
namespace geotherm::app {

/// The openness of each vertex: of the half space on either side of its normal, the share that the
/// surface does not hide, weighted by the cosine to the normal; 1 on convex shapes. A vertex
/// without a normal is open to both sides. positions: V, within radius 1 of the origin; faces: F.
/// Found from depth maps of the surface along `kOpennessAxes` axes, so that hollows narrower than
/// about a hundredth of the model are not resolved. The same bits with any number of threads.
/// Cost: O(F) for each axis, about 0.6 us of processor time a face on all cores.
std::vector<PictureData::Openness> openness_of(std::span<const PictureData::Vector> positions,
                                               std::span<const std::array<std::uint32_t, 3>> faces);

/// Directions come in pairs, to both ends of an axis.
inline constexpr int kOpennessAxes = 24;

}  // namespace geotherm::app
