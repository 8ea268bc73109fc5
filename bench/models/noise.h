// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "geotherm/types.h"

namespace geotherm::generate {

/// A number in [0, 1) that depends on its arguments alone: the only randomness of the models.
double hash_unit(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed);

/// Gradient noise (Perlin 2002, quintic fade, hashed gradients): C2, about -1 to 1, 0 at every
/// point with whole coordinates, features of about unit size.
double gradient_noise(const Vec3& p, std::uint32_t seed);

/// Sum of `octaves` gradient noises, each of twice the frequency and half the height of the last.
double fractal_noise(const Vec3& p, int octaves, std::uint32_t seed);

/// Ridged multifractal noise (Musgrave 1994): about 0 to 1, sharp crests, smooth valleys; an octave
/// counts more where the coarser ones are high.
double ridged_noise(const Vec3& p, int octaves, std::uint32_t seed);

/// 0 below `from`, 1 above `to`, a cubic between (from < to).
double smooth_step(double from, double to, double x);

}  // namespace geotherm::generate
