// SPDX-License-Identifier: MIT
#include "app/picture/openness.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "solver/core/parallel.h"

namespace geotherm::app {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;
using Triangle = std::array<std::uint32_t, 3>;

/// Cells along a side of a depth map, which shows the scene's sphere.
constexpr int kCells = 128;
constexpr float kCell = 2.0F / kCells;
/// Smaller faces are found by their corners and middles alone.
constexpr float kSmallFace = 0.8F * kCell;
/// Along the surface depth maps say nothing, and little light comes from there.
constexpr float kMinCosine = 0.1F;

Vector3f vector(const PictureData::Vector& v) { return {v[0], v[1], v[2]}; }

/// How far the surface reaches along an axis, seen from both of its ends: its largest and its
/// least depth in each cell.
class DepthMap {
 public:
  explicit DepthMap(int axis) : highest_(kCells * kCells, -kFar), lowest_(kCells * kCells, kFar) {
    // Evenly over half a sphere: a spiral with steps of a golden angle.
    const float z = 1 - (static_cast<float>(axis) + 0.5F) / kOpennessAxes;
    const float turn = 2 * std::numbers::pi_v<float> * static_cast<float>(axis) / kGolden;
    const float r = std::sqrt(1 - z * z);
    along_ = {r * std::cos(turn), r * std::sin(turn), z};
    right_ = along_.unitOrthogonal();
    up_ = along_.cross(right_);
  }

  const Vector3f& along() const { return along_; }

  /// Where a point lies on the map: two coordinates in cells, and its depth.
  Vector3f place(const Vector3f& p) const {
    constexpr float kMiddle = kCells / 2.0F;
    return {right_.dot(p) * (kMiddle - 1) + kMiddle, up_.dot(p) * (kMiddle - 1) + kMiddle,
            along_.dot(p)};
  }

  void add_point(const Vector3f& placed) { add(cell(placed.x()), cell(placed.y()), placed.z()); }

  void add_face(const Vector3f& a, const Vector3f& b, const Vector3f& c) {
    const Vector2f ab = (b - a).head<2>(), ac = (c - a).head<2>();
    const float area = ab.x() * ac.y() - ab.y() * ac.x();
    if (!(std::abs(area) > 1e-6F)) return;
    const Vector3f low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    for (int y = cell(low.y()); y <= cell(high.y()); ++y) {
      for (int x = cell(low.x()); x <= cell(high.x()); ++x) {
        const Vector2f at =
            Vector2f(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F) - a.head<2>();
        const float u = (at.x() * ac.y() - at.y() * ac.x()) / area;
        const float v = (ab.x() * at.y() - ab.y() * at.x()) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        add(x, y, a.z() + u * (b.z() - a.z()) + v * (c.z() - a.z()));
      }
    }
  }

  /// How much of the light from both ends of the axis comes here, 0 to 1 each: in the four cells
  /// around the point nothing lies farther out by more than `slack`.
  std::array<float, 2> light(const Vector3f& placed, float slack) const {
    const float fx = placed.x() - 0.5F, fy = placed.y() - 0.5F;
    const int x = std::min(cell(fx), kCells - 2), y = std::min(cell(fy), kCells - 2);
    const float u = std::clamp(fx - static_cast<float>(x), 0.0F, 1.0F);
    const float v = std::clamp(fy - static_cast<float>(y), 0.0F, 1.0F);
    const std::array weights = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
    std::array<float, 2> out{};
    for (int k = 0; k < 4; ++k) {
      const auto i = static_cast<std::size_t>((y + k / 2) * kCells + x + k % 2);
      const float weight = weights[static_cast<std::size_t>(k)];
      if (highest_[i] <= placed.z() + slack) out[0] += weight;
      if (lowest_[i] >= placed.z() - slack) out[1] += weight;
    }
    return out;
  }

 private:
  static constexpr float kFar = 4;
  static constexpr float kGolden = std::numbers::phi_v<float>;

  /// The nearest one to places outside, which models that move may reach.
  static int cell(float x) { return x > 0 ? static_cast<int>(std::min(x, kCells - 1.0F)) : 0; }

  void add(int x, int y, float depth) {
    const auto i = static_cast<std::size_t>(y * kCells + x);
    highest_[i] = std::max(highest_[i], depth);
    lowest_[i] = std::min(lowest_[i], depth);
  }

