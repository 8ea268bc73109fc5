// SPDX-License-Identifier: MIT
#include "solver/polyhedral/wave_places.h"

#include "solver/core/parallel.h"

namespace geotherm {
namespace {

/// Bits of a coordinate in a Morton number; three of them fill 63.
constexpr int kMortonBits = 21;

/// Minimum vertices per thread.
constexpr std::int64_t kMinVerticesPerThread = 1 << 13;

/// Spreads the low bits so that two zeros follow each.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffff;
  x = (x | x << 16) & 0x001f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

}  // namespace

std::vector<std::uint64_t> morton_numbers(const IntrinsicSurface& base, int threads) {
  Vec3 low = Vec3::Constant(kUnreached), high = -low;
  for (Index v = 0; v < base.vertex_count(); ++v) {
    if (!is_used(base, v)) continue;
    low = low.cwiseMin(base.position(v));
    high = high.cwiseMax(base.position(v));
  }
  const Vec3 origin = low / 2;  // halves, because the extent may be beyond the doubles' range
  const double extent = (high / 2 - origin).maxCoeff();
  const double steps = extent > 0 ? ((1 << kMortonBits) - 1) / extent : 0.0;
  std::vector<std::uint64_t> out(static_cast<std::size_t>(base.vertex_count()), 0);
  parallel_for(threads, base.vertex_count(), kMinVerticesPerThread,
               [&](std::int64_t begin, std::int64_t end) {
                 for (auto v = static_cast<Index>(begin); v < static_cast<Index>(end); ++v) {
                   if (!is_used(base, v)) continue;
                   const Vec3 at = (base.position(v) / 2 - origin) * steps;
                   for (int c = 0; c < 3; ++c) {
                     out[v] |= spread(static_cast<std::uint64_t>(at(c))) << c;
                   }
                 }
               });
  return out;
}

}  // namespace geotherm
