// SPDX-License-Identifier: MIT
#include "engine/scene/colours.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "embedded/colour_map_cividis.h"
#include "embedded/colour_map_cool_warm.h"
#include "embedded/colour_map_grey.h"
#include "embedded/colour_map_inferno.h"
#include "embedded/colour_map_magma.h"
#include "embedded/colour_map_plasma.h"
#include "embedded/colour_map_red_blue.h"
#include "embedded/colour_map_red_yellow_blue.h"
#include "embedded/colour_map_turbo.h"
#include "embedded/colour_map_viridis.h"

namespace geotherm::engine {
namespace {

float linear_of(float c) {
  return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
}

float encoded(float c) {
  return c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1 / 2.4F) - 0.055F;
}

}  // namespace

glm::vec3 oklab_of(const glm::vec3& srgb) {
  const glm::vec3 c(linear_of(srgb.r), linear_of(srgb.g), linear_of(srgb.b));
  const float l = std::cbrt(0.4122214708F * c.r + 0.5363325363F * c.g + 0.0514459929F * c.b);
  const float m = std::cbrt(0.2119034982F * c.r + 0.6806995451F * c.g + 0.1073969566F * c.b);
  const float s = std::cbrt(0.0883024619F * c.r + 0.2817188376F * c.g + 0.6299787005F * c.b);
  return {0.2104542553F * l + 0.7936177850F * m - 0.0040720468F * s,
          1.9779984951F * l - 2.4285922050F * m + 0.4505937099F * s,
          0.0259040371F * l + 0.7827717662F * m - 0.8086757660F * s};
}

glm::vec3 srgb_of(const glm::vec3& oklab) {
  const float l = oklab.x + 0.3963377774F * oklab.y + 0.2158037573F * oklab.z;
  const float m = oklab.x - 0.1055613458F * oklab.y - 0.0638541728F * oklab.z;
  const float s = oklab.x - 0.0894841775F * oklab.y - 1.2914855480F * oklab.z;
  const glm::vec3 cube(l * l * l, m * m * m, s * s * s);
  return {encoded(4.0767416621F * cube.x - 3.3077115913F * cube.y + 0.2309699292F * cube.z),
          encoded(-1.2684380046F * cube.x + 2.6097574011F * cube.y - 0.3413193965F * cube.z),
          encoded(-0.0041960863F * cube.x - 0.7034186147F * cube.y + 1.7076147010F * cube.z)};
}

namespace {

/// What stands before `separator`; `text` keeps what follows it.
std::string_view take(std::string_view& text, char separator) {
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return part;
}

float number_in(std::string_view text) {
  float value = 0;
  [[maybe_unused]] const auto end =
      std::from_chars(text.data(), text.data() + text.size(), value).ptr;
  assert(end == text.data() + text.size() && "a colour map's asset is damaged");
  return value;
}

struct OwnedMap {
  ColourMap map;
  std::vector<glm::vec3> controls;
};

OwnedMap parse(std::span<const unsigned char> bytes) {
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  OwnedMap owned;
  while (!rest.empty()) {
    std::string_view line = take(rest, '\n');
    if (line.empty() || line.front() == '#') continue;
    const std::string_view word = take(line, ' ');
    if (word == "name") {
      owned.map.name = line;
    } else if (word == "description") {
      owned.map.description = line;
    } else if (word == "diverging") {
      owned.map.diverging = true;
    } else {
      const float green = number_in(take(line, ' '));
      owned.controls.push_back(glm::vec3(number_in(word), green, number_in(line)) / 255.0F);
    }
  }
  assert(!owned.map.name.empty() && owned.controls.size() >= 2);
  return owned;
}

struct Library {
  std::vector<OwnedMap> owned;
  std::vector<ColourMap> maps;
};

Library build_library() {
  using namespace embedded;
  Library library;
  for (const auto bytes :
       {colour_map_red_blue(), colour_map_viridis(), colour_map_cividis(), colour_map_magma(),
        colour_map_inferno(), colour_map_plasma(), colour_map_turbo(), colour_map_red_yellow_blue(),
        colour_map_cool_warm(), colour_map_grey()}) {
    library.owned.push_back(parse(bytes));
  }
  for (const OwnedMap& owned : library.owned) {
    library.maps.push_back(owned.map);
    library.maps.back().controls = owned.controls;
  }
  return library;
}

}  // namespace

std::span<const ColourMap> colour_maps() {
  static const Library kLibrary = build_library();
  return kLibrary.maps;
}

const ColourMap* find_colour_map(std::string_view name) {
  const auto maps = colour_maps();
  const auto found =
      std::find_if(maps.begin(), maps.end(), [&](const ColourMap& m) { return m.name == name; });
  return found == maps.end() ? nullptr : &*found;
}

glm::vec3 colour_at(const ColourMap& map, float x, bool reversed) {
  x = x > 0 ? std::min(x, 1.0F) : 0.0F;  // what is not a number goes to the lower end
  if (reversed) x = 1 - x;
  const float place = x * static_cast<float>(map.controls.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), map.controls.size() - 2);
  return glm::mix(map.controls[i], map.controls[i + 1], place - static_cast<float>(i));
}

ColourTable colour_table(const ColourMap& map, bool reversed) {
  ColourTable table;
  for (int i = 0; i < kColourSteps; ++i) {
    const float x = static_cast<float>(i) / (kColourSteps - 1);
    table[static_cast<std::size_t>(i)] = glm::vec4(colour_at(map, x, reversed), 1);
  }
  return table;
}

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
