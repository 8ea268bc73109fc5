// SPDX-License-Identifier: MIT
#include "engine/scene/region_margins.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace geotherm::engine {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

class Margins {
 public:
  Margins(const SurfaceGeometry& geometry, std::span<const std::int32_t> regions,
          std::span<const float> distances)
      : geometry_(geometry),
        regions_(regions),
        distances_(distances),
        gradients_(geometry.positions.size(), glm::vec4(0)) {}

  std::vector<float> compute() {
    for (const Triangle& t : geometry_.faces) add_gradient(t);
    for (const Triangle& t : geometry_.faces) {
      for (std::size_t k = 0; k < 3; ++k) {
        add_other(t[k], t[(k + 1) % 3]);
        add_other(t[(k + 1) % 3], t[k]);
      }
    }
    std::vector<float> margins(regions_.size(), kNothingNear);
    for (const auto& [place, other] : others_) {
      const float continued =
          other.count > 0 ? other.sum / static_cast<float>(other.count) : other.least;
      float& margin = margins[place.first];
      margin = std::min(margin, std::max(continued, kMin));
    }
    std::ranges::replace(margins, kNothingNear, 1.0F);
    return margins;
  }

 private:
  static constexpr float kNothingNear = std::numeric_limits<float>::max();
  static constexpr float kMin = 1e-6F;

  /// How much farther a vertex is from the source of another region than from its own.
  struct Other {
    float sum = 0;  ///< of those found by gradients
    int count = 0;
    float least = kNothingNear;  ///< along edges
  };

  bool known(std::uint32_t v) const {
    constexpr float kLargest = 1e20F;
    return regions_[v] >= 0 && std::abs(distances_[v]) < kLargest;
  }

  /// Within one region, weighted by area.
  void add_gradient(const Triangle& t) {
    if (regions_[t[0]] != regions_[t[1]] || regions_[t[1]] != regions_[t[2]]) return;
    if (!known(t[0]) || !known(t[1]) || !known(t[2])) return;
    const glm::vec3 a = geometry_.positions[t[0]];
    const glm::vec3 b = geometry_.positions[t[1]] - a, c = geometry_.positions[t[2]] - a;
    const glm::vec3 normal = glm::cross(b, c);
    const float area = glm::length(normal);
    if (!(area > 0)) return;
    const float to_b = distances_[t[1]] - distances_[t[0]];
    const float to_c = distances_[t[2]] - distances_[t[0]];
    const glm::vec3 gradient =
        (to_b * glm::cross(c, normal) + to_c * glm::cross(normal, b)) / (area * area);
    for (const std::uint32_t v : t) gradients_[v] += glm::vec4(gradient * area, area);
  }

  void add_other(std::uint32_t v, std::uint32_t beyond) {
    if (regions_[v] == regions_[beyond]) return;
    const glm::vec3 way = geometry_.positions[v] - geometry_.positions[beyond];
    const float length = glm::length(way);
    Other& other = others_[{v, regions_[beyond]}];
    if (!known(v) || !known(beyond)) {
      other.least = std::min(other.least, length);
      return;
    }
    const float before = distances_[beyond] - distances_[v];
    other.least = std::min(other.least, before + length);
    const glm::vec4& gradient = gradients_[beyond];
    if (!(gradient.w > 0)) return;
    const float rise = glm::dot(glm::vec3(gradient), way) / gradient.w;
    other.sum += before + std::clamp(rise, -length, length);
    ++other.count;
  }

  SurfaceGeometry geometry_;
  std::span<const std::int32_t> regions_;
  std::span<const float> distances_;
  std::vector<glm::vec4> gradients_;  ///< times area; area
  std::map<std::pair<std::uint32_t, std::int32_t>, Other> others_;
};

}  // namespace

std::vector<float> region_margins(const SurfaceGeometry& geometry,
                                  std::span<const std::int32_t> regions,
                                  std::span<const float> distances) {
  if (distances.empty()) return std::vector<float>(regions.size(), 1.0F);
  return Margins(geometry, regions, distances).compute();
}

}  // namespace geotherm::engine
