// SPDX-License-Identifier: MIT
#include "solver/heat/near_march.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>

#include "solver/geometry/edit.h"
#include "solver/polyhedral/wave_surface.h"

namespace geotherm {
namespace {

/// Vertices that are walked around one source: some eight edges far on even meshes, for a few
/// hundredths of what a query of 15,000 vertices costs.
constexpr double kNearOfSource = 200;
/// And at most this share of all: on coarse meshes, too, most of the answer is heat's, so that
/// errors fall as meshes get finer.
constexpr double kNearShare = 0.07;
/// The march is made for at most so many sources: of more, each would have a small neighbourhood,
/// and all together would cost as much as the heat method.
constexpr std::size_t kMaxMarchSources = 64;

/// A disc of so many vertices of an even mesh is guessed this much larger.
constexpr double kRoom = 1.5;

/// The straight line may pass beside the side by this share of it, at a corner that both sides of
/// it meet.
constexpr double kCrossingTolerance = 1e-9;
/// Up to this share of the limit heat's distance does not count.
constexpr double kHeatless = 0.5;

/// Vertices that have a distance: a hash table with open addressing, as large as the march may get,
/// in place of an entry for every vertex of the mesh.
class Reached {
 public:
  struct Entry {
    Index vertex = kNoIndex;
    bool done = false;  ///< the distance is the last
    double distance = kUnreached;
  };

  explicit Reached(std::size_t count)
      : entries_(std::bit_ceil(4 * std::max<std::size_t>(count, 8))) {}

  /// The entry of a vertex, new where it had none.
  Entry& at(Index vertex) {
    Entry& entry = entries_[slot_of(vertex)];
    if (entry.vertex == kNoIndex) ++used_;
    entry.vertex = vertex;
    return entry;
  }
  /// So many more may come; entries are elsewhere after it.
  void make_room(std::size_t more) {
    if (2 * (used_ + more) < entries_.size()) return;
    const std::size_t size = std::bit_ceil(4 * (used_ + more));
    const std::vector<Entry> old = std::exchange(entries_, std::vector<Entry>(size));
    for (const Entry& entry : old) {
      if (entry.vertex != kNoIndex) entries_[slot_of(entry.vertex)] = entry;
    }
  }

 private:
  static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;  ///< 2^64 over the golden ratio

  std::size_t slot_of(Index vertex) const {
    const std::size_t mask = entries_.size() - 1;
    std::size_t slot = (static_cast<std::uint64_t>(vertex) * kGolden >> 32) & mask;
    while (entries_[slot].vertex != kNoIndex && entries_[slot].vertex != vertex) {
      slot = (slot + 1) & mask;
    }
    return slot;
  }

