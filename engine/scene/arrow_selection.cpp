// SPDX-License-Identifier: MIT
#include "engine/scene/arrow_selection.h"

#include <algorithm>
#include <cmath>

namespace geotherm::engine {
namespace {

using Place = ArrowPlaces::Place;

constexpr float kMinFacing = 0.12F;  // cosine between a face's normal and the view: not edge-on
constexpr float kMinDepth = 1e-4F;
/// An arrow's share of the room between arrows, and of a large face.
constexpr float kLengthOfRoom = 0.92F, kLengthOfFace = 0.55F;
constexpr float kMaxOfRoom = 2;  ///< an arrow on a large face is at most so many rooms long
/// A face gets a grid of arrows when it is larger than this, in rooms.
constexpr float kLargeFace = 3.5F;
constexpr int kMaxOnASide = 400;

class Selector {
 public:
  Selector(const ArrowSurface& surface, const Camera& camera, const ArrowStyle& style, float scale,
           std::span<const glm::vec3> primary, std::span<const glm::vec3> secondary)
      : surface_(surface),
        camera_(camera),
        wanted_(style.spacing * scale),
        primary_(style.primary ? primary : std::span<const glm::vec3>()),
        secondary_(style.secondary ? secondary : std::span<const glm::vec3>()) {}

  ArrowSelection select() {
    if (primary_.empty() && secondary_.empty()) return {};
    constexpr float kReach = 1.0F;  // every point is at most this far from the origin
    const float nearest = std::max(-eye_z(glm::vec3(0)) - kReach, kMinDepth);
    for (const Place& place : surface_.places.places()) {
      // All that follow the first that is too close to its neighbours are closer still.
      if (place.spacing * pixels_per_unit(nearest) < wanted_) break;
      take(place);
    }
    return std::move(selection_);
  }

 private:
  float eye_z(const glm::vec3& p) const { return (camera_.view * glm::vec4(p, 1)).z; }
  float pixels_per_unit(float depth) const {
    return camera_.pixels_per_unit / (camera_.orthographic ? 1.0F : depth);
  }
  bool faces_the_eye(const glm::vec3& at, const glm::vec3& normal) const {
    const float facing = glm::dot(normal, camera_.to_eye(at));
    return (surface_.geometry.solid ? facing : std::abs(facing)) >= kMinFacing;
  }
  /// Within the picture or at most `margin` pixels from it.
  bool is_seen(const glm::vec3& at, float margin) const {
    const glm::vec3 p = camera_.project(at);
    return p.x >= -margin && p.y >= -margin && p.x <= camera_.extent.x + margin &&
           p.y <= camera_.extent.y + margin;
  }

  void take(const Place& place) {
    const float depth = -eye_z(place.centre);
    const float scale = pixels_per_unit(std::max(depth, kMinDepth));
    if (place.face_size * scale > kLargeFace * wanted_) {
      fill_face(place, depth);
    } else if (depth > kMinDepth && place.spacing * scale >= wanted_) {
      add(place.centre, place, scale);
    }
  }

  /// Arrows on a grid over a face that is much larger than the room for one.
  void fill_face(const Place& place, float depth) {
    const auto& t = surface_.geometry.faces[place.face];
    const glm::vec3 a = surface_.geometry.positions[t[0]];
    const glm::vec3 b = surface_.geometry.positions[t[1]];
    const glm::vec3 c = surface_.geometry.positions[t[2]];
    const float side = std::max({glm::length(b - a), glm::length(c - a), glm::length(c - b)});
    const float at_depth = std::max(depth, kMinDepth);
    const float cells = side * pixels_per_unit(at_depth) / (1.3F * wanted_);
    const int n = static_cast<int>(std::clamp(cells, 1.0F, static_cast<float>(kMaxOnASide)));
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        const auto size = static_cast<float>(n);
        const float u = (static_cast<float>(i) + 1.0F / 3) / size;
        const float v = (static_cast<float>(j) + 1.0F / 3) / size;
        const glm::vec3 at = a + u * (b - a) + v * (c - a);
        const float here = -eye_z(at);
        if (here > kMinDepth) add(at, place, pixels_per_unit(here), true);
      }
    }
  }

  void add(const glm::vec3& at, const Place& place, float scale, bool one_of_many = false) {
    const float room = wanted_ / scale;
    if (!is_seen(at, 2 * kMaxOfRoom * wanted_) || !faces_the_eye(at, place.normal)) return;
    const float of_face = one_of_many ? 0 : kLengthOfFace * place.face_size;
    const float full = std::clamp(of_face, kLengthOfRoom * room, kMaxOfRoom * room);
    glm::vec3 tail = at;
    const auto add_one = [&](std::span<const glm::vec3> field, std::vector<ArrowInstance>& to) {
      if (field.empty()) return;
      const glm::vec3 along = field[place.face] * full;
      if (along == glm::vec3(0)) return;
      if (tail == at) tail -= 0.5F * along;
      to.push_back({tail, along, place.normal, full});
    };
    add_one(primary_, selection_.primary);
    add_one(secondary_, selection_.secondary);
  }

  const ArrowSurface& surface_;
  const Camera& camera_;
  const float wanted_;
  std::span<const glm::vec3> primary_, secondary_;
  ArrowSelection selection_;
};

}  // namespace

ArrowSelection select_arrows(const ArrowSurface& surface, const Camera& camera,
                             const ArrowStyle& style, float scale,
                             std::span<const glm::vec3> primary,
                             std::span<const glm::vec3> secondary) {
  return Selector(surface, camera, style, scale, primary, secondary).select();
}

}  // namespace geotherm::engine
