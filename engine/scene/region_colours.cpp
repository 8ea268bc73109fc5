// SPDX-License-Identifier: MIT
#include "engine/scene/region_colours.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/scene/oklab.h"

namespace geotherm::engine {
namespace {

using Pair = std::pair<std::int32_t, std::int32_t>;

/// Tried out: the first twelve are farthest from each other with these.
constexpr std::array kLightness = {0.72, 0.58, 0.86};
constexpr double kChroma = 0.18;
constexpr double kFirstHue = 0.375;  // of a turn

template <class T>
void sort_unique(std::vector<T>& all) {
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

/// Each region (first) with the lower ones beside it.
std::vector<Pair> borders(std::span<const std::array<std::uint32_t, 3>> faces,
                          std::span<const std::int32_t> regions) {
  std::vector<Pair> pairs;
  for (const auto& face : faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = regions[face[k]];
      const std::int32_t b = regions[face[(k + 1) % 3]];
      if (a != b && std::min(a, b) >= 0) pairs.emplace_back(std::max(a, b), std::min(a, b));
    }
  }
  sort_unique(pairs);
  return pairs;
}

std::array<glm::vec3, kRegionColours> palette_in_oklab() {
  std::array<glm::vec3, kRegionColours> palette{};
  for (std::uint32_t i = 0; i < kRegionColours; ++i) palette[i] = oklab_of(region_colour(i));
  return palette;
}

/// The colour for region r, which must not look like those of `beside`.
std::uint32_t colour_beside(std::int32_t r, std::span<const std::uint32_t> beside,
                            const std::array<glm::vec3, kRegionColours>& palette) {
  std::uint32_t best = 0;
  float best_distance = -1;
  for (std::uint32_t step = 0; step < kRegionColours && best_distance < kDistinct; ++step) {
    const std::uint32_t i = (static_cast<std::uint32_t>(r) + step) % kRegionColours;
    float distance = std::numeric_limits<float>::max();
    for (const std::uint32_t other : beside) {
      distance = std::min(distance, glm::length(palette[i] - palette[other]));
    }
    if (distance > best_distance) {
      best = i;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace

glm::vec3 region_colour(std::uint32_t i) {
  const double hue = 2 * std::numbers::pi * std::fmod(kFirstHue + i / std::numbers::phi, 1.0);
  const double lightness = kLightness[i % kLightness.size()];
  glm::vec3 colour(0);
  // No screen shows all hues as strong.
  for (double chroma = kChroma; chroma > 0.01; chroma *= 0.97) {
    colour = srgb_of(glm::vec3(lightness, chroma * std::cos(hue), chroma * std::sin(hue)));
    const glm::vec3 shown = glm::clamp(colour, 0.0F, 1.0F);
    if (shown == colour) break;
  }
  return glm::clamp(colour, 0.0F, 1.0F);
}

ColourTable region_table() {
  ColourTable table{};
  for (std::uint32_t i = 0; i < kColourSteps; ++i) {
    table[i] = i < kRegionColours ? glm::vec4(region_colour(i), 1) : table[i - kRegionColours];
  }
  return table;
}

std::vector<std::int32_t> region_colour_places(std::span<const std::array<std::uint32_t, 3>> faces,
                                               std::span<const std::int32_t> regions) {
  const auto palette = palette_in_oklab();
  const std::vector<Pair> pairs = borders(faces, regions);
  std::vector<std::int32_t> known(regions.begin(), regions.end());
  sort_unique(known);
  const auto place_of = [&known](std::int32_t r) {
    return static_cast<std::size_t>(std::lower_bound(known.begin(), known.end(), r) -
                                    known.begin());
  };
  std::vector<std::uint32_t> colours(known.size());
  auto pair = pairs.begin();
  std::vector<std::uint32_t> beside;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] < 0) continue;
    beside.clear();
    for (; pair != pairs.end() && pair->first == known[i]; ++pair) {
      beside.push_back(colours[place_of(pair->second)]);
    }
    colours[i] = colour_beside(known[i], beside, palette);
  }
  std::vector<std::int32_t> out;
  out.reserve(regions.size());
  for (const std::int32_t r : regions) {
    out.push_back(r < 0 ? -1 : static_cast<std::int32_t>(colours[place_of(r)]));
  }
  return out;
}

}  // namespace geotherm::engine