  std::vector<Entry> entries_;
  std::size_t used_ = 0;
};

double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

/// From the source, which is `from_a` away from a and `from_b` from b and lies beyond them, to
/// `target`; kUnreached where the straight line does not pass between a and b.
double straight_through(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                        const Eigen::Vector2d& target, double from_a, double from_b) {
  const Eigen::Vector2d side = b - a, apart = target - a;
  const double length = length_of(side.x(), side.y());
  const double along = (side.x() * apart.x() + side.y() * apart.y()) / length;
  const double height = std::abs(cross(side, apart)) / length;
  const double source = (length + (from_a - from_b) * (from_a + from_b) / length) / 2;
  const double square = (from_a - source) * (from_a + source);
  if (!(square >= -kCrossingTolerance * length * length)) return kUnreached;
  const double depth = std::sqrt(std::max(square, 0.0));
  const double crossing = source + (along - source) * depth / (depth + height);
  const bool passes =
      crossing >= -kCrossingTolerance * length && crossing <= (1 + kCrossingTolerance) * length;
  return passes ? length_of(along - source, depth + height) : kUnreached;
}

std::vector<NearDistance> march_over(std::span<const NearFace> near,
                                     std::span<const NearDistance> seeds, std::size_t count) {
  std::vector<std::int64_t> numbers;
  for (const NearFace& face : near)
    numbers.insert(numbers.end(), face.corners.begin(), face.corners.end());
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  const auto here = [&](std::int64_t number) {
    return static_cast<Index>(std::ranges::lower_bound(numbers, number) - numbers.begin());
  };
  std::vector<Face> faces;
  std::vector<FaceLayout> layout;
  for (const NearFace& face : near) {
    faces.push_back({here(face.corners[0]), here(face.corners[1]), here(face.corners[2])});
    layout.push_back(face.layout);
  }
  std::vector<NearDistance> from;
  for (const NearDistance& seed : seeds) from.push_back({here(seed.vertex), seed.distance});
  const CornerTable corners(static_cast<Index>(numbers.size()), faces);
  auto found = march_nearest(corners, faces, layout, from, count);
  for (NearDistance& each : found) each.vertex = numbers[static_cast<std::size_t>(each.vertex)];
  return found;
}

}  // namespace

std::size_t near_count(std::size_t sources, double faces) {
  if (sources > kMaxMarchSources) return 0;
  const double vertices = faces / 2;  // of a closed surface
  return static_cast<std::size_t>(
      std::min(kNearOfSource * static_cast<double>(sources), kNearShare * vertices));
}

std::vector<NearDistance> march_nearest(const CornerTable& corners, std::span<const Face> faces,
                                        std::span<const FaceLayout> layout,
                                        std::span<const NearDistance> seeds, std::size_t count) {
  std::vector<NearDistance> out;
  if (count == 0) return out;
  using Waiting = std::pair<double, Index>;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting;
  Reached reached(count);
  const auto lower = [&waiting](Reached::Entry& entry, double distance) {
    if (!(distance < entry.distance)) return;
    entry.distance = distance;
    waiting.emplace(distance, entry.vertex);
  };
  reached.make_room(seeds.size());
  for (const NearDistance& seed : seeds)
    lower(reached.at(static_cast<Index>(seed.vertex)), seed.distance);
  while (!waiting.empty() && out.size() < count) {
    const double distance = waiting.top().first;
    const Index vertex = waiting.top().second;
    waiting.pop();
    if (std::exchange(reached.at(vertex).done, true)) continue;
    out.push_back({vertex, distance});
    reached.make_room(2 * corners.at(vertex).size());
    for (const Side corner : corners.at(vertex)) {
      const auto f = static_cast<std::size_t>(face_of(corner));
      const int from = corner_of(corner), next = next_corner(from), last = previous_corner(from);
      Reached::Entry& a = reached.at(faces[f][next]);
      Reached::Entry& b = reached.at(faces[f][last]);
      if (a.done && b.done) continue;
      const auto place = corners_of(layout[f]);
      const auto along_edge = [&](Reached::Entry& entry, int to) {
        const Eigen::Vector2d side = place[to] - place[from];
        lower(entry, distance + length_of(side.x(), side.y()));
      };
      if (!a.done) along_edge(a, next);
      if (!b.done) along_edge(b, last);
      if (!a.done && !b.done) continue;
      Reached::Entry& target = a.done ? b : a;
      const int to = a.done ? last : next, other = a.done ? next : last;
      const double known = (a.done ? a : b).distance;
      lower(target, straight_through(place[from], place[other], place[to], distance, known));
    }
  }
  return out;
}

std::vector<NearDistance> march_around(std::span<const NearDistance> seeds, std::size_t count,
                                       double mean_edge,
                                       const std::function<NearFaces(double reach)>& within) {
  if (count == 0) return {};
  const auto each = static_cast<double>(count) / static_cast<double>(seeds.size());
  double reach = kRoom * mean_edge * std::sqrt(each / M_PI);
  for (;;) {
    const NearFaces near = within(reach);
    std::vector<NearDistance> found = march_over(near.faces, seeds, count);
    const double limit = found.back().distance;
    const bool enough = found.size() >= count;
    if ((enough && limit <= reach) || near.are_all) return found;
    reach = enough ? limit : 2 * reach;
  }
}

double share_of_heat(double distance, double limit) {
  if (!(limit > 0)) return 1;
  return std::clamp((distance / limit - kHeatless) / (1 - kHeatless), 0.0, 1.0);
}

}  // namespace geotherm
