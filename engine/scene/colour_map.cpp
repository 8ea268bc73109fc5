// SPDX-License-Identifier: MIT
#include "engine/scene/colour_map.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstddef>
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

}  // namespace geotherm::engine
