// SPDX-License-Identifier: MIT
#include "engine/scene/arrows.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace geotherm::engine {
namespace {

constexpr int kLastLevel = 34;  // kCoarsest / 2^17: below a millionth of the model's size

/// 21 bits of each coordinate of a point of [-1, 1]^3, interleaved.
std::uint64_t morton(const glm::vec3& p) {
  const auto spread = [](float x) {
    const float at = std::clamp((x + 1) * 0.5F, 0.0F, 1.0F) * 2097151.0F;
    auto v = static_cast<std::uint64_t>(at);
    v = (v | v << 32) & 0x1f00000000ffffULL;
    v = (v | v << 16) & 0x1f0000ff0000ffULL;
    v = (v | v << 8) & 0x100f00f00f00f00fULL;
    v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
    return (v | v << 2) & 0x1249249249249249ULL;
  };
  return spread(p.x) | spread(p.y) << 1 | spread(p.z) << 2;
}

/// The places taken so far on a grid, each cell a linked list.
class Taken {
 public:
  Taken(float cell, std::size_t expected)
      : cell_(cell), mask_(std::bit_ceil(2 * expected + 16) - 1), first_(mask_ + 1, -1) {}

  void add(const ArrowPlaces::Place& place) {
    const std::size_t slot = slot_of(key(place.centre));
    entries_.push_back({place.centre, place.normal, first_[slot]});
    first_[slot] = static_cast<int>(entries_.size()) - 1;
  }

  /// No place on the same side of the surface within one cell's width.
  bool has_room(const ArrowPlaces::Place& place) const {
    const glm::ivec3 centre = key(place.centre);
    for (int i = 0; i < 27; ++i) {
      const glm::ivec3 near = centre + glm::ivec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      for (int e = first_[slot_of(near)]; e >= 0; e = entries_[static_cast<std::size_t>(e)].next) {
        const Entry& entry = entries_[static_cast<std::size_t>(e)];
        const glm::vec3 away = entry.centre - place.centre;
        if (glm::dot(away, away) < cell_ * cell_ && glm::dot(entry.normal, place.normal) >= 0) {
          return false;
        }
      }
    }
    return true;
  }

 private:
  struct Entry {
    glm::vec3 centre, normal;
    int next;
  };
  glm::ivec3 key(const glm::vec3& p) const { return glm::ivec3(glm::floor(p / cell_)); }
  std::size_t slot_of(const glm::ivec3& k) const {
    const auto mix = static_cast<std::uint64_t>(static_cast<std::uint32_t>(k.x)) * 0x9e3779b1U ^
                     static_cast<std::uint64_t>(static_cast<std::uint32_t>(k.y)) * 0x85ebca77U ^
                     static_cast<std::uint64_t>(static_cast<std::uint32_t>(k.z)) * 0xc2b2ae3dU;
    return (mix ^ mix >> 17) & mask_;
  }

  float cell_;
  std::size_t mask_;
  std::vector<int> first_;
  std::vector<Entry> entries_;
};

float spacing_of(int level) {
  return ArrowPlaces::kCoarsest * std::exp2(-0.5F * static_cast<float>(level));
}

struct Drafted {
  ArrowPlaces::Place place;
  std::uint64_t code;
};

std::vector<Drafted> draft_places(const SurfaceGeometry& geometry) {
  std::vector<Drafted> drafts;
  drafts.reserve(geometry.faces.size());
  for (std::uint32_t f = 0; f < geometry.faces.size(); ++f) {
    const auto& t = geometry.faces[f];
    const glm::dvec3 a = geometry.positions[t[0]];
    const glm::dvec3 b = geometry.positions[t[1]];
    const glm::dvec3 c = geometry.positions[t[2]];
    const glm::dvec3 area = 0.5 * glm::cross(b - a, c - a);
    const double size = glm::length(area);
    if (!(size > 0)) continue;
    const glm::vec3 centre((a + b + c) / 3.0);
    drafts.push_back({{centre, f, glm::vec3(area / size), static_cast<float>(std::sqrt(size)), 0},
                      morton(centre)});
  }
  std::sort(drafts.begin(), drafts.end(), [](const Drafted& a, const Drafted& b) {
    return a.code != b.code ? a.code < b.code : a.place.face < b.place.face;
  });
  return drafts;
}

/// The first draft after `from` that lies in a later cell; cells are what the upper bits say.
std::size_t next_cell(const std::vector<Drafted>& drafts, std::size_t from, int bits) {
  const std::uint64_t cell = drafts[from].code >> bits;
  const auto is_here = [&](std::size_t i) { return drafts[i].code >> bits == cell; };
  std::size_t step = 1;
  while (from + step < drafts.size() && is_here(from + step)) step *= 2;
  std::size_t low = from + step / 2;  // in the cell
  std::size_t high = std::min(from + step, drafts.size());
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (is_here(middle) ? low : high) = middle;
  }
  return high;
}

/// Throws darts: the first open draft of each of the small cells is tried.
class DartBoard {
 public:
  explicit DartBoard(std::vector<Drafted> drafts)
      : drafts_(std::move(drafts)), chosen_(drafts_.size()) {
    places_.reserve(drafts_.size());
  }

  /// So full that what is left lies next to what was taken.
  bool full() const { return 4 * places_.size() >= drafts_.size(); }

  void throw_level(int level) {
    const float spacing = spacing_of(level);
    Taken taken(spacing, places_.size() * 4);
    for (const ArrowPlaces::Place& place : places_) taken.add(place);
    // Cells a quarter of the spacing wide hold more than enough candidates.
    const int bits = std::max(0, 63 - 3 * (level / 2 + 3));
    for (std::size_t i = 0, end = 0; i < drafts_.size(); i = end) {
      end = next_cell(drafts_, i, bits);
      while (i < end && chosen_[i]) ++i;
      if (i == end || !taken.has_room(drafts_[i].place)) continue;
      taken.add(drafts_[i].place);
      take(i, spacing);
    }
  }

  /// The rest, about twice as close together as the last level.
  std::vector<ArrowPlaces::Place> finish() {
    const float spacing = places_.empty() ? spacing_of(0) : 0.5F * places_.back().spacing;
    for (std::size_t i = 0; i < drafts_.size(); ++i) {
      if (!chosen_[i]) take(i, spacing);
    }
    return std::move(places_);
  }

 private:
  void take(std::size_t i, float spacing) {
    chosen_[i] = 1;
    places_.push_back(drafts_[i].place);
    places_.back().spacing = spacing;
  }

  std::vector<Drafted> drafts_;
  std::vector<char> chosen_;
  std::vector<ArrowPlaces::Place> places_;
};

}  // namespace

ArrowPlaces::ArrowPlaces(const SurfaceGeometry& geometry) {
  DartBoard board(draft_places(geometry));
  for (int level = 0; level <= kLastLevel && !board.full(); ++level) board.throw_level(level);
  places_ = board.finish();
}

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