  Vector3f along_, right_, up_;
  std::vector<float> highest_, lowest_;
};

/// The normal at each vertex, by the area of its faces; where faces are turned against each other,
/// on the side of the first one.
std::vector<Vector3f> vertex_normals_in_scene(std::span<const PictureData::Vector> positions,
                                              std::span<const Triangle> faces) {
  std::vector<Vector3f> normals(positions.size(), Vector3f::Zero());
  for (const Triangle& t : faces) {
    const Vector3f a = vector(positions[t[0]]);
    Vector3f area = (vector(positions[t[1]]) - a).cross(vector(positions[t[2]]) - a);
    for (const std::uint32_t v : t) {
      normals[v] += normals[v].dot(area) < 0 ? Vector3f(-area) : area;
    }
  }
  for (Vector3f& normal : normals) normal.stableNormalize();
  return normals;
}

bool is_small(std::span<const PictureData::Vector> positions, const Triangle& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3f side = vector(positions[t[k]]) - vector(positions[t[(k + 1) % 3]]);
    if (!(side.squaredNorm() < kSmallFace * kSmallFace)) return false;
  }
  return true;
}

DepthMap depth_map(int axis, std::span<const PictureData::Vector> positions,
                   std::span<const Triangle> faces, std::span<const char> small) {
  DepthMap map(axis);
  std::vector<Vector3f> placed;
  placed.reserve(positions.size());
  for (const PictureData::Vector& p : positions) placed.push_back(map.place(vector(p)));
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto [a, b, c] = faces[f];
    if (small[f] != 0) {
      map.add_point(placed[a]);
      map.add_point((placed[a] + placed[b] + placed[c]) / 3);
    } else {
      map.add_face(placed[a], placed[b], placed[c]);
    }
  }
  return map;
}

/// The shares of both sides of a normal that the maps see from here.
PictureData::Openness seen_from(const Vector3f& p, const Vector3f& normal,
                                std::span<const DepthMap> maps) {
  PictureData::Openness out{{normal.x(), normal.y(), normal.z()}, 1, 1};
  if (!(normal.squaredNorm() > 0.5F)) return out;
  float front = 0, back = 0, all = 0;
  for (const DepthMap& map : maps) {
    const float cosine = map.along().dot(normal);
    const float weight = std::abs(cosine);
    if (weight < kMinCosine) continue;
    // Within a cell the surface itself rises by its slope.
    const float slack = kCell * (1 + 1.5F * std::sqrt(1 - weight * weight) / weight);
    const auto [ahead, behind] = map.light(map.place(p), slack);
    front += weight * (cosine > 0 ? ahead : behind);
    back += weight * (cosine > 0 ? behind : ahead);
    all += weight;
  }
  out.front = front / all;
  out.back = back / all;
  return out;
}

/// Means over the faces around each vertex: the maps' cells do not show.
void smooth(std::vector<PictureData::Openness>& all, std::span<const Triangle> faces) {
  struct Sum {
    float front = 0, back = 0, count = 0;
  };
  std::vector<Sum> sums(all.size());
  for (const Triangle& t : faces) {
    for (const std::uint32_t v : t) {
      for (const std::uint32_t w : t) {
        const PictureData::Openness& other = all[w];
        const bool same = vector(all[v].normal).dot(vector(other.normal)) >= 0;
        sums[v].front += same ? other.front : other.back;
        sums[v].back += same ? other.back : other.front;
        ++sums[v].count;
      }
    }
  }
  for (std::size_t v = 0; v < all.size(); ++v) {
    if (sums[v].count == 0) continue;
    all[v].front = sums[v].front / sums[v].count;
    all[v].back = sums[v].back / sums[v].count;
  }
}

}  // namespace

std::vector<PictureData::Openness> openness_of(std::span<const PictureData::Vector> positions,
                                               std::span<const Triangle> faces) {
  const std::vector<Vector3f> normals = vertex_normals_in_scene(positions, faces);
  std::vector<char> small;
  small.reserve(faces.size());
  for (const Triangle& t : faces) small.push_back(static_cast<char>(is_small(positions, t)));

  constexpr double kNanosecondsAFace = 4 * kOpennessAxes;
  const int threads =
      threads_worth(thread_count(0), kNanosecondsAFace * static_cast<double>(faces.size()));
  std::vector<DepthMap> maps;
  for (int axis = 0; axis < kOpennessAxes; ++axis) maps.emplace_back(axis);
  run_calls(threads, kOpennessAxes, [&](int axis) {
    DepthMap& map = maps[static_cast<std::size_t>(axis)];
    map = depth_map(axis, positions, faces, small);
  });

  std::vector<PictureData::Openness> out(positions.size());
  constexpr std::size_t kAtOnce = 2048;
  run_calls(threads, static_cast<int>((out.size() + kAtOnce - 1) / kAtOnce), [&](int piece) {
    const std::size_t from = static_cast<std::size_t>(piece) * kAtOnce;
    for (std::size_t v = from; v < std::min(from + kAtOnce, out.size()); ++v) {
      out[v] = seen_from(vector(positions[v]), normals[v], maps);
    }
  });
  constexpr int kPasses = 2;
  for (int i = 0; i < kPasses; ++i) smooth(out, faces);
  return out;
}

}  // namespace geotherm::app
