// SPDX-License-Identifier: MIT
#include "bench/models/noise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace geotherm::generate {
namespace {

/// Mixes 32 bits so that each input bit moves every output bit (the "lowbias32" constants).
std::uint32_t mix(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  x ^= x >> 16;
  return x;
}

std::uint32_t bits(std::int32_t v) { return static_cast<std::uint32_t>(v); }

// A point's hash in three steps, as neighbours share the first two.
std::uint32_t hash_z(std::int32_t z, std::uint32_t seed) {
  return mix(bits(z) + seed * 0xc2b2ae3dU);
}
std::uint32_t hash_y(std::int32_t y, std::uint32_t rest) {
  return mix(bits(y) * 0x85ebca77U + rest);
}
std::uint32_t hash_x(std::int32_t x, std::uint32_t rest) {
  return mix(bits(x) * 0x9e3779b1U + rest);
}

/// The product with one of the twelve directions to the middles of a cube's edges.
double gradient_dot(std::uint32_t h, double x, double y, double z) {
  const std::uint32_t k = h % 12;
  const double a = k < 8 ? x : y;
  const double b = k < 4 ? y : z;
  return ((h & 0x10000U) ? a : -a) + ((h & 0x20000U) ? b : -b);
}

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

double mix_values(double a, double b, double t) { return a + t * (b - a); }

}  // namespace

double hash_unit(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
  return hash_x(x, hash_y(y, hash_z(z, seed))) * (1.0 / 4294967296.0);
}

double gradient_noise(const Vec3& p, std::uint32_t seed) {
  const std::array<double, 3> low = {std::floor(p.x()), std::floor(p.y()), std::floor(p.z())};
  const auto ix = static_cast<std::int32_t>(low[0]);
  const auto iy = static_cast<std::int32_t>(low[1]);
  const auto iz = static_cast<std::int32_t>(low[2]);
  const double x = p.x() - low[0];
  const double y = p.y() - low[1];
  const double z = p.z() - low[2];
  const double u = fade(x);
  const double v = fade(y);
  const std::uint32_t near = hash_z(iz, seed);
  const std::uint32_t far = hash_z(iz + 1, seed);
  const auto row = [&](std::int32_t j, std::uint32_t rest, double zk) {
    const std::uint32_t here = hash_y(iy + j, rest);
    return mix_values(gradient_dot(hash_x(ix, here), x, y - j, zk),
                      gradient_dot(hash_x(ix + 1, here), x - 1, y - j, zk), u);
  };
  return mix_values(mix_values(row(0, near, z), row(1, near, z), v),
                    mix_values(row(0, far, z - 1), row(1, far, z - 1), v), fade(z));
}

double fractal_noise(const Vec3& p, int octaves, std::uint32_t seed) {
  double sum = 0;
  double height = 1;
  Vec3 q = p;
  for (int i = 0; i < octaves; ++i) {
    sum += height * gradient_noise(q, seed + static_cast<std::uint32_t>(i));
    height *= 0.5;
    q = 2 * q + Vec3(0.37, 0.61, 0.13);  // shifted, or all octaves would vanish at the same points
  }
  return sum;
}

double ridged_noise(const Vec3& p, int octaves, std::uint32_t seed) {
  double sum = 0;
  double total = 0;
  double height = 1;
  double weight = 1;
  Vec3 q = p;
  for (int i = 0; i < octaves; ++i) {
    const double n = gradient_noise(q, seed + static_cast<std::uint32_t>(i));
    const double crest = (1 - std::min(std::abs(n), 1.0)) * (1 - std::min(std::abs(n), 1.0));
    sum += height * weight * crest;
    total += height;
    weight = std::clamp(1.6 * crest * weight, 0.0, 1.0);
    height *= 0.5;
    q = 2 * q + Vec3(0.37, 0.61, 0.13);
  }
  return sum / total;
}

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace geotherm::generate
